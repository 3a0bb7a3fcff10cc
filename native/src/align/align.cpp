// Prepare, choose target angles, deform; with finer, then coarser targets, and at last a rectangle, where that fails.
#include "align/align.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>

#include "align/deform.h"
#include "align/polar_angles.h"
#include "align/prepare.h"
#include "align/target_angles.h"
#include "geometry/predicates.h"
#include "geometry/tutte.h"
#include "measure/distortion.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

// A notch is kept where its two flanks, 2 * depth * (pi/2)^2, outweigh its corners: four quarter turns of this many sigmas.
constexpr double kCornerCost = 2.5;
constexpr double kLeastSegment = 2;  // shortest side of the axis-aligned chart, in sigmas
// Where a deformation fails, a finer and then a coarser sigma are tried: a closer likeness, then fewer corners.
constexpr double kSigmas[] = {1, 0.6, 2.5};
constexpr double kSigmaOfWidth = 0.125;  // the sigma of a strip, whose ends else are short: so much of its mean width
// Lines nearer than this many sigmas are made one, unless that raises E_d - 1 by more than the factor.
constexpr double kSameLine[] = {0.5, 0.1, 1e-3, 1e-6};
constexpr double kMergeCost = 1.05;
constexpr double kFreeMerge = 1e-4;  // E_d that merging may always cost: nearly flat charts would be cut into slivers
constexpr double kAligned = 0.01;    // rad off an axis at most: a boundary that runs along the axes as it is
constexpr double kTooDistorted = 4;  // E_d of an axis-aligned chart that is not worth it, unless it was more before

void rotate(Chart& chart, double angle) {
  const Mat2 rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
  for (Vec2& uv : chart.uvs) uv = rotation * uv;
}

bool positive(const Chart& chart, const std::vector<Vec2>& uvs) {
  return std::all_of(chart.triangles.begin(), chart.triangles.end(),
                     [&](const Triangle& t) { return orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]) > 0; });
}

