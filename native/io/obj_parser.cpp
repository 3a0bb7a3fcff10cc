// Reads the text of an OBJ file: v, vt, vn, f and l records with line continuations, relative indices and any line end.
#include "io/obj_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "atlas_refine/error.h"
#include "io/input_file.h"
#include "io/keyhole.h"
#include "io/label_reader.h"
#include "io/obj_scanner.h"
#include "io/read_number.h"

namespace atlas_refine::io {

namespace {

using Span = ObjText::Span;

constexpr int kNotGiven = std::numeric_limits<int>::min();
constexpr int kNowhere = 1 << 30;  // what stands for an index that no file can hold: 0, or a larger one

/// Why a face cannot be in the atlas that names what the file does not have, or what is not finite.
struct Fault {
  ObjText::Remark ObjText::*kind;
  std::string what;  // with the line
};
/// By the numbers of the faces.
using Faults = std::unordered_map<int, Fault>;

/// One pass, the places of everything that may be rewritten remembered.
class ObjParser {
 public:
  /// `known` are faults of faces that come before what they name.
  ObjParser(std::string text, const Faults& known) : known_(known), obj_{.text = std::move(text)}, scanner_(obj_.text) {}
  /// Reads all. Returns the faults of faces that only what follows them shows: with these known it has to be read anew.
  Faults read();
  ObjText take() &&;
  std::string take_text() && { return std::move(obj_.text); }

 private:
  /// One corner of a face or one point of a line element, v, v/vt, v//vn or v/vt/vn; 0-based and, where the index is relative,
  /// below 0 where it reaches back before the first record.
  struct Corner {
    int vertex = kNotGiven;
    int uv = kNotGiven;
    int normal = kNotGiven;
    Span vertex_text;
    Span uv_text;
    Span normal_text;
  };

  void read_record();
  void read_position(std::size_t record_begin);
  void read_uv(std::size_t record_begin);
  void read_normal(std::size_t record_begin);
  void read_face(std::size_t record_begin);
  void read_line_element();
  void read_point_element();
  void read_label(std::string_view keyword);
  ObjText::Remark* reason_to_leave_out(const ObjText::FaceRecord& record);
  std::optional<Fault> fault_of(const ObjText::FaceRecord& record) const;
  void add_face();
  void add_corner(const Corner& corner);
  void add_element(const Corner& corner);
  bool is_infinite_uv(int uv) const;
  bool is_infinite_position(int vertex) const;
  std::optional<Fault> fault_of_vertex(const ObjText::FaceRecord& record, int vertex) const;
  std::optional<Fault> fault_of_uv(const ObjText::FaceRecord& record, int uv) const;
  Faults late_faults() const;
  void drop_missing_normals();
  void refuse_without_faces() const;

  Corner corner(Span token) const;
  int index(std::string_view text, Span token, std::size_t count) const;
  double number(Span token) const;
  double position_number(std::string_view& not_finite);

