// The output mesh of a cut: corners, sources and weights fit together, the surface stays closed, faces keep their winding.
#include "report/cut_faces.h"

#include <Eigen/Geometry>

#include "cut/boundary_places.h"
#include "cut/restore_faces.h"
#include "cut_checks.h"
#include "geometry/convex_polygon.h"
#include "sheets.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

using testing::Laid;

CutFaces faces_of(const Laid& laid, bool triangulate = false) {
  std::vector<std::vector<Vec2>> uvs;
  for (const Piece& piece : laid.cut.pieces) uvs.push_back(piece.mesh.uvs);
  return cut_faces(laid.atlas, laid.set, laid.cut, {uvs, triangulate});
}

Vec3 area_vector(const std::vector<Vec3>& positions, const std::vector<int>& corners, int begin, int end) {
  Vec3 sum = Vec3::Zero();
  for (int c = begin; c < end; ++c) {
    const int next = c + 1 < end ? c + 1 : begin;
    sum += 0.5 * (positions[corners[c]] - positions[corners[begin]]).cross(positions[corners[next]] - positions[corners[begin]]);
  }
  return sum;
}

TEST(CutFaces, CornersSourcesAndWeightsFitTogether) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Laid laid = testing::laid(atlas);
    const CutFaces out = faces_of(laid);
    const int faces = static_cast<int>(out.mesh.face_sources.size()), old_vertices = static_cast<int>(atlas.positions.size());
    ASSERT_EQ(static_cast<int>(out.mesh.face_offsets.size()), faces + 1);
    ASSERT_EQ(out.mesh.corner_vertices.size(), out.corners.size());
    ASSERT_EQ(out.positions.size(), atlas.positions.size() + out.mesh.new_vertices.size());
    EXPECT_TRUE(std::is_sorted(out.mesh.face_sources.begin(), out.mesh.face_sources.end()));
    for (int v = 0; v < old_vertices; ++v) EXPECT_EQ(out.positions[v], atlas.positions[v]);
    for (std::size_t k = 0; k < out.mesh.new_vertices.size(); ++k) {
      const NewVertex& vertex = out.mesh.new_vertices[k];
      EXPECT_GE(vertex.weights.minCoeff(), 0);
      EXPECT_NEAR(vertex.weights.sum(), 1, 1e-12);
      Vec3 there = Vec3::Zero();
      for (int j = 0; j < 3; ++j) {
        ASSERT_GE(vertex.corners[j], 0);
        there += vertex.weights[j] * atlas.positions[atlas.corner_vertices[vertex.corners[j]]];
      }
      EXPECT_LT((there - out.positions[old_vertices + k]).norm(), 1e-12);
      const auto face = [&](int c) { return std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), c); };
      EXPECT_EQ(face(vertex.corners[0]), face(vertex.corners[1]));
      EXPECT_EQ(face(vertex.corners[0]), face(vertex.corners[2]));
    }
    std::vector<int> used(out.positions.size(), 0);
    for (int v : out.mesh.corner_vertices) ++used[v];
    for (std::size_t v = old_vertices; v < used.size(); ++v) EXPECT_GT(used[v], 0) << "a new vertex without a face";
  }
}

TEST(CutFaces, NewVerticesStayOnAWallFarFromTheOrigin) {
  constexpr double kFar = 1e16 / 3;  // rounding there is half a unit
  for (Atlas atlas : testing::many_atlases()) {
    for (Vec3& position : atlas.positions) position.z() = kFar;
    for (const Vec3& position : faces_of(testing::laid(atlas)).positions) EXPECT_EQ(position.z(), kFar) << atlas.name;
  }
}

TEST(CutFaces, NoFaceNamesAVertexTwiceBesideAConesTip) {
  // Two edges of one face from the tip's vertices are one edge in space: cut across, both get one new vertex, which is doubled.
  const Atlas atlas = cone(8);
  const CutFaces out = faces_of(testing::laid(atlas, 0.9));
  const auto old_vertices = static_cast<int>(atlas.positions.size());
  for (std::size_t f = 0; f < out.mesh.face_sources.size(); ++f) {
    const auto begin = out.mesh.corner_vertices.begin();
    std::set<int> vertices(begin + out.mesh.face_offsets[f], begin + out.mesh.face_offsets[f + 1]);
    EXPECT_EQ(static_cast<int>(vertices.size()), out.mesh.face_offsets[f + 1] - out.mesh.face_offsets[f]) << "face " << f;
  }
  int doubled = 0;
  for (std::size_t k = old_vertices; k < out.positions.size(); ++k)
    doubled += std::count(out.positions.begin() + k + 1, out.positions.end(), out.positions[k]) > 0;
  EXPECT_GT(doubled, 0) << "the cut does not run across the tip's faces";
  ASSERT_EQ(out.positions.size(), old_vertices + out.mesh.new_vertices.size());
}

