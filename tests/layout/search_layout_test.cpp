// The search: the bound met, pieces apart and inside the box, nothing lost when they are placed, threads without influence.
#include "layout/search_layout.h"

#include "atlas_refine/error.h"
#include "cut_checks.h"
#include "layout/place_pieces.h"

namespace atlas_refine {
namespace {

Layout searched(const testing::Laid& laid, const LayoutOptions& options) {
  Monitor monitor;
  return search_layouts(laid.aligned, laid.set.charts, options, monitor).front();
}

void expect_apart(const Layout& layout) {
  const double gap = layout.gap.length(layout.box);
  double area = 0;
  for (std::size_t a = 0; a < layout.pieces.size(); ++a) {
    const auto high = [](const PlacedPiece& p) {
      const Vec2 size = p.box.size();
      return Vec2(p.position + (p.quarter_turn ? Vec2(size.y(), size.x()) : size));
    };
    const PlacedPiece& piece = layout.pieces[a];
    area += piece.box.area();
    EXPECT_GE(piece.position.minCoeff(), -1e-12);
    EXPECT_LE((high(piece) - layout.box).maxCoeff(), 1e-9);
    for (std::size_t b = a + 1; b < layout.pieces.size(); ++b) {
      const PlacedPiece& other = layout.pieces[b];
      EXPECT_GE(std::max((other.position - high(piece)).maxCoeff(), (piece.position - high(other)).maxCoeff()), gap);
    }
  }
  EXPECT_NEAR(layout.pe, area / layout.box.prod(), 1e-9);
}

TEST(SearchLayout, HoldsTheBoundAndTheGap) {
  for (const Atlas& atlas : testing::many_atlases()) {
    for (const double bound : {0.7, 0.85}) {
      const testing::Laid laid = testing::laid(atlas, bound);
      EXPECT_GE(laid.layout.pe, bound);
      expect_apart(laid.layout);
    }
  }
}

TEST(SearchLayout, AFixedAspect) {
  const testing::Laid laid = testing::laid(shapes::mesh(shapes::star(), 0.12));
  for (const double aspect : {1.0, 2.5}) {
    LayoutOptions options = testing::layout_options(0.8);
    options.box_aspect = aspect;
    const Layout layout = searched(laid, options);
    EXPECT_NEAR(layout.box.x() / layout.box.y(), aspect, 1e-9);
    EXPECT_GE(layout.pe, 0.8);
    expect_apart(layout);
  }
}

TEST(SearchLayout, ThreadsAndRepetitionChangeNothing) {
  const testing::Laid laid = testing::laid(testing::many_atlases().front());
  const Layout one = searched(laid, testing::layout_options(0.85)), two = searched(laid, testing::layout_options(0.85, 2));
  ASSERT_EQ(one.pieces.size(), two.pieces.size());
  EXPECT_EQ(one.box, two.box);
  for (std::size_t p = 0; p < one.pieces.size(); ++p) {
    EXPECT_EQ(one.pieces[p].position, two.pieces[p].position);
    EXPECT_EQ(one.pieces[p].quarter_turn, two.pieces[p].quarter_turn);
  }
}

TEST(SearchLayout, OtherLayoutsHoldTheBoundByOtherCuts) {
  constexpr double kBound = 0.8;
  std::size_t others = 0;
  for (const Atlas& atlas : testing::many_atlases()) {
    const testing::Laid laid = testing::laid(atlas, kBound);
    Monitor monitor;
    const auto found = search_layouts(laid.aligned, laid.set.charts, testing::layout_options(kBound), monitor);
    for (std::size_t a = 0; a < found.size(); ++a) {
      EXPECT_GE(found[a].pe, kBound);
      expect_apart(found[a]);
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_TRUE(found[a].pieces.size() != found[b].pieces.size() || std::abs(found[a].growth - found[b].growth) > 1e-9);
    }
    others += found.size() - 1;
  }
  EXPECT_GT(others, 0U);
}

TEST(SearchLayout, OtherPackingsHoldTheBoundAndTheGapToo) {
  int found = 0;
  for (const auto& atlas : testing::many_atlases()) {
    const testing::Laid laid = testing::laid(atlas, 0.7);
    for (const Layout& other : packed_otherwise(laid.layout, 4, testing::layout_options(0.7))) {
      ++found;
      EXPECT_GE(other.pe, 0.7);
      expect_apart(other);
      ASSERT_EQ(other.pieces.size(), laid.layout.pieces.size());
      bool moved = false;
      for (std::size_t p = 0; p < other.pieces.size(); ++p)
        moved = moved || (other.pieces[p].position - laid.layout.pieces[p].position).norm() > 0.02 * other.box.norm();
      EXPECT_TRUE(moved);
    }
  }
  EXPECT_GT(found, 0);
}

TEST(SearchLayout, PackingsThatAreMirroredAreNoOthers) {
  // Whatever the seed, this comb's few pieces lie alike.
  const testing::Laid laid = testing::laid(shapes::mesh(shapes::comb(), 0.06), 0.7);
  EXPECT_TRUE(packed_otherwise(laid.layout, 4, testing::layout_options(0.7)).empty());
}

TEST(SearchLayout, ALengthThatCostsMoreIsCutLess) {
  const testing::Laid laid = testing::laid(shapes::mesh(shapes::comb(), 0.06), 0.6, 0.004);
  LayoutOptions options = testing::layout_options(0.6);
  options.rectangles.candidates = 300;
  options.rectangles.omega = 0;
  const Layout free = searched(laid, options);
  options.rectangles.omega = 1;
  const Layout dear = searched(laid, options);
  EXPECT_LE(dear.pieces.size(), free.pieces.size());
  EXPECT_GE(free.pe, dear.pe);
}

TEST(SearchLayout, ExtraCornersWhereTheBoundIsOutOfReachWithout) {
  // Two squares fill at most 2/3 of a box of aspect 3.
  const testing::Laid laid = testing::laid(shapes::mesh(shapes::rectangle(1, 1), 0.1), 0.5);
  EXPECT_EQ(laid.layout.extra_corners, 0);
  LayoutOptions options = testing::layout_options(0.8);
  options.box_aspect = 3;
  const Layout layout = searched(laid, options);
  EXPECT_GT(layout.extra_corners, 0);
  EXPECT_GT(layout.pieces.size(), 1u);
  EXPECT_GE(layout.pe, 0.8);
  expect_apart(layout);
}

TEST(SearchLayout, StopsWhenAsked) {
  const testing::Laid laid = testing::laid(testing::many_atlases().front());
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(search_layouts(laid.aligned, laid.set.charts, testing::layout_options(0.8), monitor), RefineError);
}

TEST(PlacePieces, EveryPieceGoesToItsPlace) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const testing::Laid laid = testing::laid(atlas);
    const std::vector<Chart> pieces = meshes_of(laid.cut);
    ASSERT_EQ(pieces.size(), laid.layout.pieces.size());
    const std::vector<Chart> placed = place_pieces(laid.layout, pieces, charts_of(laid.cut));
    testing::expect_certified(placed);
    EXPECT_NEAR(uv_area(placed), uv_area(pieces), 1e-9);
    EXPECT_NEAR(testing::energy_as_is(placed), testing::energy_as_is(pieces), 1e-9);
    EXPECT_GE(gap_between_charts(placed), laid.layout.gap.length(laid.layout.box) * (1 - 1e-9));
    EXPECT_LE((uv_box(placed).max - laid.layout.box).maxCoeff(), 1e-9);
  }
}

TEST(PlacePieces, APieceWithoutAPlaceIsAnError) {
  testing::Laid laid = testing::laid(shapes::mesh(shapes::star(), 0.12));
  laid.layout.pieces.pop_back();
  EXPECT_THROW(place_pieces(laid.layout, meshes_of(laid.cut), charts_of(laid.cut)), RefineError);
}

}  // namespace
}  // namespace atlas_refine
