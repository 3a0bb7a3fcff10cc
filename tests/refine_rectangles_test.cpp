// The road that cuts as a whole, on generated atlases, by the public measures of its output mesh.
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "cut_checks.h"
#include "output_checks.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::expect_sound_output;
using testing::output;
using testing::refusal;
using testing::same_bits;
using testing::says;

RefineOptions rectangles(double pe_bound = 0.8) {
  RefineOptions options;
  options.pe_bound = pe_bound;
  options.seams = Seams::Rectangles;
  options.rectangles.candidates = 40;
  return options;
}

RefineResult refine_soundly(const Atlas& atlas, const RefineOptions& options) {
  try {
    RefineResult result = refine(atlas, options);
    expect_sound_output(atlas, result, options);
    return result;
  } catch (const RefineError& error) {
    ADD_FAILURE() << to_string(error.code()) << ": " << error.what();
    RefineResult result;
    result.corner_uvs = atlas.corner_uvs;
    return result;
  }
}

/// A shape that must be cut, its input distorted.
Atlas star(double bend = 0.5) { return shapes::mesh(shapes::star(), 0.1, bend); }

Atlas comb(double bend) { return shapes::mesh(shapes::comb(), 0.1, bend); }

Atlas part_of(const Atlas& atlas, const std::vector<int>& sources, const std::function<bool(int)>& wanted) {
  Atlas out;
  out.positions = atlas.positions;
  out.face_offsets = {0};
  for (int f = 0; f < atlas.face_count(); ++f) {
    if (!wanted(sources[f])) continue;
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      out.corner_vertices.push_back(atlas.corner_vertices[c]);
      out.corner_uvs.push_back(atlas.corner_uvs[c]);
    }
    out.face_offsets.push_back(out.corner_count());
  }
  return out;
}

TEST(RefineRectangles, OfManyTrianglesCoarseChartsAreReducedFirst) {
  // Above and below the number from which that is so the same optimum comes out, and the same on any number of threads.
  RefineOptions options = rectangles(0.75);
  const RefineResult few = refine_soundly(shapes::mesh(shapes::star(), 0.02, 0.5), options);
  const Atlas fine = shapes::mesh(shapes::star(), 0.01, 0.5);
  ASSERT_GT(fine.face_count(), 3000);
  const RefineResult many = refine_soundly(fine, options);
  EXPECT_EQ(many.intervention, Intervention::Cut);
  EXPECT_LT(many.after.distortion, few.after.distortion + 0.002);
  options.threads = 3;
  EXPECT_TRUE(same_bits(refine(fine, options).corner_uvs, many.corner_uvs));
  options.max_distortion = 100;  // no limit, but with one all triangles are reduced at once
  const RefineResult direct = refine_soundly(fine, options);
  EXPECT_FALSE(same_bits(direct.corner_uvs, many.corner_uvs));
  EXPECT_LT(many.after.distortion, direct.after.distortion + 1e-4);
}

/// UVs of the pieces before they are reduced.
std::vector<Vec2> packed_uvs(const Atlas& atlas, const RefineOptions& options) {
  struct : DebugSink {
    void receive(const AtlasSnapshot& snapshot) override {
      if (snapshot.stage == "packed") uvs = snapshot.uvs;
    }
    std::vector<Vec2> uvs;
  } sink;
  refine(atlas, options, {}, &sink);
  return sink.uvs;
}

TEST(RefineRectangles, OfSeveralLayoutsTheBestIsKept) {
  // Of the second polygon another than the best one by eq. (11) has the least distortion.
  for (const int seed : {1, 8}) {
    const Atlas atlas = shapes::mesh(shapes::random_star_polygon(seed), 0.014);
    ASSERT_GT(atlas.face_count(), 3000);
    RefineOptions options = rectangles();
    const std::vector<Vec2> best = packed_uvs(atlas, options);
    const double distortion = refine(atlas, options).after.distortion;
    options.max_distortion = 100;  // with a limit the first that keeps it is taken
    EXPECT_EQ(best == packed_uvs(atlas, options), seed == 1);
    EXPECT_LT(distortion, refine(atlas, options).after.distortion + 1e-4);
  }
}

