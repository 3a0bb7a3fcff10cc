// The ways in which programs write the same OBJ file: each is read alike, and keeps all of its bytes but UVs and their indices.
#include <gtest/gtest.h>

#include <cctype>
#include <functional>

#include "io/hand_made_cut.h"
#include "io/number_text.h"
#include "io/obj_file.h"

namespace atlas_refine::io {
namespace {

/// A unit square of two triangles, its UVs in <>; ~ is a second number that is not written and stands for 0.
struct Dialect {
  const char* name;
  std::string text;
};

const std::string positions = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string uvs = "vt <0> <0>\nvt <1> <0>\nvt <1> <1>\nvt <0> <1>\n";
const std::string faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

const std::vector<Dialect> dialects = {
    {"plain", positions + uvs + faces},
    {"negative", positions + uvs + "f -4/-4 -3/-3 -2/-2\nf -4/-4 -2/-2 -1/-1\n"},
    {"mixed signs", positions + uvs + "f 1/-4 -3/2 3/3\nf -4/1 3/-2 -1/4\n"},
    {"interleaved",
     "v 0 0 0\nvt <0> <0>\nv 1 0 0\nvt <1> <0>\nv 1 1 0\nvt <1> <1>\nf -3/-3 -2/-2 -1/-1\nv 0 1 0\nvt <0> <1>\nf -4/-4 -2/-2 "
     "4/4\n"},
    {"faces first", faces + positions + uvs},
    {"backslash behind all", faces + positions + uvs.substr(0, uvs.size() - 1) + "\\"},
    {"backslashes behind all", faces + positions + uvs.substr(0, uvs.size() - 1) + "\\\n \\"},
    {"UVs first", uvs + positions + faces},
    {"three numbers in vt", positions + "vt <0> <0> 0.0\nvt <1> <0> 0.25\nvt <1> <1> -1\nvt <0> <1> 0\n" + faces},
    {"one number in vt", positions + "vt <0><~>\nvt <1><~> # u\nvt <1> <1>\nvt <0> <1> 0\n" + faces},
    {"vertex colours", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 .5 .5 .5\n" + uvs + faces},
    {"colours with alpha", "v 0 0 0 1 0 0 1\nv 1 0 0 0 1 0 1\nv 1 1 0 0 0 1 1\nv 0 1 0 .5 .5 .5 1\n" + uvs + faces},
    {"homogeneous", "v 0 0 0 1\nv 2 0 0 2\nv .5 .5 0 .5\nv 0 1 0 1.0\n" + uvs + faces},
    {"CRLF", replaced(positions + uvs + faces, "\n", "\r\n")},
    {"lone CR", replaced(positions + uvs + faces, "\n", "\r")},
    {"mixed line ends", replaced(positions, "\n", "\r\n") + uvs + replaced(faces, "\n", "\r")},
    {"no line end", positions + uvs + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4"},
    {"continued",
     "v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt \\\n<0> <0>\nvt <1> \\\n <0>\nvt <1> <1>\nvt <0> <1>\nf 1/1 2/2 \\\n3/3\nf "
     "1/1\\\n 3/3 4/4\n"},
    {"continued before blanks", positions + uvs + "f 1/1 2/2 \\  \n  3/3\nf 1/1 \\\t\r\n3/3 \\ \t\n4/4\n"},
    {"continued at the end", positions + uvs + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4 \\ "},
    {"comments after data",
     "v 0 0 0 # v 1 2 3\nv 1 0 0 #\nv 1 1 0\nv 0 1 0\nvt <0> <0> # 1 2\nvt <1> <0>\nvt <1> <1> #\nvt <0> <1>\n"
     "f 1/1 2/2 3/3 # f 9/9 8/8 7/7\nf 1/1 3/3 4/4 #c\n"},
    {"comments without a blank",
     "v 0 0 0#v 1 2 3\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt <0> <0>#\nvt <1> <0>\nvt <1> <1>\nvt <0> <1>\nf 1/1 2/2 3/3#f 9\nf 1/1 3/3 "
     "4/4\n"},
    {"comment lines", "# f 1 2 3\n" + positions + "  # vt 5 5\n#vt 6 6\n" + uvs + "#\n" + faces + "# end"},
    {"groups, materials, elements", "mtllib a b.mtl\no square\n" + positions + uvs +
                                        "vn 0 0 1\ng one two\nusemtl red paint\ns 1\nf 1/1/1 2/2/1 3/3/1\nl 1/1 2/2 3\nl -1 "
                                        "-2\np 1 -1\ng\ns off\nusemtl\nf 1/1 3/3 4/4\n"},
    {"free-form records", "vp 0.5\ncstype bezier\ndeg 3\n" + positions + uvs + "curv 0 1 1 2 3 4\nparm u 0 1\nend\n" + faces},
    {"byte order mark", "\xEF\xBB\xBF" + positions + uvs + faces},
    {"UTF-8 names", "o \xC3\xA9tag\xC3\xA8re\ng \xE6\xA3\x9A\nusemtl \xF0\x9F\x8E\xA8\n" + positions + uvs + faces},
    {"Latin-1 names", "o \xE9tag\xE8re\n" + positions + uvs + faces},
    {"numbers",
     "v 0e0 -0 0.\nv +1 .0 0E-5\nv 1.e0 10e-1 +0\nv -0.0 +.1e+1 00\nvt <+0> <0.>\nvt <1.> <.0e5>\nvt <1E+00> <100e-2>\nvt <-0.0> "
     "<+1.0>\n" +
         faces},
    {"tabs and blanks",
     "v\t0\t0\t0\nv 1 \t 0   0\n\tv 1 1 0\n   v 0 1 0   \nvt\t<0>\t<0>\n vt  <1>   <0> \nvt <1> <1>\t\nvt <0> <1>\n"
     "f   1/1  2/2\t3/3  \n\tf 1/1 3/3 4/4\t\n"},
    {"empty lines", "\n\n" + positions + "\n  \n" + uvs + "\n\t\n" + faces + "\n\n"},
    {"empty parts", positions + uvs + "f 1/1/ 2/2/ 3/3/\nf 1/1/ 3/3/ 4/4/\n"},
    {"normals on some faces", positions + uvs + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/-1\nf 1/1 3/3 4/4\n"},
    {"normals on some corners", positions + uvs + "vn 0 0 1\nf 1/1/1 2/2 3/3/1\nf 1/1 3/3 4/4/1\n"},
};

double moved(double coordinate) { return 0.5 * coordinate + 0.25; }

/// The text with each UV number as `write` has it.
std::string with_numbers(const std::string& text, const std::function<std::string(const std::string&)>& write) {
  std::string result;
  std::size_t copied = 0;
  for (std::size_t begin = text.find('<'); begin != std::string::npos; begin = text.find('<', copied)) {
    const std::size_t end = text.find('>', begin);
    result += text.substr(copied, begin - copied) + write(text.substr(begin + 1, end - begin - 1));
    copied = end + 1;
  }
  return result + text.substr(copied);
}

std::string original(const std::string& text) {
  return with_numbers(text, [](const std::string& number) { return number == "~" ? "" : number; });
}

std::string all_moved(const std::string& text) {
  return with_numbers(text, [](const std::string& number) {
    std::string result = number == "~" ? " " : "";
    append_number(result, moved(number == "~" ? 0 : std::stod(number)));
    return result;
  });
}

class ObjDialects : public testing::TestWithParam<Dialect> {
 protected:
  ObjFile file_ = ObjFile::parse(original(GetParam().text));
};

TEST_P(ObjDialects, AreReadAlike) {
  const Atlas plain = ObjFile::parse(original(dialects.front().text)).atlas();
  EXPECT_EQ(file_.atlas().positions, plain.positions);
  EXPECT_EQ(file_.atlas().face_offsets, plain.face_offsets);
  EXPECT_EQ(file_.atlas().corner_vertices, plain.corner_vertices);
  EXPECT_EQ(file_.atlas().corner_uvs, plain.corner_uvs);
  EXPECT_TRUE(file_.notes().empty());
}

TEST_P(ObjDialects, KeepEveryByteButUvs) {
  EXPECT_EQ(file_.with_uvs(file_.atlas().corner_uvs), original(GetParam().text));
  std::vector<Vec2> uvs = file_.atlas().corner_uvs;
  for (Vec2& uv : uvs) uv = Vec2(moved(uv.x()), moved(uv.y()));
  EXPECT_EQ(file_.with_uvs(uvs), all_moved(GetParam().text));
}

TEST_P(ObjDialects, HoldASeamThatIsNew) {
  std::vector<Vec2> uvs = file_.atlas().corner_uvs;
  for (int c = 3; c < 6; ++c) uvs[c].x() += 5;
  const ObjFile again = ObjFile::parse(file_.with_uvs(uvs));
  EXPECT_EQ(again.atlas().corner_uvs, uvs);
  EXPECT_EQ(again.atlas().corner_vertices, file_.atlas().corner_vertices);
}

TEST_P(ObjDialects, HoldACut) {
  CutMesh cut;
  cut.face_offsets = {0, 3, 6, 10};
  cut.corner_vertices = {0, 1, 4, 1, 2, 4, 0, 4, 2, 3};
  cut.face_sources = {0, 0, 1};
  cut.new_vertices = {{{0, 2, 1}, Vec3(0.5, 0.5, 0)}};
  add_corner_means(cut, file_.atlas());
  std::vector<Vec2> uvs;
  for (int c = 0; c < 10; ++c) uvs.emplace_back(c, -c);
  const ObjFile again = ObjFile::parse(file_.with_cut(cut, uvs));
  EXPECT_EQ(again.atlas().corner_uvs, uvs);
  EXPECT_EQ(again.atlas().corner_vertices, cut.corner_vertices);
  EXPECT_EQ(again.atlas().positions.back(), Vec3(0.5, 0.5, 0));
  EXPECT_TRUE(again.notes().empty());
}

INSTANTIATE_TEST_SUITE_P(All, ObjDialects, testing::ValuesIn(dialects), [](const auto& info) {
  std::string name;
  for (char c : std::string(info.param.name)) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  return name;
});

}  // namespace
}  // namespace atlas_refine::io
