// Reads the text of an OBJ file into an ObjFile: one pass, positions of everything that may be rewritten remembered.
#pragma once

#include <string>
#include <string_view>

#include "obj_file.h"

namespace atlas_refine::cli {

class ObjParser {
 public:
  /// `file` holds the text already; run() fills in the rest.
  explicit ObjParser(ObjFile& file);
  void run();

 private:
  using Span = ObjFile::Span;
  /// One corner of a face or one point of a line element, v, v/vt, v//vn or v/vt/vn; 0-based, -1 where not given.
  struct Corner {
    int vertex = -1;
    int uv = -1;
    int normal = -1;
    Span vertex_text;
    Span uv_text;
  };

  void read_position(std::size_t record_begin);
  void read_uv(std::size_t record_begin);
  void read_normal(std::size_t record_begin);
  void read_face(std::size_t record_begin);
  void read_line_element();
  void read_point_element();
  void add_corner(const Corner& corner);
  void check_indices() const;
  void check_face(int face, std::vector<int>& face_seen_at_vertex) const;

  Corner corner(Span token) const;
  int index(std::string_view text, Span token, std::size_t count) const;
  double number(Span token) const;
  double finite_number(const char* what);

  Span next_token();
  void skip_blanks();
  void skip_logical_line();
  void skip_physical_line();
  std::size_t line_end_length(std::size_t at) const;
  bool continues_at(std::size_t at) const;
  std::string_view view(Span span) const { return std::string_view(text_).substr(span.begin, span.end - span.begin); }
  [[noreturn]] void fail(const std::string& what) const { fail_at(line_, what); }
  [[noreturn]] static void fail_at(int line, const std::string& what);

  ObjFile& file_;
  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int highest_normal_ = -1;
  int line_of_highest_normal_ = 0;
  bool any_uvs_ = false;
  int first_face_without_uvs_ = -1;
};

}  // namespace atlas_refine::cli