constexpr const char* kMadeWorse = "cut, they are more distorted than they came, and than they are whole";

TEST(RefineRectangles, EveryAtlasReachesTheBound) {
  const std::vector<Atlas> atlases = testing::many_atlases();
  for (std::size_t k = 0; k < atlases.size(); ++k) {
    SCOPED_TRACE("atlas " + std::to_string(k));
    const RefineResult result = refine_soundly(atlases[k], rectangles());
    EXPECT_NE(result.rectangles.has_value(), says(result.fallbacks, kMadeWorse));
    EXPECT_LT(result.after.distortion, std::max(1.1, 1.02 * result.before.distortion));
  }
}

TEST(RefineRectangles, ChartsAreNotCutOnlyToBeWorse) {
  int left_whole = 0;
  for (const Atlas& atlas : testing::many_atlases()) {
    const RefineResult result = refine_soundly(atlas, rectangles());
    const bool worse = result.after.distortion > result.before.distortion + 1e-4;
    EXPECT_FALSE(result.cut && worse &&
                 says(result.warnings, "without cuts the charts hold the same bound with less distortion"));
    if (!says(result.fallbacks, kMadeWorse)) continue;
    EXPECT_EQ(result.intervention, Intervention::Squeezed);
    EXPECT_FALSE(result.cut);
    ++left_whole;
  }
  EXPECT_GT(left_whole, 0);
}

TEST(RefineRectangles, RandomPolygonsAtHigherBoundsAndFixedAspects) {
  for (int seed = 10; seed < 22; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RefineOptions options = rectangles(seed % 2 == 0 ? 0.85 : 0.8);
    options.box_aspect = seed % 3 == 0 ? 1 : 0;
    options.stored = seed % 4 == 0 ? Stored::Float32 : Stored::Double;
    const shapes::Polygon polygon = seed % 2 == 0 ? shapes::random_polygon(seed) : shapes::random_star_polygon(seed);
    refine_soundly(shapes::mesh(polygon, 0.1), options);
  }
}

TEST(RefineRectangles, SeveralChartsTogether) {
  std::vector<Atlas> parts;
  for (int k = 0; k < 5; ++k) {
    const shapes::Polygon polygon = k % 2 == 0 ? shapes::random_polygon(40 + k) : shapes::random_star_polygon(40 + k);
    parts.push_back(shapes::mesh(shapes::transformed(polygon, 0.5 + 0.2 * k, k, {3.0 * k, 0}), 0.15));
  }
  const Atlas atlas = shapes::combine(parts);
  refine_soundly(atlas, rectangles(0.85));
  RefineOptions keep = rectangles(0.8);
  keep.density = Density::Keep;
  refine_soundly(atlas, keep);
}

TEST(RefineRectangles, AnAtlasAtTheBoundIsUnchanged) {
  const Atlas atlas = shapes::mesh(shapes::rectangle(1, 0.7), 0.1);
  const RefineResult result = refine(atlas, rectangles());
  EXPECT_EQ(result.intervention, Intervention::Unchanged);
  EXPECT_FALSE(result.cut.has_value());
  EXPECT_TRUE(same_bits(result.corner_uvs, atlas.corner_uvs));
}

TEST(RefineRectangles, AStatedGapIsKept) {
  RefineOptions options = rectangles();
  for (const Gap& gap : {Gap{0.004}, Gap{4.0 / 512, Gap::Unit::LongSide}, Gap{0}}) {
    options.gap = gap;
    const RefineResult result = refine_soundly(star(), options);
    EXPECT_EQ(result.gap.value, gap.value);
  }
}

