// The text of a Wavefront OBJ file, and where in it everything stands that may be rewritten.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine::io {

struct ObjText {
  /// A stretch of the text.
  struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// A v record, and the numbers behind its position (w, a colour): extras[first_extra] and the following.
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
    int line = 0;  ///< 1-based, on which it starts
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
    int corner = -1;  ///< -1: not a face's
  };

  std::string_view view(Span span) const { return std::string_view(text).substr(span.begin, span.end - span.begin); }

  std::string text;
  Atlas atlas;
  std::vector<UvRecord> uv_records;
  std::vector<UvReference> uv_references;  ///< in the file's order
  std::vector<PositionRecord> position_records;
  std::vector<double> extras;
  std::vector<NormalRecord> normal_records;
  std::vector<FaceRecord> face_records;
  std::vector<int> corner_normals;  ///< index into normal_records, -1 where the corner names none
  std::vector<VertexReference> vertex_references;
};

}  // namespace atlas_refine::io