  const Faults& known_;
  ObjText obj_;
  ObjScanner scanner_;
  std::vector<int> infinite_positions_, infinite_uvs_;  // in ascending order
  std::string first_infinite_position_, first_infinite_uv_, first_fault_;
  std::vector<Corner> corners_;  // of the present face
  std::vector<int> kept_;        // those of them that do not repeat the one before
  std::vector<int> sorted_;      // their vertices
  LabelReader materials_, objects_, groups_;
};

Faults ObjParser::read() {
  obj_.atlas.face_offsets = {0};
  if (obj_.text.empty()) throw RefineError(ErrorCode::BadInput, "read", "is empty");
  while (!scanner_.at_end()) read_record();
  return late_faults();
}

ObjText ObjParser::take() && {
  refuse_without_faces();
  drop_missing_normals();
  obj_.materials = materials_.take();
  FaceLabels objects = objects_.take();
  const bool unnamed = objects.names.size() == 1 && objects.names.front().empty();
  obj_.objects = unnamed ? groups_.take() : std::move(objects);
  obj_.atlas.corner_uvs.resize(obj_.atlas.corner_vertices.size());
  for (auto reference = obj_.uv_references.rbegin(); reference != obj_.uv_references.rend(); ++reference) {
    if (reference->corner >= 0) obj_.atlas.corner_uvs[reference->corner] = obj_.uv_records[reference->record].value;
  }
  return std::move(obj_);
}

void ObjParser::read_record() {
  scanner_.skip_indent();
  const std::size_t record_begin = scanner_.at();
  const std::string_view keyword = obj_.view(scanner_.next_token());
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
    if (keyword == "usemtl" || keyword == "o" || keyword == "g") read_label(keyword);
    scanner_.skip_physical_line();
  }
}

void ObjParser::read_label(std::string_view keyword) {
  const Span first = scanner_.next_token();
  Span name = first;
  for (Span token = first; token.begin != token.end; token = scanner_.next_token()) name.end = token.end;
  LabelReader& reader = keyword == "usemtl" ? materials_ : keyword == "o" ? objects_ : groups_;
  reader.set(std::string(obj_.view(name)));
}

void ObjParser::read_position(std::size_t record_begin) {
  ObjText::PositionRecord record;
  const int line = scanner_.line();
  record.first_extra = static_cast<int>(obj_.extras.size());
  std::string_view not_finite;
  const double x = position_number(not_finite);
  const double y = position_number(not_finite);
  const double z = position_number(not_finite);
  obj_.atlas.positions.emplace_back(x, y, z);
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token())
    obj_.extras.push_back(number(token));
  scanner_.skip_logical_line();
  record.extra_count = static_cast<int>(obj_.extras.size()) - record.first_extra;
  if (record.extra_count == 1 && obj_.extras.back() != 0) obj_.atlas.positions.back() /= obj_.extras.back();
  if (!obj_.atlas.positions.back().allFinite()) {
    const std::string what = not_finite.empty() ? "a vertex position that its w makes infinite"
                                                : "a vertex position that is not finite: " + quoted(not_finite);
    if (infinite_positions_.empty()) first_infinite_position_ = "line " + std::to_string(line) + ": " + what;
    infinite_positions_.push_back(static_cast<int>(obj_.position_records.size()));
    obj_.atlas.positions.back().setZero();  // no face of the atlas has it
  }
  record.whole = {record_begin, scanner_.record_end()};
  obj_.position_records.push_back(record);
}

void ObjParser::read_uv(std::size_t record_begin) {
  ObjText::UvRecord record;
  record.u = scanner_.next_token();
  if (record.u.begin == record.u.end) scanner_.fail("a vt record without a number");
  record.v = scanner_.next_token();
  const bool has_v = record.v.begin != record.v.end;
  if (!has_v) record.v = {record.u.end, record.u.end};
  record.value = Vec2(number(record.u), has_v ? number(record.v) : 0);
  if (!record.value.allFinite()) {
    if (infinite_uvs_.empty())
      first_infinite_uv_ = "line " + std::to_string(scanner_.line()) +
                           ": a UV that is not finite: " + quoted(obj_.view({record.u.begin, record.v.end}));
    infinite_uvs_.push_back(static_cast<int>(obj_.uv_records.size()));
  }
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token()) number(token);  // w
  scanner_.skip_logical_line();
  record.whole = {record_begin, scanner_.record_end()};
  obj_.uv_records.push_back(record);
}

// Normals matter only where faces are divided, so text that is no normal is no reason to refuse the file.
void ObjParser::read_normal(std::size_t record_begin) {
  Vec3 value = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 3; ++k) {
    const std::string_view text = obj_.view(scanner_.next_token());
    std::from_chars(text.data(), text.data() + text.size(), value[k]);
  }
  scanner_.skip_logical_line();
  obj_.normal_records.push_back({{record_begin, scanner_.record_end()}, value});
}

