// A Wavefront OBJ file whose UVs can be replaced, and whose faces can be divided, while the rest of it stays as it was.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "atlas_refine/refine.h"

namespace atlas_refine::cli {

class ObjFile {
 public:
  /// Reads `path` as text of v, vt, vn and f records; all other records (groups, materials, lines, comments, ...) are kept
  /// unread. Throws InputError that names the line where a record cannot be used.
  static ObjFile read(const std::filesystem::path& path);

  /// As `read`, from text in memory. Throws RefineError(BadInput).
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

  /// The file's text with the faces of `cut`, whose corners have these UVs. Each f record becomes the faces that are parts of it;
  /// the file's v and vn records stay first and in order, new ones follow them. What a new vertex has (colours, normals) is
  /// interpolated in its face. v, vt and vn records that stand behind the first face move before it, since not every reader
  /// takes an index that is defined later; all indices become absolute. Other records stay where they are.
  std::string text_with_cut(const CutMesh& cut, const std::vector<Vec2>& corner_uvs) const;

 private:
  friend class ObjParser;
  friend class ObjCutWriter;

  /// A stretch of text_.
  struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// A v record, and the numbers behind its position (w, a colour): extras_[first_extra] and the following.
  struct PositionRecord {
    Span whole;
    int first_extra = 0;
    int extra_count = 0;
  };
  /// A vn record; its value is NaN where its text is none.
  struct NormalRecord {
    Span whole;
    Vec3 value;
  };
  /// An f record: its whole line or lines with the line end, and what stands behind its last corner.
  struct FaceRecord {
    Span whole;
    Span tail;
  };
  /// Where a point of a line or point element names a v record.
  struct VertexReference {
    Span text;
    int vertex = -1;
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
  /// One corner of the output, whose UV comes from a vt record.
  struct UvUse {
    int record;
    Vec2 uv;
    int corner;
  };
  /// The vt records of the output: values of record r are values[first[r]] .. values[first[r + 1] - 1]; the file's last record
  /// is followed by the values of corners that have no record of the file.
  struct NewRecords {
    std::vector<Vec2> values;
    std::vector<int> first;
    std::vector<int> of_corner;
  };
  NewRecords weld(std::vector<UvUse> uses) const;
  void write_records(const UvRecord& record, const NewRecords& records, std::string& out) const;
  void write_reference(const UvReference& reference, const NewRecords& records, std::string& out) const;

  std::string text_;
  Atlas atlas_;
  std::vector<int> face_lines_;
  std::vector<UvRecord> uv_records_;
  std::vector<UvReference> uv_references_;  // in the file's order
  std::vector<PositionRecord> position_records_;
  std::vector<double> extras_;
  std::vector<NormalRecord> normal_records_;
  std::vector<FaceRecord> face_records_;
  std::vector<int> corner_normals_;  // index into normal_records_, -1 where the corner names none
  std::vector<VertexReference> vertex_references_;
};

}  // namespace atlas_refine::cli
