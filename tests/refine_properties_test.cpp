// What must not matter: units, places, turns by quarters, the order of faces and vertices. Metrics stay the same to rounding.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output_atlas.h"
#include "refine_checks.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

// PE and E_d where the search meets charts in another order or rounding, and takes another way to a result that is as good.
constexpr double kOtherWay = 0.02;
// Powers of two change no digit: results are the same to the last bit.
constexpr double kSameBits = 0;

struct Case {
  std::string name;
  RefineOptions options;
};

Case with_seams(Seams seams) {
  RefineOptions options{.pe_bound = 0.8, .seams = seams};
  options.rectangles.candidates = 30;
  return {seams == Seams::None ? "Squeezed" : "Cut", options};
}

Atlas sample() {
  return shapes::combine({shapes::mesh(shapes::transformed(shapes::c_shape(), 1, 0.3, {0, 0}), 0.15),
                          shapes::mesh(shapes::transformed(shapes::star(), 0.7, 0.1, {0, 2}), 0.15)});
}

Atlas with_uvs(Atlas atlas, const std::function<Vec2(const Vec2&)>& change) {
  for (Vec2& uv : atlas.corner_uvs) uv = change(uv);
  return atlas;
}

Atlas with_positions(Atlas atlas, const std::function<Vec3(const Vec3&)>& change) {
  for (Vec3& p : atlas.positions) p = change(p);
  return atlas;
}

/// The same mesh, vertices and faces in another order.
Atlas permuted(const Atlas& atlas, std::uint64_t seed) {
  Rng rng(seed);
  const auto shuffled = [&](int count) {
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (int k = count - 1; k > 0; --k) std::swap(order[k], order[rng.below(k + 1)]);
    return order;
  };
  const std::vector<int> vertices = shuffled(static_cast<int>(atlas.positions.size())), faces = shuffled(atlas.face_count());
  Atlas out{.positions = atlas.positions, .face_offsets = {0}};
  for (std::size_t v = 0; v < vertices.size(); ++v) out.positions[vertices[v]] = atlas.positions[v];
  for (const int f : faces) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      out.corner_vertices.push_back(vertices[atlas.corner_vertices[c]]);
      out.corner_uvs.push_back(atlas.corner_uvs[c]);
    }
    out.face_offsets.push_back(out.corner_count());
  }
  return out;
}

class Properties : public ::testing::TestWithParam<Case> {
 protected:
  const RefineResult& plain() {
    if (!plain_) plain_ = refine(sample(), GetParam().options);
    return *plain_;
  }
  void expect_same(const Atlas& changed, double tolerance) {
    const RefineResult result = refine(changed, GetParam().options);
    const Validity validity = validate(testing::output(changed, result));
    EXPECT_TRUE(validity.valid()) << validity.problem;
    EXPECT_TRUE(result.bound_met);
    EXPECT_EQ(result.intervention, plain().intervention);
    EXPECT_NEAR(result.after.pe, plain().after.pe, tolerance);
    EXPECT_NEAR(result.after.distortion, plain().after.distortion, tolerance);
    for (const std::string& text : result.fallbacks) EXPECT_TRUE(plain().fallbacks.size() > 0) << text;
  }

 private:
  std::optional<RefineResult> plain_;
};

TEST_P(Properties, TheUnitOfTheSurfaceDoesNotMatter) {
  for (const double scale : {0x1p-20, 0x1p20})
    expect_same(with_positions(sample(), [&](const Vec3& p) { return Vec3(scale * p); }), kSameBits);
  for (const double scale : {1e-6, 1e6})
    expect_same(with_positions(sample(), [&](const Vec3& p) { return Vec3(scale * p); }), kOtherWay);
}

