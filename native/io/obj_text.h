// The text of a Wavefront OBJ file, and where in it everything stands that may be rewritten.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/face_labels.h"

namespace atlas_refine::io {

struct ObjText {
  /// A stretch of the text.
  struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// A v record, and the numbers behind its position (w, a colour): extras[first_extra] and the following. One is w.
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
  /// An f record whose face is in the atlas: its whole line or lines with the line end, and what stands behind its last corner.
  struct FaceRecord {
    int line = 0;    ///< 1-based, on which it starts
    int number = 0;  ///< 0-based, among all f records
    Span whole;
    Span tail;
  };
  /// Where an element that is not in the atlas (a line, a point, a face left out) names a v or vn record. It may be one that the
  /// file does not have: behind the last, or before the first.
  struct ElementReference {
    enum class Kind { Position, Normal };
    Span text;
    int record = -1;
    Kind kind = Kind::Position;
  };
  /// Where a vt record lies: its whole line or lines with the line end, and its first two numbers (v empty where not written).
  struct UvRecord {
    Span whole;
    Span u;
    Span v;
    Vec2 value;
  };
  /// Where a face corner or a point of a line element names a vt record. Of several for one corner, which its face names several
  /// times in a row, the first has its UV. What is not in the atlas may name one that the file does not have.
  struct UvReference {
    Span text;
    int record = -1;
    int corner = -1;  ///< -1: of an element that is not in the atlas
  };
  /// What is read in another way than it is written: of how many f records, and the line of the first.
  struct Remark {
    int count = 0;
    int first_line = 0;
    void add(int line) {
      if (count++ == 0) first_line = line;
    }
  };

  std::string_view view(Span span) const { return std::string_view(text).substr(span.begin, span.end - span.begin); }

  std::string text;
  Atlas atlas;  ///< of the faces that are not left out
  std::vector<UvRecord> uv_records;
  std::vector<UvReference> uv_references;  ///< in the file's order
  std::vector<PositionRecord> position_records;
  std::vector<double> extras;
  std::vector<NormalRecord> normal_records;
  std::vector<FaceRecord> face_records;
  FaceLabels materials;             ///< of usemtl records; faces before the first have the name ""
  FaceLabels objects;               ///< of o records, or where there are none of g records
  std::vector<int> corner_normals;  ///< index into normal_records, -1 where the corner names none
  std::vector<ElementReference> element_references;
  std::unordered_map<int, int> repeats;  ///< by corner: how often its face names it again right behind itself
  int face_count = 0;                    ///< of all f records
  Remark with_repeats;
  Remark without_normals;      ///< that the file does not have; all that is read of them is that they are not there
  Remark left_out_degenerate;  ///< fewer than three different vertices
  Remark left_out_without_uvs;
  Remark left_out_out_of_range;  ///< a vertex or UV that the file does not have
  Remark left_out_infinite_position;
  Remark left_out_infinite;    ///< a UV is not finite
  Remark left_out_revisiting;  ///< a vertex comes twice, neither in a row nor at the bridge of a keyhole
};

}  // namespace atlas_refine::io
