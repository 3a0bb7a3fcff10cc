// Several files as one atlas: a cut result finds its way back to each file, and files appear together or not at all.
#include "collection.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "io/hand_made_cut.h"
#include "io/input_file.h"
#include "io/obj_file.h"
#include "output_file.h"

namespace atlas_refine::cli {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() : folder_(fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string text(const std::string& name) const {
    std::ostringstream out;
    out << std::ifstream(folder_ / name).rdbuf();
    return out.str();
  }
  int count() const { return static_cast<int>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator())); }

  fs::path folder_;
};

/// One triangle, two that share an edge with it in space, and one that stands alone.
class ThreeModels : public Files {
 protected:
  ThreeModels() {
    collection_.add(write("a.obj", "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"));
    collection_.add(write("b.obj", "v 0 1 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nvt 0 0\nf 1/1 2/1 3/1\n\nf 2/1 4/1 3/1\n"));
    collection_.add(write("c.obj", "v 0 0 9\nv 1 0 9\nv 0 1 9\nvt 0 0\nf -3/-1 -2/-1 -1/-1\n"));
  }

  /// On the edge that a and b share each gets a vertex of its own, b's second face is divided, c stays whole.
  RefineResult cut_result() const {
    RefineResult result;
    result.intervention = Intervention::Cut;
    CutMesh& cut = result.cut.emplace();
    cut.face_offsets = {0, 4, 8, 11, 14, 17};
    cut.corner_vertices = {0, 1, 10, 2, 3, 11, 4, 5, 4, 6, 12, 4, 12, 5, 7, 8, 9};
    cut.face_sources = {0, 1, 2, 2, 3};
    cut.new_vertices = {{{1, 2, 0}, Vec3(0.5, 0.5, 0)}, {{3, 4, 5}, Vec3(0.5, 0.5, 0)}, {{7, 8, 6}, Vec3(0.25, 0.75, 0)}};
    io::add_corner_means(cut, collection_.atlas());
    for (int c = 0; c < 17; ++c) result.corner_uvs.emplace_back(c, -c);
    return result;
  }

  Collection collection_;
};

TEST_F(ThreeModels, AreConcatenated) {
  EXPECT_EQ(collection_.atlas().face_offsets, (std::vector<int>{0, 3, 6, 9, 12}));
  EXPECT_EQ(collection_.atlas().corner_vertices, (std::vector<int>{0, 1, 2, 3, 4, 5, 4, 6, 5, 7, 8, 9}));
  EXPECT_EQ(collection_.atlas().positions.size(), 10);
  EXPECT_EQ(collection_.atlas().vertex_meshes, (std::vector<int>{0, 0, 0, 1, 1, 1, 1, 2, 2, 2}));
}

TEST_F(ThreeModels, AFaceIsNamedByFileAndLine) {
  EXPECT_EQ(collection_.place_of_face(0), (folder_ / "a.obj").string() + ": line 6");
  EXPECT_EQ(collection_.place_of_face(2), (folder_ / "b.obj").string() + ": line 8");
  EXPECT_EQ(collection_.place_of_face(3), (folder_ / "c.obj").string() + ": line 5");
  EXPECT_EQ(collection_.place_of_face(-1), (folder_ / "a.obj").string() + " and 2 more");
}

TEST_F(ThreeModels, EachFileGetsItsPartOfTheCut) {
  const RefineResult result = cut_result();
  const Collection::Output a = collection_.output(0, result), b = collection_.output(1, result);
  EXPECT_EQ(a.bytes, "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 -1\nvt 3 -3\nv 0.5 0.5 0\nvt 2 -2\nf 1/1 2/2 4/4 3/3\n");
  EXPECT_EQ(a.added_faces, 0);
  EXPECT_EQ(a.added_vertices, 1);
  const Atlas again = io::ObjFile::parse(b.bytes).atlas();
  EXPECT_EQ(again.face_offsets, (std::vector<int>{0, 4, 7, 10}));
  EXPECT_EQ(again.corner_vertices, (std::vector<int>{0, 4, 1, 2, 1, 3, 5, 1, 5, 2}));
  EXPECT_EQ(again.corner_uvs, std::vector<Vec2>(result.corner_uvs.begin() + 4, result.corner_uvs.begin() + 14));
  EXPECT_EQ(again.positions[4], Vec3(0.5, 0.5, 0)) << "each file has a vertex on the shared edge";
  EXPECT_EQ(again.positions[5], Vec3(1.25, 0.75, 0));
  EXPECT_EQ(b.added_faces, 1);
  EXPECT_EQ(b.added_vertices, 2);
}

