// Flat charts whose boundary runs along two axes already: kept as they are and cut, at any size, angle and scale.
#include <map>

#include "atlas_refine/refine.h"
#include "cut_checks.h"

namespace atlas_refine {
namespace {

constexpr double kOddAngle = 0.37;  // rad

struct FloorPlan {
  const char* name;
  std::vector<const char*> rows;  // of unit cells
  int corners;                    // of all its outlines
  int rectangles;                 // the fewest that it can be cut into; 0 where that is not asked for
};

const std::vector<FloorPlan>& letters() {
  static const std::vector<FloorPlan> plans = {
      {"L", {"X..", "X..", "XXX"}, 6, 2},     {"T", {"XXX", ".X.", ".X."}, 8, 2},
      {"U", {"X.X", "X.X", "XXX"}, 8, 3},     {"Z", {"XX.", ".X.", ".XX"}, 8, 3},
      {"S", {".XX", ".X.", "XX."}, 8, 3},     {"F", {"XXX", "X..", "XX.", "X.."}, 10, 3},
      {"plus", {".X.", "XXX", ".X."}, 12, 3}, {"stairs", {"X...", "XX..", "XXX.", "XXXX"}, 10, 4},
  };
  return plans;
}

/// Six rooms with doors to a corridor.
const FloorPlan& six_rooms() {
  static const FloorPlan plan = {
      "six rooms",
      {"XXX.XXX.XXX", "XXX.XXX.XXX", ".X...X...X.", "XXXXXXXXXXX", ".X...X...X.", "XXX.XXX.XXX", "XXX.XXX.XXX"},
      52,
      0};
  return plan;
}

/// The same with a pillar in two of them.
const FloorPlan& rooms_with_pillars() {
  static const FloorPlan plan = {
      "rooms with pillars",
      {"XXX.XXX.XXX", "X.X.XXX.XXX", "XXX.XXX.X.X", ".X...X..XXX", "XXXXXXXXXXX", ".X...X...X.", "XXX.XXX.XXX", "XXX.XXX.XXX"},
      50,
      0};
  return plan;
}

/// `per_cell` x `per_cell` quads in every cell, turned by `angle_rad` and scaled on the surface and in the UV plane alike.
Atlas quads(const FloorPlan& plan, int per_cell, double angle_rad, double scale) {
  Atlas atlas;
  atlas.name = plan.name;
  atlas.face_offsets = {0};
  std::map<std::pair<int, int>, int> index;
  const double c = scale * std::cos(angle_rad) / per_cell, s = scale * std::sin(angle_rad) / per_cell;
  const auto add_corner = [&](int i, int j) {
    const Vec2 p(c * i - s * j, s * i + c * j);
    const auto [at, added] = index.try_emplace({i, j}, static_cast<int>(atlas.positions.size()));
    if (added) atlas.positions.emplace_back(p.x(), p.y(), 0);
    atlas.corner_vertices.push_back(at->second);
    atlas.corner_uvs.push_back(p);
  };
  const int height = per_cell * static_cast<int>(plan.rows.size());
  for (int j = 0; j < height; ++j) {
    const std::string row = plan.rows[plan.rows.size() - 1 - j / per_cell];
    for (int i = 0; i < per_cell * static_cast<int>(row.size()); ++i) {
      if (row[i / per_cell] != 'X') continue;
      for (const auto& [di, dj] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
        add_corner(i + di, j + dj);
      atlas.face_offsets.push_back(atlas.corner_count());
    }
  }
  return atlas;
}

/// The plan's outline as one face. It must have no hole.
Atlas one_face(const FloorPlan& plan, double angle_rad, double scale) {
  const Chart chart = testing::charts_of(quads(plan, 1, angle_rad, scale)).front();
  const std::vector<int>& loop = chart.boundary_loops.front();
  Atlas atlas;
  atlas.name = plan.name;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 before = chart.uvs[loop[(k + loop.size() - 1) % loop.size()]], at = chart.uvs[loop[k]];
    const Vec2 after = chart.uvs[loop[(k + 1) % loop.size()]];
    if (std::abs(doubled_area(before, at, after)) < 0.1 * scale * scale) continue;
    atlas.corner_vertices.push_back(static_cast<int>(atlas.positions.size()));
    atlas.positions.emplace_back(at.x(), at.y(), 0);
    atlas.corner_uvs.push_back(at);
  }
  atlas.face_offsets = {0, atlas.corner_count()};
  return atlas;
}

/// One cell and several per unit, straight and turned, at three scales; and as one face.
std::vector<Atlas> variants(const FloorPlan& plan, bool has_hole) {
  std::vector<Atlas> out;
  for (const int per_cell : {1, 5}) {
    out.push_back(quads(plan, per_cell, 0, 1));
    for (const double scale : {1e-3, 1.0, 1e3}) out.push_back(quads(plan, per_cell, kOddAngle, scale));
  }
  if (has_hole) return out;
  for (const double scale : {1e-3, 1.0, 1e3}) out.push_back(one_face(plan, kOddAngle, scale));
  return out;
}

void expect_kept_by_alignment(const Atlas& atlas, int corners) {
  const std::vector<Chart> charts = testing::charts_of(atlas);
  ASSERT_EQ(charts.size(), 1u);
  const AxisAlignedChart out = testing::aligned(charts, 0.004).front();
  EXPECT_EQ(out.way, AxisAlignedChart::Way::Deformed);
  testing::expect_axis_aligned(out);
  EXPECT_LT(dirichlet_sums(out.mesh.to_chart(charts[0])).best_energy(), 1 + 1e-9);
  const std::vector<int> turns = corner_turns(out.quarter_turns);
  EXPECT_GE(std::count_if(turns.begin(), turns.end(), [](int k) { return k != 0; }), corners);
}

/// Returns the number of charts after the cut.
int cut_without_distortion(const Atlas& atlas) {
  RefineOptions options;
  options.seams = Seams::Rectangles;
  options.rectangles.candidates = 60;
  const RefineResult result = refine(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(result.after.distortion, 1 + 1e-6);
  EXPECT_EQ(result.ended, Ended::AtOptimum);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_LT(result.after.stretch_max, 1 + 1e-3);
  EXPECT_GE(result.after.pe, options.pe_bound);
  if (!result.rectangles) {
    ADD_FAILURE() << "no report of rectangles";
    return 0;
  }
  EXPECT_EQ(result.rectangles->tutte_charts, 0);
  EXPECT_EQ(result.rectangles->boxed_charts, 0);
  return result.after.chart_count;
}

TEST(FlatShapes, LettersAreCutWithoutDistortion) {
  for (const FloorPlan& plan : letters()) {
    int variant = 0;
    for (const Atlas& atlas : variants(plan, false)) {
      SCOPED_TRACE(plan.name + std::string(", variant ") + std::to_string(variant++));
      expect_kept_by_alignment(atlas, plan.corners);
      const int charts = cut_without_distortion(atlas);
      EXPECT_GE(charts, plan.rectangles);
      EXPECT_LE(charts, plan.rectangles + 1);
      if (plan.rectangles == 2) {
        EXPECT_EQ(charts, 2);
      }
    }
  }
}

TEST(FlatShapes, SixRoomsKeepTheirDoors) {
  int variant = 0;
  for (const Atlas& atlas : variants(six_rooms(), false)) {
    SCOPED_TRACE(variant++);
    expect_kept_by_alignment(atlas, six_rooms().corners);
    EXPECT_GT(cut_without_distortion(atlas), 6);
  }
}

TEST(FlatShapes, HolesAreCutOpenAlongTheAxes) {
  int variant = 0;
  for (const Atlas& atlas : variants(rooms_with_pillars(), true)) {
    SCOPED_TRACE(variant++);
    expect_kept_by_alignment(atlas, rooms_with_pillars().corners);
    EXPECT_GT(cut_without_distortion(atlas), 6);
  }
}

/// Steps that are shorter than two sigma are no corners of their own.
TEST(FlatShapes, StepsShorterThanTwoSigmaAreSmoothed) {
  constexpr int kSteps = 40, kPerimeter = 4 * kSteps;
  std::vector<std::string> rows;
  for (int k = 1; k <= kSteps; ++k) rows.push_back(std::string(k, 'X') + std::string(kSteps - k, '.'));
  FloorPlan plan{"many steps", {}, 0, 0};
  for (const std::string& row : rows) plan.rows.push_back(row.c_str());
  const std::vector<Chart> charts = testing::charts_of(quads(plan, 1, 0, 1));
  const auto corners = [&](double least_segment) {
    const std::vector<int> turns = corner_turns(testing::aligned(charts, 0.5 * least_segment / kPerimeter).front().quarter_turns);
    return std::count_if(turns.begin(), turns.end(), [](int k) { return k != 0; });
  };
  EXPECT_EQ(corners(0.9), 2 * kSteps + 2);
  EXPECT_LT(corners(4), kSteps);
}

}  // namespace
}  // namespace atlas_refine
