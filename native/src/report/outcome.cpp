// Parts added up, and what is told of who took part.
#include "report/outcome.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "report/certify.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

std::vector<ChartReport> chart_reports(const InputAtlas& whole, const Participants& participants, const RefineOptions& options,
                                       const std::vector<Done>& done) {
  std::vector<ChartReport> out = reports_of_input(whole);
  for (const Done& d : done) {
    for (std::size_t k = 0; k < d.part.charts.size(); ++k) out[d.part.charts[k]] = d.outcome.charts[k];
  }
  const Freedoms freedom = freedom_of(whole.set, options);
  for (std::size_t k = 0; k < freedom.size(); ++k) {
    if (freedom[k] != Freedom::Bends) out[k].fate = freedom[k] == Freedom::Fixed ? Fate::Locked : Fate::Kept;
  }
  for (const LeftChart& left : participants.left) {
    out[left.chart].fate = Fate::Left;
    out[left.chart].reason = left.reason;
  }
  for (const Follower& follower : participants.followers) {
    ChartReport& own = out[follower.chart];
    const ChartReport& leader = out[follower.leader];
    own.fate = Fate::Stacked;
    own.stacked_on = follower.leader;
    own.distortion_after = leader.distortion_after;
    own.stretch_max = leader.stretch_max;
    // They cover the same of the texture, whatever they have of the surface.
    const double denser = own.area > 0 ? std::sqrt(leader.area / own.area) : 0;
    own.density_before = denser * leader.density_before;
    own.density_after = denser * leader.density_after;
  }
  return out;
}

std::vector<Measures> measures_of(const std::vector<Done>& done, Measures Outcome::*which) {
  std::vector<Measures> out;
  for (const Done& d : done) out.push_back(d.outcome.*which);
  return out;
}

std::vector<double> areas_of(const InputAtlas& whole, const std::vector<Done>& done) {
  std::vector<double> out;
  for (const Done& d : done) {
    double& area = out.emplace_back(0);
    for (const int k : d.part.charts) area += whole.set.charts[k].surface.area();
  }
  return out;
}

Triangulations sum(Triangulations a, const Triangulations& b) {
  for (auto count : {&Triangulations::fan_flipped, &Triangulations::ears_flipped, &Triangulations::not_convex})
    a.*count += b.*count;
  return a;
}

RectangleReport sum(RectangleReport a, const RectangleReport& b) {
  for (auto count : {&RectangleReport::tutte_charts, &RectangleReport::boxed_charts, &RectangleReport::holes_cut,
                     &RectangleReport::extra_corners, &RectangleReport::trails})
    a.*count += b.*count;
  a.packed_pe = std::min(a.packed_pe, b.packed_pe);
  return a;
}

CutReport sum(const CutReport& a, const CutReport& b) { return {.cuts = a.cuts + b.cuts, .tried = a.tried + b.tried}; }

}  // namespace

std::string name_of(int group, const RefineOptions& options) {
  const bool named = group < static_cast<int>(options.group_names.size()) && !options.group_names[group].empty();
  return named ? options.group_names[group] : "group " + std::to_string(group);
}

void summarise(const InputAtlas& whole, const Participants& participants, const RefineOptions& options,
               const std::vector<Done>& done, RefineResult& result) {
  const std::vector<double> areas = areas_of(whole, done);
  result.before = combined(measures_of(done, &Outcome::before), areas);
  result.after = combined(measures_of(done, &Outcome::after), areas);
  result.charts = chart_reports(whole, participants, options, done);
  for (int f = 0; f < whole.atlas.face_count(); ++f)
    result.face_charts.push_back(whole.set.corners[whole.atlas.face_offsets[f]].chart);
  result.bound_met = true;
  for (std::size_t k = 0; k < done.size(); ++k) {
    const auto& [part, outcome] = done[k];
    if (k == 0 || outcome.gap.value < result.gap.value) result.gap = outcome.gap;
    result.triangulations = sum(result.triangulations, outcome.triangulations);
    result.intervention = std::max(result.intervention, outcome.intervention);
    result.bound_met = result.bound_met && outcome.bound_met;
    result.price = std::max(result.price, outcome.price);
    result.ended = std::max(result.ended, outcome.ended);
    if (outcome.rectangles)
      result.rectangles = result.rectangles ? sum(*result.rectangles, *outcome.rectangles) : *outcome.rectangles;
    if (outcome.cuts) result.cuts = result.cuts ? sum(*result.cuts, *outcome.cuts) : *outcome.cuts;
    for (PieceReport piece : outcome.pieces) {
      piece.chart = part.charts[piece.chart];
      result.pieces.push_back(piece);
    }
    if (!options.groups.empty())
      result.groups.push_back({part.group, name_of(part.group, options), outcome.before.chart_count, outcome.intervention,
                               outcome.bound_met, outcome.reason, outcome.before, outcome.after, outcome.gap});
  }
}

