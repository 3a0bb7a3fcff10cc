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

/// Two quads side by side, the second named by `second`; the file has a vt record for each of their six corners in space.
std::string two_quads(const std::string& second) {
  return "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\n"
         "vt 0 0\nvt 1 0\nvt 2 0\nvt 0 1\nvt 1 1\nvt 2 1\nvt 7 7\nf 1/1 2/2 5/5 4/4\n" +
         second + "f 3/3 6/6 5/5\n";
}

struct Oddity {
  std::string face;
  std::string note;
};

TEST(ObjFile, FacesThatNoAtlasCanHoldAreLeftOutAndWrittenAsTheyWere) {
  for (const auto& [face, note] : std::vector<Oddity>{
           {"f 2 3 6 5\n", "1 face has corners without UVs and is left out (line 16)"},
           {"f 2/2 3/3 6 5/5\n", "1 face has corners without UVs and is left out (line 16)"},
           {"f 2//1 3//1 6//1\n", "1 face has corners without UVs and is left out (line 16)"},
           {"f 2/2 3/3 # two\n", "1 face has fewer than three different vertices and is left out (line 16)"},
           {"f\n", "1 face has fewer than three different vertices and is left out (line 16)"},
           {"f 2/2 3/3 2/2 3/7\n", "1 face has fewer than three different vertices and is left out (line 16)"},
           {"f 2/2 3/3 6/6 2/2 5/5\n", "1 face comes to a vertex twice and is left out (line 16)"},
           {"f 2 3 6\nf -6/-5 2 3\n", "2 faces have corners without UVs and are left out (the first on line 16)"}}) {
    const ObjFile file = ObjFile::parse(two_quads(face));
    EXPECT_EQ(file.atlas().face_offsets, (std::vector<int>{0, 4, 7})) << face;
    EXPECT_EQ(file.notes(), std::vector<std::string>{note});
    EXPECT_EQ(file.face_number(1), file.face_count() - 1);
    EXPECT_EQ(file.where(1), file.face_count() == 3 ? "line 17" : "line 18");
    std::vector<Vec2> uvs = file.atlas().corner_uvs;
    for (Vec2& uv : uvs) uv *= 0.5;
    const std::string text = file.with_uvs(uvs);
    EXPECT_EQ(text.substr(text.find("f 1/1")), "f 1/1 2/2 5/5 4/4\n" + face + "f 3/3 6/6 5/5\n");
    EXPECT_EQ(ObjFile::parse(text).atlas().corner_uvs, uvs);
  }
}

TEST(ObjFile, FacesLeftOutFollowRecordsThatAreRepeated) {
  const ObjFile file = ObjFile::parse(two_quads("f 2/2 3/3 6\n"));
  const std::vector<Vec2> uvs = shifted(file.atlas().corner_uvs, 4, 5);
  const std::string text = file.with_uvs(uvs);
  EXPECT_EQ(text.substr(text.find("vt")),
            "vt 0 0\nvt 1 0\nvt 7 0\nvt 0 1\nvt 1 1\nvt 6 1\nvt 7 1\nvt 7 7\n"
            "f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6\nf 3/3 6/7 5/6\n");
  EXPECT_EQ(ObjFile::parse(text).atlas().corner_uvs, uvs);
}

TEST(ObjFile, AVertexNamedSeveralTimesInARowIsOneCorner) {
  for (const std::string face :
       {"f 2/2 3/3 6/6 5/5 5/5\n", "f 2/2 2/2 2/2 3/3 6/6 5/5\n", "f 2/2 3/3 6/6 5/5 2/2\n", "f 2/2 3/3 3/7 6/6 5/5\n"}) {
    const ObjFile file = ObjFile::parse(two_quads(face));
    EXPECT_EQ(file.atlas().face_offsets, (std::vector<int>{0, 4, 8, 11})) << face;
    EXPECT_EQ(std::vector<int>(file.atlas().corner_vertices.begin() + 4, file.atlas().corner_vertices.begin() + 8),
              (std::vector<int>{1, 2, 5, 4}));
    EXPECT_EQ(file.atlas().corner_uvs[5], Vec2(2, 0)) << "the first of them has the UV";
    EXPECT_EQ(file.notes(), std::vector<std::string>{"1 face names a vertex several times in a row, taken once (line 16)"});
    EXPECT_EQ(file.with_uvs(file.atlas().corner_uvs), two_quads(face));
    std::vector<Vec2> uvs = file.atlas().corner_uvs;
    for (Vec2& uv : uvs) uv *= 0.5;
    const std::string text = file.with_uvs(uvs);
    EXPECT_NE(text.find("4/4\n" + face + "f 3/3"), std::string::npos) << text;
    EXPECT_EQ(ObjFile::parse(text).atlas().corner_uvs, uvs);
  }
}

