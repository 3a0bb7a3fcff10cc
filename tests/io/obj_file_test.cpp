// OBJ text in, OBJ text out: only vt records and vt indices change.
#include "io/obj_file.h"

#include <gtest/gtest.h>

#include "atlas_refine/error.h"

namespace atlas_refine::io {
namespace {

const std::string two_triangles =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0 0.5\nvt 1 1\nvt 0 1\nvt 9 9\n"
    "g a\nf 1/1 2/2 3/3\nl 2/2 3/3 4/5\ng b\nf -4/-5 -2/-3 -1/-2\n";

std::vector<Vec2> shifted(std::vector<Vec2> uvs, int first, double by) {
  for (std::size_t c = first; c < uvs.size(); ++c) uvs[c].x() += by;
  return uvs;
}

TEST(ObjFile, ReadsPolygonsAndUvs) {
  const ObjFile file = ObjFile::parse(two_triangles);
  EXPECT_EQ(file.atlas().face_offsets, (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(file.atlas().corner_vertices, (std::vector<int>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(file.atlas().corner_uvs[5], Vec2(0, 1));
  EXPECT_EQ(file.where(1), "line 14");
}

TEST(ObjFile, SameUvsGiveTheSameText) {
  const std::string text = "vt .50 1e-0 # c\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0.1\r\nvt 0 7\r\nf 1/1 2/2 3/3";
  const ObjFile file = ObjFile::parse(text);
  EXPECT_EQ(file.with_uvs(file.atlas().corner_uvs), text);
}

TEST(ObjFile, OneValuePerRecordLeavesIndicesAlone) {
  const ObjFile file = ObjFile::parse(two_triangles);
  std::vector<Vec2> uvs = file.atlas().corner_uvs;
  for (Vec2& uv : uvs) uv = uv * 0.1 + Vec2(0.2, 0.3);
  EXPECT_EQ(file.with_uvs(uvs),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
            "vt 0.2 0.3\nvt 0.30000000000000004 0.3 0.5\nvt 0.30000000000000004 0.4\nvt 0.2 0.4\nvt 9 9\n"
            "g a\nf 1/1 2/2 3/3\nl 2/2 3/3 4/5\ng b\nf -4/-5 -2/-3 -1/-2\n");
}

TEST(ObjFile, RecordsThatSeveralValuesNeedAreRepeatedInPlace) {
  const ObjFile file = ObjFile::parse(two_triangles);
  const std::vector<Vec2> uvs = shifted(file.atlas().corner_uvs, 3, 5);
  const std::string text = file.with_uvs(uvs);
  EXPECT_EQ(text,
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
            "vt 0 0\nvt 5 0\nvt 1 0 0.5\nvt 1 1\nvt 6 1\nvt 5 1\nvt 9 9\n"
            "g a\nf 1/1 2/3 3/4\nl 2/3 3/4 4/7\ng b\nf -4/-6 -2/-3 -1/-2\n");
  const ObjFile again = ObjFile::parse(text);
  EXPECT_EQ(again.atlas().corner_uvs, uvs);
  EXPECT_EQ(again.atlas().corner_vertices, file.atlas().corner_vertices);
}

TEST(ObjFile, RepeatedRecordsAreWeldedByValue) {
  const ObjFile file = ObjFile::parse(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5 0.5\n"
      "f 1/1 2/1 3/1\nf 1/1 2/1 4/1");
  const std::vector<Vec2> uvs = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, -1}};
  const std::string text = file.with_uvs(uvs);
  EXPECT_EQ(ObjFile::parse(text).atlas().corner_uvs, uvs);
  EXPECT_EQ(text.find("vt 0 0\n"), text.rfind("vt 0 0\n"));
}

TEST(ObjFile, RelativeIndicesFollowRecordsRepeatedBetweenBlocks) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf -3/-3 -2/-2 -1/-1\nf 1/1 2/2 3/3\n"
      "v 0 0 1\nv 1 0 1\nv 0 1 1\nvt 0 2\nvt 1 2\nvt 0 3\nf -3/-3 -2/-2 -1/-1\nf -6/-6 2/2 -1/6\n";
  const ObjFile file = ObjFile::parse(text);
  std::vector<Vec2> uvs = file.atlas().corner_uvs;
  for (std::size_t c = 0; c < uvs.size(); ++c) {
    const std::size_t face = c / 3;
    uvs[c] += 0.01 * static_cast<double>(face) * Vec2(1, 1);
  }
  const ObjFile again = ObjFile::parse(file.with_uvs(uvs));
  EXPECT_EQ(again.atlas().corner_uvs, uvs);
  EXPECT_EQ(again.atlas().corner_vertices, file.atlas().corner_vertices);
}

TEST(ObjFile, LastRecordWithoutLineEndCanBeRepeated) {
  const ObjFile file = ObjFile::parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\nvt 0 0");
  const std::vector<Vec2> uvs = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(ObjFile::parse(file.with_uvs(uvs)).atlas().corner_uvs, uvs);
}

TEST(ObjFile, EveryDoubleReadsBack) {
  const ObjFile file = ObjFile::parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const std::vector<Vec2> uvs = {{0.1, 1.0 / 3}, {5e-324, 1.7976931348623157e308}, {-2.2250738585072014e-308, 1e-7}};
  EXPECT_EQ(ObjFile::parse(file.with_uvs(uvs)).atlas().corner_uvs, uvs);
}

TEST(ObjFile, RefusalNamesTheLine) {
  try {
    ObjFile::parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n\nf 1/1 2/1 4/1\n");
    FAIL() << "vertex 4 does not exist";
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_STREQ(error.what(), "line 6: face 0: vertex 4 is out of range, the file has 3 vertices");
  }
}

}  // namespace
}  // namespace atlas_refine::io
