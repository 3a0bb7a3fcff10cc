// The vt records of an OBJ file whose corners have other UVs than before.
#include "io/obj_uv_records.h"

#include <algorithm>

#include "io/number_text.h"

namespace atlas_refine::io {

UvRecords weld(const ObjText& obj, std::vector<UvUse> uses) {
  std::sort(uses.begin(), uses.end(), [](const UvUse& a, const UvUse& b) {
    if (a.record != b.record) return a.record < b.record;
    if (a.uv.x() != b.uv.x()) return a.uv.x() < b.uv.x();
    return a.uv.y() < b.uv.y();
  });
  UvRecords result;
  result.of_corner.resize(uses.size());
  auto use = uses.begin();
  for (std::size_t record = 0; record <= obj.uv_records.size(); ++record) {
    const std::size_t first = result.values.size();
    result.first.push_back(static_cast<int>(first));
    for (; use != uses.end() && use->record == static_cast<int>(record); ++use) {
      if (result.values.size() == first || result.values.back() != use->uv) result.values.push_back(use->uv);
      result.of_corner[use->corner] = static_cast<int>(result.values.size()) - 1;
    }
    if (result.values.size() == first && record < obj.uv_records.size()) result.values.push_back(obj.uv_records[record].value);
  }
  return result;
}

int first_value_of(const UvRecords& records, int record) {
  const auto count = static_cast<int>(records.first.size()) - 1;
  if (record < 0) return record;
  return record < count ? records.first[record] : static_cast<int>(records.values.size()) + record - count;
}

void write_uv_records(const ObjText& obj, int record, const UvRecords& records, std::string& out) {
  const ObjText::UvRecord& old = obj.uv_records[record];
  for (int i = records.first[record]; i < records.first[record + 1]; ++i) {
    const Vec2& uv = records.values[i];
    const bool ends_in_mid_line = i > records.first[record] && out.back() != '\n' && out.back() != '\r';
    if (ends_in_mid_line) out += '\n';
    // What is not finite is no corner's.
    if (uv == old.value || !old.value.allFinite()) {
      out.append(obj.text, old.whole.begin, old.whole.end - old.whole.begin);
      continue;
    }
    out.append(obj.text, old.whole.begin, old.u.begin - old.whole.begin);
    append_number(out, uv.x());
    if (old.v.begin == old.u.end) out += ' ';
    out.append(obj.text, old.u.end, old.v.begin - old.u.end);
    append_number(out, uv.y());
    out.append(obj.text, old.v.end, old.whole.end - old.v.end);
  }
}

}  // namespace atlas_refine::io
