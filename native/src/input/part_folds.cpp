// Regions of faces that lie alike in the UV plane: the large ones are charts, the small ones defects.
#include "input/part_folds.h"

#include <algorithm>
#include <array>

#include "input/face_areas.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {

namespace {

// Shares of a chart's faces and of its area in space.
constexpr double kMinority = 0.25;  // turned over in all, at most, where they may count as defects
constexpr double kFew = 0.05;       // of one region

struct Amount {
  double area = 0;  // in space
  int faces = 0;

  Amount plus(const Amount& other) const { return {area + other.area, faces + other.faces}; }
  /// The larger of both shares.
  double share_of(const Amount& whole) const {
    const double of_faces = static_cast<double>(faces) / whole.faces;
    return whole.area > 0 ? std::max(of_faces, area / whole.area) : of_faces;
  }
};

/// A chart before it is parted: its faces that lie clockwise, wound as the chart is, and the others.
using Sides = std::array<Amount, 2>;

/// Faces that lie alike and are joined with each other.
struct Region {
  Amount amount;
  int fold_edges = 0;            // of its border: where it is joined with faces that lie the other way round
  int open_edges = 0;            // the rest of its border
  bool shares_vertices = false;  // across fold edges
};

/// Whether a region is to stay in its chart: it is an island, or it belongs to a small share of faces that are turned over.
bool is_defect(const Region& region, bool turned_over, const Sides& chart) {
  const Amount whole = chart[0].plus(chart[1]);
  const bool few = region.amount.share_of(whole) <= kFew;
  if (few && region.open_edges == 0) return true;
  const bool minority = chart[turned_over].share_of(whole) <= kMinority;
  return minority && (region.fold_edges >= region.open_edges || (few && region.shares_vertices));
}

class FoldParting {
 public:
  FoldParting(const Atlas& atlas, EdgeJoins& joins)
      : atlas_(atlas),
        joins_(joins),
        counterclockwise_(atlas.face_count(), 0),
        regions_of_(atlas.face_count()),
        charts_of_(regions_of_) {}

  std::vector<std::array<int, 2>> run() {
    find_sides();
    if (!find_regions()) return {};
    measure();
    std::vector<std::array<int, 2>> parted;
    for_each_join([&](int c, int other) {
      if (is_fold(c, other) && !stays(face(c)) && !stays(face(other))) parted.push_back({c, other});
    });
    for (const auto& [c, other] : parted) joins_.partners[c] = joins_.partners[other] = -1;
    return parted;
  }

 private:
  int face(int corner) const { return joins_.corner_faces[corner]; }
  bool is_fold(int c, int other) const { return counterclockwise_[face(c)] != counterclockwise_[face(other)]; }

  template <class Body>
  void for_each_join(Body body) const {
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      if (joins_.partners[c] > c) body(c, joins_.partners[c]);
    }
  }

  /// How each face lies, wound as its chart is; faces without area lie as a neighbour does.
  void find_sides() {
    std::vector<int> queue;
    for (int f = 0; f < atlas_.face_count(); ++f) {
      counterclockwise_[f] = joins_.turned_faces[f] ? -joins_.senses[f] : joins_.senses[f];
      if (counterclockwise_[f] != 0) queue.push_back(f);
    }
    if (queue.size() == counterclockwise_.size()) return;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      for (int c = atlas_.face_offsets[queue[at]]; c < atlas_.face_offsets[queue[at] + 1]; ++c) {
        const int other = joins_.partners[c] < 0 ? queue[at] : face(joins_.partners[c]);
        if (counterclockwise_[other] != 0) continue;
        counterclockwise_[other] = counterclockwise_[queue[at]];
        queue.push_back(other);
      }
    }
  }

  /// False where no chart is folded.
  bool find_regions() {
    bool folded = false;
    for_each_join([&](int c, int other) { folded = folded || is_fold(c, other); });
    if (!folded) return false;
    for_each_join([&](int c, int other) {
      charts_of_.unite(face(c), face(other));
      if (!is_fold(c, other)) regions_of_.unite(face(c), face(other));
    });
    return true;
  }

  void measure() {
    regions_.resize(atlas_.face_count());
    charts_.resize(atlas_.face_count());
    for (int f = 0; f < atlas_.face_count(); ++f) {
      const Amount own{doubled_area_in_space(atlas_, f), 1};
      Region& region = regions_[regions_of_.find(f)];
      region.amount = region.amount.plus(own);
      Amount& side = charts_[charts_of_.find(f)][counterclockwise_[f] < 0];
      side = side.plus(own);
      for (int c = atlas_.face_offsets[f]; c < atlas_.face_offsets[f + 1]; ++c) {
        const int other = joins_.partners[c];
        if (other < 0) ++region.open_edges;
        if (other < 0 || !is_fold(c, other)) continue;
        ++region.fold_edges;
        const int v = atlas_.corner_vertices[c];
        region.shares_vertices = region.shares_vertices || v == atlas_.corner_vertices[other] ||
                                 v == atlas_.corner_vertices[joins_.next_corner(atlas_, other)];
      }
    }
  }

  bool stays(int face) {
    return is_defect(regions_[regions_of_.find(face)], counterclockwise_[face] < 0, charts_[charts_of_.find(face)]);
  }

  const Atlas& atlas_;
  EdgeJoins& joins_;
  std::vector<int> counterclockwise_;  // of each face: 1, -1, 0 where nothing around it has area
  DisjointSets regions_of_, charts_of_;
  std::vector<Region> regions_;  // at the first face of each
  std::vector<Sides> charts_;    // likewise
};

}  // namespace

std::vector<std::array<int, 2>> part_folds(const Atlas& atlas, EdgeJoins& joins) {
  std::vector<std::array<int, 2>> parted = FoldParting(atlas, joins).run();
  if (!parted.empty()) orient_faces(atlas, joins);
  return parted;
}

}  // namespace atlas_refine
