// Prepare, choose target angles, deform; with finer, then coarser targets, and at last a rectangle, where that fails.
#include "align/align.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "align/deform.h"
#include "align/polar_angles.h"
#include "align/prepare.h"
#include "align/target_angles.h"
#include "geometry/predicates.h"
#include "geometry/tutte.h"
#include "measure/distortion.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

// A notch is kept where its two flanks, 2 * depth * (pi/2)^2, outweigh its corners: four quarter turns of this many sigmas.
constexpr double kCornerCost = 2.5;
constexpr double kLeastSegment = 2;  // shortest side of the axis-aligned chart, in sigmas
// Where a deformation fails, a finer and then a coarser sigma are tried: a closer likeness, then fewer corners.
constexpr double kSigmas[] = {1, 0.6, 2.5};
// Lines nearer than this many sigmas are made one, unless that raises E_d - 1 by more than the factor.
constexpr double kSameLine[] = {0.5, 0.1, 1e-3, 1e-6};
constexpr double kMergeCost = 1.05;
constexpr int kLeastTriangles = 4;   // charts of fewer are packed as they are
constexpr double kTooDistorted = 4;  // E_d of an axis-aligned chart that is not worth it

void rotate(Chart& chart, double angle) {
  const Mat2 rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
  for (Vec2& uv : chart.uvs) uv = rotation * uv;
}

bool positive(const Chart& chart, const std::vector<Vec2>& uvs) {
  return std::all_of(chart.triangles.begin(), chart.triangles.end(),
                     [&](const Triangle& t) { return orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]) > 0; });
}

std::vector<int> targets(const BoundaryAngles& boundary, const std::vector<double>& angles, double sigma, double corner_cost) {
  const double length = sigma * boundary.perimeter();
  return target_angles({boundary.lengths, angles, corner_cost * length, kLeastSegment * length});
}

/// Tutte's embedding onto the rectangle whose corners suit the boundary best.
std::optional<std::vector<Vec2>> onto_rectangle(const Chart& chart, const BoundaryAngles& boundary,
                                                const std::vector<int>& quarter_turns) {
  const int n = boundary.size();
  const std::vector<int> turns = corner_turns(quarter_turns);
  std::vector<int> corners;
  for (int i = 0; i < n; ++i) {
    if (turns[i] == 1) corners.push_back(i);
  }
  if (corners.size() != 4) return std::nullopt;
  std::array<double, 4> sides{};
  for (int k = 0; k < 4; ++k) {
    for (int i = corners[k]; i != corners[(k + 1) % 4]; i = (i + 1) % n) sides[k] += boundary.lengths[i];
  }
  const Vec2 size(0.5 * (sides[0] + sides[2]), 0.5 * (sides[1] + sides[3]));
  const bool upright = quarter_turns[corners[0]] % 2 != 0;
  const Vec2 box = upright ? Vec2(size.y(), size.x()) : size;
  std::vector<Vec2> polygon(n);
  const std::array<Vec2, 4> starts = {Vec2(0, 0), Vec2(box.x(), 0), box, Vec2(0, box.y())};
  for (int k = 0; k < 4; ++k) {
    const int direction = ((quarter_turns[corners[k]] % 4) + 4) % 4;
    const Vec2 from = starts[direction], to = starts[(direction + 1) % 4];
    double at = 0;
    for (int i = corners[k]; i != corners[(k + 1) % 4]; i = (i + 1) % n) {
      // One coordinate is the side's own, so that edges are parallel to the axes to the last bit.
      polygon[i] = from;
      const int axis = direction % 2;
      polygon[i][axis] = from[axis] + at / sides[k] * (to[axis] - from[axis]);
      at += boundary.lengths[i];
    }
  }
  std::vector<Vec2> uvs = tutte(chart, 0, polygon);
  if (!positive(chart, uvs)) return std::nullopt;
  return uvs;
}

/// Segments whose coordinates are nearly the same get the same one, as their mean: trails between their corners then meet.
std::vector<Vec2> merged_lines(const std::vector<Vec2>& uvs, const std::vector<int>& boundary,
                               const std::vector<int>& quarter_turns, double tolerance) {
  std::vector<Vec2> out = uvs;
  const std::size_t n = boundary.size();
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> lines;
    const auto keeps = [&](std::size_t i) { return (quarter_turns[i] % 2 == 0) == (axis == 1); };
    for (std::size_t i = 0; i < n; ++i) {
      if (keeps(i)) lines.push_back(uvs[boundary[i]][axis]);
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::vector<double> means(lines.size());
    for (std::size_t first = 0; first < lines.size();) {
      std::size_t end = first;
      double sum = 0;
      while (end < lines.size() && lines[end] - lines[first] <= tolerance) sum += lines[end++];
      std::fill(means.begin() + first, means.begin() + end, sum / static_cast<double>(end - first));
      first = end;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!keeps(i)) continue;
      const double line = uvs[boundary[i]][axis];
      const double mean = means[std::lower_bound(lines.begin(), lines.end(), line) - lines.begin()];
      out[boundary[i]][axis] = out[boundary[(i + 1) % n]][axis] = mean;
    }
  }
  return out;
}

class Aligner {
 public:
  Aligner(const Chart& source, double sigma, Monitor& monitor) : source_(source), sigma_(sigma), monitor_(monitor) {}

