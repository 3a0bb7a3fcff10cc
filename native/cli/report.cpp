// What the program tells: a JSON report, a summary for people, the table of `measure`.
#include "report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace atlas_refine::cli {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string dump(const Json& json) {
  // File names need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json to_json(const Measures& m) {
  return {{"pe", number(m.pe)},
          {"pe_fixed_aspect", number(m.pe_fixed_aspect)},
          {"box_width", number(m.box_width)},
          {"box_height", number(m.box_height)},
          {"unit_square_share", number(m.unit_square_share)},
          {"boundary_length", number(m.boundary_length)},
          {"seam_edges", m.seam_edges},
          {"chart_count", m.chart_count},
          {"smallest_chart", number(m.smallest_chart)},
          {"small_charts", m.small_charts},
          {"distortion", number(m.distortion)},
          {"distortion_to_input", number(m.distortion_to_input)},
          {"stretch_99", number(m.stretch_99)},
          {"stretch_max", number(m.stretch_max)},
          {"gap_between", number(m.gap_between)},
          {"gap_within", number(m.gap_within)}};
}

Json to_json(const Triangulations& t) {
  return {{"fan_flipped", t.fan_flipped}, {"ears_flipped", t.ears_flipped}, {"not_convex", t.not_convex}};
}

Json to_json(const Gap& gap) {
  return {{"value", number(gap.value)}, {"unit", gap.unit == Gap::Unit::BoxDiagonal ? "box_diagonal" : "long_side"}};
}

Json to_json(const RectangleOptions& o) {
  return {{"sigma", o.sigma}, {"candidates", o.candidates}, {"omega", o.omega}, {"until_input", o.until_input}};
}

Json to_json(const RectangleReport& r) {
  return {{"tutte_charts", r.tutte_charts},
          {"boxed_charts", r.boxed_charts},
          {"holes_cut", r.holes_cut},
          {"extra_corners", r.extra_corners},
          {"trails", r.trails},
          {"packed_pe", number(r.packed_pe)}};
}

Json to_json(const FileReport& file) {
  return {{"input", file.input.string()},    {"output", file.output.string()}, {"faces", file.faces},
          {"added_faces", file.added_faces}, {"vertices", file.vertices},      {"added_vertices", file.added_vertices}};
}

Json needed_options(const CommandLine& line) {
  const RefineOptions& o = line.options;
  return {{"max_boundary_growth", o.max_boundary_growth ? Json(*o.max_boundary_growth) : Json(nullptr)},
          {"seam_cost", o.seam_cost},
          {"effort", o.effort == Effort::Fast   ? "fast"
                     : o.effort == Effort::Best ? "best"
                                                : "normal"},
          {"trade_off", line.trade_off ? Json(line.trade_off->string()) : Json(nullptr)},
          {"point", o.point ? Json(*o.point) : Json(nullptr)}};
}

Json to_json(const CutReport& cuts) {
  Json trade_off = Json::array();
  for (const TradeOff& t : cuts.trade_off)
    trade_off.push_back({{"boundary_growth", number(t.boundary_growth)}, {"distortion", number(t.distortion)}, {"cuts", t.cuts}});
  return {{"cuts", cuts.cuts},
          {"tried", cuts.tried},
          {"trade_off", trade_off},
          {"chosen", cuts.chosen < 0 ? Json(nullptr) : Json(cuts.chosen)}};
}

Json to_json(const CommandLine& line) {
  const RefineOptions& o = line.options;
  return {{"pe_bound", o.pe_bound},
          {"seams", o.seams == Seams::Rectangles ? "rectangles"
                    : o.seams == Seams::Needed   ? "needed"
                                                 : "none"},
          {"cut", o.cut == Cut::Edges ? "edges" : "split"},
          {"rectangles", o.seams == Seams::Rectangles ? to_json(o.rectangles) : Json(nullptr)},
          {"box_aspect", o.box_aspect == 0 ? Json("free") : Json(o.box_aspect)},
          {"gap", o.gap ? to_json(*o.gap) : Json("automatic")},
          {"needed", o.seams == Seams::Needed ? needed_options(line) : Json(nullptr)},
          {"max_distortion", o.max_distortion ? Json(*o.max_distortion) : Json(nullptr)},
          {"max_stretch", o.max_stretch ? Json(*o.max_stretch) : Json(nullptr)},
          {"relax", o.relax},
          {"best_effort", o.best_effort},
          {"density", o.density == Density::Keep ? "keep" : "equal"},
          {"group_by", line.group_by},
          {"stacks", o.stacks == Stacks::Separate ? "separate" : "keep"},
          {"collapsed", o.collapsed == Collapsed::Embed ? "embed" : "leave"},
          {"open_closed", o.open_closed},
          {"triangulate", o.triangulate},
          {"reference", o.reference == Reference::Input ? "input" : "surface"},
          {"importance", line.importance ? Json(line.importance->string()) : Json(nullptr)},
          {"keep_shape", line.keep_shape ? Json(line.keep_shape->string()) : Json(nullptr)},
          {"locked", line.locked ? Json(line.locked->string()) : Json(nullptr)},
          {"no_seam", line.no_seam ? Json(line.no_seam->string()) : Json(nullptr)},
          {"prefer_seam", line.prefer_seam ? Json(line.prefer_seam->string()) : Json(nullptr)},
          {"rotate", o.rotate == Rotate::Any            ? "any"
                     : o.rotate == Rotate::QuarterTurns ? "90"
                                                        : "none"},
          {"align_axes", o.align_axes},
          {"seed", o.seed},
          {"threads", o.threads},
          {"svg", line.svg_folder ? Json(line.svg_folder->string()) : Json(nullptr)}};
}

