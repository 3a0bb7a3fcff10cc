// A Wavefront OBJ file whose UVs can be replaced while every other byte of it stays as it was.
#include "obj_file.h"

#include <algorithm>
#include <charconv>

#include "atlas_refine/error.h"
#include "input_file.h"
#include "number_text.h"
#include "obj_cut_writer.h"
#include "obj_parser.h"

namespace atlas_refine::cli {

ObjFile ObjFile::read(const std::filesystem::path& path) {
  std::string text = read_text(path, "an OBJ file");
  try {
    return parse(std::move(text));
  } catch (const RefineError& error) {
    throw InputError(path, error.what());
  }
}

ObjFile ObjFile::parse(std::string text) {
  ObjFile file;
  file.text_ = std::move(text);
  ObjParser(file).run();
  file.atlas_.corner_uvs.resize(file.atlas_.corner_vertices.size());
  for (const UvReference& reference : file.uv_references_) {
    if (reference.corner >= 0) file.atlas_.corner_uvs[reference.corner] = file.uv_records_[reference.record].value;
  }
  return file;
}

std::string ObjFile::text_with_cut(const CutMesh& cut, const std::vector<Vec2>& corner_uvs) const {
  return ObjCutWriter(*this, cut, corner_uvs).text();
}

std::string ObjFile::text_with_uvs(const std::vector<Vec2>& corner_uvs) const {
  std::vector<UvUse> uses;
  uses.reserve(corner_uvs.size());
  for (const UvReference& reference : uv_references_) {
    if (reference.corner >= 0) uses.push_back({reference.record, corner_uvs[reference.corner], reference.corner});
  }
  const NewRecords records = weld(std::move(uses));
  // One value for each record: indices, absolute and relative, mean what they meant.
  const bool renumbered = records.values.size() != uv_records_.size();
  std::string out;
  out.reserve(text_.size() + uv_records_.size() * 24);
  std::size_t copied = 0;
  auto reference = uv_references_.begin();
  const auto write_references_before = [&](std::size_t end) {
    for (; renumbered && reference != uv_references_.end() && reference->text.begin < end; ++reference) {
      out.append(text_, copied, reference->text.begin - copied);
      write_reference(*reference, records, out);
      copied = reference->text.end;
    }
  };
  for (const UvRecord& record : uv_records_) {
    write_references_before(record.whole.begin);
    out.append(text_, copied, record.whole.begin - copied);
    write_records(record, records, out);
    copied = record.whole.end;
  }
  write_references_before(text_.size());
  return out.append(text_, copied);
}

// The distinct values of each record's corners in ascending order; a record that no corner uses keeps its own. Corners without
// a record of the file count as users of one more record behind the last.
ObjFile::NewRecords ObjFile::weld(std::vector<UvUse> uses) const {
  std::sort(uses.begin(), uses.end(), [](const UvUse& a, const UvUse& b) {
    if (a.record != b.record) return a.record < b.record;
    if (a.uv.x() != b.uv.x()) return a.uv.x() < b.uv.x();
    return a.uv.y() < b.uv.y();
  });
  NewRecords result;
  result.of_corner.resize(uses.size());
  auto use = uses.begin();
  for (std::size_t record = 0; record <= uv_records_.size(); ++record) {
    const std::size_t first = result.values.size();
    result.first.push_back(static_cast<int>(first));
    for (; use != uses.end() && use->record == static_cast<int>(record); ++use) {
      if (result.values.size() == first || result.values.back() != use->uv) result.values.push_back(use->uv);
      result.of_corner[use->corner] = static_cast<int>(result.values.size()) - 1;
    }
    if (result.values.size() == first && record < uv_records_.size()) result.values.push_back(uv_records_[record].value);
  }
  return result;
}

void ObjFile::write_records(const UvRecord& record, const NewRecords& records, std::string& out) const {
  const auto r = static_cast<std::size_t>(&record - uv_records_.data());
  for (int i = records.first[r]; i < records.first[r + 1]; ++i) {
    const Vec2& uv = records.values[i];
    const bool ends_in_mid_line = i > records.first[r] && out.back() != '\n' && out.back() != '\r';
    if (ends_in_mid_line) out += '\n';
    if (uv == record.value) {
      out.append(text_, record.whole.begin, record.whole.end - record.whole.begin);
      continue;
    }
    out.append(text_, record.whole.begin, record.u.begin - record.whole.begin);
    append_number(out, uv.x());
    if (record.v.begin == record.u.end) out += ' ';
    out.append(text_, record.u.end, record.v.begin - record.u.end);
    append_number(out, uv.y());
    out.append(text_, record.v.end, record.whole.end - record.v.end);
  }
}

// A relative index stays relative: some readers do not allow both kinds in one corner.
void ObjFile::write_reference(const UvReference& reference, const NewRecords& records, std::string& out) const {
  int value = 0;
  std::from_chars(text_.data() + reference.text.begin, text_.data() + reference.text.end, value);
  const int record = reference.corner < 0 ? records.first[reference.record] : records.of_corner[reference.corner];
  if (value > 0) {
    value = record + 1;
  } else {
    const int records_so_far = reference.record - value;
    value = record - records.first[records_so_far];
  }
  out += std::to_string(value);
}

}  // namespace atlas_refine::cli