TEST_F(ThreeModels, AFileThatNoCutCrossesKeepsAllButItsUvs) {
  const Collection::Output c = collection_.output(2, cut_result());
  EXPECT_EQ(c.bytes, "v 0 0 9\nv 1 0 9\nv 0 1 9\nvt 14 -14\nvt 15 -15\nvt 16 -16\nf -3/-3 -2/-2 -1/-1\n");
  EXPECT_EQ(c.added_faces + c.added_vertices, 0);
}

TEST_F(ThreeModels, AFileThatCannotBeUsedIsNamed) {
  const fs::path bad = write("d.obj", "v 0 0 0\nf 1 1 1\n");
  try {
    collection_.add(bad);
    FAIL() << "no UVs";
  } catch (const io::InputError& error) {
    EXPECT_EQ(error.path, bad);
  }
  EXPECT_EQ(collection_.file_count(), 3);
}

TEST_F(Files, FacesAreCountedInTheirFileWithThoseLeftOut) {
  const std::string model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1 2 3\nf 1/1 2/1 3/1\n";
  Collection collection;
  collection.add(write("a.obj", model));
  collection.add(write("b.obj", model + "f 2/1 1/1 3/1\n"));
  EXPECT_EQ(collection.atlas().face_count(), 3);
  EXPECT_EQ(collection.face_count(), 5);
  EXPECT_EQ(collection.of_atlas(std::vector<double>{1, 2, 3, 4, 5}), (std::vector<double>{2, 4, 5}));
  EXPECT_EQ(collection.notes()[1], (folder_ / "b.obj").string() + ": 1 face has corners without UVs and is left out (line 5)");
  EXPECT_EQ(collection.place_of_face(2), (folder_ / "b.obj").string() + ": line 7");
  EXPECT_EQ(collection.number_in_file(-1), -1);
  EXPECT_EQ(collection.number_in_file(1), 1);
  EXPECT_EQ(collection.words_in_file("face 0 of chart 0 is flipped", 0), "face 1 of chart 0 is flipped");
  EXPECT_EQ(collection.words_in_file("face 01 is flipped", 0), "face 01 is flipped");
  EXPECT_EQ(collection.words_in_file("a box without area", -1), "a box without area");
}

TEST_F(Files, AppearTogether) {
  write("old", "before");
  {
    std::list<PendingFile> files;
    files.emplace_back(folder_ / "new", "1");
    files.emplace_back(folder_ / "old", "2");
    EXPECT_EQ(text("old"), "before");
    EXPECT_FALSE(fs::exists(folder_ / "new"));
    commit_together(files);
  }
  EXPECT_EQ(text("new") + text("old"), "12");
  EXPECT_EQ(count(), 2);
}

TEST_F(Files, OneThatCannotAppearHoldsBackTheOthers) {
  write("old", "before");
  {
    std::list<PendingFile> files;
    files.emplace_back(folder_ / "new", "1");
    files.emplace_back(folder_ / "old", "2");
    files.emplace_back(folder_ / "taken", "3");
    fs::create_directory(folder_ / "taken");
    EXPECT_THROW(commit_together(files), OutputError);
  }
  EXPECT_EQ(text("old"), "before");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  EXPECT_EQ(count(), 2);
}

TEST_F(Files, AFolderThatIsNotKeptGoesAgain) {
  { const PendingFolder folder(folder_ / "made"); }
  EXPECT_EQ(count(), 0);
  {
    PendingFolder folder(folder_ / "made");
    folder.keep();
  }
  { const PendingFolder there(folder_ / "made"); }
  EXPECT_EQ(count(), 1);
}

}  // namespace
}  // namespace atlas_refine::cli
