// Writes an OBJ file whose faces were divided: f records in parts, new v, vt and vn records, everything else kept.
#include "io/obj_cut_writer.h"

#include <algorithm>
#include <stdexcept>

#include "io/number_text.h"

namespace atlas_refine::io {

namespace {

/// Of `count` records that all stand before it: what is before the first stays so.
int written(int record, int count) { return record < 0 ? record - count : record + 1; }

}  // namespace

ObjCutWriter::ObjCutWriter(const ObjText& file, const CutMesh& cut, const std::vector<Vec2>& corner_uvs)
    : file_(file), cut_(cut), atlas_(file.atlas) {
  if (const std::size_t end = file.text.find_first_of("\r\n"); end != std::string::npos)
    line_end_ = file.text.compare(end, 2, "\r\n") == 0 ? "\r\n" : file.text.substr(end, 1);
  find_parts();
  find_uvs(corner_uvs);
  find_normals();
}

void ObjCutWriter::find_parts() {
  if (cut_.corner_sources.size() != cut_.corner_vertices.size() || cut_.corner_weights.size() != cut_.corner_vertices.size())
    throw std::logic_error("the cut does not say what its corners are means of");
  first_part_.assign(atlas_.face_count() + 1, 0);
  for (std::size_t part = 0; part < cut_.face_sources.size(); ++part) {
    const int face = cut_.face_sources[part];
    ++first_part_[face + 1];
    for (int c = cut_.face_offsets[part]; c < cut_.face_offsets[part + 1]; ++c) {
      const auto& sources = cut_.corner_sources[c];
      const bool of_face = std::all_of(sources.begin(), sources.end(), [&](int source) {
        return source >= atlas_.face_offsets[face] && source < atlas_.face_offsets[face + 1];
      });
      if (!of_face || (!is_new(c) && atlas_.corner_vertices[sources[0]] != cut_.corner_vertices[c]))
        throw std::logic_error("a part of face " + std::to_string(face) + " has a corner of another face");
    }
  }
  for (int face = 0; face < atlas_.face_count(); ++face) first_part_[face + 1] += first_part_[face];
}

void ObjCutWriter::find_uvs(const std::vector<Vec2>& corner_uvs) {
  std::vector<int> record_of_corner(atlas_.corner_count());
  for (auto reference = file_.uv_references.rbegin(); reference != file_.uv_references.rend(); ++reference) {
    if (reference->corner >= 0) record_of_corner[reference->corner] = reference->record;
  }
  std::vector<UvUse> uses;
  uses.reserve(corner_uvs.size());
  for (int c = 0; c < static_cast<int>(corner_uvs.size()); ++c) {
    const int record = is_new(c) ? static_cast<int>(file_.uv_records.size()) : record_of_corner[cut_.corner_sources[c][0]];
    uses.push_back({record, corner_uvs[c], c});
  }
  uvs_ = weld(file_, std::move(uses));
}

void ObjCutWriter::find_normals() {
  normals_.assign(cut_.corner_vertices.size(), -1);
  for (int c = 0; c < static_cast<int>(normals_.size()); ++c)
    normals_[c] = is_new(c) ? interpolated_normal(c) : file_.corner_normals[cut_.corner_sources[c][0]];
}

// Where normals cancel, cannot be read or are not given at all of the corners, the nearest corner's normal serves.
int ObjCutWriter::interpolated_normal(int corner) {
  const Vec3& weights = cut_.corner_weights[corner];
  int heaviest = 0;
  weights.maxCoeff(&heaviest);
  const int nearest = file_.corner_normals[cut_.corner_sources[corner][heaviest]];
  Vec3 sum = Vec3::Zero();
  bool all_equal = true, all_given = true;
  for (int i = 0; i < 3; ++i) {
    if (weights[i] == 0) continue;
    const int normal = file_.corner_normals[cut_.corner_sources[corner][i]];
    all_equal = all_equal && normal == nearest;
    all_given = all_given && normal >= 0;
    if (all_given) sum += weights[i] * file_.normal_records[normal].value;
  }
  const double length = sum.norm();
  if (all_equal || !all_given || !(length > 0) || !std::isfinite(length)) return nearest;
  sum /= length;
  const auto next = static_cast<int>(file_.normal_records.size() + new_normals_.size());
  const auto [place, is_new] = index_of_normal_.try_emplace({sum.x(), sum.y(), sum.z()}, next);
  if (is_new) new_normals_.push_back(sum);
  return place->second;
}

std::string ObjCutWriter::text() {
  out_.reserve(2 * file_.text.size());
  std::size_t copied = 0;
  for (const Edit& edit : edits()) {
    out_.append(file_.text, copied, edit.span.begin - copied);
    write(edit);
    copied = edit.span.end;
  }
  return out_.append(file_.text, copied);
}

std::vector<ObjCutWriter::Edit> ObjCutWriter::edits() const {
  std::vector<Edit> result;
  for (const auto& record : file_.position_records) {
    if (stands_behind_first_face(record.whole)) result.push_back({record.whole, Edit::Kind::Drop});
  }
  for (const auto& record : file_.normal_records) {
    if (stands_behind_first_face(record.whole)) result.push_back({record.whole, Edit::Kind::Drop});
  }
  for (int r = 0; r < static_cast<int>(file_.uv_records.size()); ++r) {
    const Span whole = file_.uv_records[r].whole;
    result.push_back({whole, stands_behind_first_face(whole) ? Edit::Kind::Drop : Edit::Kind::UvRecord, r});
  }
  for (int face = 0; face < atlas_.face_count(); ++face)
    result.push_back({file_.face_records[face].whole, Edit::Kind::Face, face});
  for (const auto& reference : file_.element_references)
    result.push_back({reference.text, Edit::Kind::Index, written_index(reference)});
  for (const auto& reference : file_.uv_references) {
    const auto count = static_cast<int>(uvs_.values.size());
    if (reference.corner < 0)
      result.push_back({reference.text, Edit::Kind::Index, written(first_value_of(uvs_, reference.record), count)});
  }
  std::sort(result.begin(), result.end(), [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
  return result;
}

// What the file does not have is not there in the output either: new records are counted in.
int ObjCutWriter::written_index(const ObjText::ElementReference& reference) const {
  const bool is_position = reference.kind == ObjText::ElementReference::Kind::Position;
  const std::size_t old = is_position ? file_.position_records.size() : file_.normal_records.size();
  const std::size_t added = is_position ? cut_.new_vertices.size() : new_normals_.size();
  const bool is_behind = reference.record >= static_cast<int>(old);
  return written(reference.record + (is_behind ? static_cast<int>(added) : 0), static_cast<int>(old + added));
}

void ObjCutWriter::write(const Edit& edit) {
  switch (edit.kind) {
    case Edit::Kind::Drop:
      break;
    case Edit::Kind::UvRecord:
      write_uv_records(file_, edit.index, uvs_, out_);
      break;
    case Edit::Kind::Face:
      if (edit.index == 0) write_moved_records();
      write_face(edit.index);
      break;
    case Edit::Kind::Index:
      out_ += std::to_string(edit.index);
      break;
  }
}

// What faces may name stands before them: the file's own records from behind the first face, then the new ones.
void ObjCutWriter::write_moved_records() {
  end_line();
  for (const auto& record : file_.position_records) {
    if (stands_behind_first_face(record.whole)) write_whole(record.whole);
  }
  write_new_positions();
  for (int r = 0; r < static_cast<int>(file_.uv_records.size()); ++r) {
    if (!stands_behind_first_face(file_.uv_records[r].whole)) continue;
    write_uv_records(file_, r, uvs_, out_);
    end_line();
  }
  for (std::size_t i = uvs_.first.back(); i < uvs_.values.size(); ++i) {
    out_ += "vt";
    for (double number : uvs_.values[i]) append_number(out_ += ' ', number);
    end_line();
  }
  for (const auto& record : file_.normal_records) {
    if (stands_behind_first_face(record.whole)) write_whole(record.whole);
  }
  for (const Vec3& normal : new_normals_) {
    out_ += "vn";
    for (double number : normal) append_number(out_ += ' ', number);
    end_line();
  }
}

// The numbers behind a position (a colour) are interpolated where all corners have as many of them; w of a mean is 1.
void ObjCutWriter::write_new_positions() {
  for (const NewVertex& vertex : cut_.new_vertices) {
    out_ += "v";
    Vec3 position = Vec3::Zero();
    for (int k = 0; k < 3; ++k) position += vertex.weights[k] * atlas_.positions[atlas_.corner_vertices[vertex.corners[k]]];
    for (double number : position) append_number(out_ += ' ', number);
    std::array<const ObjText::PositionRecord*, 3> records;
    for (int k = 0; k < 3; ++k) records[k] = &file_.position_records[atlas_.corner_vertices[vertex.corners[k]]];
    const int count = records[0]->extra_count;
    const bool same = count == records[1]->extra_count && (vertex.weights[2] == 0 || count == records[2]->extra_count);
    if (same && count == 1) out_ += " 1";
    for (int i = 0; same && count > 1 && i < count; ++i) {
      double number = 0;
      for (int k = 0; k < 3; ++k) {
        if (vertex.weights[k] != 0) number += vertex.weights[k] * file_.extras[records[k]->first_extra + i];
      }
      append_number(out_ += ' ', number);
    }
    end_line();
  }
}

void ObjCutWriter::write_face(int face) {
  const Span tail = file_.face_records[face].tail;
  const bool is_whole = first_part_[face + 1] - first_part_[face] == 1;
  for (int part = first_part_[face]; part < first_part_[face + 1]; ++part) {
    out_ += 'f';
    for (int c = cut_.face_offsets[part]; c < cut_.face_offsets[part + 1]; ++c) {
      std::string corner = ' ' + std::to_string(cut_.corner_vertices[c] + 1) + '/' + std::to_string(uvs_.of_corner[c] + 1);
      if (normals_[c] >= 0) corner += '/' + std::to_string(normals_[c] + 1);
      for (int times = is_whole ? times_named(c) : 1; times > 0; --times) out_ += corner;
    }
    if (part + 1 < first_part_[face + 1]) end_line();
  }
  out_.append(file_.text, tail.begin, tail.end - tail.begin);
}

int ObjCutWriter::times_named(int corner) const {
  if (is_new(corner)) return 1;
  const auto repeats = file_.repeats.find(cut_.corner_sources[corner][0]);
  return repeats == file_.repeats.end() ? 1 : 1 + repeats->second;
}

void ObjCutWriter::write_whole(Span record) {
  out_.append(file_.text, record.begin, record.end - record.begin);
  end_line();
}

// Only the file's last record may lack a line end.
void ObjCutWriter::end_line() {
  if (!out_.empty() && out_.back() != '\n' && out_.back() != '\r') out_ += line_end_;
}

}  // namespace atlas_refine::io
