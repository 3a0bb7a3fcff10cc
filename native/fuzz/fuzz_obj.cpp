// The OBJ reader and both writers: any text is read or refused in words, and what was read comes back as it was.
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <numeric>

#include "atlas_refine/error.h"
#include "io/file_kind.h"
#include "io/obj_file.h"

namespace atlas_refine::fuzz {

namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "fuzz_obj: " << what << '\n';
  std::abort();
}

bool same_mesh(const Atlas& a, const Atlas& b) {
  return a.positions == b.positions && a.face_offsets == b.face_offsets && a.corner_vertices == b.corner_vertices;
}

/// Each corner another UV, so that shared records must part.
std::vector<Vec2> other_uvs(const Atlas& atlas) {
  std::vector<Vec2> uvs;
  for (int c = 0; c < atlas.corner_count(); ++c) uvs.push_back({0.1 * (c % 7), 1.0 / (1 + c)});
  return uvs;
}

/// Every face as it is.
CutMesh uncut(const Atlas& atlas) {
  CutMesh cut;
  cut.face_offsets = atlas.face_offsets;
  cut.corner_vertices = atlas.corner_vertices;
  cut.face_sources.resize(atlas.face_count());
  std::iota(cut.face_sources.begin(), cut.face_sources.end(), 0);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    cut.corner_sources.push_back({c, c, c});
    cut.corner_weights.push_back({1, 0, 0});
  }
  return cut;
}

/// The first edge of the first face divided in its middle.
CutMesh divided(const Atlas& atlas) {
  CutMesh cut = uncut(atlas);
  cut.corner_vertices.insert(cut.corner_vertices.begin() + 1, static_cast<int>(atlas.positions.size()));
  cut.corner_sources.insert(cut.corner_sources.begin() + 1, {0, 1, 0});
  cut.corner_weights.insert(cut.corner_weights.begin() + 1, {0.5, 0.5, 0});
  for (std::size_t f = 1; f < cut.face_offsets.size(); ++f) ++cut.face_offsets[f];
  cut.new_vertices.push_back({{0, 1, 0}, {0.5, 0.5, 0}});
  return cut;
}

void read_and_write(const std::string& text) {
  const io::ObjFile file = io::ObjFile::parse(text);
  const Atlas& atlas = file.atlas();
  require(file.with_uvs(atlas.corner_uvs) == text, "its own UVs change the file");
  const std::vector<Vec2> uvs = other_uvs(atlas);
  const io::ObjFile moved = io::ObjFile::parse(file.with_uvs(uvs));
  require(same_mesh(moved.atlas(), atlas), "new UVs change the mesh");
  require(moved.atlas().corner_uvs == uvs, "new UVs do not come back");
  require(moved.notes().size() == file.notes().size(), "new UVs change what is left out");
  const io::ObjFile whole = io::ObjFile::parse(file.with_cut(uncut(atlas), uvs));
  require(same_mesh(whole.atlas(), atlas) && whole.atlas().corner_uvs == uvs, "a cut that cuts nothing changes the mesh");
  std::vector<Vec2> divided_uvs = uvs;
  divided_uvs.insert(divided_uvs.begin() + 1, Vec2(0.5 * (uvs[0] + uvs[1])));
  const io::ObjFile cut = io::ObjFile::parse(file.with_cut(divided(atlas), divided_uvs));
  require(cut.atlas().corner_uvs == divided_uvs, "UVs of a divided face do not come back");
}

}  // namespace

}  // namespace atlas_refine::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::clock_t start = std::clock();
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  atlas_refine::io::foreign_kind(text);
  try {
    atlas_refine::fuzz::read_and_write(text);
  } catch (const atlas_refine::RefineError& error) {
    atlas_refine::fuzz::require(*error.what() != '\0', "a refusal without words");
  }
  atlas_refine::fuzz::require(std::clock() - start < 2 * CLOCKS_PER_SEC, "slow");
  return 0;
}
