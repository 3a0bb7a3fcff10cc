// Reads the text of an OBJ file: v, vt, vn, f and l records with line continuations, relative indices and any line end.
#include "io/obj_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "atlas_refine/error.h"
#include "io/input_file.h"
#include "io/obj_scanner.h"

namespace atlas_refine::io {

namespace {

using Span = ObjText::Span;

/// The name that holds from a record on, until the next.
class LabelReader {
 public:
  void set(std::string name) { name_ = std::move(name); }
  void label_face() {
    if (!labels_.of_face.empty() && labels_.names[labels_.of_face.back()] == name_) {
      labels_.of_face.push_back(labels_.of_face.back());
      return;
    }
    const auto [at, added] = numbers_.emplace(name_, static_cast<int>(labels_.names.size()));
    if (added) labels_.names.push_back(name_);
    labels_.of_face.push_back(at->second);
  }
  FaceLabels take() { return std::move(labels_); }

 private:
  std::string name_;
  FaceLabels labels_;
  std::unordered_map<std::string, int> numbers_;
};

/// Whether a polygon that comes to some vertices several times is loops of different vertices, three or more in each, joined by
/// edges that it runs along to and fro: the way in which outlines with holes are written as one polygon.
bool is_keyhole(std::vector<int> polygon) {
  std::vector<std::vector<int>> open = {std::move(polygon)};
  std::vector<int> seen;
  while (!open.empty()) {
    const std::vector<int> loop = std::move(open.back());
    open.pop_back();
    const auto n = static_cast<int>(loop.size());
    std::map<std::pair<int, int>, int> edges;  // by their ends, where they start
    bool parted = false;
    for (int i = 0; i < n && !parted; ++i) {
      const int from = loop[i], to = loop[(i + 1) % n];
      if (const auto back = edges.find({to, from}); back != edges.end()) {
        // ... from=b a=to ... : what lies between the two ways, and the rest.
        const int j = back->second;
        open.emplace_back(loop.begin() + j + 1, loop.begin() + i);
        std::vector<int>& rest = open.emplace_back(loop.begin() + i + 1, loop.end());
        rest.insert(rest.end(), loop.begin(), loop.begin() + j);
        parted = true;
      }
      edges[{from, to}] = i;
    }
    if (parted) continue;
    if (n < 3) return false;
    seen.insert(seen.end(), loop.begin(), loop.end());
  }
  std::sort(seen.begin(), seen.end());
  return std::adjacent_find(seen.begin(), seen.end()) == seen.end();
}

/// One pass, the places of everything that may be rewritten remembered.
class ObjParser {
 public:
  explicit ObjParser(ObjText obj) : obj_(std::move(obj)), scanner_(obj_.text) {}
  ObjText run() &&;

 private:
  /// One corner of a face or one point of a line element, v, v/vt, v//vn or v/vt/vn; 0-based, -1 where not given.
  struct Corner {
    int vertex = -1;
    int uv = -1;
    int normal = -1;
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
  ObjText::Remark* reason_to_leave_out();
  void add_face();
  void add_corner(const Corner& corner);
  void add_element(const Corner& corner);
  bool is_infinite(int uv) const;
  [[noreturn]] void refuse_infinite_uv() const;
  void check_indices() const;
  void check_vertices(int face) const;
  void check_uv(const ObjText::UvReference& reference) const;

  Corner corner(Span token) const;
  int index(std::string_view text, Span token, std::size_t count) const;
  double number(Span token) const;
  double finite_number(const char* what);

