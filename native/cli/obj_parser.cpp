// Reads the text of an OBJ file: v, vt, vn, f and l records with line continuations, relative indices and any line end.
#include "obj_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "atlas_refine/error.h"
#include "input_file.h"

namespace atlas_refine::cli {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

ObjParser::ObjParser(ObjFile& file) : file_(file), text_(file.text_) {}

void ObjParser::run() {
  file_.atlas_.face_offsets = {0};
  if (text_.empty()) throw RefineError(ErrorCode::BadInput, "read", "is empty");
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // UTF-8 byte order mark
  while (at_ < text_.size()) {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    const std::size_t record_begin = at_;
    const std::string_view keyword = view(next_token());
    if (keyword == "v") {
      read_position(record_begin);
    } else if (keyword == "vt") {
      read_uv(record_begin);
    } else if (keyword == "vn") {
      read_normal(record_begin);
    } else if (keyword == "f") {
      read_face(record_begin);
    } else if (keyword == "l") {
      read_line_element();
    } else if (keyword == "p") {
      read_point_element();
    } else {
      skip_physical_line();
    }
  }
  check_indices();
}

void ObjParser::read_position(std::size_t record_begin) {
  ObjFile::PositionRecord record;
  record.first_extra = static_cast<int>(file_.extras_.size());
  const double x = finite_number("vertex position");
  const double y = finite_number("vertex position");
  const double z = finite_number("vertex position");
  file_.atlas_.positions.emplace_back(x, y, z);
  for (Span token = next_token(); token.begin != token.end; token = next_token()) file_.extras_.push_back(number(token));
  skip_logical_line();
  record.extra_count = static_cast<int>(file_.extras_.size()) - record.first_extra;
  record.whole = {record_begin, at_};
  file_.position_records_.push_back(record);
}

void ObjParser::read_uv(std::size_t record_begin) {
  ObjFile::UvRecord record;
  record.u = next_token();
  if (record.u.begin == record.u.end) fail("a vt record without a number");
  record.v = next_token();
  const bool has_v = record.v.begin != record.v.end;
  if (!has_v) record.v = {record.u.end, record.u.end};
  Vec2 uv(number(record.u), has_v ? number(record.v) : 0);
  if (!uv.allFinite()) fail("a UV that is not finite: " + quoted(view({record.u.begin, record.v.end})));
  for (Span token = next_token(); token.begin != token.end; token = next_token()) number(token);  // w
  skip_logical_line();
  record.whole = {record_begin, at_};
  record.value = uv;
  file_.uv_records_.push_back(record);
}

// Normals matter only where faces are divided, so text that is no normal is no reason to refuse the file.
void ObjParser::read_normal(std::size_t record_begin) {
  Vec3 value = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 3; ++k) {
    const std::string_view text = view(next_token());
    std::from_chars(text.data(), text.data() + text.size(), value[k]);
  }
  skip_logical_line();
  file_.normal_records_.push_back({{record_begin, at_}, value});
}

void ObjParser::read_face(std::size_t record_begin) {
  const int face = file_.atlas_.face_count();
  file_.face_lines_.push_back(line_);
  int corners = 0;
  Corner first;
  ObjFile::FaceRecord record;
  for (Span token = next_token(); token.begin != token.end; token = next_token(), ++corners) {
    record.tail.begin = token.end;
    const Corner c = corner(token);
    if (corners == 0) first = c;
    if ((c.uv < 0) != (first.uv < 0) || (c.normal < 0) != (first.normal < 0))
      fail("face " + std::to_string(face) + ": corner " + quoted(view(token)) + " has other parts than the face's first corner");
    add_corner(c);
  }
  if (corners < 3) fail("face " + std::to_string(face) + " has " + std::to_string(corners) + " corners, 3 are needed");
  if (first.uv >= 0) {
    any_uvs_ = true;
  } else if (first_face_without_uvs_ < 0) {
    first_face_without_uvs_ = face;
  }
  file_.atlas_.face_offsets.push_back(file_.atlas_.corner_count());
  skip_logical_line();
  record.tail.end = at_;
  record.whole = {record_begin, at_};
  file_.face_records_.push_back(record);
}

void ObjParser::add_corner(const Corner& corner) {
  if (file_.atlas_.corner_vertices.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail("more face corners than this program can count");
  if (corner.normal > highest_normal_) {
    highest_normal_ = corner.normal;
    line_of_highest_normal_ = line_;
  }
  if (corner.uv >= 0) file_.uv_references_.push_back({corner.uv_text, corner.uv, file_.atlas_.corner_count()});
  file_.atlas_.corner_vertices.push_back(corner.vertex);
  file_.corner_normals_.push_back(corner.normal);
}

// Line and point elements keep their text; only where records are renumbered or moved their indices must follow.
void ObjParser::read_line_element() {
  for (Span token = next_token(); token.begin != token.end; token = next_token()) {
    const Corner c = corner(token);
    if (c.uv >= 0) file_.uv_references_.push_back({c.uv_text, c.uv, -1});
    file_.vertex_references_.push_back({c.vertex_text, c.vertex});
  }
  skip_logical_line();
}

void ObjParser::read_point_element() {
  for (Span token = next_token(); token.begin != token.end; token = next_token()) {
    const std::string_view text = view(token);
    const auto count = static_cast<int>(file_.atlas_.positions.size());
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool relative = error == std::errc() && end == text.data() + text.size() && value < 0 && value >= -count;
    if (relative) file_.vertex_references_.push_back({token, count + value});
  }
  skip_logical_line();
}

// Positive indices may name records that follow, so they are checked at the end.
void ObjParser::check_indices() const {
  const Atlas& atlas = file_.atlas_;
  if (atlas.face_count() == 0) throw RefineError(ErrorCode::BadInput, "read", "has no faces");
  if (!any_uvs_) throw RefineError(ErrorCode::BadInput, "read", "has no UVs: no face corner names a vt record");
  if (const int face = first_face_without_uvs_; face >= 0)
    fail_at(file_.face_lines_[face], "face " + std::to_string(face) + " has no UVs, other faces have");
  if (highest_normal_ >= static_cast<int>(file_.normal_records_.size()))
    fail_at(line_of_highest_normal_, "normal index " + std::to_string(highest_normal_ + 1) + " is out of range, the file has " +
                                         std::to_string(file_.normal_records_.size()) + " normals");
  std::vector<int> face_seen_at_vertex(atlas.positions.size(), -1);
  for (int face = 0; face < atlas.face_count(); ++face) check_face(face, face_seen_at_vertex);
  for (const ObjFile::UvReference& reference : file_.uv_references_) {
    if (reference.record < static_cast<int>(file_.uv_records_.size())) continue;
    const auto after = std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), reference.corner);
    const int face = static_cast<int>(after - atlas.face_offsets.begin()) - 1;
    const std::string where = reference.corner < 0 ? "a line element: " : "face " + std::to_string(face) + ": ";
    const std::string what = where + "UV index " + std::to_string(reference.record + 1) + " is out of range, the file has " +
                             std::to_string(file_.uv_records_.size()) + " UVs";
    if (reference.corner < 0) throw RefineError(ErrorCode::BadInput, "read", what);
    fail_at(file_.face_lines_[face], what);
  }
}

