// A Wavefront OBJ file whose UVs can be replaced while every other byte of it stays as it was.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine::cli {

class ObjFile {
 public:
  /// Reads `path` as text of v, vt, vn and f records; all other records (groups, materials, lines, comments, ...) are kept
  /// unread. Throws RefineError(BadInput) that names the line where a record cannot be used.
  static ObjFile read(const std::filesystem::path& path);

  /// As `read`, from text in memory.
  static ObjFile parse(std::string text);

  /// Positions, polygons and UVs in the file's order.
  const Atlas& atlas() const { return atlas_; }

  /// The file's own text.
  const std::string& text() const { return text_; }

  /// 1-based line on which face `face` (0-based) starts.
  int line_of_face(int face) const { return face_lines_[face]; }

  /// The file's text with these UVs, one per corner of `atlas()`. Only vt records and vt indices differ: each vt record becomes
  /// one record per value its corners now hold, so the UVs stay as shared as they were; records that no face uses stay.
  /// Numbers are the shortest decimals that read back as the same doubles.
  std::string text_with_uvs(const std::vector<Vec2>& corner_uvs) const;

 private:
  friend class ObjParser;

  /// A stretch of text_.
  struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Where a vt record lies: its whole line or lines with the line end, and its first two numbers (v empty where not written).
  struct UvRecord {
    Span whole;
    Span u;
    Span v;
    Vec2 value;
  };
  /// Where a face corner or a point of a line element names a vt record.
  struct UvReference {
    Span text;
    int record = -1;
    int corner = -1;  // -1: not a face's
  };
  /// The vt records of the output: values of record r are values[first[r]] .. values[first[r + 1] - 1].
  struct NewRecords {
    std::vector<Vec2> values;
    std::vector<int> first;
    std::vector<int> of_corner;
  };
  NewRecords weld(const std::vector<Vec2>& corner_uvs) const;
  void write_records(const UvRecord& record, const NewRecords& records, std::string& out) const;
  void write_reference(const UvReference& reference, const NewRecords& records, std::string& out) const;

  std::string text_;
  Atlas atlas_;
  std::vector<int> face_lines_;
  std::vector<UvRecord> uv_records_;
  std::vector<UvReference> uv_references_;  // in the file's order
};

}  // namespace atlas_refine::cli
