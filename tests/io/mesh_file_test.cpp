// Mesh files by name: what is read, and how a file that cannot be used is named.
#include "io/mesh_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/input_file.h"

namespace atlas_refine::io {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  MeshFiles() : path_(fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name()) {}
  ~MeshFiles() override { fs::remove(path_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string refusal() const {
    try {
      read_mesh_file(path_);
    } catch (const InputError& error) {
      EXPECT_EQ(error.path, path_);
      return error.what();
    }
    return "accepted";
  }

  fs::path path_;
};

TEST_F(MeshFiles, ItsOwnUvsGiveItsOwnBytes) {
  const std::string text = "# -0\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt -0.0 1e0\r\nvt .50 0\r\nvt 0 7\r\nf 1/1 2/2 3/1 # end";
  write(text);
  const auto file = read_mesh_file(path_);
  EXPECT_EQ(file->atlas().face_count(), 1);
  EXPECT_EQ(file->where(0), "line 8");
  EXPECT_EQ(file->with_uvs(file->atlas().corner_uvs), text);
}

TEST_F(MeshFiles, WhatCannotBeUsedIsNamed) {
  EXPECT_EQ(refusal(), "does not exist");
  write("");
  EXPECT_EQ(refusal(), "is empty");
  write("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 4/1\n");
  EXPECT_EQ(refusal(), "line 5: face 0: vertex 4 is out of range, the file has 3 vertices");
}

}  // namespace
}  // namespace atlas_refine::io
