// The program atlas-refine: mesh files in, the same files with a better atlas out.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <list>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "atlas_refine/refine.h"
#include "chart_words.h"
#include "collection.h"
#include "command_line.h"
#include "interrupt.h"
#include "io/input_file.h"
#include "io/mesh_file.h"
#include "number_files.h"
#include "output_file.h"
#include "progress_bar.h"
#include "report.h"
#include "trade_off.h"

namespace atlas_refine::cli {

namespace {

enum Exit {
  exit_done = 0,
  exit_internal_error = 1,
  exit_not_valid = 1,  // measure: the atlas it has printed the figures of
  exit_usage = 2,
  exit_bad_input = 3,
  exit_bound_not_reached = 4
};

/// Memory that is given back to the system comes back page by page, emptied, which takes its time (native/README.md, "Two
/// threads").
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the most there can be; and none of these two changes by itself from here on
  mallopt(M_TRIM_THRESHOLD, 256 * kMiB);
  mallopt(M_TOP_PAD, 16 * kMiB);
#endif
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of the whole program so far.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Errors are exactly one line: `atlas-refine: <thing>: <what is wrong>`.
int complain(const std::string& message, int exit_code) {
  std::string line = "atlas-refine: " + message;
  for (char& c : line) c = c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "%s\n", line.c_str());
  return exit_code;
}

int exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadOption:
      return exit_usage;
    case ErrorCode::BadInput:
      return exit_bad_input;
    case ErrorCode::BoundNotReached:
    case ErrorCode::NotCertified:
      return exit_bound_not_reached;
    case ErrorCode::Cancelled:
      return exit_interrupted;
  }
  return exit_internal_error;
}

/// Names the file, and the line where the library names a face.
int complain(const RefineError& error, const Collection& files) {
  if (error.code() == ErrorCode::Cancelled) return exit_interrupted;
  if (error.code() == ErrorCode::BadOption) return complain(error.what(), exit_usage);
  return complain(files.place_of_face(error.face()) + ": " + files.words_in_file(error.what(), error.face()),
                  exit_code_of(error.code()));
}

void check_outputs(const CommandLine& line) {
  const bool folder_missing = line.is_collection() && !std::filesystem::exists(line.output);
  if (line.is_collection()) check_folder_creatable(line.output);
  for (int k = 0; k < static_cast<int>(line.inputs.size()) && !folder_missing; ++k) check_writable(line.output_of(k));
  if (!line.is_collection() && !io::names_mesh_file(line.output))
    throw OutputError(line.output, "has an unknown format; OBJ files can be written, NAME.obj");
  if (line.report) check_writable(*line.report);
  for (int k = 0; k < static_cast<int>(line.inputs.size()) && line.report; ++k) {
    if (same_file(*line.report, line.output_of(k)))
      throw OutputError(*line.report, "is the output already, not a place for the report");
    if (same_file(*line.report, line.inputs[k])) throw OutputError(*line.report, "is the input, not a place for the report");
  }
  if (line.svg_folder) check_folder_creatable(*line.svg_folder);
  if (line.trade_off) {
    check_writable(*line.trade_off);
    check_writable(line.trade_off_picture());
  }
}

std::unique_ptr<DebugSink> pictures(const CommandLine& line) {
  if (!line.svg_folder) return nullptr;
  std::error_code error;
  std::filesystem::create_directory(*line.svg_folder, error);
  if (error) throw OutputError(*line.svg_folder, "cannot be created: " + error.message());
  return svg_sink(*line.svg_folder);
}

void set_groups(const CommandLine& line, const Collection& files, RefineOptions& options) {
  if (line.group_by == "material") files.group_by_material(options);
  if (line.group_by == "object") files.group_by_object(options);
  if (line.group_by == "tile") {
    TileGroups tiles = group_by_tile(files.atlas());
    options.groups = std::move(tiles.groups);
    options.group_origins = std::move(tiles.origins);
    options.group_names = std::move(tiles.names);
  }
}