std::map<std::pair<int, int>, int> edge_uses(const std::vector<int>& offsets, const std::vector<int>& corners) {
  std::map<std::pair<int, int>, int> uses;
  for (std::size_t f = 0; f + 1 < offsets.size(); ++f) {
    for (int c = offsets[f]; c < offsets[f + 1]; ++c)
      ++uses[std::minmax(corners[c], corners[c + 1 < offsets[f + 1] ? c + 1 : offsets[f]])];
  }
  return uses;
}

double border_length(const std::vector<Vec3>& positions, const std::map<std::pair<int, int>, int>& uses) {
  double sum = 0;
  for (const auto& [edge, used] : uses) {
    EXPECT_LE(used, 2);
    if (used == 1) sum += (positions[edge.first] - positions[edge.second]).norm();
  }
  return sum;
}

/// Three triangles in a row, the middle one with two vertices at one place in space, and another chart at one of its edges there.
Atlas with_vertices_together() {
  Atlas atlas = flat_atlas({{-1, 0, 0}, {-0.1, 0, 0}, {0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 1, 0}, {3, 0, 0}, {4, 0.5, 0}},
                           {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {5, 6, 7}});
  for (const int v : {1, 2, 6}) atlas.positions[v] = {0, 0, 0};
  atlas.positions[5] = atlas.positions[4];
  return atlas;
}

TEST(CutFaces, EdgesThatLieTogetherHaveVerticesOfTheirOwnAndStayClosed) {
  const Atlas atlas = with_vertices_together();
  Laid laid{atlas, split_charts(atlas), {}, {}, {}};
  ASSERT_EQ(laid.set.charts.size(), 2u);
  std::vector<SplitMesh> meshes;
  for (const Chart& chart : laid.set.charts) meshes.emplace_back(chart);
  const auto vertex = [&](int v) {
    return laid.set
        .corners[std::find(atlas.corner_vertices.begin(), atlas.corner_vertices.end(), v) - atlas.corner_vertices.begin()]
        .vertex;
  };
  for (const int foot : {1, 2}) {
    const Side side = meshes[0].find_side(vertex(foot), vertex(4));
    meshes[0].split(side, 0.5, 0.5 * (meshes[0].uvs[vertex(foot)] + meshes[0].uvs[vertex(4)]));
  }
  match_boundaries(meshes, laid.set.points);
  laid.cut = divided_atlas(meshes, laid.set.charts, laid.set.points);
  const CutFaces out = faces_of(laid);
  EXPECT_EQ(out.mesh.new_vertices.size(), 2u);
  EXPECT_EQ(out.positions[8], out.positions[9]);
  EXPECT_NEAR(border_length(out.positions, edge_uses(out.mesh.face_offsets, out.mesh.corner_vertices)),
              border_length(atlas.positions, edge_uses(atlas.face_offsets, atlas.corner_vertices)), 1e-12);
}

