// Whether the arrays of an atlas fit together.
#include "input/check_atlas.h"

#include <algorithm>
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
    }
  }
}

/// Only that they are corners of one face: a wrong division of a polygon is passed over.
void check_triangles(const Atlas& atlas) {
  const auto face_of = [&](int corner) {
    return std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), corner) - atlas.face_offsets.begin();
  };
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t) {
    for (int corner : atlas.triangles[t]) {
      if (corner < 0 || corner >= atlas.corner_count() || face_of(corner) != face_of(atlas.triangles[t][0]))
        fail(atlas, "triangle " + std::to_string(t) + " does not have three corners of one face");
    }
  }
}

}  // namespace

std::string message_prefix(const Atlas& atlas) { return atlas.name.empty() ? "" : "object '" + atlas.name + "': "; }

void check_arrays(const Atlas& atlas) {
  if (atlas.corner_uvs.size() != atlas.corner_vertices.size()) {
    fail(atlas, std::to_string(atlas.corner_uvs.size()) + " UVs for " + std::to_string(atlas.corner_count()) + " corners");
  }
  if (!atlas.vertex_meshes.empty() && atlas.vertex_meshes.size() != atlas.positions.size())
    fail(atlas, std::to_string(atlas.vertex_meshes.size()) + " mesh numbers for " + std::to_string(atlas.positions.size()) +
                    " vertices");
  check_faces(atlas);
  check_corners(atlas);
  check_triangles(atlas);
}

void check_atlas(const Atlas& atlas) {
  check_arrays(atlas);
  for (std::size_t v = 0; v < atlas.positions.size(); ++v) {
    if (!usable(atlas.positions[v]))
      fail(atlas, "vertex " + std::to_string(v) + ": the position is not a finite number below 1e60");
  }
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      if (!usable(atlas.corner_uvs[c])) fail(atlas, "face " + std::to_string(f) + ": a UV is not a finite number below 1e60", f);
    }
  }
}

UsableAtlas set_unusable_aside(const Atlas& atlas) {
  UsableAtlas out{.atlas = atlas, .has_uvs = std::vector<char>(atlas.face_count(), 1)};
  Vec2 high = Vec2::Constant(-kLargestCoordinate);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      if (!usable(atlas.corner_uvs[c]) || !usable(atlas.positions[atlas.corner_vertices[c]])) out.has_uvs[f] = 0;
    }
    for (int c = atlas.face_offsets[f]; out.has_uvs[f] && c < atlas.face_offsets[f + 1]; ++c)
      high = high.cwiseMax(atlas.corner_uvs[c]);
  }
  if (std::all_of(out.has_uvs.begin(), out.has_uvs.end(), [](char has) { return has == 0; })) {
    check_atlas(atlas);  // names the first
  }
  for (Vec3& position : out.atlas.positions) {
    if (!usable(position)) position.setZero();
  }
  // A point of their own: they share a chart with no other face.
  const Vec2 aside = high + Vec2::Constant(1);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; !out.has_uvs[f] && c < atlas.face_offsets[f + 1]; ++c) out.atlas.corner_uvs[c] = aside;
  }
  return out;
}

bool is_usable(const Atlas& atlas) {
  const auto all = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](const auto& value) { return usable(value); });
  };
  return all(atlas.positions) && all(atlas.corner_uvs);
}

}  // namespace atlas_refine
