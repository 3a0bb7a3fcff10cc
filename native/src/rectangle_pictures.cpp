// Each picture is the chart at one step, with marks over it.
#include "rectangle_pictures.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "align/polar_angles.h"
#include "layout/quad_mesh.h"
#include "measure/distortion.h"
#include "measure/snapshot.h"

namespace atlas_refine {
namespace {

using Kind = PictureMark::Kind;

Kind direction(int quarter_turns) { return static_cast<Kind>(((quarter_turns % 4) + 4) % 4); }

class Painter {
 public:
  Painter(const Chart& source, const AxisAlignedChart& aligned)
      : source_(source), aligned_(aligned), chart_(aligned.mesh.to_chart(source)) {}

  std::vector<AtlasSnapshot> run(const std::vector<TrailStart>& trails, double sigma) {
    std::vector<AtlasSnapshot> out;
    show_before(sigma, out);
    out.push_back(picture("axis-aligned", chart_, "the boundary parallel to the axes (3.1.2)"));
    add_corners(chart_.uvs, out.back());

    out.push_back(picture("trails", chart_, "every trail of every reflex corner: the quad mesh Q (3.2)"));
    const QuadMesh quads = make_quad_mesh(aligned_, source_, 0);
    std::vector<TrailStart> all;
    for (const auto& trail : quads.trails) all.push_back(trail.start);
    add_trails(all, TrailTracer::Until::Boundary, Kind::Trail, out.back());
    add_corners(chart_.uvs, out.back());

    out.push_back(picture("rectangles", chart_, "the motorcycles that were chosen, and the rectangles between them (3.2)"));
    add_trails(trails, TrailTracer::Until::BoundaryOrTrail, Kind::Cut, out.back());
    return out;
  }

 private:
  static AtlasSnapshot picture(const char* stage, const Chart& chart, const char* caption) {
    return make_snapshot(stage, caption, {chart}, uv_box({chart}));
  }

  /// The input chart, rotated: smoothed directions, then target angles.
  void show_before(double sigma, std::vector<AtlasSnapshot>& out) const {
    Chart before = chart_;
    for (int v = 0; v < before.vertex_count(); ++v) before.uvs[v] = value_at(aligned_.mesh.supports[v], source_.uvs);
    before.boundary_loops = {aligned_.boundary};
    const BoundaryAngles boundary = polar_angles(before);
    std::vector<double> angles = smoothed_angles(boundary, sigma * boundary.perimeter());
    const double turn = aligning_rotation(boundary.lengths, angles);
    for (Vec2& uv : before.uvs) uv = Eigen::Rotation2Dd(turn) * uv;
    out.push_back(picture("smoothed", before, "nearest axis of every smoothed boundary direction (eq. 3-5)"));
    for (int i = 0; i < boundary.size(); ++i) {
      const int nearest = static_cast<int>(std::lround((angles[i] + turn) / (0.5 * std::numbers::pi)));
      add_edge(before.uvs, i, nearest, out.back());
    }
    out.push_back(picture("targets", before, "target angles and corners (eq. 6-7)"));
    for (int i = 0; i < boundary.size(); ++i) add_edge(before.uvs, i, aligned_.quarter_turns[i], out.back());
    add_corners(before.uvs, out.back());
  }

  void add_edge(const std::vector<Vec2>& uvs, int i, int quarter_turns, AtlasSnapshot& picture) const {
    const std::size_t n = aligned_.boundary.size();
    picture.marks.push_back({direction(quarter_turns), uvs[aligned_.boundary[i]], uvs[aligned_.boundary[(i + 1) % n]]});
  }
  void add_corners(const std::vector<Vec2>& uvs, AtlasSnapshot& picture) const {
    const std::vector<int> turns = corner_turns(aligned_.quarter_turns);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const Vec2& at = uvs[aligned_.boundary[i]];
      if (turns[i] != 0) picture.marks.push_back({turns[i] > 0 ? Kind::ConvexCorner : Kind::ReflexCorner, at, at});
    }
  }
  void add_trails(const std::vector<TrailStart>& trails, TrailTracer::Until until, Kind kind, AtlasSnapshot& picture) const {
    SplitMesh mesh = aligned_.mesh;
    TrailTracer tracer(mesh, aligned_.boundary, aligned_.quarter_turns);
    for (const TrailStart& start : trails) tracer.hold(start.vertex);
    for (const TrailStart& start : trails) {
      const int end = tracer.trace(start, until).back();
      picture.marks.push_back({kind, mesh.uvs[start.vertex], mesh.uvs[end]});
    }
  }

  const Chart& source_;
  const AxisAlignedChart& aligned_;
  Chart chart_;
};

}  // namespace

std::vector<AtlasSnapshot> rectangle_pictures(const std::vector<Chart>& charts, const std::vector<AxisAlignedChart>& aligned,
                                              const std::vector<std::vector<TrailStart>>& trails, double sigma) {
  int largest = -1;
  double most = 0;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    if (aligned[c].boundary.empty() || uv_area(charts[c]) <= most) continue;
    largest = c;
    most = uv_area(charts[c]);
  }
  if (largest < 0) return {};
  return Painter(charts[largest], aligned[largest]).run(trails[largest], sigma);
}

}  // namespace atlas_refine