void ObjParser::read_face(std::size_t record_begin) {
  ObjText::FaceRecord record;
  record.line = scanner_.line();
  record.number = obj_.face_count++;
  corners_.clear();
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token()) {
    record.tail.begin = token.end;
    corners_.push_back(corner(token));
  }
  scanner_.skip_logical_line();
  record.tail.end = scanner_.record_end();
  record.whole = {record_begin, scanner_.record_end()};
  if (ObjText::Remark* reason = reason_to_leave_out(record)) {
    reason->add(record.line);
    for (const Corner& corner : corners_) add_element(corner);
    return;
  }
  if (kept_.size() < corners_.size()) obj_.with_repeats.add(record.line);
  obj_.face_records.push_back(record);
  for (LabelReader* labels : {&materials_, &objects_, &groups_}) labels->label_face();
  add_face();
}

// Null where the face is in the atlas.
ObjText::Remark* ObjParser::reason_to_leave_out(const ObjText::FaceRecord& record) {
  kept_.clear();
  for (int k = 0; k < static_cast<int>(corners_.size()); ++k) {
    if (kept_.empty() || corners_[kept_.back()].vertex != corners_[k].vertex) kept_.push_back(k);
  }
  while (kept_.size() > 1 && corners_[kept_.back()].vertex == corners_[kept_.front()].vertex) kept_.pop_back();
  sorted_.clear();
  for (int k : kept_) sorted_.push_back(corners_[k].vertex);
  std::sort(sorted_.begin(), sorted_.end());
  const auto distinct = std::unique(sorted_.begin(), sorted_.end()) - sorted_.begin();
  if (distinct < 3) return &obj_.left_out_degenerate;
  if (std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.uv == kNotGiven; }))
    return &obj_.left_out_without_uvs;
  if (const std::optional<Fault> fault = fault_of(record)) {
    if (first_fault_.empty()) first_fault_ = fault->what;
    return &(obj_.*fault->kind);
  }
  if (distinct == static_cast<std::ptrdiff_t>(kept_.size())) return nullptr;
  std::vector<int> vertices;
  for (int k : kept_) vertices.push_back(corners_[k].vertex);
  return is_keyhole(std::move(vertices)) ? nullptr : &obj_.left_out_revisiting;
}

// Positive indices may name records that follow: what they come to shows at the end, see late_faults().
std::optional<Fault> ObjParser::fault_of(const ObjText::FaceRecord& record) const {
  if (const auto known = known_.find(record.number); known != known_.end()) return known->second;
  for (const Corner& corner : corners_) {
    const auto is_nowhere = [](int index) { return index < 0 || index == kNowhere; };
    if (is_nowhere(corner.vertex) || is_nowhere(corner.uv)) {
      const Span token = {corner.vertex_text.begin, std::max(corner.uv_text.end, corner.normal_text.end)};
      return Fault{&ObjText::left_out_out_of_range,
                   "line " + std::to_string(record.line) + ": index out of range in " + quoted(obj_.view(token))};
    }
    if (is_infinite_position(corner.vertex)) return fault_of_vertex(record, corner.vertex);
    if (is_infinite_uv(corner.uv)) return fault_of_uv(record, corner.uv);
  }
  return std::nullopt;
}

bool ObjParser::is_infinite_position(int vertex) const {
  return std::binary_search(infinite_positions_.begin(), infinite_positions_.end(), vertex);
}

bool ObjParser::is_infinite_uv(int uv) const { return std::binary_search(infinite_uvs_.begin(), infinite_uvs_.end(), uv); }

std::optional<Fault> ObjParser::fault_of_vertex(const ObjText::FaceRecord& record, int vertex) const {
  if (is_infinite_position(vertex)) return Fault{&ObjText::left_out_infinite_position, first_infinite_position_};
  if (vertex < static_cast<int>(obj_.atlas.positions.size())) return std::nullopt;
  return Fault{&ObjText::left_out_out_of_range, "line " + std::to_string(record.line) + ": face " +
                                                    std::to_string(record.number) + ": vertex " + std::to_string(vertex + 1) +
                                                    " is out of range, the file has " +
                                                    std::to_string(obj_.atlas.positions.size()) + " vertices"};
}

