// A Wavefront OBJ file whose UVs can be replaced, and whose faces can be divided, while the rest of it stays as it was.
#pragma once

#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "io/obj_text.h"

namespace atlas_refine::io {

class ObjFile final : public MeshFile {
 public:
  /// Reads text of v, vt, vn and f records; all other records (groups, materials, lines, comments, ...) are kept unread. Throws
  /// RefineError(BadInput) that names the line where a record cannot be used. A vertex that a face names several times in a row
  /// is one corner of it; faces with fewer than three different vertices, with a vertex that comes twice but for keyholes, or
  /// without a finite UV at each corner are not in the atlas.
  static ObjFile parse(std::string text);

  const Atlas& atlas() const override { return text_.atlas; }
  int face_count() const override { return text_.face_count; }
  int face_number(int face) const override { return text_.face_records[face].number; }
  std::vector<std::string> notes() const override;
  const FaceLabels& materials() const override { return text_.materials; }
  const FaceLabels& objects() const override { return text_.objects; }
  std::string where(int face) const override { return "line " + std::to_string(text_.face_records[face].line); }

  /// Only vt records and vt indices differ: each vt record becomes one record per value its corners now hold, so the UVs stay as
  /// shared as they were; records that no face uses stay. Numbers are the shortest decimals that read back as the same doubles.
  std::string with_uvs(const std::vector<Vec2>& corner_uvs) const override;

  /// Each f record becomes the faces that are parts of it; the file's v and vn records stay first and in order, new ones follow
  /// them. What a new vertex has (colours, normals) is interpolated in its face. v, vt and vn records that stand behind the first
  /// face move before it, since not every reader takes an index that is defined later; all indices become absolute. Other records
  /// stay where they are.
  std::string with_cut(const CutMesh& cut, const std::vector<Vec2>& corner_uvs) const override;

 private:
  explicit ObjFile(ObjText text) : text_(std::move(text)) {}

  ObjText text_;
};

}  // namespace atlas_refine::io