Json to_json(const ChartReport& chart, std::size_t index) {
  return {{"index", index},
          {"faces", chart.faces},
          {"area", number(chart.area)},
          {"mirrored", chart.mirrored},
          {"re_embedded", chart.re_embedded},
          {"fate", to_string(chart.fate)},
          {"reason", chart.reason.empty() ? Json(nullptr) : Json(chart.reason)},
          {"stacked_on", chart.stacked_on < 0 ? Json(nullptr) : Json(chart.stacked_on)},
          {"distortion_before", number(chart.distortion_before)},
          {"distortion_after", number(chart.distortion_after)},
          {"stretch_max", number(chart.stretch_max)},
          {"density_before", number(chart.density_before)},
          {"density_after", number(chart.density_after)}};
}

Json to_json(const Repair& repair) {
  return {{"what", repair.what},
          {"charts", repair.charts},
          {"faces", repair.faces},
          {"distortion_to_input", number(repair.distortion_to_input)}};
}

Json to_json(const GroupReport& group) {
  return {{"group", group.group},
          {"name", group.name},
          {"charts", group.charts},
          {"intervention", to_string(group.intervention)},
          {"bound_met", group.bound_met},
          {"reason", group.reason.empty() ? Json() : Json(group.reason)},
          {"before", to_json(group.before)},
          {"after", to_json(group.after)},
          {"gap", to_json(group.gap)}};
}

Json to_json(const Profile& profile, double files) {
  Json phases = Json::object();
  for (const PhaseTime& time : profile.phases) phases[time.phase] = time.seconds;
  return {{"phases", phases}, {"files", files}, {"steps", profile.steps}, {"mean_step", profile.mean_step}};
}

template <class Entry>
Json list_of(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (const Entry& entry : entries) list.push_back(to_json(entry));
  return list;
}

Json to_json(const PieceReport& piece, std::size_t index) {
  return {{"index", index},
          {"chart", piece.chart},
          {"faces", piece.faces},
          {"area", number(piece.area)},
          {"distortion", number(piece.distortion)},
          {"stretch_max", number(piece.stretch_max)}};
}

/// Of each chart the first and last number of every run of faces of the input that it has.
std::vector<std::vector<std::array<int, 2>>> face_ranges(const RefineResult& result) {
  std::vector<std::vector<std::array<int, 2>>> ranges(result.charts.size());
  int previous = -1;
  for (int f = 0; f < static_cast<int>(result.face_charts.size()); ++f) {
    const int chart = result.face_charts[f];
    if (chart == previous)
      ranges[chart].back()[1] = f;
    else
      ranges[chart].push_back({f, f});
    previous = chart;
  }
  return ranges;
}

/// With the faces of those that are no part of the atlas.
Json charts_of(const RefineResult& result) {
  const auto ranges = face_ranges(result);
  Json list = Json::array();
  for (std::size_t k = 0; k < result.charts.size(); ++k) {
    const Fate fate = result.charts[k].fate;
    Json& chart = list.emplace_back(to_json(result.charts[k], k));
    chart["face_ranges"] = fate == Fate::Left || fate == Fate::Stacked ? Json(ranges[k]) : Json(nullptr);
  }
  return list;
}

template <class Entry>
Json numbered(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (std::size_t k = 0; k < entries.size(); ++k) list.push_back(to_json(entries[k], k));
  return list;
}

Json to_json(const Validity& validity) {
  return {{"valid", validity.valid()},
          {"problem", validity.problem},
          {"chart", validity.chart},
          {"face", validity.face},
          {"flipped_faces", validity.flipped_faces},
          {"mirrored_charts", validity.mirrored_charts},
          {"crossings", validity.crossings},
          {"triangulations", to_json(validity.triangulations)}};
}