/// Every corner of the cut is a mean of corners of the input face that its own face is part of; returns how many are new.
int expect_corner_means(const Atlas& atlas, const CutFaces& out) {
  const CutMesh& mesh = out.mesh;
  EXPECT_EQ(mesh.corner_sources.size(), mesh.corner_vertices.size());
  EXPECT_EQ(mesh.corner_weights.size(), mesh.corner_vertices.size());
  int new_corners = 0;
  for (std::size_t f = 0; f < mesh.face_sources.size(); ++f) {
    for (int c = mesh.face_offsets[f]; c < mesh.face_offsets[f + 1]; ++c) {
      const Vec3& weights = mesh.corner_weights[c];
      EXPECT_GE(weights.minCoeff(), 0);
      EXPECT_NEAR(weights.sum(), 1, 1e-12);
      int heaviest = 0;
      weights.maxCoeff(&heaviest);
      Vec3 there = Vec3::Zero();
      std::vector<Vec3> corners;
      for (int k = 0; k < 3; ++k) {
        const int source = mesh.corner_sources[c][k];
        EXPECT_GE(source, atlas.face_offsets[mesh.face_sources[f]]);
        EXPECT_LT(source, atlas.face_offsets[mesh.face_sources[f] + 1]);
        if (weights[k] == 0) {
          EXPECT_EQ(source, mesh.corner_sources[c][heaviest]);
        }
        corners.push_back(atlas.positions[atlas.corner_vertices[source]]);
        there += weights[k] * corners.back();
      }
      const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
      const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
      there = there.cwiseMax(low).cwiseMin(high);
      EXPECT_EQ(there, out.positions[mesh.corner_vertices[c]]) << "faces of one vertex must agree to the last bit";
      if (mesh.corner_vertices[c] < static_cast<int>(atlas.positions.size())) {
        EXPECT_EQ(weights, Vec3(1, 0, 0));
        EXPECT_EQ(atlas.corner_vertices[mesh.corner_sources[c][0]], mesh.corner_vertices[c]);
      } else {
        ++new_corners;
      }
    }
  }
  return new_corners;
}

/// The atlas with every third face wound the other way.
Atlas with_mixed_winding(const Atlas& atlas) {
  Atlas out = atlas;
  for (int f = 0; f < atlas.face_count(); f += 3) {
    std::reverse(out.corner_vertices.begin() + atlas.face_offsets[f], out.corner_vertices.begin() + atlas.face_offsets[f + 1]);
    std::reverse(out.corner_uvs.begin() + atlas.face_offsets[f], out.corner_uvs.begin() + atlas.face_offsets[f + 1]);
  }
  return out;
}

TEST(CutFaces, CornersAreMeansOfCornersOfTheirOwnFace) {
  for (const Atlas& atlas : testing::many_atlases()) {
    Laid laid = testing::laid(atlas);
    EXPECT_GT(expect_corner_means(atlas, faces_of(laid)), 0);
    for (Piece& piece : laid.cut.pieces) restore_faces(piece, laid.set.charts[piece.chart], 1);
    expect_corner_means(atlas, faces_of(laid));
  }
}

TEST(CutFaces, CornersAreMeansOfCornersOfTheirOwnFaceAlsoWhereVerticesAreDoubledOrFacesTurned) {
  for (const Atlas& atlas : {shapes::mesh(shapes::c_shape(), 0.12), testing::open_box(5)}) {
    for (const Atlas& other : {unwelded(atlas), with_mixed_winding(atlas)})
      EXPECT_GT(expect_corner_means(other, faces_of(testing::laid(other))), 0);
  }
}

TEST(CutFaces, FacesKeepAreaAndWindingInSpace) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const CutFaces out = faces_of(testing::laid(atlas));
    std::vector<Vec3> before, after(atlas.face_count(), Vec3::Zero());
    for (int f = 0; f < atlas.face_count(); ++f)
      before.push_back(area_vector(atlas.positions, atlas.corner_vertices, atlas.face_offsets[f], atlas.face_offsets[f + 1]));
    for (std::size_t f = 0; f < out.mesh.face_sources.size(); ++f) {
      const Vec3 part =
          area_vector(out.positions, out.mesh.corner_vertices, out.mesh.face_offsets[f], out.mesh.face_offsets[f + 1]);
      const int source = out.mesh.face_sources[f];
      EXPECT_GT(part.dot(before[source]), 0) << "wound against the input";
      after[source] += part;
    }
    for (int f = 0; f < atlas.face_count(); ++f) EXPECT_LT((after[f] - before[f]).norm(), 1e-9 * before[f].norm() + 1e-15);
  }
}

TEST(CutFaces, TheSurfaceStaysClosedAlsoAfterFacesAreRestored) {
  for (const Atlas& atlas : testing::many_atlases()) {
    Laid laid = testing::laid(atlas);
    const double before = border_length(atlas.positions, edge_uses(atlas.face_offsets, atlas.corner_vertices));
    for (int round = 0; round < 2; ++round) {
      const CutFaces out = faces_of(laid);
      EXPECT_NEAR(border_length(out.positions, edge_uses(out.mesh.face_offsets, out.mesh.corner_vertices)), before, 1e-9);
      for (Piece& piece : laid.cut.pieces) restore_faces(piece, laid.set.charts[piece.chart], 1);
    }
  }
}

