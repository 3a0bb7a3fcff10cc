// Regular meshes of a few faces, and the damage: numbers, places, corners, faces, whole axes.
#include "fuzzed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace atlas_refine::fuzz {

namespace {

using Face = std::vector<int>;

constexpr std::array kNumbers{0.0, 1.0,  -1.0, 0.5, 0.25, 1e-3, 1e-6, 1e-9, 1e-16, 1e-30, 1e-150, 1e-300,
                              2.0, 10.0, 1e3,  1e5, 1e6,  -1e6, 1e8,  1e9,  -1e9,  1e16,  1e30};

/// A mesh whose UVs are still corner by corner.
struct Draft {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<std::vector<Vec2>> uvs;

  void add_face(const Face& face, const std::vector<Vec2>& corners) {
    faces.push_back(face);
    uvs.push_back(corners);
  }
  int add_position(const Vec3& p) {
    positions.push_back(p);
    return static_cast<int>(positions.size()) - 1;
  }
};

double number(FuzzedDataProvider& data) {
  if (data.ConsumeBool()) return data.PickValueInArray(kNumbers);
  return data.ConsumeIntegralInRange<int>(-64, 64) / 16.0;
}

/// Quads of a grid, its surface lifted to a wave; `hole` leaves one of several out.
void add_grid(FuzzedDataProvider& data, Draft& draft) {
  const int columns = data.ConsumeIntegralInRange(1, 6), rows = data.ConsumeIntegralInRange(1, 6);
  const int hole = data.ConsumeIntegralInRange(-1, columns * rows - 1);
  const double bend = data.ConsumeIntegralInRange(0, 8) / 8.0;
  const Vec2 at(data.ConsumeIntegralInRange(0, 8), data.ConsumeIntegralInRange(0, 8));
  const int first = static_cast<int>(draft.positions.size());
  const auto uv = [&](int i, int j) { return Vec2(at + Vec2(i, j) / 6.0); };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) draft.add_position({uv(i, j).x(), uv(i, j).y(), bend * std::sin(2.0 * i) * std::cos(j)});
  }
  for (int k = 0; k < columns * rows; ++k) {
    if (k == hole && columns * rows > 1) continue;
    const int i = k % columns, j = k / columns, v = first + j * (columns + 1) + i;
    draft.add_face({v, v + 1, v + columns + 2, v + columns + 1}, {uv(i, j), uv(i + 1, j), uv(i + 1, j + 1), uv(i, j + 1)});
  }
}

/// One polygon, convex to star-shaped.
void add_polygon(FuzzedDataProvider& data, Draft& draft) {
  const int corners = data.ConsumeIntegralInRange(3, 30);
  const double dent = data.ConsumeIntegralInRange(0, 7) / 8.0;
  const Vec2 at(data.ConsumeIntegralInRange(-8, 8), data.ConsumeIntegralInRange(-8, 8));
  Face face;
  std::vector<Vec2> uvs;
  for (int k = 0; k < corners; ++k) {
    const double turn = 2 * 3.14159265358979 * k / corners, radius = k % 2 == 0 ? 1 : 1 - dent;
    uvs.push_back(at + radius * Vec2(std::cos(turn), std::sin(turn)));
    face.push_back(draft.add_position({uvs.back().x(), uvs.back().y(), 0}));
  }
  draft.add_face(face, uvs);
}

/// Triangles about a tip: a cone, closed in space or not, its tip one vertex or one for each triangle.
void add_cone(FuzzedDataProvider& data, Draft& draft) {
  const int count = data.ConsumeIntegralInRange(3, 12);
  const bool closed = data.ConsumeBool(), one_tip = data.ConsumeBool();
  const double height = number(data), turn_uv = data.ConsumeIntegralInRange(1, 12) / 12.0;
  const int tip = draft.add_position({0, 0, height}), first = tip + 1;
  const auto ring_uv = [&](int k) {
    const double turn = turn_uv * 2 * 3.14159265358979 * k / count;
    return Vec2(std::cos(turn), std::sin(turn));
  };
  for (int k = 0; k <= count; ++k) {
    const double turn = 2 * 3.14159265358979 * (closed && k == count ? 0 : k) / (closed ? count : count + 1.0);
    draft.add_position({std::cos(turn), std::sin(turn), 0});
  }
  for (int k = 0; k < count; ++k) {
    const int own_tip = one_tip ? tip : draft.add_position(Vec3(draft.positions[tip]));
    const Vec2 tip_uv = one_tip ? Vec2(0, 0) : Vec2(0.1 * ring_uv(k));
    draft.add_face({own_tip, first + k, first + k + 1}, {tip_uv, ring_uv(k), ring_uv(k + 1)});
  }
}

/// Six quads that close a cube, each a chart, some joined to the one before.
void add_cube(FuzzedDataProvider& data, Draft& draft) {
  const int v = static_cast<int>(draft.positions.size());
  for (int k = 0; k < 8; ++k) draft.add_position({k & 1 ? 1.0 : 0, k & 2 ? 1.0 : 0, k & 4 ? 1.0 : 0});
  const std::array<std::array<int, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  double at = 0;
  for (const auto& side : sides) {
    at += data.ConsumeBool() ? 1 : 1.25;
    draft.add_face({v + side[0], v + side[1], v + side[2], v + side[3]},
                   {Vec2(at, 0), Vec2(at + 1, 0), Vec2(at + 1, 1), Vec2(at, 1)});
  }
}

