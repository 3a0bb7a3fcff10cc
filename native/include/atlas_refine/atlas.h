// The input and output value of every public call: a polygon mesh with one UV per face corner.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace atlas_refine {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// A polygon mesh and its UV map. Face f owns the corners face_offsets[f] .. face_offsets[f + 1] - 1.
///
/// UVs are given by value at every corner, as file formats and Blender store them. Two faces belong to one chart where they
/// share an edge and hold equal UVs at both of its ends; vertices of equal position count as one vertex there, so meshes
/// whose vertices are doubled for the sake of normals keep their charts whole.
struct Atlas {
  std::string name;                  ///< names the object in messages; may be empty
  std::vector<Vec3> positions;       ///< one per vertex, model units
  std::vector<int> face_offsets;     ///< faces + 1 entries, starting with 0; every face has at least 3 corners
  std::vector<int> corner_vertices;  ///< one per corner: index into positions
  std::vector<Vec2> corner_uvs;      ///< one per corner, UV units
  /// Optional: how the consumer divides faces of more than three corners, as triples of corners of one face, any order of
  /// faces. Faces that are not named are divided here: a fan from the first corner where that is valid, else by ears.
  std::vector<std::array<int, 3>> triangles = {};

  /// Optional: one number per vertex, of the mesh it belongs to where several are given as one. Vertices of different meshes
  /// never count as one: variants of a model that lie at one place share no chart and no cut.
  std::vector<int> vertex_meshes = {};

  int face_count() const { return face_offsets.empty() ? 0 : static_cast<int>(face_offsets.size()) - 1; }
  int corner_count() const { return static_cast<int>(corner_vertices.size()); }
};

}  // namespace atlas_refine