TEST(CutFaces, FacesThatNothingCrossesKeepTheirCorners) {
  int untouched = 0;
  for (const Atlas& atlas : testing::many_atlases()) {
    const CutFaces out = faces_of(testing::laid(atlas));
    std::vector<int> parts(atlas.face_count(), 0);
    for (int f : out.mesh.face_sources) ++parts[f];
    EXPECT_EQ(std::count(parts.begin(), parts.end(), 0), 0) << "a face is lost";
    for (std::size_t f = 0; f < out.mesh.face_sources.size(); ++f) {
      const int source = out.mesh.face_sources[f];
      if (parts[source] > 1) continue;
      std::vector<int> old_corners;
      for (int c = out.mesh.face_offsets[f]; c < out.mesh.face_offsets[f + 1]; ++c) {
        const int v = out.mesh.corner_vertices[c];
        if (v < static_cast<int>(atlas.positions.size())) old_corners.push_back(v);
      }
      const std::vector<int> expected(atlas.corner_vertices.begin() + atlas.face_offsets[source],
                                      atlas.corner_vertices.begin() + atlas.face_offsets[source + 1]);
      EXPECT_EQ(old_corners, expected);
      ++untouched;
    }
  }
  EXPECT_GT(untouched, 100);
}

TEST(CutFaces, EveryTornEdgeIsASeam) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Laid laid = testing::laid(atlas);
    const CutFaces out = faces_of(laid);
    std::set<std::pair<int, int>> seams;
    for (const auto& seam : out.mesh.new_seams) seams.insert(std::minmax(seam[0], seam[1]));
    EXPECT_EQ(seams.size(), out.mesh.new_seams.size());
    // Edges between two faces of one chart of the input, whose corners are not the same vertices of one piece.
    struct Use {
      int chart;
      std::array<std::pair<int, int>, 2> ends;
    };
    std::map<std::pair<int, int>, std::vector<Use>> uses;
    for (std::size_t f = 0; f < out.mesh.face_sources.size(); ++f) {
      const int begin = out.mesh.face_offsets[f], end = out.mesh.face_offsets[f + 1];
      for (int c = begin; c < end; ++c) {
        int a = c, b = c + 1 < end ? c + 1 : begin;
        if (out.mesh.corner_vertices[a] > out.mesh.corner_vertices[b]) std::swap(a, b);
        const auto corner = [&](int k) { return std::pair(out.corners[k].chart, out.corners[k].vertex); };
        uses[{out.mesh.corner_vertices[a], out.mesh.corner_vertices[b]}].push_back(
            {laid.cut.pieces[out.corners[c].chart].chart, {corner(a), corner(b)}});
      }
    }
    for (const auto& [edge, both] : uses) {
      if (both.size() != 2 || both[0].chart != both[1].chart) continue;
      EXPECT_EQ(both[0].ends != both[1].ends, seams.contains(edge));
    }
  }
}

TEST(CutFaces, PolygonsAreConvexInSpaceAndInTheUvPlane) {
  int polygons = 0, whole = 0;
  for (const Atlas& atlas : {testing::open_box(5), shapes::quad_band(24, 5)}) {
    const Laid laid = testing::laid(atlas);
    for (const bool triangulate : {false, true}) {
      const CutFaces out = faces_of(laid, triangulate);
      for (std::size_t f = 0; f < out.mesh.face_sources.size(); ++f) {
        std::vector<Vec2> uvs;
        bool is_new = false;
        for (int c = out.mesh.face_offsets[f]; c < out.mesh.face_offsets[f + 1]; ++c) {
          uvs.push_back(laid.cut.pieces[out.corners[c].chart].mesh.uvs[out.corners[c].vertex]);
          is_new = is_new || out.mesh.corner_vertices[c] >= static_cast<int>(atlas.positions.size());
        }
        EXPECT_TRUE(is_strictly_convex(uvs));
        EXPECT_FALSE(triangulate && is_new && uvs.size() > 3);
        polygons += is_new && uvs.size() > 3;
        whole += triangulate && uvs.size() == 4;
      }
    }
  }
  EXPECT_GT(polygons, 0);
  EXPECT_GT(whole, 0) << "faces that nothing divides stay as they are";
}

}  // namespace
}  // namespace atlas_refine