std::optional<Fault> ObjParser::fault_of_uv(const ObjText::FaceRecord& record, int uv) const {
  if (is_infinite_uv(uv)) return Fault{&ObjText::left_out_infinite, first_infinite_uv_};
  if (uv < static_cast<int>(obj_.uv_records.size())) return std::nullopt;
  return Fault{&ObjText::left_out_out_of_range,
               "line " + std::to_string(record.line) + ": face " + std::to_string(record.number) + ": UV index " +
                   std::to_string(uv + 1) + " is out of range, the file has " + std::to_string(obj_.uv_records.size()) + " UVs"};
}

void ObjParser::add_face() {
  const int first = obj_.atlas.corner_count();
  std::size_t next = 0;
  for (int k = 0; k < static_cast<int>(corners_.size()); ++k) {
    const Corner& corner = corners_[k];
    if (next < kept_.size() && kept_[next] == k) {
      ++next;
      add_corner(corner);
      continue;
    }
    // Behind the last corner it may be the first that comes again.
    const bool repeats_last = corners_[kept_[next - 1]].vertex == corner.vertex;
    const int same = repeats_last ? first + static_cast<int>(next) - 1 : first;
    obj_.uv_references.push_back({corner.uv_text, corner.uv, same});
    ++obj_.repeats[same];
  }
  obj_.atlas.face_offsets.push_back(obj_.atlas.corner_count());
}

void ObjParser::add_corner(const Corner& corner) {
  const int line = obj_.face_records.back().line;
  if (obj_.atlas.corner_vertices.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
    scanner_.fail_at(line, "more face corners than this program can count");
  obj_.uv_references.push_back({corner.uv_text, corner.uv, obj_.atlas.corner_count()});
  obj_.atlas.corner_vertices.push_back(corner.vertex);
  obj_.corner_normals.push_back(corner.normal);
}

// What is not in the atlas keeps its text; only where records are renumbered or moved its indices must follow.
void ObjParser::add_element(const Corner& corner) {
  using Kind = ObjText::ElementReference::Kind;
  const auto is_given = [](int index) { return index != kNotGiven && index != kNowhere; };
  if (is_given(corner.uv)) obj_.uv_references.push_back({corner.uv_text, corner.uv, -1});
  if (is_given(corner.vertex)) obj_.element_references.push_back({corner.vertex_text, corner.vertex, Kind::Position});
  if (is_given(corner.normal)) obj_.element_references.push_back({corner.normal_text, corner.normal, Kind::Normal});
}

void ObjParser::read_line_element() {
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token()) add_element(corner(token));
  scanner_.skip_logical_line();
}

void ObjParser::read_point_element() {
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token()) {
    const std::string_view text = obj_.view(token);
    const auto count = static_cast<int>(obj_.atlas.positions.size());
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool relative = error == std::errc() && end == text.data() + text.size() && value < 0 && value >= -count;
    if (relative) obj_.element_references.push_back({token, count + value, ObjText::ElementReference::Kind::Position});
  }
  scanner_.skip_logical_line();
}

Faults ObjParser::late_faults() const {
  const Atlas& atlas = obj_.atlas;
  Faults faults;
  const auto note = [&](int face, std::optional<Fault> fault) {
    if (fault) faults.emplace(obj_.face_records[face].number, std::move(*fault));
  };
  for (int face = 0; face < atlas.face_count(); ++face) {
    for (int k = atlas.face_offsets[face]; k < atlas.face_offsets[face + 1]; ++k)
      note(face, fault_of_vertex(obj_.face_records[face], atlas.corner_vertices[k]));
  }
  int face = 0;  // references are in the order of corners, but for one that repeats its face's first
  for (const ObjText::UvReference& reference : obj_.uv_references) {
    if (reference.corner < 0) continue;
    while (reference.corner >= atlas.face_offsets[face + 1]) ++face;
    note(face, fault_of_uv(obj_.face_records[face], reference.record));
  }
  return faults;
}