/// What an artist may have meant to keep apart, where one atlas was made of it.
std::vector<std::string> shared_by(const CommandLine& line, const Collection& files) {
  std::vector<std::string> out;
  RefineOptions groups;
  if (line.group_by != "none") return out;
  files.group_by_material(groups);
  if (groups.group_names.size() > 1) {
    std::string names;
    for (std::size_t k = 0; k < groups.group_names.size() && k < 6; ++k) names += (k > 0 ? ", " : "") + groups.group_names[k];
    if (groups.group_names.size() > 6) names += " and " + std::to_string(groups.group_names.size() - 6) + " more";
    out.push_back("one atlas for " + names + "; --group-by material makes one for each");
  }
  if (const std::size_t tiles = group_by_tile(files.atlas()).origins.size(); tiles > 1)
    out.push_back("charts of " + std::to_string(tiles) + " UDIM tiles share one now; --group-by tile makes an atlas for each");
  return out;
}

RefineResult refine_with_progress(const Atlas& atlas, const RefineOptions& options, DebugSink* debug) {
  ProgressBar bar;
  const auto report_progress = [&bar](const Progress& progress) {
    bar.show(progress);
    return !interrupted();
  };
  return refine(atlas, options, report_progress, debug);
}

/// E_d without cuts at one bound after the other, as far as they can be reached; what holds a bound holds those below it too.
std::vector<PackingPoint> packing_curve(const Atlas& atlas, RefineOptions options) {
  options.seams = Seams::None;
  options.trade_off = false;
  options.point.reset();
  options.max_distortion.reset();
  options.max_stretch.reset();
  options.best_effort = options.relax = true;
  std::vector<PackingPoint> out;
  for (int percent = 60; percent <= 95; percent += 5) {
    options.pe_bound = 0.01 * percent;
    const RefineResult result = refine_with_progress(atlas, options, nullptr);
    if (result.bound_met) out.push_back({options.pe_bound, result.after.distortion});
  }
  for (std::size_t k = out.size(); k > 1; --k) out[k - 2].distortion = std::min(out[k - 2].distortion, out[k - 1].distortion);
  return out;
}

void add_trade_off(const CommandLine& line, const RefineResult& result, const std::vector<PackingPoint>& packing,
                   std::list<PendingFile>& pending) {
  const CutReport cuts = result.cuts.value_or(CutReport());
  const double pe = line.options.pe_bound;
  pending.emplace_back(*line.trade_off, trade_off_csv(pe, cuts.trade_off, packing));
  pending.emplace_back(line.trade_off_picture(), trade_off_svg(pe, cuts.trade_off, packing, cuts.chosen));
}

RepairWords words_of(const Collection& files, const RefineResult& result) {
  return [&](const Repair& repair) { return repair_words(repair, result, files); };
}

/// The results and the report appear together, or none does.
std::vector<FileReport> write_outputs(const CommandLine& line, const Collection& files, const RefineResult& result,
                                      const std::vector<PackingPoint>& packing, Times& times) {
  const InterruptScope ask(OnInterrupt::Ask);
  const auto start = std::chrono::steady_clock::now();
  const double used = processor_seconds();
  std::unique_ptr<PendingFolder> folder;
  if (line.is_collection()) folder = std::make_unique<PendingFolder>(line.output);
  std::list<PendingFile> pending;
  std::vector<FileReport> reports;
  for (int k = 0; k < files.file_count(); ++k) {
    const Collection::Output output = files.output(k, result);
    pending.emplace_back(line.output_of(k), output.bytes);
    reports.push_back({files.path(k), line.output_of(k), files.face_count_of(k), output.added_faces,
                       static_cast<int>(files.atlas_of(k).positions.size()), output.added_vertices});
  }
  times.write = seconds_since(start);
  times.files += processor_seconds() - used;
  if (line.report) pending.emplace_back(*line.report, json_report(line, reports, result, times, words_of(files, result)));
  if (line.trade_off) add_trade_off(line, result, packing, pending);
  if (interrupted()) throw RefineError(ErrorCode::Cancelled, "write", "cancelled");
  commit_together(pending);
  if (folder) folder->keep();
  return reports;
}

/// Groups that keep their UVs because no result of them holds: all others are written.
int complain_of_groups(const Collection& files, const RefineResult& result) {
  const auto is_left = [](const GroupReport& group) { return !group.reason.empty(); };
  const auto first = std::find_if(result.groups.begin(), result.groups.end(), is_left);
  if (first == result.groups.end()) return exit_done;
  const auto more = std::count_if(first + 1, result.groups.end(), is_left);
  const std::string others = more == 0 ? "" : " (and " + std::to_string(more) + " more)";
  return complain(files.place_of_face(-1) + ": " + first->name + others + " keeps its UVs, the rest is written: " + first->reason,
                  exit_bound_not_reached);
}