TEST(RefineRectangles, ThreadsChangeNoBit) {
  const Atlas atlas = shapes::combine({star(), shapes::mesh(shapes::transformed(shapes::comb(), 1, 0, {2, 0}), 0.1)});
  RefineOptions options = rectangles();
  options.threads = 1;
  const RefineResult one = refine(atlas, options);
  options.threads = 2;
  const RefineResult two = refine(atlas, options);
  ASSERT_TRUE(one.cut && two.cut);
  EXPECT_EQ(one.cut->corner_vertices, two.cut->corner_vertices);
  EXPECT_TRUE(same_bits(one.corner_uvs, two.corner_uvs));
}

/// A wavy sheet of n x n quads and triangles, its charts random regions: with holes, pinched vertices, shared borders.
Atlas random_regions(std::uint64_t seed) {
  Rng rng(seed);
  const int n = 4 + rng.below(6);
  std::vector<int> label(n * n, -1), open;
  for (int k = 0; k < 4; ++k) {
    const int face = rng.below(n * n);
    if (label[face] < 0) open.push_back(face);
    label[face] = k;
  }
  while (!open.empty()) {
    const int at = rng.below(static_cast<int>(open.size())), face = open[at], x = face % n, y = face / n;
    std::vector<int> free;
    for (const auto& [i, j] : {std::pair(x + 1, y), std::pair(x - 1, y), std::pair(x, y + 1), std::pair(x, y - 1)}) {
      if (i >= 0 && j >= 0 && i < n && j < n && label[j * n + i] < 0) free.push_back(j * n + i);
    }
    if (free.empty()) {
      open.erase(open.begin() + at);
      continue;
    }
    const int next = free[rng.below(static_cast<int>(free.size()))];
    label[next] = rng.uniform() < 0.06 ? 10 + next : label[face];
    open.push_back(next);
  }
  Atlas atlas;
  atlas.face_offsets = {0};
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) atlas.positions.push_back({1.0 * x, 1.0 * y, 0.4 * std::sin(x + 0.7 * y)});
  }
  const double shear = rng.uniform(-0.5, 0.5);
  for (int f = 0; f < n * n; ++f) {
    const int low = f / n * (n + 1) + f % n;
    const std::array<int, 4> quad = {low, low + 1, low + n + 2, low + n + 1};
    const auto add = [&](const std::vector<int>& corners) {
      for (int k : corners) {
        const Vec3& p = atlas.positions[quad[k]];
        atlas.corner_vertices.push_back(quad[k]);
        atlas.corner_uvs.push_back({p.x() + shear * p.y() + 40.0 * label[f], p.y() + 0.2 * std::cos(p.x())});
      }
      atlas.face_offsets.push_back(atlas.corner_count());
    };
    if (f % 3 == 0) {
      add({0, 1, 2, 3});
    } else {
      add({1, 2, 3});
      add({1, 3, 0});
    }
  }
  return atlas;
}

TEST(RefineRectangles, RandomRegionsOfASheet) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    refine_soundly(random_regions(seed), rectangles(seed % 2 == 0 ? 0.8 : 0.88));
  }
}

// ---- properties ----

TEST(RefineRectangles, AQuarterTurnAndAScaleOfTheUvs) {
  Atlas atlas = comb(1);
  for (Vec2& uv : atlas.corner_uvs) uv = 37 * Vec2(-uv.y(), uv.x()) + Vec2(5, -3);
  const RefineResult result = refine_soundly(atlas, rectangles());
  EXPECT_LE(result.after.distortion, 1.001 * result.before.distortion);
}

TEST(RefineRectangles, AUniformScaleOfTheSurface) {
  Atlas atlas = star();
  for (Vec3& p : atlas.positions) p *= 1e4;
  refine_soundly(atlas, rectangles());
  for (Vec3& p : atlas.positions) p *= 1e-9;
  refine_soundly(atlas, rectangles());
}

