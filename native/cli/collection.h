// One or several files as one atlas, and a result of it given back to the files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/refine.h"
#include "io/mesh_file.h"

namespace atlas_refine::cli {

/// A collection of models (section 4, "A collection of models"): faces, vertices and corners of the files, one after the other.
class Collection {
 public:
  /// Throws io::InputError.
  void add(const std::filesystem::path& path);

  int file_count() const { return static_cast<int>(files_.size()); }
  const std::filesystem::path& path(int k) const { return files_[k].path; }
  const Atlas& atlas_of(int k) const { return files_[k].mesh->atlas(); }
  int face_count_of(int k) const { return files_[k].mesh->face_count(); }
  const Atlas& atlas() const { return files_.size() == 1 ? atlas_of(0) : atlas_; }

  /// Of all files, with the faces that are not in atlas().
  int face_count() const;
  /// Of one value for each face of the files those for the faces of atlas().
  template <class Value>
  std::vector<Value> of_atlas(const std::vector<Value>& face_values) const {
    std::vector<Value> result;
    for (int face : faces_of_atlas()) result.push_back(face_values[face]);
    return result;
  }

  /// Groups for RefineOptions, and their names: materials of one name are one in all files, objects of each file are its own.
  void group_by_material(RefineOptions& options) const;
  void group_by_object(RefineOptions& options) const;

  /// What the files hold that is not in atlas(), or not as they have it; of several files each line names its own.
  std::vector<std::string> notes() const;

  /// The number in its file of a face of atlas(); -1 where there is none.
  int number_in_file(int face) const;
  /// The library's words about that face, with that number.
  std::string words_in_file(std::string words, int face) const;

  /// "FILE: face 55 of 'Head', line 402", as messages say where a face of atlas() is; FILE only of several, a name where it has
  /// one.
  std::string words_for_face(int face) const;

  /// "FILE" or, where the face (of atlas()) is known, "FILE: line N"; without a face the first file stands for all.
  std::string place_of_face(int face) const;

  /// What file `k` has become in `result`: its bytes, and what the cut added to it.
  struct Output {
    std::string bytes;
    int added_faces = 0;
    int added_vertices = 0;
  };
  Output output(int k, const RefineResult& result) const;

 private:
  struct File {
    std::filesystem::path path;
    std::unique_ptr<const io::MeshFile> mesh;
    int first_vertex;
    int first_face;
    int first_corner;
  };
  /// A file's part of a result; `cut` only where it divides or extends one of the file's faces.
  struct Part {
    std::vector<Vec2> corner_uvs;
    std::optional<CutMesh> cut;
  };
  const File& file_of_face(int face) const;
  /// Of each face of atlas() the number among the faces of all files.
  std::vector<int> faces_of_atlas() const;
  Part part(const File& file, const RefineResult& result) const;
  CutMesh cut_of(const File& file, const CutMesh& whole, std::size_t first, std::size_t last) const;

  std::vector<File> files_;
  Atlas atlas_;
};

}  // namespace atlas_refine::cli