void ObjParser::check_face(int face, std::vector<int>& face_seen_at_vertex) const {
  const Atlas& atlas = file_.atlas_;
  for (int k = atlas.face_offsets[face]; k < atlas.face_offsets[face + 1]; ++k) {
    const int vertex = atlas.corner_vertices[k];
    const auto complain = [&](const std::string& what) {
      fail_at(file_.face_lines_[face], "face " + std::to_string(face) + ": vertex " + std::to_string(vertex + 1) + what);
    };
    if (vertex >= static_cast<int>(atlas.positions.size()))
      complain(" is out of range, the file has " + std::to_string(atlas.positions.size()) + " vertices");
    if (face_seen_at_vertex[vertex] == face) complain(" is used twice");
    face_seen_at_vertex[vertex] = face;
  }
}

ObjParser::Corner ObjParser::corner(Span token) const {
  const std::string_view text = view(token);
  Corner result;
  const std::size_t slash1 = std::min(text.find('/'), text.size());
  result.vertex_text = {token.begin, token.begin + slash1};
  result.vertex = index(view(result.vertex_text), token, file_.atlas_.positions.size());
  if (slash1 == text.size()) return result;
  const std::size_t slash2 = std::min(text.find('/', slash1 + 1), text.size());
  result.uv_text = {token.begin + slash1 + 1, token.begin + slash2};
  if (const auto uv = view(result.uv_text); !uv.empty()) result.uv = index(uv, token, file_.uv_records_.size());
  if (slash2 == text.size()) return result;
  if (const auto normal = text.substr(slash2 + 1); !normal.empty())
    result.normal = index(normal, token, file_.normal_records_.size());
  return result;
}

// A 1-based index, or a negative one relative to the `count` records so far. `token` is what messages quote.
int ObjParser::index(std::string_view text, Span token, std::size_t count) const {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument)
    fail(quoted(view(token)) + " is not a face corner");
  const bool fits = error == std::errc() && value <= std::numeric_limits<int>::max();
  if (!fits || value == 0 || value < -static_cast<long long>(count)) fail("index out of range in " + quoted(view(token)));
  return static_cast<int>(value > 0 ? value - 1 : static_cast<long long>(count) + value);
}

double ObjParser::number(Span token) const {
  std::string_view text = view(token);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) fail(quoted(view(token)) + " is not a number");
  // from_chars does not tell an overflow from an underflow.
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);
}

double ObjParser::finite_number(const char* what) {
  const Span token = next_token();
  if (token.begin == token.end) fail(std::string("a ") + what + " with too few numbers");
  const double value = number(token);
  if (!std::isfinite(value)) fail(std::string("a ") + what + " that is not finite: " + quoted(view(token)));
  return value;
}

// The next token of the logical line; empty at its end and at a comment.
ObjParser::Span ObjParser::next_token() {
  skip_blanks();
  Span token{at_, at_};
  if (at_ < text_.size() && text_[at_] == '#') return token;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '\r' && !continues_at(at_)) ++at_;
  token.end = at_;
  return token;
}

void ObjParser::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (continues_at(at_)) {
      at_ += 1 + line_end_length(at_ + 1);
      ++line_;
    } else {
      return;
    }
  }
}

void ObjParser::skip_logical_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') {
    if (continues_at(at_)) {
      skip_blanks();
    } else {
      ++at_;
    }
  }
  skip_physical_line();
}

void ObjParser::skip_physical_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
  if (at_ == text_.size()) return;
  at_ += line_end_length(at_);
  ++line_;
}

std::size_t ObjParser::line_end_length(std::size_t at) const {
  if (at >= text_.size()) return 0;
  if (text_[at] == '\n') return 1;
  if (text_[at] != '\r') return 0;
  return at + 1 < text_.size() && text_[at + 1] == '\n' ? 2 : 1;
}

// Whether a backslash here joins the next line to this one.
bool ObjParser::continues_at(std::size_t at) const { return text_[at] == '\\' && line_end_length(at + 1) > 0; }

void ObjParser::fail_at(int line, const std::string& what) {
  throw RefineError(ErrorCode::BadInput, "read", "line " + std::to_string(line) + ": " + what);
}

}  // namespace atlas_refine::cli