TEST(RefineRectangles, PermutedFaces) {
  const Atlas atlas = shapes::combine({star(), shapes::mesh(shapes::transformed(shapes::c_shape(), 1, 0, {2, 0}), 0.1)});
  std::vector<int> order(atlas.face_count());
  for (int f = 0; f < atlas.face_count(); ++f) order[f] = f;
  Rng rng(3);
  for (int f = atlas.face_count() - 1; f > 0; --f) std::swap(order[f], order[rng.below(f + 1)]);
  Atlas permuted;
  permuted.positions = atlas.positions;
  permuted.face_offsets = {0};
  for (int f : order) {
    const int begin = atlas.face_offsets[f], count = atlas.face_offsets[f + 1] - begin, turn = f % count;
    for (int k = 0; k < count; ++k) {
      permuted.corner_vertices.push_back(atlas.corner_vertices[begin + (k + turn) % count]);
      permuted.corner_uvs.push_back(atlas.corner_uvs[begin + (k + turn) % count]);
    }
    permuted.face_offsets.push_back(permuted.corner_count());
  }
  refine_soundly(permuted, rectangles());
}

TEST(RefineRectangles, PolygonFacesAndMirroredCharts) {
  Atlas atlas = shapes::quad_grid(12, 4);
  for (Vec2& uv : atlas.corner_uvs) {
    const double angle = 2.2 * uv.x(), radius = 0.7 - uv.y();
    uv = {-radius * std::cos(angle), radius * std::sin(angle)};
  }
  refine_soundly(atlas, rectangles());
  const RefineResult one = refine_soundly(atlas, rectangles()), other = refine_soundly(shapes::mirrored(atlas), rectangles());
  EXPECT_NE(one.charts[0].mirrored, other.charts[0].mirrored);
  EXPECT_EQ(one.repairs.size() + other.repairs.size(), 1u);
  EXPECT_NEAR(one.after.distortion, other.after.distortion, 0.02);
}

// ---- options ----

TEST(RefineRectangles, ValuesOutOfRangeAreRefused) {
  const auto expect_bad = [](const std::function<void(RefineOptions&)>& change) {
    RefineOptions options = rectangles();
    change(options);
    EXPECT_EQ(refusal(unit_square(), options).code(), ErrorCode::BadOption);
  };
  for (const double sigma : {0.0, -0.1, 0.11, std::nan("")}) expect_bad([&](RefineOptions& o) { o.rectangles.sigma = sigma; });
  for (const double omega : {-0.01, 1.01, std::nan("")}) expect_bad([&](RefineOptions& o) { o.rectangles.omega = omega; });
  for (const int count : {0, -1, 1000001}) expect_bad([&](RefineOptions& o) { o.rectangles.candidates = count; });
  for (const double weight : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    expect_bad([&](RefineOptions& o) { o.importance = {1, weight}; });
  expect_bad([](RefineOptions& o) { o.importance = {1}; });
  expect_bad([](RefineOptions& o) { o.importance = {1, 1, 1}; });
}

TEST(RefineRectangles, UntilTheBoundTheDistortionFalls) {
  for (const double bound : {0.7, 0.9}) {
    RefineOptions options = rectangles(bound);
    const RefineResult all = refine_soundly(comb(2), options);
    options.rectangles.until_input = true;
    const RefineResult enough = refine_soundly(comb(2), options);
    EXPECT_LT(enough.after.distortion, enough.before.distortion);
    EXPECT_LT(all.after.distortion, enough.after.distortion);
    EXPECT_LT(all.after.pe, enough.after.pe);
  }
}

TEST(RefineRectangles, TheInputAsReferenceIsKeptCloser) {
  RefineOptions options = rectangles();
  const RefineResult surface = refine_soundly(star(1.2), options);
  options.reference = Reference::Input;
  const RefineResult input = refine_soundly(star(1.2), options);
  EXPECT_LT(input.after.distortion_to_input, surface.after.distortion_to_input);
  EXPECT_GT(input.after.distortion, surface.after.distortion);
}

TEST(RefineRectangles, HeavyFacesAreDistortedLess) {
  const Atlas atlas = star();
  const auto heavy = [&](int face) { return 4 * face < atlas.face_count(); };
  RefineOptions options = rectangles(0.9);
  const auto heavy_distortion = [&] {
    const RefineResult result = refine_soundly(atlas, options);
    return measure(part_of(output(atlas, result), result.cut->face_sources, heavy)).distortion;
  };
  const double equal = heavy_distortion();
  for (int f = 0; f < atlas.face_count(); ++f) options.importance.push_back(heavy(f) ? 50 : 1);
  EXPECT_LT(heavy_distortion(), equal);
}

TEST(RefineRectangles, FewerCandidatesThanChains) {
  RefineOptions options = rectangles();
  options.rectangles.candidates = 1;
  refine_soundly(star(), options);
}

TEST(RefineRectangles, TinyInputs) {
  for (const int quads : {1, 2, 5}) {
    Atlas atlas = strip(quads);
    for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() + 0.9 * uv.y(), uv.y()};  // sheared
    refine_soundly(atlas, rectangles());
  }
  refine_soundly(flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), rectangles(0.4));
}