int run_refine(CommandLine line) {
  check_outputs(line);
  Collection files;
  try {
    Times times;
    auto start = std::chrono::steady_clock::now();
    for (const auto& input : line.inputs) files.add(input);
    if (line.keep_shape) line.options.keep_shape = files.of_atlas(read_flags(*line.keep_shape, files.face_count()));
    const int vertices = static_cast<int>(files.atlas().positions.size());
    if (line.no_seam) line.options.no_seam = read_edges(*line.no_seam, vertices);
    if (line.prefer_seam) line.options.prefer_seam = read_edges(*line.prefer_seam, vertices);
    if (line.locked) line.options.locked = files.of_atlas(read_flags(*line.locked, files.face_count()));
    if (line.importance) line.options.importance = files.of_atlas(read_importance(*line.importance, files.face_count()));
    set_groups(line, files, line.options);
    times.read = seconds_since(start);
    times.files = processor_seconds();

    const InterruptScope ask_and_exit(OnInterrupt::AskAndExit);
    const auto debug = pictures(line);
    start = std::chrono::steady_clock::now();
    RefineResult result = refine_with_progress(files.atlas(), line.options, debug.get());
    std::vector<PackingPoint> packing;
    if (line.trade_off) packing = packing_curve(files.atlas(), line.options);
    times.refine = seconds_since(start);
    for (std::string& warning : result.warnings) warning = with_place(warning, result, files);
    for (std::string& fallback : result.fallbacks) fallback = with_place(fallback, result, files);
    const std::vector<std::string> notes = files.notes();
    result.warnings.insert(result.warnings.begin(), notes.begin(), notes.end());
    if (result.intervention != Intervention::Unchanged) {
      const std::vector<std::string> shared = shared_by(line, files);
      result.warnings.insert(result.warnings.end(), shared.begin(), shared.end());
    }
    const std::vector<FileReport> reports = write_outputs(line, files, result, packing, times);
    std::fputs(summary(reports, result, times, words_of(files, result)).c_str(), stdout);
    return complain_of_groups(files, result);
  } catch (const RefineError& error) {
    return complain(error, files);
  }
}

int run_measure(const CommandLine& line) {
  Collection files;
  try {
    files.add(line.inputs.front());
    const Measures measures = measure(files.atlas(), line.options.box_aspect);
    Validity validity = validate(files.atlas());
    validity.problem = files.words_in_file(validity.problem, validity.face);
    validity.face = files.number_in_file(validity.face);
    const std::string text = line.json ? measures_json(line.inputs.front().string(), measures, validity, files.notes())
                                       : measures_table(measures, validity, files.notes());
    std::fputs(text.c_str(), stdout);
    return validity.valid() ? exit_done : exit_not_valid;
  } catch (const RefineError& error) {
    return complain(error, files);
  }
}

int run_job(const CommandLine& line) {
  switch (line.job) {
    case CommandLine::Job::Refine:
      return run_refine(line);
    case CommandLine::Job::Measure:
      return run_measure(line);
    case CommandLine::Job::PrintText:
      std::fputs(line.text.c_str(), stdout);
      return exit_done;
  }
  return exit_internal_error;
}

int run(int argc, char** argv) {
  const CommandLine line = parse_command_line(argc, argv);
  int code = exit_internal_error;
  try {
    code = run_job(line);
  } catch (const std::bad_alloc&) {
    return complain(line.inputs.front().string() + ": not enough memory for a mesh of this size", exit_bad_input);
  }
  if (std::fflush(stdout) != 0) throw OutputError("standard output", std::string("cannot be written: ") + std::strerror(errno));
  return code;
}

}  // namespace

}  // namespace atlas_refine::cli

int main(int argc, char** argv) {
  using namespace atlas_refine::cli;
  keep_freed_memory();
  install_interrupt_handler();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow any more is then an error like a full disk
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    return complain(error.what(), exit_usage);
  } catch (const atlas_refine::io::InputError& error) {
    return complain(error.path.string() + ": " + error.what(), exit_bad_input);
  } catch (const OutputError& error) {
    return complain(error.path.string() + ": " + error.what(), exit_usage);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), exit_internal_error);
  }
}