std::vector<int> targets(const BoundaryAngles& boundary, const std::vector<double>& angles, double sigma, double corner_cost) {
  const double perimeter = boundary.perimeter();
  return target_angles({boundary.lengths, angles, corner_cost * perimeter, kLeastSegment * sigma * perimeter});
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

/// A prepared chart whose boundary edges are axis-parallel.
struct AlignedDisk {
  AxisAlignedChart::Way way;
  std::vector<int> boundary;
  std::vector<int> quarter_turns;
  std::vector<Vec2> uvs;
  double energy = 0;  // E_d
};

/// With near lines made one, in surface units, E_d known; nothing where that fails.
std::optional<AlignedDisk> finished(Chart chart, AlignedDisk disk, double sigma) {
  chart.uvs = disk.uvs;
  const double energy = dirichlet_sums(chart).best_energy();
  const double sigma_length = sigma * polar_angles(chart).perimeter();
  for (const double tolerance : kSameLine) {
    chart.uvs = merged_lines(disk.uvs, disk.boundary, disk.quarter_turns, tolerance * sigma_length);
    if (!positive(chart, chart.uvs)) continue;
    const DirichletSums sums = dirichlet_sums(chart);
    if (!(sums.best_energy() - 1 <= kMergeCost * (energy - 1) + kFreeMerge)) continue;
    disk.energy = sums.best_energy();
    disk.uvs = std::move(chart.uvs);
    for (Vec2& uv : disk.uvs) uv *= sums.best_scale();
    return disk;
  }
  return std::nullopt;  // two lines that cannot be told apart, and a hair of the chart between them
}

/// Length of each segment between corners. There must be one.
std::vector<double> segment_lengths(const BoundaryAngles& boundary, const std::vector<int>& turns) {
  const int n = boundary.size();
  const auto first = std::find_if(turns.begin(), turns.end(), [](int k) { return k != 0; }) - turns.begin();
  std::vector<double> lengths;
  for (int k = 0; k < n; ++k) {
    const int i = static_cast<int>((first + k) % n);
    if (turns[i] != 0) lengths.push_back(0);
    lengths.back() += boundary.lengths[i];
  }
  return lengths;
}

/// The boundary's own directions, turned by `turn_rad`, where it runs along the axes already and, unless it is a rectangle, no
/// segment is too short.
std::vector<int> own_directions(const BoundaryAngles& boundary, double turn_rad, double sigma) {
  std::vector<int> quarter_turns;
  for (const double angle : boundary.angle_rad) {
    const double quarters = (angle + turn_rad) / (0.5 * std::numbers::pi);
    quarter_turns.push_back(static_cast<int>(std::lround(quarters)));
    if (std::abs(quarters - quarter_turns.back()) * 0.5 * std::numbers::pi > kAligned) return {};
  }
  const std::vector<int> turns = corner_turns(quarter_turns);
  if (std::any_of(turns.begin(), turns.end(), [](int k) { return k > 1 || k < -2; })) return {};
  const std::vector<double> lengths = segment_lengths(boundary, turns);
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  if (lengths.size() > 4 && shortest < kLeastSegment * sigma * boundary.perimeter()) return {};
  return quarter_turns;
}

/// Turns the chart to the axes that its boundary suggests and deforms it until it runs along them.
std::optional<AlignedDisk> deformed(Chart chart, BoundaryAngles boundary, double turn_rad, const std::vector<int>& quarter_turns,
                                    Monitor& monitor) {
  if (quarter_turns.empty()) return std::nullopt;
  rotate(chart, turn_rad);
  for (double& angle : boundary.angle_rad) angle += turn_rad;
  auto shape = deform_to_axes(chart, {boundary, quarter_turns}, [&] { monitor.check(); });
  if (!shape) return std::nullopt;
  return AlignedDisk{AxisAlignedChart::Way::Deformed, boundary.vertices, std::move(shape->quarter_turns), std::move(shape->uvs)};
}

/// As its boundary runs already.
std::optional<AlignedDisk> kept(const Chart& chart, double sigma, Monitor& monitor) {
  const BoundaryAngles boundary = polar_angles(chart);
  const double turn_rad = aligning_rotation(boundary.lengths, boundary.angle_rad);
  return deformed(chart, boundary, turn_rad, own_directions(boundary, turn_rad, sigma), monitor);
}

/// By smoothing of width `sigma`, as a fraction of the boundary; `corner_cost` in the same unit.
std::optional<AlignedDisk> smoothed(const Chart& chart, double sigma, double corner_cost, Monitor& monitor) {
  const BoundaryAngles boundary = polar_angles(chart);
  std::vector<double> angles = smoothed_angles(boundary, sigma * boundary.perimeter());
  const double turn_rad = aligning_rotation(boundary.lengths, angles);
  for (double& angle : angles) angle += turn_rad;
  return deformed(chart, boundary, turn_rad, targets(boundary, angles, sigma, corner_cost), monitor);
}

std::optional<AlignedDisk> rectangle(const Chart& chart, double sigma) {
  constexpr double kOnlyFour = 1e3;
  const BoundaryAngles boundary = polar_angles(chart);
  const std::vector<double> angles = smoothed_angles(boundary, sigma * boundary.perimeter());
  const std::vector<int> quarter_turns = targets(boundary, angles, sigma, kOnlyFour * sigma);
  if (quarter_turns.empty()) return std::nullopt;
  auto uvs = onto_rectangle(chart, boundary, quarter_turns);
  if (!uvs) return std::nullopt;
  return AlignedDisk{AxisAlignedChart::Way::Rectangle, boundary.vertices, quarter_turns, std::move(*uvs)};
}

/// What a boundary is told by from one of its corners on: the turn at each, and the length of the segment after it.
using Segments = std::vector<std::pair<int, long>>;

/// Starts the boundary at a corner and turns the chart by quarters until it sets out along u from there: at the corner from which
/// its segments come first in their order, so that the layout depends neither on numbers nor on the turn of the input.
void stand_up(AlignedDisk& disk) {
  constexpr double kTold = 1e5;  // lengths differ from each other where they differ by more of the boundary's
  const int n = static_cast<int>(disk.boundary.size());
  const std::vector<int> turns = corner_turns(disk.quarter_turns);
  std::vector<int> corners;
  std::vector<double> lengths;
  const int first = static_cast<int>(std::find_if(turns.begin(), turns.end(), [](int k) { return k != 0; }) - turns.begin());
  double perimeter = 0;
  for (int k = 0; k < n; ++k) {
    const int i = (first + k) % n;
    if (turns[i] != 0) corners.push_back(i), lengths.push_back(0);
    const double length = (disk.uvs[disk.boundary[(i + 1) % n]] - disk.uvs[disk.boundary[i]]).norm();
    lengths.back() += length;
    perimeter += length;
  }
  Segments segments;
  for (std::size_t k = 0; k < corners.size(); ++k)
    segments.emplace_back(turns[corners[k]], std::lround(kTold * lengths[k] / perimeter));
  std::size_t best = 0;
  Segments least = segments;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    std::rotate(segments.begin(), segments.begin() + 1, segments.end());
    if (segments < least) least = segments, best = k;
  }
  const int start = corners[best], label = disk.quarter_turns[start];
  for (int i = 0; i < n; ++i) disk.quarter_turns[i] += (i < start ? 4 : 0) - label;
  std::rotate(disk.quarter_turns.begin(), disk.quarter_turns.begin() + start, disk.quarter_turns.end());
  std::rotate(disk.boundary.begin(), disk.boundary.begin() + start, disk.boundary.end());
  for (int k = ((-label) % 4 + 4) % 4; k > 0; --k) {
    for (Vec2& uv : disk.uvs) uv = Vec2(-uv.y(), uv.x());
  }
}

