// The library on small damaged meshes: a certified result, or a refusal in words.
//
// With ATLAS_REFINE_FUZZ_OBJ=FILE in the environment the input is written there as an OBJ file, its options in the first line.
#include <cstdlib>
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

void check(const Atlas& atlas, const RefineOptions& options, const RefineResult& result) {
  const Validity validity = validate(testing::output(atlas, result));
  require(validity.valid(), "the result is not valid: " + validity.problem);
  require(result.bound_met || options.best_effort, "the bound was missed without a word");
  require(!result.bound_met || result.after.pe_fixed_aspect >= options.pe_bound, "the bound does not hold");
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
  FuzzedDataProvider data(bytes, size);
  atlas_refine::fuzz::refine_input(data);
  return 0;
}