  AxisAlignedChart run() {
    PreparedChart prepared = prepare_chart(source_);
    AxisAlignedChart out{.way = AxisAlignedChart::Way::AsItIs, .mesh = SplitMesh(source_), .boundary = {}, .quarter_turns = {}};
    if (!prepared.opening.is_disk || source_.triangles.size() < kLeastTriangles) return as_it_is(std::move(out));
    out.holes_cut = prepared.opening.holes_cut;
    chart_ = prepared.mesh.to_chart(source_);
    auto uvs = deformed(out);
    if (!uvs) uvs = rectangle(out);
    if (!uvs) return as_it_is(std::move(out));
    out.mesh = std::move(prepared.mesh);
    out.mesh.uvs = std::move(*uvs);
    return out;
  }

 private:
  /// At its own scale, turned so that its bounding box is small.
  AxisAlignedChart as_it_is(AxisAlignedChart out) {
    out.holes_cut = 0;
    const double scale = dirichlet_sums(source_).best_scale();
    double best = std::numeric_limits<double>::infinity();
    constexpr int kTurns = 45;
    for (int k = 0; k < kTurns; ++k) {
      Chart turned = source_;
      rotate(turned, 0.5 * std::numbers::pi * k / kTurns);
      if (uv_box({turned}).area() >= best) continue;
      best = uv_box({turned}).area();
      out.mesh.uvs = turned.uvs;
    }
    for (Vec2& uv : out.mesh.uvs) uv *= scale;
    return out;
  }

  std::optional<std::vector<Vec2>> deformed(AxisAlignedChart& out) {
    for (const double factor : kSigmas) {
      const double sigma = factor * sigma_;
      Chart chart = chart_;
      BoundaryAngles boundary = polar_angles(chart);
      std::vector<double> angles = smoothed_angles(boundary, sigma * boundary.perimeter());
      const double turn = aligning_rotation(boundary.lengths, angles);
      rotate(chart, turn);
      for (double& angle : angles) angle += turn;
      for (double& angle : boundary.angle_rad) angle += turn;
      out.quarter_turns = targets(boundary, angles, sigma, kCornerCost);
      if (out.quarter_turns.empty()) continue;
      auto shape = deform_to_axes(chart, {boundary, out.quarter_turns}, [&] { monitor_.check(); });
      if (!shape) continue;
      out.way = AxisAlignedChart::Way::Deformed;
      out.quarter_turns = std::move(shape->quarter_turns);
      return accepted(boundary, std::move(shape->uvs), out);
    }
    return std::nullopt;
  }

  std::optional<std::vector<Vec2>> rectangle(AxisAlignedChart& out) {
    constexpr double kOnlyFour = 1e3;
    const BoundaryAngles boundary = polar_angles(chart_);
    const std::vector<double> angles = smoothed_angles(boundary, sigma_ * boundary.perimeter());
    out.quarter_turns = targets(boundary, angles, sigma_, kOnlyFour);
    if (out.quarter_turns.empty()) return std::nullopt;
    const auto uvs = onto_rectangle(chart_, boundary, out.quarter_turns);
    if (!uvs) return std::nullopt;
    out.way = AxisAlignedChart::Way::Rectangle;
    return accepted(boundary, *uvs, out);
  }

  /// In surface units; nothing where the chart would be bent beyond use.
  std::optional<std::vector<Vec2>> accepted(const BoundaryAngles& boundary, std::vector<Vec2> uvs, AxisAlignedChart& out) const {
    Chart aligned = chart_;
    aligned.uvs = uvs;
    double energy = dirichlet_sums(aligned).best_energy();
    if (!(energy < kTooDistorted)) return std::nullopt;
    bool merged = false;
    for (const double tolerance : kSameLine) {
      aligned.uvs = merged_lines(uvs, boundary.vertices, out.quarter_turns, tolerance * sigma_ * boundary.perimeter());
      if (!positive(aligned, aligned.uvs) || dirichlet_sums(aligned).best_energy() - 1 > kMergeCost * (energy - 1)) continue;
      uvs = aligned.uvs;
      merged = true;
      break;
    }
    if (!merged) return std::nullopt;  // two lines that cannot be told apart, and a hair of the chart between them
    const DirichletSums sums = dirichlet_sums(aligned);
    for (Vec2& uv : uvs) uv *= sums.best_scale();
    out.boundary = boundary.vertices;
    return uvs;
  }

  const Chart& source_;
  double sigma_;
  Monitor& monitor_;
  Chart chart_;
};

}  // namespace

std::vector<AxisAlignedChart> align_charts(const std::vector<Chart>& charts, const AlignOptions& options, Monitor& monitor) {
  std::vector<std::optional<AxisAlignedChart>> slots(charts.size());
  std::atomic<int> done = 0;
  parallel_ranges(static_cast<int>(charts.size()), options.threads, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      slots[c] = Aligner(charts[c], options.sigma, monitor).run();
      monitor.report(static_cast<double>(++done) / static_cast<double>(charts.size()));
    }
  });
  std::vector<AxisAlignedChart> out;
  for (auto& slot : slots) out.push_back(std::move(*slot));
  return out;
}

}  // namespace atlas_refine