/// At its own scale, in the best of so many turns of less than a quarter.
AxisAlignedChart as_it_is(const Chart& source, int turns) {
  AxisAlignedChart out{.way = AxisAlignedChart::Way::AsItIs, .mesh = SplitMesh(source), .boundary = {}, .quarter_turns = {}};
  const double scale = dirichlet_sums(source).best_scale();
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < turns; ++k) {
    Chart turned = source;
    rotate(turned, 0.5 * std::numbers::pi * k / turns);
    if (uv_box({turned}).area() >= best) continue;
    best = uv_box({turned}).area();
    out.mesh.uvs = turned.uvs;
  }
  for (Vec2& uv : out.mesh.uvs) uv *= scale;
  return out;
}

/// As its boundary runs, else by smoothing with finer, then coarser sigmas, with that of a strip, at last as a rectangle: the
/// first that is not too distorted. Where all are, the least, if the chart was worse before.
std::optional<AlignedDisk> aligned_disk(const Chart& chart, double sigma, Monitor& monitor) {
  const double perimeter = polar_angles(chart).perimeter();
  std::vector<std::function<std::optional<AlignedDisk>()>> attempts = {[&] { return kept(chart, sigma, monitor); }};
  for (const double factor : kSigmas)
    attempts.emplace_back([&, factor] { return smoothed(chart, factor * sigma, kCornerCost * factor * sigma, monitor); });
  const double sigma_of_width = kSigmaOfWidth * 2 * uv_area(chart) / (perimeter * perimeter);
  if (sigma_of_width < sigma)
    attempts.emplace_back([&] { return smoothed(chart, sigma_of_width, kCornerCost * sigma, monitor); });
  attempts.emplace_back([&] { return rectangle(chart, sigma); });
  std::optional<AlignedDisk> best;
  for (const auto& attempt : attempts) {
    std::optional<AlignedDisk> disk = attempt();
    if (disk) disk = finished(chart, std::move(*disk), sigma);
    if (disk && (!best || disk->energy < best->energy)) best = std::move(disk);
    if (best && best->energy < kTooDistorted) return best;
  }
  return best && best->energy < dirichlet_sums(chart).best_energy() ? best : std::nullopt;
}

AxisAlignedChart align(const Chart& source, const SidePrices& prices, double sigma, Monitor& monitor) {
  constexpr int kTurns = 45;
  PreparedChart prepared = prepare_chart(source, prices);
  if (!prepared.opening.is_disk) return as_it_is(source, kTurns);
  Chart chart = prepared.mesh.to_chart(source);
  // Two sides of a quad on the boundary may come to lie on one line: what is not convex then is divided in the end.
  chart.guards.clear();
  std::optional<AlignedDisk> disk = aligned_disk(chart, sigma, monitor);
  if (!disk) return as_it_is(source, kTurns);
  stand_up(*disk);
  prepared.mesh.uvs = std::move(disk->uvs);
  return {.way = disk->way,
          .mesh = std::move(prepared.mesh),
          .boundary = std::move(disk->boundary),
          .quarter_turns = std::move(disk->quarter_turns),
          .holes_cut = prepared.opening.holes_cut};
}

}  // namespace

std::vector<AxisAlignedChart> align_charts(const std::vector<Chart>& charts, const AlignOptions& options, Monitor& monitor) {
  const PhaseScope scope(Phase::Align);
  std::vector<std::optional<AxisAlignedChart>> slots(charts.size());
  std::atomic<int> done = 0;
  parallel_ranges(static_cast<int>(charts.size()), options.threads, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const SidePrices prices = options.prices.empty() ? SidePrices() : options.prices[c];
      slots[c] = bends(options.freedom, c) ? align(charts[c], prices, options.sigma, monitor) : as_it_is(charts[c], 1);
      monitor.report(static_cast<double>(++done) / static_cast<double>(charts.size()));
    }
  });
  std::vector<AxisAlignedChart> out;
  for (auto& slot : slots) out.push_back(std::move(*slot));
  return out;
}

}  // namespace atlas_refine
