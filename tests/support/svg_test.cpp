// The pictures: numbered files, a size that a README can carry, an error where they cannot be written.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "atlas_refine/debug_sink.h"
#include "atlas_refine/error.h"
#include "input/split_charts.h"
#include "measure/distortion.h"
#include "measure/snapshot.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

AtlasSnapshot snapshot(const Atlas& atlas, const std::string& stage) {
  const std::vector<Chart> charts = charts_as_placed(split_charts(atlas));
  return make_snapshot(stage, "PE 0.5 & <more>", charts, uv_box(charts));
}

std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class Svg : public testing::Test {
 protected:
  Svg() : directory_(std::filesystem::temp_directory_path() / ("atlas_refine_svg_" + std::to_string(::getpid()))) {
    std::filesystem::create_directory(directory_);
  }
  ~Svg() override { std::filesystem::remove_all(directory_); }
  std::filesystem::path directory_;
};

TEST_F(Svg, OneNumberedFileForEachStage) {
  const auto sink = svg_sink(directory_);
  sink->receive(snapshot(shapes::two_squares(0.1), "input"));
  sink->receive(snapshot(shapes::mesh(shapes::ring()), "squeezed"));
  const std::string first = read(directory_ / "00-input.svg");
  EXPECT_EQ(first.rfind("<svg", 0), 0u);
  EXPECT_NE(first.find("PE 0.5 &amp; &lt;more&gt;"), std::string::npos);
  EXPECT_EQ(first.find("nan"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "01-squeezed.svg"));
}

TEST_F(Svg, TwentyThousandTrianglesStaySmall) {
  const Atlas atlas = shapes::mesh(shapes::rectangle(1, 1), 0.0105, 0.8);
  ASSERT_GT(atlas.face_count(), 15000);
  svg_sink(directory_)->receive(snapshot(atlas, "input"));
  EXPECT_LT(std::filesystem::file_size(directory_ / "00-input.svg"), 600000u);
}

TEST_F(Svg, DegenerateAtlasesAreDrawn) {
  Atlas atlas = shapes::two_squares(0.1);
  for (Vec2& uv : atlas.corner_uvs) uv.setZero();
  svg_sink(directory_)->receive(snapshot(atlas, "input"));
  EXPECT_EQ(read(directory_ / "00-input.svg").find("nan"), std::string::npos);
}

TEST_F(Svg, AMissingDirectoryIsNamed) {
  const auto sink = svg_sink(directory_ / "missing");
  try {
    sink->receive(snapshot(shapes::two_squares(0.1), "input"));
    ADD_FAILURE();
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadOption);
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos);
  }
}

}  // namespace
}  // namespace atlas_refine
