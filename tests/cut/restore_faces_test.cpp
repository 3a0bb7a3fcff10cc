// Restoring: fewer vertices, the same surface, nothing flipped, the border untouched.
#include "cut/restore_faces.h"

#include "cut_checks.h"

namespace atlas_refine {
namespace {

std::vector<std::pair<Vec2, int>> border(const Piece& piece) {
  std::vector<std::pair<Vec2, int>> out;
  for (const auto& loop : piece.mesh.boundary_loops) {
    for (int v : loop) out.emplace_back(piece.mesh.uvs[v], piece.points[v]);
  }
  return out;
}

TEST(RestoreFaces, RemovesVerticesAndKeepsTheRest) {
  int removed_in_all = 0;
  for (const Atlas& atlas : testing::many_atlases()) {
    testing::Laid laid = testing::laid(atlas);
    for (Piece& piece : laid.cut.pieces) {
      const Piece before = piece;
      const Chart& source = laid.set.charts[piece.chart];
      const int removed = restore_faces(piece, source, 1);
      removed_in_all += removed;
      EXPECT_EQ(piece.mesh.vertex_count(), before.mesh.vertex_count() - removed);
      EXPECT_EQ(piece.mesh.triangles.size(), before.mesh.triangles.size() - 2 * removed);
      EXPECT_NEAR(testing::rest_area(piece.mesh), testing::rest_area(before.mesh), 1e-10);
      EXPECT_NEAR(uv_area({piece.mesh}), uv_area({before.mesh}), 1e-10);
      testing::expect_positive(piece.mesh.uvs, piece.mesh.triangles);
      testing::expect_conforming(SplitMesh(piece.mesh));
      EXPECT_TRUE(border(piece) == border(before));
      for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
        const Triangle& v = piece.mesh.triangles[t];
        EXPECT_EQ(piece.mesh.triangle_faces[t], source.triangle_faces[piece.sources[t]]);
        const RestTriangle rest =
            rest_of_part(source, piece.sources[t], {piece.supports[v[0]], piece.supports[v[1]], piece.supports[v[2]]});
        EXPECT_NEAR(rest.area, piece.mesh.surface[t].area, 1e-12);
      }
    }
  }
  EXPECT_GT(removed_in_all, 20);
}

TEST(RestoreFaces, FacesThatAreWholeAgainHaveTheirGuards) {
  int regained = 0;
  for (const Atlas& atlas : {testing::open_box(5), shapes::quad_band(24, 5)}) {
    testing::Laid laid = testing::laid(atlas);
    for (Piece& piece : laid.cut.pieces) {
      const Chart& source = laid.set.charts[piece.chart];
      const std::size_t before = piece.mesh.guards.size();
      restore_faces(piece, source, 1);
      regained += piece.mesh.guards.size() > before;
      for (const Guard& guard : piece.mesh.guards) {
        testing::expect_positive(piece.mesh.uvs, {guard.triangle});
        const auto own = std::count(piece.mesh.triangle_faces.begin(), piece.mesh.triangle_faces.end(), guard.face);
        EXPECT_EQ(own, 2) << "a divided quad has guards";
      }
    }
  }
  EXPECT_GT(regained, 0);
}

TEST(RestoreFaces, AnUndividedChartHasNothingToRestore) {
  testing::Laid laid = testing::laid(shapes::mesh(shapes::rectangle(1, 0.7), 0.1));
  Piece& piece = laid.cut.pieces.front();
  restore_faces(piece, laid.set.charts.front(), 1);
  EXPECT_EQ(restore_faces(piece, laid.set.charts.front(), 1), 0);
}

}  // namespace
}  // namespace atlas_refine