void add_soup(FuzzedDataProvider& data, Draft& draft) {
  const int count = data.ConsumeIntegralInRange(1, 4);
  for (int k = 0; k < count; ++k) {
    Face face;
    std::vector<Vec2> uvs;
    for (int corner = 0; corner < 3; ++corner) {
      face.push_back(draft.add_position({number(data), number(data), number(data)}));
      uvs.push_back({number(data), number(data)});
    }
    draft.add_face(face, uvs);
  }
}

int any_below(FuzzedDataProvider& data, std::size_t count) { return data.ConsumeIntegralInRange(0, static_cast<int>(count) - 1); }

void damage_corner(FuzzedDataProvider& data, Draft& draft) {
  const int face = any_below(data, draft.faces.size()), corner = any_below(data, draft.faces[face].size());
  Vec2& uv = draft.uvs[face][corner];
  switch (data.ConsumeIntegralInRange(0, 3)) {
    case 0:
      uv[data.ConsumeIntegralInRange(0, 1)] = number(data);
      return;
    case 1:
      uv += 0.05 * Vec2(number(data), number(data));
      return;
    case 2: {
      const int other = any_below(data, draft.faces.size());
      uv = Vec2(draft.uvs[other][any_below(data, draft.faces[other].size())]);
      return;
    }
    default:
      draft.faces[face][corner] = any_below(data, draft.positions.size());
  }
}

void damage_position(FuzzedDataProvider& data, Draft& draft) {
  Vec3& p = draft.positions[any_below(data, draft.positions.size())];
  if (data.ConsumeBool())
    p[data.ConsumeIntegralInRange(0, 2)] = number(data);
  else
    p = Vec3(draft.positions[any_below(data, draft.positions.size())]);
}

void damage_face(FuzzedDataProvider& data, Draft& draft) {
  const int face = any_below(data, draft.faces.size());
  switch (data.ConsumeIntegralInRange(0, 4)) {
    case 0:
      std::reverse(draft.faces[face].begin(), draft.faces[face].end());
      std::reverse(draft.uvs[face].begin(), draft.uvs[face].end());
      return;
    case 1:
      std::reverse(draft.uvs[face].begin(), draft.uvs[face].end());
      return;
    case 2:
      draft.add_face(Face(draft.faces[face]), std::vector<Vec2>(draft.uvs[face]));
      return;
    case 3: {
      const Vec2 by(number(data), number(data));
      for (Vec2& uv : draft.uvs[face]) uv += by;
      return;
    }
    default:
      if (draft.faces.size() == 1) return;
      draft.faces.erase(draft.faces.begin() + face);
      draft.uvs.erase(draft.uvs.begin() + face);
  }
}

void damage_axis(FuzzedDataProvider& data, Draft& draft) {
  const double factor = number(data);
  const int axis = data.ConsumeIntegralInRange(0, 4);
  if (axis < 3) {
    for (Vec3& p : draft.positions) p[axis] *= factor;
    return;
  }
  for (auto& face : draft.uvs) {
    for (Vec2& uv : face) uv[axis - 3] *= factor;
  }
}

void damage(FuzzedDataProvider& data, Draft& draft) {
  switch (data.ConsumeIntegralInRange(0, 3)) {
    case 0:
      return damage_corner(data, draft);
    case 1:
      return damage_position(data, draft);
    case 2:
      return damage_face(data, draft);
    default:
      return damage_axis(data, draft);
  }
}

Atlas atlas_of(const Draft& draft) {
  Atlas atlas;
  atlas.positions = draft.positions;
  atlas.face_offsets = {0};
  for (std::size_t f = 0; f < draft.faces.size(); ++f) {
    atlas.corner_vertices.insert(atlas.corner_vertices.end(), draft.faces[f].begin(), draft.faces[f].end());
    atlas.corner_uvs.insert(atlas.corner_uvs.end(), draft.uvs[f].begin(), draft.uvs[f].end());
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return atlas;
}

}  // namespace

Atlas fuzzed_mesh(FuzzedDataProvider& data) {
  constexpr std::size_t kMostFaces = 40;
  constexpr std::array kParts{add_grid, add_polygon, add_cone, add_cube, add_soup};
  Draft draft;
  const int parts = data.ConsumeIntegralInRange(1, 3);
  for (int k = 0; k < parts; ++k) data.PickValueInArray(kParts)(data, draft);
  const int damages = data.ConsumeIntegralInRange(0, 6);
  for (int k = 0; k < damages; ++k) damage(data, draft);
  draft.faces.resize(std::min(draft.faces.size(), kMostFaces));
  draft.uvs.resize(draft.faces.size());
  return atlas_of(draft);
}

}  // namespace atlas_refine::fuzz
