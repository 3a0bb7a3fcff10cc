// The library on small damaged meshes: a certified result, or a refusal in words.
//
// With ATLAS_REFINE_FUZZ_OBJ=FILE in the environment the input is written there as an OBJ file, its options in the first line.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>

#include "atlas_refine/refine.h"
#include "fuzzed_mesh.h"
#include "fuzzed_options.h"
#include "output_atlas.h"

namespace atlas_refine::fuzz {

namespace {

void write_obj(const char* path, const Atlas& atlas, const RefineOptions& options) {
  std::ofstream out(path);
  out.precision(17);
  out << "# " << words(options) << '\n';
  for (const Vec3& p : atlas.positions) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const Vec2& uv : atlas.corner_uvs) out << "vt " << uv.x() << ' ' << uv.y() << '\n';
  for (int f = 0; f < atlas.face_count(); ++f) {
    out << 'f';
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c)
      out << ' ' << atlas.corner_vertices[c] + 1 << '/' << c + 1;
    out << '\n';
  }
}

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "fuzz_refine: " << what << '\n';
  std::abort();
}

/// Locked charts may be as they like, and on each other.
bool takes_part(const ChartReport& chart) {
  return chart.fate != Fate::Left && chart.fate != Fate::Stacked && chart.fate != Fate::Locked;
}

bool keeps_uvs(const RefineResult& result, int group) {
  return std::any_of(result.groups.begin(), result.groups.end(),
                     [&](const GroupReport& report) { return report.group == group && !report.reason.empty(); });
}

bool says_why(const RefineResult& result) {
  return std::any_of(result.groups.begin(), result.groups.end(),
                     [](const GroupReport& report) { return !report.reason.empty(); });
}

/// Of each input face the group of the atlas that it is in, -1 where its chart was left, lies on another one or is locked, or the
/// whole group keeps its UVs.
std::vector<int> atlas_of_faces(const Atlas& atlas, const RefineOptions& options, const RefineResult& result) {
  std::vector<int> groups = options.groups;
  groups.resize(atlas.face_count(), 0);
  for (int f = 0; f < atlas.face_count(); ++f) {
    if (!takes_part(result.charts[result.face_charts[f]]) || keeps_uvs(result, groups[f])) groups[f] = -1;
  }
  return groups;
}

/// The faces of one atlas of the output; its other vertices stay, unused.
Atlas one_of(const Atlas& output, const std::vector<int>& group_of_face, int group) {
  Atlas out{.positions = output.positions, .face_offsets = {0}};
  for (int f = 0; f < output.face_count(); ++f) {
    if (group_of_face[f] != group) continue;
    for (int c = output.face_offsets[f]; c < output.face_offsets[f + 1]; ++c) {
      out.corner_vertices.push_back(output.corner_vertices[c]);
      out.corner_uvs.push_back(output.corner_uvs[c]);
    }
    out.face_offsets.push_back(out.corner_count());
  }
  return out;
}

/// A piece whose faces are all wound against the rest of its chart is mirrored by itself, which the result warns of.
bool warns_of_mirrored(const RefineResult& result) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [](const std::string& warning) { return warning.find(" mirrored: ") != std::string::npos; });
}

void check_validity(const Atlas& atlas, const RefineOptions& options, const RefineResult& result) {
  const std::vector<int> input_groups = atlas_of_faces(atlas, options, result);
  std::vector<int> groups = input_groups;
  if (result.cut) {
    groups.clear();
    for (const int source : result.cut->face_sources) groups.push_back(input_groups[source]);
  }
  const Atlas output = testing::output(atlas, result);
  for (int group = 0; group <= *std::max_element(groups.begin(), groups.end()); ++group) {
    const Atlas one = one_of(output, groups, group);
    if (one.face_count() == 0) continue;
    const Validity validity = validate(one);
    const bool turned_only = validity.mirrored_charts > 0 && validity.flipped_faces == 0 && validity.crossings == 0;
    require(validity.valid() || (turned_only && warns_of_mirrored(result)),
            std::string("the result (") + to_string(result.intervention) + ", group " + std::to_string(group) +
                ") is not valid: " + validity.problem);
  }
}

/// Charts that were refined lie within the texture, at the corner of its tile.
void check_texture(const Atlas& atlas, const RefineOptions& options, const RefineResult& result) {
  if (!options.in_texture || !result.bound_met) return;
  const std::vector<int> groups = atlas_of_faces(atlas, options, result);
  const Atlas output = testing::output(atlas, result);
  for (int f = 0; f < output.face_count(); ++f) {
    const int group = groups[result.cut ? result.cut->face_sources[f] : f];
    if (group < 0) continue;
    const bool has_tile = group < static_cast<int>(options.group_origins.size());
    const Vec2 corner = has_tile ? options.group_origins[group] : Vec2(0, 0);
    for (int c = output.face_offsets[f]; c < output.face_offsets[f + 1]; ++c) {
      const Vec2 uv = output.corner_uvs[c] - corner;
      require(uv.minCoeff() >= 0 && uv.maxCoeff() <= 1, "face " + std::to_string(f) + " lies beside the texture");
    }
  }
}

void check(const Atlas& atlas, const RefineOptions& options, const RefineResult& result) {
  check_validity(atlas, options, result);
  require(result.bound_met || options.best_effort || says_why(result), "the bound was missed without a word");
  const bool any_in = std::any_of(result.charts.begin(), result.charts.end(), takes_part);
  const bool is_sized = options.in_texture && options.uv_density > 0;  // charts take what that asks, no more
  require(!any_in || !result.bound_met || is_sized || result.after.pe_fixed_aspect >= options.pe_bound,
          "the bound does not hold");
  check_texture(atlas, options, result);
}

/// Processor time, which other programs do not lengthen. A packing that cannot be had takes up to three seconds of a release
/// build, which is five times as fast.
void require_fast(std::clock_t start) {
  constexpr double kMostSeconds = 30;
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  require(seconds <= kMostSeconds, "slow, " + std::to_string(seconds) + " s of processor time");
}

void refine_input(FuzzedDataProvider& data) {
  const Atlas atlas = fuzzed_mesh(data);
  const RefineOptions options = fuzzed_options(data, atlas);
  if (const char* path = std::getenv("ATLAS_REFINE_FUZZ_OBJ")) write_obj(path, atlas, options);
  try {
    check(atlas, options, refine(atlas, options));
  } catch (const RefineError& error) {
    require(error.code() != ErrorCode::Cancelled && *error.what() != '\0', "a refusal without words");
  }
}

}  // namespace

}  // namespace atlas_refine::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::clock_t start = std::clock();
  FuzzedDataProvider data(bytes, size);
  atlas_refine::fuzz::refine_input(data);
  atlas_refine::fuzz::require_fast(start);
  return 0;
}
