// OBJ text with divided faces: what is kept, what is new, and that it reads back.
#include <gtest/gtest.h>

#include "io/hand_made_cut.h"
#include "io/obj_file.h"

namespace atlas_refine::io {
namespace {

using Faces = std::vector<std::vector<int>>;

/// Parts as (source, vertices), vertices 0-based, new ones behind those of the file.
CutMesh cut_of(const std::vector<int>& sources, const Faces& parts, std::vector<NewVertex> vertices) {
  CutMesh cut;
  cut.face_sources = sources;
  cut.face_offsets = {0};
  for (const auto& part : parts) {
    cut.corner_vertices.insert(cut.corner_vertices.end(), part.begin(), part.end());
    cut.face_offsets.push_back(static_cast<int>(cut.corner_vertices.size()));
  }
  cut.new_vertices = std::move(vertices);
  return cut;
}

std::string with_cut(const ObjFile& file, CutMesh cut, const std::vector<Vec2>& uvs) {
  add_corner_means(cut, file.atlas());
  return file.with_cut(cut, uvs);
}

const std::string two_triangles =
    "# two\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1 0.5 # third\nvt 0 1\n"
    "g a\nusemtl red\ns 1\nf 1/1 2/2 3/3 # first\ng b\nusemtl blue\nf 1/1 3/3 4/4\n";

/// The first triangle is divided from vertex 1 (0-based) to a point on the edge 0-2, which both triangles have.
CutMesh divided_two() { return cut_of({0, 0, 1}, {{0, 1, 4}, {1, 2, 4}, {0, 4, 2, 3}}, {{{0, 2, 1}, Vec3(0.75, 0.25, 0)}}); }

const std::vector<Vec2> divided_uvs = {{0, 0},       {1, 0}, {0.25, 0.25}, {2, 0}, {2, 1},
                                       {1.25, 0.25}, {0, 0}, {0.25, 0.25}, {1, 1}, {0, 1}};

TEST(ObjCut, FacesAreReplacedInPlaceAndTheRestIsKept) {
  const ObjFile file = ObjFile::parse(two_triangles);
  EXPECT_EQ(with_cut(file, divided_two(), divided_uvs),
            "# two\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
            "vt 0 0\nvt 1 0\nvt 2 0\nvt 1 1 0.5 # third\nvt 2 1 0.5 # third\nvt 0 1\n"
            "g a\nusemtl red\ns 1\n"
            "v 0.25 0.25 0\nvt 0.25 0.25\nvt 1.25 0.25\n"
            "f 1/1 2/2 5/7\nf 2/3 3/5 5/8 # first\n"
            "g b\nusemtl blue\nf 1/1 5/7 3/4 4/6\n");
}

TEST(ObjCut, ReadsBack) {
  const CutMesh cut = divided_two();
  const ObjFile again = ObjFile::parse(with_cut(ObjFile::parse(two_triangles), cut, divided_uvs));
  EXPECT_EQ(again.atlas().corner_uvs, divided_uvs);
  EXPECT_EQ(again.atlas().corner_vertices, cut.corner_vertices);
  EXPECT_EQ(again.atlas().face_offsets, cut.face_offsets);
  EXPECT_EQ(again.atlas().positions.back(), Vec3(0.25, 0.25, 0));
}

TEST(ObjCut, EveryDoubleReadsBack) {
  const Vec3 weights(1.0 / 3, 0.1, 1 - 1.0 / 3 - 0.1);
  std::vector<Vec2> uvs(10, Vec2(1.0 / 7, 5e-324));
  const CutMesh cut = cut_of({0, 0, 0, 1}, {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {0, 2, 3}}, {{{0, 1, 2}, weights}});
  uvs.resize(cut.corner_vertices.size(), Vec2(-1e300, 0.1));
  const ObjFile file = ObjFile::parse("v 0.1 0.2 0.3\nv 1 0.7 1e-5\nv 1 1e10 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1\n");
  const ObjFile again = ObjFile::parse(with_cut(file, cut, uvs));
  EXPECT_EQ(again.atlas().corner_uvs, uvs);
  const auto& p = file.atlas().positions;
  EXPECT_EQ(again.atlas().positions.back(), Vec3(weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2]));
}

TEST(ObjCut, ColoursAreInterpolatedWhereAllCornersHaveThem) {
  const std::string coloured = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\n";
  const CutMesh cut = cut_of({0, 0}, {{0, 1, 3}, {1, 2, 3}}, {{{2, 0, 1}, Vec3(0.75, 0.25, 0)}});
  const std::vector<Vec2> uvs(6, Vec2(0, 0));
  EXPECT_NE(with_cut(ObjFile::parse(coloured), cut, uvs).find("v 0.75 0.75 0 0.25 0 0.75\n"), std::string::npos);
  const std::string partly = "v 0 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\n";
  EXPECT_NE(with_cut(ObjFile::parse(partly), cut, uvs).find("v 0.75 0.75 0\n"), std::string::npos);
}

TEST(ObjCut, NormalsAreInterpolatedInEachFace) {
  const std::string text =
      "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nvt 0 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\n"
      "f 1/1/1 2/1/2 3/1/3\nf 2/1/3 1/1/3 4/1/3\n";
  const CutMesh cut = cut_of({0, 0, 1}, {{0, 4, 2}, {4, 1, 2}, {1, 4, 0, 3}}, {{{0, 1, 2}, Vec3(0.5, 0.5, 0)}});
  const std::string out = with_cut(ObjFile::parse(text), cut, std::vector<Vec2>(10, Vec2(0, 0)));
  EXPECT_NE(out.find("vn 0.7071067811865475 0.7071067811865475 0\nf 1/1/1 5/2/4 3/1/3\nf 5/2/4 2/1/2 3/1/3\n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("f 2/1/3 5/2/3 1/1/3 4/1/3\n"), std::string::npos) << "equal normals need no new one" << out;
}

TEST(ObjCut, NormalsThatCancelOrCannotBeReadGiveWayToTheNearest) {
  const CutMesh cut = cut_of({0, 0}, {{0, 3, 2}, {3, 1, 2}}, {{{0, 1, 2}, Vec3(0.25, 0.75, 0)}});
  for (const std::string normals : {"vn 0 0 3\nvn 0 0 -1\n", "vn 1 x 0\nvn 0 0 1\n", "vn\nvn 0 0 1\n"}) {
    const std::string text = "v 0 0 0\nv 2 0 0\nv 1 1 0\nvt 0 0\n" + normals + "f 1/1/1 2/1/2 3/1/1\n";
    const std::string out = with_cut(ObjFile::parse(text), cut, std::vector<Vec2>(6, Vec2(0, 0)));
    EXPECT_NE(out.find("f 1/1/1 4/2/2 3/1/1\nf 4/2/2 2/1/2 3/1/1\n"), std::string::npos) << out;
  }
}

TEST(ObjCut, FacesAcrossAnEdgeOfDoubledVerticesUseTheirOwnNormals) {
  const std::string text =
      "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 2 0 0\nv 0 0 0\nv 1 -1 0\nvt 0 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 0 0 -1\n"
      "f 1/1/1 2/1/2 3/1/3\nf 4/1/3 5/1/4 6/1/3\n";
  const CutMesh cut = cut_of({0, 0, 1}, {{0, 6, 2}, {6, 1, 2}, {3, 6, 4, 5}}, {{{0, 1, 2}, Vec3(0.25, 0.75, 0)}});
  const std::string out = with_cut(ObjFile::parse(text), cut, std::vector<Vec2>(10, Vec2(0, 0)));
  EXPECT_NE(out.find("vn 0 0 1\nf 1/1/1 7/2/5"), std::string::npos) << out;
  EXPECT_NE(out.find("f 4/1/3 7/2/6 5/1/4 6/1/3\n"), std::string::npos) << out;
}

TEST(ObjCut, RecordsBehindTheFirstFaceMoveBeforeItAndIndicesBecomeAbsolute) {
  const std::string text =
      "o A\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\n  f -3/-1/-1 -2/-1/-1 -1/-1/-1\r\np -1 2\r\n"
      "o B\r\nv 0 0 1\r\nv 1 0 1\r\nv 0 1 1\r\nl -1 -2 -3/-1\r\nf -3/-1/1 -2/-1/1 -1/-1/1\r\nvt 0 5\r\nvn 0 1 0\r\nf 4/2/2 6/2/2 "
      "5/2/2";
  const ObjFile file = ObjFile::parse(text);
  const CutMesh cut = cut_of({0, 1, 2, 2}, {{0, 1, 2}, {3, 4, 5}, {3, 6, 5}, {6, 4, 5}}, {{{6, 8, 7}, Vec3(0.5, 0.5, 0)}});
  std::vector<Vec2> uvs(12, Vec2(0.5, 0));
  const std::string out = with_cut(file, cut, uvs);
  EXPECT_EQ(out,
            "o A\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0.5 0\r\nvn 0 0 1\r\n  \r\n"
            "v 0 0 1\r\nv 1 0 1\r\nv 0 1 1\r\nv 0.5 0 1\r\nvt 0.5 0\r\nvt 0.5 0\r\nvn 0 1 0\r\n"
            "f 1/1/1 2/1/1 3/1/1\r\np 3 2\r\no B\r\nl 6 5 4/1\r\nf 4/1/1 5/1/1 6/1/1\r\n"
            "f 4/2/2 7/3/2 6/2/2\r\nf 7/3/2 5/2/2 6/2/2");
  EXPECT_EQ(ObjFile::parse(out).atlas().corner_uvs, uvs);
}

TEST(ObjCut, FacesThatAreNotInTheAtlasKeepTheirTextWithAbsoluteIndices) {
  const ObjFile file = ObjFile::parse(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\nf 1//-1  2//1 -1//-1 # none\nf 1/1 2/1 2/1 3/1\nv 9 9 9\nvn 1 0 0\n"
      "f -1/1/-1 1/1/-2\nf 3/1 2/1 2/1 1/1 # last\n");
  const CutMesh cut = cut_of({0, 0, 1}, {{0, 4, 2}, {4, 1, 2}, {2, 1, 0}}, {{{0, 1, 2}, Vec3(0.5, 0.5, 0)}});
  EXPECT_EQ(with_cut(file, cut, std::vector<Vec2>(9, Vec2(0, 0))),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\nf 1//1  2//1 3//1 # none\n"
            "v 9 9 9\nv 0.5 0 0\nvt 0 0\nvn 1 0 0\n"
            "f 1/1 5/2 3/1\nf 5/2 2/1 3/1\nf 4/1/2 1/1/1\nf 3/1 2/1 2/1 1/1 # last\n");
}

TEST(ObjCut, NormalsThatSomeCornersLackAreNotInvented) {
  const ObjFile file = ObjFile::parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1 3/1/1\n");
  const CutMesh cut = cut_of({0, 0}, {{0, 3, 2}, {3, 1, 2}}, {{{0, 1, 2}, Vec3(0.25, 0.75, 0)}});
  const std::string out = with_cut(file, cut, std::vector<Vec2>(6, Vec2(0, 0)));
  EXPECT_TRUE(out.ends_with("f 1/1/1 4/2 3/1/1\nf 4/2 2/1 3/1/1\n")) << out;
}

TEST(ObjCut, AHomogeneousPositionIsTheMeanInSpace) {
  const ObjFile file = ObjFile::parse("v 2 0 0 2\nv 2 0 0 1\nv 1 1 0 1\nvt 0 0\nf 1/1 2/1 3/1\n");
  const CutMesh cut = cut_of({0, 0}, {{0, 3, 2}, {3, 1, 2}}, {{{0, 1, 2}, Vec3(0.5, 0.5, 0)}});
  const std::string out = with_cut(file, cut, std::vector<Vec2>(6, Vec2(0, 0)));
  EXPECT_NE(out.find("\nv 1.5 0 0 1\n"), std::string::npos) << out;
}

TEST(ObjCut, LastFaceWithoutLineEnd) {
  const ObjFile file = ObjFile::parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1");
  const CutMesh cut = cut_of({0, 0}, {{0, 3, 2}, {3, 1, 2}}, {{{0, 1, 2}, Vec3(0.5, 0.5, 0)}});
  const std::string out = with_cut(file, cut, std::vector<Vec2>(6, Vec2(0, 0)));
  EXPECT_TRUE(out.ends_with("f 1/1 4/2 3/1\nf 4/2 2/1 3/1")) << out;
}

TEST(ObjCut, CornersOfAnotherFaceAreRefused) {
  const ObjFile file = ObjFile::parse(two_triangles);
  CutMesh cut = divided_two();
  EXPECT_THROW(file.with_cut(cut, divided_uvs), std::logic_error) << "no corner means";
  add_corner_means(cut, file.atlas());
  for (const int source : {-1, 3, 6}) {
    CutMesh wrong = cut;
    wrong.corner_sources[2][1] = source;
    EXPECT_THROW(file.with_cut(wrong, divided_uvs), std::logic_error) << source;
  }
  CutMesh wrong = cut;
  wrong.corner_sources[0].fill(1);
  EXPECT_THROW(file.with_cut(wrong, divided_uvs), std::logic_error) << "another corner of the face";
}

}  // namespace
}  // namespace atlas_refine::io
