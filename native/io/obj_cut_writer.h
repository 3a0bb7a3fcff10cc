// Writes an OBJ file whose faces were divided: f records in parts, new v, vt and vn records, everything else kept.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "atlas_refine/result.h"
#include "io/obj_text.h"
#include "io/obj_uv_records.h"

namespace atlas_refine::io {

class ObjCutWriter {
 public:
  /// Throws std::logic_error where the corners of `cut` are not means of corners of the file's faces.
  ObjCutWriter(const ObjText& file, const CutMesh& cut, const std::vector<Vec2>& corner_uvs);
  std::string text();

 private:
  using Span = ObjText::Span;
  /// A stretch of the file's text that the output has something else for.
  struct Edit {
    Span span;
    enum class Kind { Drop, UvRecord, Face, Index } kind;
    int index = -1;  ///< of a record of the file, a face; with Index as it is written
  };

  void find_parts();
  void find_uvs(const std::vector<Vec2>& corner_uvs);
  void find_normals();
  int interpolated_normal(int corner);
  bool is_new(int corner) const { return cut_.corner_vertices[corner] >= static_cast<int>(atlas_.positions.size()); }

  std::vector<Edit> edits() const;
  int written_index(const ObjText::ElementReference& reference) const;
  void write(const Edit& edit);
  void write_moved_records();
  void write_new_positions();
  void write_face(int face);
  int times_named(int corner) const;
  void write_whole(Span record);
  void end_line();
  bool stands_behind_first_face(Span record) const { return record.begin > file_.face_records.front().whole.begin; }

  const ObjText& file_;
  const CutMesh& cut_;
  const Atlas& atlas_;
  std::string line_end_ = "\n";
  std::vector<int> first_part_;  // of the file's faces; parts of f: first_part_[f] .. first_part_[f + 1] - 1
  UvRecords uvs_;
  std::vector<int> normals_;  // of the cut's corners: index into the output's vn records, -1 where there is none
  std::vector<Vec3> new_normals_;
  std::map<std::array<double, 3>, int> index_of_normal_;
  std::string out_;
};

}  // namespace atlas_refine::io