// Whole, they end at 8.03 in a square, and four of them at 3.2.
TEST(RefineRectangles, ChartsOfOneLongFaceAreCutAcross) {
  for (const Atlas& atlas : {plank(20), tube(4, 20)}) {
    RefineOptions options = rectangles();
    options.box_aspect = 1;
    const RefineResult result = refine_soundly(atlas, options);
    EXPECT_EQ(result.intervention, Intervention::Cut);
    EXPECT_LT(result.after.distortion, 1.01);
  }
}

/// As few faces as there can be: two for each point.
Atlas fan_star(int points, double inner_radius) {
  std::vector<Vec3> positions = {Vec3::Zero()};
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < 2 * points; ++k) {
    const double radius = k % 2 == 0 ? 1 : inner_radius, angle = std::numbers::pi * k / points;
    positions.push_back(radius * Vec3(std::cos(angle), std::sin(angle), 0));
    faces.push_back({0, k + 1, (k + 1) % (2 * points) + 1});
  }
  return flat_atlas(positions, faces);
}

// Whole, they end at 4.1, 4.8 and 5.9.
TEST(RefineRectangles, ChartsWithoutTrailsAreCutAcrossTheirNecks) {
  for (const int points : {7, 8, 9}) {
    SCOPED_TRACE(points);
    const RefineResult result = refine_soundly(fan_star(points, 0.25), rectangles());
    EXPECT_EQ(result.intervention, Intervention::Cut);
    EXPECT_LT(result.after.distortion, 1.01);
    EXPECT_TRUE(says(result.fallbacks, "cut across necks"));
    EXPECT_FALSE(says(result.warnings, "no chart needs a cut"));
  }
}

// As long as one is whole no cut of another saves anything, and what a cut leaves is long and narrow as well.
TEST(RefineRectangles, SoAreThoseLongerThanRectanglesMayBe) {
  RefineOptions options = rectangles();
  options.box_aspect = 1;
  const RefineResult result = refine_soundly(tube(4, 100), options);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(result.after.distortion, 1.3);
  EXPECT_LT(result.boundary_growth, 0.3);  // straight across
}

TEST(RefineRectangles, ManyLongChartsAreCutNoMoreThanTheyMust) {
  std::vector<Atlas> planks;
  for (int k = 0; k < 30; ++k) planks.push_back(plank(20 + k));
  RefineOptions options = rectangles();
  options.box_aspect = 1;
  const RefineResult result = refine_soundly(shapes::combine(planks), options);
  EXPECT_LT(result.after.distortion, 1.001);
  EXPECT_LT(result.boundary_growth, 0.07);
}

}  // namespace
}  // namespace atlas_refine