TEST(ObjFile, ACornerThatIsRepeatedWithAnotherUvFollowsTheFirst) {
  const ObjFile file = ObjFile::parse(two_quads("f 2/2 3/3 3/7 6/6 5/5\n"));
  const std::string text = file.with_uvs(shifted(file.atlas().corner_uvs, 0, 1));
  EXPECT_NE(text.find("vt 2 1\nvt 3 1\nvt 3 0\nf"), std::string::npos) << text;
}

TEST(ObjFile, AFaceWithAnInfiniteUvIsLeftOutAndItsRecordKept) {
  for (const std::string number : {"nan 0", "0 -NaN", "inf", "-nan(ind) 1e999 # bad"}) {
    const std::string text = "vt " + number + "\nf 2/2 3/3 6/8 5/5\n";
    const ObjFile file = ObjFile::parse(two_quads(text));
    EXPECT_EQ(file.atlas().face_offsets, (std::vector<int>{0, 4, 7})) << number;
    EXPECT_EQ(file.notes(), std::vector<std::string>{"1 face has a UV that is not finite and is left out (line 17)"});
    EXPECT_EQ(file.with_uvs(file.atlas().corner_uvs), two_quads(text));
    EXPECT_NE(file.with_uvs(shifted(file.atlas().corner_uvs, 0, 1)).find("4/4\n" + text + "f 3/3"), std::string::npos);
    EXPECT_NE(file.with_uvs(shifted(file.atlas().corner_uvs, 4, 1)).find("\nvt " + number + "\nf 2/2 3/3 6/9 5/5\n"),
              std::string::npos)
        << file.with_uvs(shifted(file.atlas().corner_uvs, 4, 1));
    const ObjFile before = ObjFile::parse("f 1/8 2/1 3/1\n" + two_quads(text));
    EXPECT_EQ(before.notes(),
              std::vector<std::string>{"2 faces have a UV that is not finite and are left out (the first on line 1)"});
    EXPECT_EQ(before.atlas().face_offsets, file.atlas().face_offsets);
  }
}

TEST(ObjFile, HomogeneousPositionsAreDividedByW) {
  const ObjFile file = ObjFile::parse("v 2 4 6 2\nv 1 0 0 1.0\nv 0 1 0 0\nv 1 2 3 0.5 0.5 0.5\nvt 0 0\nf 1/1 2/1 3/1 4/1\n");
  EXPECT_EQ(file.atlas().positions, (std::vector<Vec3>{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {1, 2, 3}}));
}

TEST(ObjFile, AWThatMakesAPositionInfiniteIsRefusedByItsLine) {
  for (const std::string w : {"nan", "-nan", "1e-320"}) {
    try {
      ObjFile::parse("v 0 0 0\nv 1 0 0 " + w + "\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
      FAIL() << w;
    } catch (const RefineError& error) {
      EXPECT_EQ(std::string(error.what()), "line 2: a vertex position that its w makes infinite") << w;
    }
  }
}

TEST(ObjFile, ACornerNamedTwiceMayComeFromARecordThatFollows) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
      "f -3/-3 -2/-2 -1/-1 3/4\nvt 5 5\nf 1/1 2/2 3/3\n";
  const ObjFile file = ObjFile::parse(text);
  const std::vector<Vec2> uvs = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0.1, 0}, {0.7, 0}, {0.7, 0.7}};
  EXPECT_EQ(ObjFile::parse(file.with_uvs(uvs)).atlas().corner_uvs, uvs);
}

}  // namespace
}  // namespace atlas_refine::io