// Where no face is divided normals are not looked at, so a missing one is no reason to leave out its face.
void ObjParser::drop_missing_normals() {
  const auto count = static_cast<int>(obj_.normal_records.size());
  for (int face = 0; face < obj_.atlas.face_count(); ++face) {
    bool misses = false;
    for (int k = obj_.atlas.face_offsets[face]; k < obj_.atlas.face_offsets[face + 1]; ++k) {
      int& normal = obj_.corner_normals[k];
      if (normal >= 0 && normal < count) continue;
      misses = misses || normal != kNotGiven;
      normal = -1;
    }
    if (misses) obj_.without_normals.add(obj_.face_records[face].line);
  }
}

void ObjParser::refuse_without_faces() const {
  const auto refuse = [](const std::string& what) { throw RefineError(ErrorCode::BadInput, "read", what); };
  if (obj_.face_count == 0) refuse("has no faces");
  if (obj_.left_out_without_uvs.count + obj_.left_out_degenerate.count == obj_.face_count) {
    refuse(obj_.left_out_without_uvs.count > 0 ? "has no UVs: no face has a vt index at each of its corners"
                                               : "has no faces of three different vertices");
  }
  if (obj_.atlas.face_count() > 0) return;
  refuse(first_fault_.empty() ? "has no faces with UVs that come to each of their vertices once" : first_fault_);
}

ObjParser::Corner ObjParser::corner(Span token) const {
  const std::string_view text = obj_.view(token);
  Corner result;
  const std::size_t slash1 = std::min(text.find('/'), text.size());
  result.vertex_text = {token.begin, token.begin + slash1};
  result.vertex = index(obj_.view(result.vertex_text), token, obj_.atlas.positions.size());
  if (slash1 == text.size()) return result;
  const std::size_t slash2 = std::min(text.find('/', slash1 + 1), text.size());
  result.uv_text = {token.begin + slash1 + 1, token.begin + slash2};
  if (const auto uv = obj_.view(result.uv_text); !uv.empty()) result.uv = index(uv, token, obj_.uv_records.size());
  if (slash2 == text.size()) return result;
  result.normal_text = {token.begin + slash2 + 1, token.end};
  if (const auto normal = obj_.view(result.normal_text); !normal.empty())
    result.normal = index(normal, token, obj_.normal_records.size());
  return result;
}

// Of a 1-based index, or a negative one relative to the `count` records so far. `token` is what messages quote.
int ObjParser::index(std::string_view text, Span token, std::size_t count) const {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument)
    scanner_.fail(quoted(obj_.view(token)) + " is not a face corner");
  if (error != std::errc() || value == 0 || std::abs(value) >= kNowhere) return kNowhere;
  return static_cast<int>(value > 0 ? value - 1 : static_cast<long long>(count) + value);
}

double ObjParser::number(Span token) const {
  const std::optional<double> value = read_number(obj_.view(token));
  if (!value) scanner_.fail(quoted(obj_.view(token)) + " is not a number");
  return *value;
}

// `not_finite` becomes the text of the first number that is not finite.
double ObjParser::position_number(std::string_view& not_finite) {
  const Span token = scanner_.next_token();
  if (token.begin == token.end) scanner_.fail("a vertex position with too few numbers");
  const double value = number(token);
  if (!std::isfinite(value) && not_finite.empty()) not_finite = obj_.view(token);
  return value;
}

}  // namespace

ObjText parse_obj(std::string text) {
  Faults known;
  ObjParser parser(std::move(text), known);
  const Faults late = parser.read();
  if (late.empty()) return std::move(parser).take();
  ObjParser again(std::move(parser).take_text(), late);
  again.read();
  return std::move(again).take();
}

}  // namespace atlas_refine::io
