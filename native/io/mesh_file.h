// A file that holds a mesh with UVs: the atlas in it, and what the file becomes with another one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "atlas_refine/result.h"
#include "io/face_labels.h"

namespace atlas_refine::io {

/// One value of this kind for each format. Whoever reads and writes meshes knows formats only through it.
class MeshFile {
 public:
  virtual ~MeshFile() = default;

  /// Positions, polygons and UVs in the file's order, without the faces that no atlas can hold.
  virtual const Atlas& atlas() const = 0;

  /// Of all faces, those that `atlas()` leaves out as well.
  virtual int face_count() const = 0;

  /// The number among all faces (0-based) of face `face` of `atlas()`.
  virtual int face_number(int face) const = 0;

  /// What `atlas()` leaves out or takes otherwise than the file has it: one line for each kind. It is written as it was.
  virtual std::vector<std::string> notes() const = 0;

  virtual const FaceLabels& materials() const = 0;
  virtual const FaceLabels& objects() const = 0;

  /// Where in the file face `face` (0-based, of `atlas()`) is, as messages say it: "line 12".
  virtual std::string where(int face) const = 0;

  /// The file's bytes with these UVs, one per corner of `atlas()`; all else stays as it was. With the file's own UVs these are
  /// its own bytes.
  virtual std::string with_uvs(const std::vector<Vec2>& corner_uvs) const = 0;

  /// The file's bytes with the faces of `cut`, whose corners have these UVs. What corners and vertices carry besides (normals,
  /// colours) is interpolated as the cut's corner_sources and corner_weights say. Throws std::logic_error where these are not of
  /// the file: a bug that must not reach a mesh.
  virtual std::string with_cut(const CutMesh& cut, const std::vector<Vec2>& corner_uvs) const = 0;
};

/// Reads an OBJ file, whatever its name. Throws InputError that says what cannot be used and, in text, on which line; a file of
/// another format is named for what it is.
std::unique_ptr<const MeshFile> read_mesh_file(const std::filesystem::path& path);

/// Whether a file of this name is one that MeshFile can become: NAME.obj, in any case.
bool names_mesh_file(const std::filesystem::path& path);

}  // namespace atlas_refine::io
