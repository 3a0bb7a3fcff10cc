// Of cuts that save the same the one along cheap edges is made: wanted or hidden ones.
#include <gtest/gtest.h>

#include "output_checks.h"
#include "polygon_sheets.h"

namespace atlas_refine {
namespace {

using testing::Cell;

constexpr int kSize = 15, kLow = 6, kHigh = 9;  // a plus of four arms, 3 wide and 6 long
constexpr double kLimit = 0.9;                  // of what squeezing loses

bool in_middle(int k) { return k >= kLow && k < kHigh; }

/// Whether a vertex at (x, y) lies in the arm: 0 to the right, then counterclockwise.
bool in_arm(const Vec3& p, int arm) {
  const double at = arm % 2 == 0 ? p.x() : p.y();
  return arm < 2 ? at >= kHigh : at <= kLow;
}

Atlas plus() {
  Atlas atlas = testing::quads(testing::cells_where(kSize, [](int x, int y) { return in_middle(x) || in_middle(y); }));
  for (Vec3& p : atlas.positions) p.z() = 0;
  return atlas;
}

/// A large square over the arm, a chart of its own.
void cover(Atlas& atlas, int arm) {
  const double side = 7.5, middle = 0.5 * kSize;
  const Vec2 centre = Vec2(middle, middle) + (arm < 2 ? 1 : -1) * (arm % 2 == 0 ? Vec2(8, 0) : Vec2(0, 8));
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    const Vec2 at = centre + side * corner;
    atlas.corner_vertices.push_back(static_cast<int>(atlas.positions.size()));
    atlas.positions.emplace_back(at.x(), at.y(), 2.5);
    atlas.corner_uvs.push_back(Vec2(100, 100) + 0.1 * corner);
  }
  atlas.face_offsets.push_back(atlas.corner_count());
}

/// With a limit that one cut keeps.
RefineOptions one_cut(const Atlas& atlas) {
  RefineOptions options;
  const double whole = refine(atlas, options).after.distortion;
  options.seams = Seams::Needed;
  options.cut = Cut::Edges;
  options.max_distortion = 1 + kLimit * (whole - 1);
  return options;
}

/// Of the new seams those that lie in the arm.
int seams_in(const Atlas& atlas, const RefineResult& result, int arm) {
  int count = 0;
  for (const auto& [a, b] : result.new_seams) count += in_arm(atlas.positions[a], arm) && in_arm(atlas.positions[b], arm);
  return count;
}

TEST(SeamPrices, CutsRunAlongEdgesThatAreWanted) {
  const Atlas atlas = plus();
  for (int arm = 0; arm < 4; ++arm) {
    RefineOptions options = one_cut(atlas);
    for (int f = 0; f < atlas.face_count(); ++f) {
      for (int k = 0; k < 4; ++k) {
        const int a = atlas.corner_vertices[4 * f + k], b = atlas.corner_vertices[4 * f + (k + 1) % 4];
        if (in_arm(atlas.positions[a], arm) && in_arm(atlas.positions[b], arm)) options.prefer_seam.push_back({a, b});
      }
    }
    const RefineResult result = refine(atlas, options);
    testing::expect_sound_output(atlas, result, options);
    EXPECT_EQ(result.new_seams.size(), 3U) << arm;
    EXPECT_EQ(seams_in(atlas, result, arm), 3) << arm;
  }
}

TEST(SeamPrices, WhereFacesAreDividedEdgesThatMustStayWholeAreToldOf) {
  const Atlas atlas = plus();
  RefineOptions options = one_cut(atlas);
  options.cut = Cut::Split;
  const std::string told = "where no seam is wanted";
  EXPECT_FALSE(testing::says(refine(atlas, options).warnings, told));
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int k = 0; k < 4; ++k)
      options.no_seam.push_back({atlas.corner_vertices[4 * f + k], atlas.corner_vertices[4 * f + (k + 1) % 4]});
  }
  const RefineResult result = refine(atlas, options);
  EXPECT_GT(result.cuts->cuts, 0);
  EXPECT_TRUE(testing::says(result.warnings, told));
}

TEST(SeamPrices, CutsRunWhereTheyAreHidden) {
  for (int arm = 0; arm < 4; ++arm) {
    Atlas atlas = plus();
    cover(atlas, arm);
    const RefineOptions options = one_cut(atlas);
    const RefineResult result = refine(atlas, options);
    EXPECT_GE(result.new_seams.size(), 3U) << arm;
    EXPECT_EQ(seams_in(atlas, result, arm), static_cast<int>(result.new_seams.size())) << arm;
  }
}

}  // namespace
}  // namespace atlas_refine