TEST_P(Properties, TheScaleOfTheUvsDoesNotMatter) {
  for (const double scale : {0x1p-20, 0x1p20})
    expect_same(with_uvs(sample(), [&](const Vec2& uv) { return Vec2(scale * uv); }), kSameBits);
  for (const double scale : {1e-6, 1e6})
    expect_same(with_uvs(sample(), [&](const Vec2& uv) { return Vec2(scale * uv); }), kOtherWay);
}

TEST_P(Properties, PlacesFarFromTheOriginDoNotMatter) {
  expect_same(with_uvs(sample(), [](const Vec2& uv) { return Vec2(uv + Vec2(1e4, -1e4)); }), kOtherWay);
  expect_same(with_positions(sample(), [](const Vec3& p) { return Vec3(p + Vec3(1e4, -1e4, 1e4)); }), kOtherWay);
}

TEST_P(Properties, QuarterTurnsOfTheUvsDoNotMatter) {
  expect_same(with_uvs(sample(), [](const Vec2& uv) { return Vec2(-uv.y(), uv.x()); }), kOtherWay);
  expect_same(with_uvs(sample(), [](const Vec2& uv) { return Vec2(-uv); }), kOtherWay);
}

TEST_P(Properties, TheOrderOfFacesAndVerticesDoesNotMatter) {
  for (const std::uint64_t seed : {1, 2}) expect_same(permuted(sample(), seed), kOtherWay);
}

/// Charts that moving alone brings to the bound only in some of the layouts that a search meets.
Atlas near_the_edge() {
  std::vector<Atlas> charts;
  for (int k = 0; k < 6; ++k)
    charts.push_back(
        shapes::mesh(shapes::transformed(shapes::random_star_polygon(20 + k, 12), 0.4 + 0.1 * k, 0.7 * k, {2.0 * k, 0}), 0.2));
  return shapes::combine(charts);
}

/// What a packing is told by.
std::pair<Intervention, double> moved_to(const Atlas& atlas, double bound) {
  const RefineResult result = refine(atlas, {.pe_bound = bound});
  return {result.intervention, result.after.pe};
}

TEST(Packing, WhetherMovingIsEnoughDoesNotDependOnTurnsUnitsAndOrders) {
  const Atlas atlas = near_the_edge();
  // The highest bound that moving alone is found to hold, to a thousandth.
  double bound = 0.5, too_high = 0.95;
  while (too_high - bound > 0.001) {
    const double middle = 0.5 * (bound + too_high);
    (moved_to(atlas, middle).first == Intervention::Moved ? bound : too_high) = middle;
  }
  const auto [intervention, pe] = moved_to(atlas, bound);
  ASSERT_EQ(intervention, Intervention::Moved);
  const auto expect_the_same = [&](const Atlas& changed, const char* what) {
    const auto [own, own_pe] = moved_to(changed, bound);
    EXPECT_EQ(own, intervention) << what;
    EXPECT_NEAR(own_pe, pe, 1e-6) << what;
  };
  expect_the_same(with_uvs(atlas, [](const Vec2& uv) { return Vec2(-uv.y(), uv.x()); }), "a quarter turn");
  expect_the_same(with_uvs(atlas, [](const Vec2& uv) { return Vec2(-uv); }), "a half turn");
  expect_the_same(with_uvs(atlas, [](const Vec2& uv) { return Vec2(1e6 * uv); }), "a scale of the UVs");
  expect_the_same(with_positions(atlas, [](const Vec3& p) { return Vec3(1e-6 * p); }), "a scale of the surface");
  expect_the_same(with_uvs(atlas, [](const Vec2& uv) { return Vec2(uv + Vec2(100, -100)); }), "far UVs");
  expect_the_same(with_positions(atlas, [](const Vec3& p) { return Vec3(p + Vec3(100, -100, 100)); }), "a far surface");
  for (const std::uint64_t seed : {1, 2}) expect_the_same(permuted(atlas, seed), "another order");
}

INSTANTIATE_TEST_SUITE_P(Roads, Properties, ::testing::Values(with_seams(Seams::None), with_seams(Seams::Rectangles)),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace atlas_refine
