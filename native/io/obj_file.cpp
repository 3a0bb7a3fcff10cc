// A Wavefront OBJ file whose UVs can be replaced while every other byte of it stays as it was.
#include "io/obj_file.h"

#include <algorithm>
#include <charconv>

#include "io/obj_cut_writer.h"
#include "io/obj_parser.h"
#include "io/obj_uv_records.h"

namespace atlas_refine::io {

namespace {

// A corner that is named several times in a row may have come from several records, each of which has its value.
int record_of(const ObjText::UvReference& reference, const UvRecords& records) {
  if (reference.corner < 0) return first_value_of(records, reference.record);
  const int first = records.first[reference.record], last = records.first[reference.record + 1];
  const int known = records.of_corner[reference.corner];
  if (known >= first && known < last) return known;
  const auto begin = records.values.begin();
  return static_cast<int>(std::find(begin + first, begin + last, records.values[known]) - begin);
}

// A relative index stays relative: some readers do not allow both kinds in one corner.
void write_reference(const ObjText& obj, const ObjText::UvReference& reference, const UvRecords& records, std::string& out) {
  int value = 0;
  std::from_chars(obj.text.data() + reference.text.begin, obj.text.data() + reference.text.end, value);
  const int record = record_of(reference, records);
  if (value > 0) {
    value = record + 1;
  } else {
    const int records_so_far = reference.record - value;
    value = record - records.first[records_so_far];
  }
  out += std::to_string(value);
}

}  // namespace

ObjFile ObjFile::parse(std::string text) { return ObjFile(parse_obj(std::move(text))); }

std::vector<std::string> ObjFile::notes() const {
  std::vector<std::string> notes;
  const auto note = [&](const ObjText::Remark& remark, const std::string& one, const std::string& several) {
    const std::string line = std::to_string(remark.first_line);
    if (remark.count == 1) notes.push_back("1 face " + one + " (line " + line + ")");
    if (remark.count > 1)
      notes.push_back(std::to_string(remark.count) + " faces " + several + " (the first on line " + line + ")");
  };
  note(text_.with_repeats, "names a vertex several times in a row, taken once",
       "name a vertex several times in a row, taken once");
  note(text_.left_out_degenerate, "has fewer than three different vertices and is left out",
       "have fewer than three different vertices and are left out");
  note(text_.left_out_without_uvs, "has corners without UVs and is left out", "have corners without UVs and are left out");
  note(text_.left_out_out_of_range, "names a vertex or UV that the file does not have and is left out",
       "name a vertex or UV that the file does not have and are left out");
  note(text_.left_out_infinite_position, "has a vertex whose position is not finite and is left out",
       "have a vertex whose position is not finite and are left out");
  note(text_.without_normals, "names a normal that the file does not have", "name a normal that the file does not have");
  note(text_.left_out_infinite, "has a UV that is not finite and is left out", "have a UV that is not finite and are left out");
  note(text_.left_out_revisiting, "comes to a vertex twice and is left out", "come to a vertex twice and are left out");
  return notes;
}

std::string ObjFile::with_cut(const CutMesh& cut, const std::vector<Vec2>& corner_uvs) const {
  return ObjCutWriter(text_, cut, corner_uvs).text();
}

std::string ObjFile::with_uvs(const std::vector<Vec2>& corner_uvs) const {
  const ObjText& obj = text_;
  if (corner_uvs == obj.atlas.corner_uvs) return obj.text;
  std::vector<UvUse> uses;
  uses.reserve(corner_uvs.size());
  for (const ObjText::UvReference& reference : obj.uv_references) {
    if (reference.corner >= 0) uses.push_back({reference.record, corner_uvs[reference.corner], reference.corner});
  }
  const UvRecords records = weld(obj, std::move(uses));
  // One value for each record: indices, absolute and relative, mean what they meant.
  const bool renumbered = records.values.size() != obj.uv_records.size();
  std::string out;
  out.reserve(obj.text.size() + obj.uv_records.size() * 24);
  std::size_t copied = 0;
  auto reference = obj.uv_references.begin();
  const auto write_references_before = [&](std::size_t end) {
    for (; renumbered && reference != obj.uv_references.end() && reference->text.begin < end; ++reference) {
      out.append(obj.text, copied, reference->text.begin - copied);
      write_reference(obj, *reference, records, out);
      copied = reference->text.end;
    }
  };
  for (int r = 0; r < static_cast<int>(obj.uv_records.size()); ++r) {
    const ObjText::Span record = obj.uv_records[r].whole;
    write_references_before(record.begin);
    out.append(obj.text, copied, record.begin - copied);
    write_uv_records(obj, r, records, out);
    copied = record.end;
  }
  write_references_before(obj.text.size());
  return out.append(obj.text, copied);
}

}  // namespace atlas_refine::io
