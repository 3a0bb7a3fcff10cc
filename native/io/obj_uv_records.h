// The vt records of an OBJ file whose corners have other UVs than before.
#pragma once

#include <string>
#include <vector>

#include "io/obj_text.h"

namespace atlas_refine::io {

/// One corner of the output, whose UV takes the place of a vt record's; `record` is the number of the file's records where it
/// comes from none.
struct UvUse {
  int record;
  Vec2 uv;
  int corner;
};

/// The vt records of the output: values of record r are values[first[r]] .. values[first[r + 1] - 1]; the file's last record is
/// followed by the values of corners that have no record of the file.
struct UvRecords {
  std::vector<Vec2> values;
  std::vector<int> first;
  std::vector<int> of_corner;
};

/// The distinct values of each record's corners in ascending order; a record that no corner uses keeps its own.
UvRecords weld(const ObjText& obj, std::vector<UvUse> uses);

/// The first value of the file's record `record`. A record that the file does not have is not there in the output either: as far
/// behind the last, or before the first.
int first_value_of(const UvRecords& records, int record);

/// Appends what the file's record `record` becomes.
void write_uv_records(const ObjText& obj, int record, const UvRecords& records, std::string& out);

}  // namespace atlas_refine::io