template <class... Args>
std::string print(const char* format, Args... args) {
  char line[256];
  std::snprintf(line, sizeof line, format, args...);
  return line;
}

/// Growth of BL as a fraction of the input's; NaN where the input has no seam to compare with.
double seam_growth(const RefineResult& result) {
  const double before = result.before.boundary_length, after = result.after.boundary_length;
  if (after == before) return 0;
  return before > 0 ? (after - before) / before : std::nan("");
}

/// What the cut did, where there was one.
std::string cut_lines(const std::vector<FileReport>& files, const RefineResult& result) {
  if (!result.cut) return "";
  const Measures& before = result.before;
  const Measures& after = result.after;
  const double growth = seam_growth(result);
  std::string text = print("  seams BL     %.3f -> %.3f", before.boundary_length, after.boundary_length);
  text += std::isfinite(growth) ? print(" (+%.1f %%)\n", 100 * growth) : "\n";
  text += print("  charts       %d -> %d, smallest %.2f %% of the surface, %d under 3 %%\n", before.chart_count,
                after.chart_count, 100 * after.smallest_chart, after.small_charts);
  text += print("  E_2          %.4f\n", after.distortion_to_input);
  int added_faces = 0, added_vertices = 0;
  for (const FileReport& file : files) {
    added_faces += file.added_faces;
    added_vertices += file.added_vertices;
  }
  text += print("  added        %d faces, %d vertices\n", added_faces, added_vertices);
  if (!result.rectangles) return text;
  const RectangleReport& r = *result.rectangles;
  text += print("  rectangles   packed to %.4f, %d trails", r.packed_pe, r.trails);
  if (r.tutte_charts > 0) text += print(", %d charts embedded onto a rectangle", r.tutte_charts);
  if (r.extra_corners > 0) text += print(", %d extra corners a chart", r.extra_corners);
  text += "\n  seconds     ";
  for (const StageTime& stage : result.timings) text += print(" %s %.2f", stage.stage.c_str(), stage.seconds);
  return text + "\n";
}

/// A number, "-" of nothing: where no chart takes part.
std::string figure(const char* format, double value) { return std::isnan(value) ? "-" : print(format, value); }

/// A distance as fraction of the box diagonal, or "none" where there is nothing to be apart from.
std::string gap_text(double gap) { return std::isfinite(gap) ? print("%.5f of the diagonal", gap) : "none"; }

/// What was done to more charts than a reader wants lines of is one line.
std::vector<Repair> joined(const std::vector<Repair>& repairs) {
  constexpr int kMostLines = 5;
  std::map<std::string, int> count;
  for (const Repair& repair : repairs) ++count[repair.what];
  std::map<std::string, std::size_t> lines;
  std::vector<Repair> out;
  for (const Repair& repair : repairs) {
    const auto [line, is_first] = lines.try_emplace(repair.what, out.size());
    if (is_first || count[repair.what] <= kMostLines) {
      out.push_back(repair);
      continue;
    }
    Repair& all = out[line->second];
    all.charts.insert(all.charts.end(), repair.charts.begin(), repair.charts.end());
    all.faces.insert(all.faces.end(), repair.faces.begin(), repair.faces.end());
    all.distortion_to_input = std::max(all.distortion_to_input, repair.distortion_to_input);
  }
  return out;
}

}  // namespace

std::string json_report(const CommandLine& line, const std::vector<FileReport>& files, const RefineResult& result,
                        const Times& times, const RepairWords& words) {
  Json repairs = list_of(result.repairs);
  for (std::size_t k = 0; k < repairs.size(); ++k) repairs[k]["text"] = words(result.repairs[k]);
  Json file_list = Json::array();
  for (const FileReport& file : files) file_list.push_back(to_json(file));
  Json stages = Json::array();
  for (const StageTime& stage : result.timings) stages.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}});
  return dump({{"program", "atlas-refine"},
               {"version", version()},
               {"files", file_list},
               {"options", to_json(line)},
               {"intervention", to_string(result.intervention)},
               {"bound_met", result.bound_met},
               {"before", to_json(result.before)},
               {"after", to_json(result.after)},
               {"added_seam_edges", result.added_seams},
               {"added_seam_length", number(seam_growth(result))},
               {"boundary_growth", number(result.boundary_growth)},
               {"new_seams", result.new_seams},
               {"triangulations", to_json(result.triangulations)},
               {"gap", to_json(result.gap)},
               {"price", number(result.price)},
               {"iterations", result.iterations},
               {"ended", to_string(result.ended)},
               {"charts", charts_of(result)},
               {"pieces", numbered(result.pieces)},
               {"rectangles", result.rectangles ? to_json(*result.rectangles) : Json(nullptr)},
               {"cuts", result.cuts ? to_json(*result.cuts) : Json(nullptr)},
               {"groups", list_of(result.groups)},
               {"repairs", repairs},
               {"fallbacks", result.fallbacks},
               {"warnings", result.warnings},
               {"timings", stages},
               {"profile", to_json(result.profile, times.files)},
               {"seconds", {{"read", times.read}, {"refine", times.refine}, {"write", times.write}}}});
}

