// Whether the arrays of an atlas fit together.
#include "input/check_atlas.h"

#include <cmath>

#include "atlas_refine/error.h"

namespace atlas_refine {

namespace {

constexpr double kLargestCoordinate = 1e60;  // areas and their squares stay finite below it

[[noreturn]] void fail(const Atlas& atlas, const std::string& message, int face = -1) {
  throw RefineError(ErrorCode::BadInput, "input", message_prefix(atlas) + message, -1, face);
}

template <class Vector>
bool usable(const Vector& vector) {
  for (int i = 0; i < vector.size(); ++i) {
    if (!(std::abs(vector[i]) <= kLargestCoordinate)) return false;
  }
  return true;
}

void check_positions(const Atlas& atlas) {
  for (std::size_t v = 0; v < atlas.positions.size(); ++v) {
    if (!usable(atlas.positions[v]))
      fail(atlas, "vertex " + std::to_string(v) + ": the position is not a finite number below 1e60");
  }
}

void check_faces(const Atlas& atlas) {
  if (atlas.face_count() == 0) fail(atlas, "the mesh has no faces");
  if (atlas.face_offsets.front() != 0 || atlas.face_offsets.back() != atlas.corner_count()) {
    fail(atlas, "the face offsets do not cover the " + std::to_string(atlas.corner_count()) + " corners");
  }
  for (int f = 0; f < atlas.face_count(); ++f) {
    const long corners = static_cast<long>(atlas.face_offsets[f + 1]) - atlas.face_offsets[f];
    if (atlas.face_offsets[f + 1] > atlas.corner_count()) fail(atlas, "the face offsets are out of order", f);
    if (corners < 3) fail(atlas, "face " + std::to_string(f) + " has fewer than 3 corners", f);
  }
}

void check_corners(const Atlas& atlas) {
  const int vertex_count = static_cast<int>(atlas.positions.size());
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      const int v = atlas.corner_vertices[c];
      if (v < 0 || v >= vertex_count) {
        fail(atlas, "face " + std::to_string(f) + " uses vertex " + std::to_string(v) + " of " + std::to_string(vertex_count), f);
      }
      if (!usable(atlas.corner_uvs[c])) fail(atlas, "face " + std::to_string(f) + ": a UV is not a finite number below 1e60", f);
    }
  }
}

}  // namespace

std::string message_prefix(const Atlas& atlas) { return atlas.name.empty() ? "" : "object '" + atlas.name + "': "; }

void check_atlas(const Atlas& atlas) {
  if (atlas.corner_uvs.size() != atlas.corner_vertices.size()) {
    fail(atlas, std::to_string(atlas.corner_uvs.size()) + " UVs for " + std::to_string(atlas.corner_count()) + " corners");
  }
  check_positions(atlas);
  check_faces(atlas);
  check_corners(atlas);
}

}  // namespace atlas_refine