  ObjText obj_;
  ObjScanner scanner_;
  int highest_normal_ = -1;
  int line_of_highest_normal_ = 0;
  int first_infinite_uv_ = -1;
  int line_of_infinite_uv_ = 0;
  std::vector<Corner> corners_;  // of the present face
  std::vector<int> kept_;        // those of them that do not repeat the one before
  std::vector<int> sorted_;      // their vertices
  LabelReader materials_, objects_, groups_;
};

ObjText ObjParser::run() && {
  obj_.atlas.face_offsets = {0};
  if (obj_.text.empty()) throw RefineError(ErrorCode::BadInput, "read", "is empty");
  while (!scanner_.at_end()) read_record();
  check_indices();
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
  const double x = finite_number("vertex position");
  const double y = finite_number("vertex position");
  const double z = finite_number("vertex position");
  obj_.atlas.positions.emplace_back(x, y, z);
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token())
    obj_.extras.push_back(number(token));
  scanner_.skip_logical_line();
  record.extra_count = static_cast<int>(obj_.extras.size()) - record.first_extra;
  if (record.extra_count == 1 && obj_.extras.back() != 0) obj_.atlas.positions.back() /= obj_.extras.back();
  if (!obj_.atlas.positions.back().allFinite()) scanner_.fail_at(line, "a vertex position that its w makes infinite");
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
  Vec2 uv(number(record.u), has_v ? number(record.v) : 0);
  if (!uv.allFinite() && first_infinite_uv_ < 0) {
    first_infinite_uv_ = static_cast<int>(obj_.uv_records.size());
    line_of_infinite_uv_ = scanner_.line();
  }
  for (Span token = scanner_.next_token(); token.begin != token.end; token = scanner_.next_token()) number(token);  // w
  scanner_.skip_logical_line();
  record.whole = {record_begin, scanner_.record_end()};
  record.value = uv;
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
  if (ObjText::Remark* reason = reason_to_leave_out()) {
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
ObjText::Remark* ObjParser::reason_to_leave_out() {
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
  if (std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.uv < 0; })) return &obj_.left_out_without_uvs;
  if (std::any_of(corners_.begin(), corners_.end(), [&](const Corner& c) { return is_infinite(c.uv); }))
    return &obj_.left_out_infinite;
  if (distinct == static_cast<std::ptrdiff_t>(kept_.size())) return nullptr;
  std::vector<int> vertices;
  for (int k : kept_) vertices.push_back(corners_[k].vertex);
  return is_keyhole(std::move(vertices)) ? nullptr : &obj_.left_out_revisiting;
}

bool ObjParser::is_infinite(int uv) const {
  return first_infinite_uv_ >= 0 && uv < static_cast<int>(obj_.uv_records.size()) && !obj_.uv_records[uv].value.allFinite();
}

void ObjParser::refuse_infinite_uv() const {
  const ObjText::UvRecord& record = obj_.uv_records[first_infinite_uv_];
  scanner_.fail_at(line_of_infinite_uv_, "a UV that is not finite: " + quoted(obj_.view({record.u.begin, record.v.end})));
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
  if (corner.normal > highest_normal_) {
    highest_normal_ = corner.normal;
    line_of_highest_normal_ = line;
  }
  obj_.uv_references.push_back({corner.uv_text, corner.uv, obj_.atlas.corner_count()});
  obj_.atlas.corner_vertices.push_back(corner.vertex);
  obj_.corner_normals.push_back(corner.normal);
}

// What is not in the atlas keeps its text; only where records are renumbered or moved its indices must follow.
void ObjParser::add_element(const Corner& corner) {
  if (corner.uv >= 0) obj_.uv_references.push_back({corner.uv_text, corner.uv, -1});
  obj_.element_references.push_back({corner.vertex_text, corner.vertex});
  if (corner.normal >= 0) obj_.element_references.push_back({corner.normal_text, corner.normal});
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
    if (relative) obj_.element_references.push_back({token, count + value});
  }
  scanner_.skip_logical_line();
}

// Positive indices may name records that follow, so they are checked at the end.
void ObjParser::check_indices() const {
  const Atlas& atlas = obj_.atlas;
  const auto refuse = [](const char* what) { throw RefineError(ErrorCode::BadInput, "read", what); };
  if (obj_.face_count == 0) refuse("has no faces");
  if (obj_.left_out_without_uvs.count + obj_.left_out_degenerate.count == obj_.face_count) {
    refuse(obj_.left_out_without_uvs.count > 0 ? "has no UVs: no face has a vt index at each of its corners"
                                               : "has no faces of three different vertices");
  }
  if (atlas.face_count() == 0 && obj_.left_out_infinite.count > 0) refuse_infinite_uv();
  if (atlas.face_count() == 0) refuse("has no faces with UVs that come to each of their vertices once");
  if (highest_normal_ >= static_cast<int>(obj_.normal_records.size()))
    scanner_.fail_at(line_of_highest_normal_, "normal index " + std::to_string(highest_normal_ + 1) +
                                                  " is out of range, the file has " + std::to_string(obj_.normal_records.size()) +
                                                  " normals");
  for (int face = 0; face < atlas.face_count(); ++face) check_vertices(face);
  for (const ObjText::UvReference& reference : obj_.uv_references) check_uv(reference);
}

void ObjParser::check_vertices(int face) const {
  const Atlas& atlas = obj_.atlas;
  for (int k = atlas.face_offsets[face]; k < atlas.face_offsets[face + 1]; ++k) {
    if (const int vertex = atlas.corner_vertices[k]; vertex >= static_cast<int>(atlas.positions.size()))
      scanner_.fail_at(obj_.face_records[face].line, "face " + std::to_string(obj_.face_records[face].number) + ": vertex " +
                                                         std::to_string(vertex + 1) + " is out of range, the file has " +
                                                         std::to_string(atlas.positions.size()) + " vertices");
  }
}

void ObjParser::check_uv(const ObjText::UvReference& reference) const {
  // A face before its vt records is not left out.
  if (reference.corner >= 0 && is_infinite(reference.record)) refuse_infinite_uv();
  if (reference.record < static_cast<int>(obj_.uv_records.size())) return;
  const std::string what = "UV index " + std::to_string(reference.record + 1) + " is out of range, the file has " +
                           std::to_string(obj_.uv_records.size()) + " UVs";
  if (reference.corner < 0) throw RefineError(ErrorCode::BadInput, "read", "a line element or a face that is left out: " + what);
  const auto& offsets = obj_.atlas.face_offsets;
  const auto after = std::upper_bound(offsets.begin(), offsets.end(), reference.corner);
  const ObjText::FaceRecord& face = obj_.face_records[after - offsets.begin() - 1];
  scanner_.fail_at(face.line, "face " + std::to_string(face.number) + ": " + what);
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

// A 1-based index, or a negative one relative to the `count` records so far. `token` is what messages quote.
int ObjParser::index(std::string_view text, Span token, std::size_t count) const {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument)
    scanner_.fail(quoted(obj_.view(token)) + " is not a face corner");
  const bool fits = error == std::errc() && value <= std::numeric_limits<int>::max();
  if (!fits || value == 0 || value < -static_cast<long long>(count))
    scanner_.fail("index out of range in " + quoted(obj_.view(token)));
  return static_cast<int>(value > 0 ? value - 1 : static_cast<long long>(count) + value);
}

double ObjParser::number(Span token) const {
  std::string_view text = obj_.view(token);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument)
    scanner_.fail(quoted(obj_.view(token)) + " is not a number");
  // from_chars does not tell an overflow from an underflow.
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);
}

double ObjParser::finite_number(const char* what) {
  const Span token = scanner_.next_token();
  if (token.begin == token.end) scanner_.fail(std::string("a ") + what + " with too few numbers");
  const double value = number(token);
  if (!std::isfinite(value)) scanner_.fail(std::string("a ") + what + " that is not finite: " + quoted(obj_.view(token)));
  return value;
}

}  // namespace

ObjText parse_obj(std::string text) {
  ObjText obj;
  obj.text = std::move(text);
  return ObjParser(std::move(obj)).run();
}

}  // namespace atlas_refine::io