std::string summary(const std::vector<FileReport>& files, const RefineResult& result, const Times& times,
                    const RepairWords& words) {
  const Measures& before = result.before;
  const Measures& after = result.after;
  std::string text = std::string(to_string(result.intervention)) + (result.bound_met ? "" : ", bound not met") + ": " +
                     std::to_string(after.chart_count) + (after.chart_count == 1 ? " chart" : " charts") +
                     print(" in %.2f s, %d iterations\n", times.refine, result.iterations);
  text += print("  PE           %.4f -> %.4f\n", before.pe_fixed_aspect, after.pe_fixed_aspect);
  text += print("  box          %.3f x %.3f, %.1f %% of the unit square\n", after.box_width, after.box_height,
                100 * after.unit_square_share);
  text += "  E_d          " + figure("%.4f", before.distortion) + " -> " + figure("%.4f", after.distortion) + "\n";
  text += "  stretch 99%  " + figure("%.3f", before.stretch_99) + " -> " + figure("%.3f", after.stretch_99) + ", largest " +
          figure("%.3f", before.stretch_max) + " -> " + figure("%.3f", after.stretch_max) + "\n";
  text += print("  added seams  %d\n", result.added_seams);
  text += cut_lines(files, result);
  text += "  gap          " + gap_text(after.gap_between) + "\n";
  for (const GroupReport& group : result.groups)
    text += "  atlas        " + group.name +
            print(": %d charts, PE %.4f -> %.4f, E_d %.4f, ", group.charts, group.before.pe_fixed_aspect,
                  group.after.pe_fixed_aspect, group.after.distortion) +
            to_string(group.intervention) + "\n";
  for (const Repair& repair : joined(result.repairs)) text += "  repair: " + words(repair) + "\n";
  for (const std::string& fallback : result.fallbacks) text += "  fallback: " + fallback + "\n";
  for (const std::string& warning : result.warnings) text += "  warning: " + warning + "\n";
  return text;
}

std::string measures_json(const std::string& input, const Measures& measures, const Validity& validity,
                          const std::vector<std::string>& notes) {
  return dump({{"program", "atlas-refine"},
               {"version", version()},
               {"input", input},
               {"measures", to_json(measures)},
               {"validity", to_json(validity)},
               {"notes", notes}});
}

std::string measures_table(const Measures& m, const Validity& validity, const std::vector<std::string>& notes) {
  std::string text;
  const auto row = [&](const char* name, const std::string& value) { text += print("%-34s ", name) + value + "\n"; };
  row("packing efficiency (PE)", print("%.4f", m.pe));
  if (m.pe_fixed_aspect != m.pe) row("PE in a texture of the asked aspect", print("%.4f", m.pe_fixed_aspect));
  row("box", print("%.6g x %.6g", m.box_width, m.box_height));
  row("share of the unit square", print("%.1f %%", 100 * m.unit_square_share));
  row("charts (CN)", std::to_string(m.chart_count));
  row("smallest chart (SA)", print("%.4g of the surface", m.smallest_chart));
  row("charts under 3 % (N3)", std::to_string(m.small_charts));
  row("seam edges", std::to_string(m.seam_edges));
  row("seam length (BL)", print("%.4f of the mesh's diagonal", m.boundary_length));
  row("distortion (E_d)", print("%.4f", m.distortion));
  row("stretch, 99 %", print("%.3f", m.stretch_99));
  row("stretch, largest", print("%.3f", m.stretch_max));
  row("gap between charts", gap_text(m.gap_between));
  row("gap within charts", gap_text(m.gap_within));
  row("valid", validity.valid() ? "yes" : "no: " + validity.problem);
  if (!validity.valid())
    row("", print("%d flipped faces, %d mirrored charts, %d crossings", validity.flipped_faces, validity.mirrored_charts,
                  validity.crossings));
  for (const std::string& note : notes) text += "warning: " + note + "\n";
  return text;
}

}  // namespace atlas_refine::cli