void tell_of(const Participants& participants, const std::vector<Done>& done, Journal& journal) {
  std::map<std::string, std::vector<int>> left;
  for (const LeftChart& chart : participants.left) left[chart.reason].push_back(chart.chart);
  for (const auto& [reason, charts] : left)
    journal.warnings.push_back(charts_named(charts) + (charts.size() == 1 ? ": " : ": each ") + reason +
                               "; left as before, outside the atlas");
  std::vector<int> stacked;
  for (const Follower& follower : participants.followers) stacked.push_back(follower.chart);
  if (!stacked.empty())
    journal.warnings.push_back(charts_named(stacked) + ": on another chart of the same shape, kept there; the area counts once");
  if (!participants.unstacked.empty())
    journal.warnings.push_back(
        charts_named(participants.unstacked) +
        ": on another chart of the same shape, but of other polygons, which cannot follow its cuts; placed apart");
  const auto parted = [](const Done& d) {
    return d.outcome.intervention != Intervention::Unchanged && d.outcome.before.gap_between == 0;
  };
  if (std::any_of(done.begin(), done.end(), parted))
    journal.warnings.emplace_back(
        stacked.empty() ? "charts overlapped or touched each other in the input; each has a place of its own now"
                        : "other charts overlapped or touched each other in the input; each of these has a place of its own now");
  if (done.empty()) journal.warnings.emplace_back("no chart takes part: nothing was changed");
}

std::vector<int> tell_of_folds(const ChartSet& set, const Participants& participants, const std::vector<Done>& done,
                               Journal& journal) {
  constexpr int kStays = -1;
  std::vector<int> goes_with(set.charts.size(), kStays);
  for (const Done& d : done) {
    if (d.outcome.intervention == Intervention::Unchanged) continue;
    for (const int k : d.part.charts) goes_with[k] = k;
  }
  for (const Follower& follower : participants.followers) goes_with[follower.chart] = goes_with[follower.leader];
  std::vector<int> torn;
  for (const Fold& fold : set.folds) {
    const std::size_t before = torn.size();
    for (const FoldEdge& edge : fold.edges) {
      if (goes_with[edge.charts[0]] != goes_with[edge.charts[1]]) torn.push_back(edge.corner);
    }
    const std::size_t edges = torn.size() - before;
    if (edges == 0) continue;
    journal.repairs.push_back(
        {.what = "folded onto each other along " + std::to_string(edges) + (edges == 1 ? " edge, parted" : " edges, parted"),
         .charts = fold.charts});
  }
  return torn;
}

std::array<int, 2> ends_of_edge(const Atlas& atlas, int corner) {
  const auto end = std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), corner);
  const int next = corner + 1 < *end ? corner + 1 : *(end - 1);
  return {atlas.corner_vertices[corner], atlas.corner_vertices[next]};
}

void add_new_seams(const Atlas& input, const std::vector<int>& corners, RefineResult& result) {
  if (corners.empty()) return;
  std::set<std::pair<int, int>> edges;  // that a cut mesh still has
  for (std::size_t f = 0; result.cut && f + 1 < result.cut->face_offsets.size(); ++f) {
    const int begin = result.cut->face_offsets[f], end = result.cut->face_offsets[f + 1];
    for (int c = begin; c < end; ++c) {
      const int next = c + 1 < end ? c + 1 : begin;
      edges.insert(std::minmax(result.cut->corner_vertices[c], result.cut->corner_vertices[next]));
    }
  }
  auto& seams = result.cut ? result.cut->new_seams : result.new_seams;
  for (const int corner : corners) {
    const std::array<int, 2> ends = ends_of_edge(input, corner);
    if (!result.cut || edges.contains(std::minmax(ends[0], ends[1]))) seams.push_back(ends);
  }
}

}  // namespace atlas_refine
