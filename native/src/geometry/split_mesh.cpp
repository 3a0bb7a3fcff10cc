// Dividing and cutting triangles.
#include "geometry/split_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

Support original(int vertex) { return {{vertex, -1, -1}, {1, 0, 0}}; }

/// The vertices of a face by those of its chart; empty where it is not whole. `whole` lists faces and their undivided parts.
std::map<int, int> vertices_of_whole_face(const Chart& source, int face, const std::vector<Triangle>& parts,
                                          const std::vector<std::pair<int, int>>& whole, const std::vector<Support>& supports) {
  // The triangles of a chart of the input are ordered by their faces.
  const auto own = std::equal_range(source.triangle_faces.begin(), source.triangle_faces.end(), face);
  std::map<int, int> vertices;
  std::ptrdiff_t count = 0;
  for (auto part = std::lower_bound(whole.begin(), whole.end(), std::pair(face, -1)); part != whole.end() && part->first == face;
       ++part, ++count) {
    for (int v : parts[part->second]) {
      const auto [known, added] = vertices.emplace(supports[v].vertices[0], v);
      if (known->second != v) return {};  // cut along an edge inside the face
    }
  }
  return count == own.second - own.first ? vertices : std::map<int, int>();
}

}  // namespace

Vec2 value_at(const Support& support, const std::vector<Vec2>& values) {
  Vec2 value = Vec2::Zero();
  for (int k = 0; k < 3; ++k) {
    if (support.vertices[k] >= 0) value += support.weights[k] * values[support.vertices[k]];
  }
  return value;
}

Vec3 weights_on(const Support& support, const Triangle& triangle) {
  Vec3 weights = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (support.vertices[k] < 0) continue;
    const auto at = std::find(triangle.begin(), triangle.end(), support.vertices[k]);
    assert(at != triangle.end());
    weights[at - triangle.begin()] += support.weights[k];
  }
  return weights;
}

Support between(const Support& a, const Support& b, double along) {
  std::map<int, double> sum;
  for (int k = 0; k < 3; ++k) {
    if (a.vertices[k] >= 0) sum[a.vertices[k]] += (1 - along) * a.weights[k];
    if (b.vertices[k] >= 0) sum[b.vertices[k]] += along * b.weights[k];
  }
  assert(sum.size() <= 3);
  Support out;
  int k = 0;
  for (const auto& [vertex, weight] : sum) {
    out.vertices[k] = vertex;
    out.weights[k++] = weight;
  }
  return out;
}

RestTriangle rest_of_part(const Chart& source, int triangle, const std::array<Support, 3>& corners) {
  std::array<Vec3, 3> weights;
  for (int k = 0; k < 3; ++k) weights[k] = weights_on(corners[k], source.triangles[triangle]);
  const Vec3 d1 = weights[1] - weights[0], d2 = weights[2] - weights[0];
  Mat2 shares;
  shares << d1[1], d2[1], d1[2], d2[2];
  const Mat2 flat = source.surface[triangle].inverse_edges.inverse();
  return {(flat * shares).inverse(), source.surface[triangle].area * shares.determinant()};
}

std::vector<Guard> guards_of_whole_faces(const Chart& source, const std::vector<Triangle>& parts, const std::vector<int>& sources,
                                         const std::vector<Support>& supports) {
  std::vector<Guard> out;
  if (source.guards.empty()) return out;
  const auto is_whole = [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](int v) { return supports[v].vertices[1] < 0; });
  };
  std::vector<std::pair<int, int>> whole;  // faces and parts
  for (std::size_t t = 0; t < parts.size(); ++t) {
    if (is_whole(parts[t])) whole.emplace_back(source.triangle_faces[sources[t]], static_cast<int>(t));
  }
  std::sort(whole.begin(), whole.end());
  std::map<int, int> vertices;  // of the present face: from the chart's to the parts'
  int face = -1;
  for (const Guard& guard : source.guards) {
    if (guard.face != face) {
      face = guard.face;
      vertices = vertices_of_whole_face(source, face, parts, whole, supports);
    }
    if (vertices.empty()) continue;
    Guard& own = out.emplace_back(guard);
    for (int& v : own.triangle) v = vertices.at(v);
  }
  return out;
}

SplitMesh::SplitMesh(const Chart& chart) : uvs(chart.uvs), triangles(chart.triangles) {
  sources.resize(triangles.size());
  one_triangle_.assign(uvs.size(), -1);
  neighbours.assign(triangles.size(), {-1, -1, -1});
  for (int v = 0; v < vertex_count(); ++v) supports.push_back(original(v));
  // In buckets by the lower ends, which hold few each: sorted as a whole they took most of the time.
  std::vector<int> first(uvs.size() + 1, 0);
  for (int t = 0; t < triangle_count(); ++t) {
    sources[t] = t;
    for (int k = 0; k < 3; ++k) {
      one_triangle_[triangles[t][k]] = t;
      ++first[std::min(triangles[t][k], triangles[t][(k + 1) % 3]) + 1];
    }
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  struct Edge {
    int high, triangle, side;
  };
  std::vector<Edge> edges(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int t = 0; t < triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      edges[next[low]++] = {high, t, k};
    }
  }
  for (int v = 0; v < vertex_count(); ++v) {
    const auto begin = edges.begin() + first[v], end = edges.begin() + first[v + 1];
    std::sort(begin, end,
              [](const Edge& a, const Edge& b) { return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle); });
    for (auto e = begin; e < end && e + 1 < end; ++e) {
      const Edge &a = e[0], &b = e[1];
      if (a.high != b.high) continue;
      neighbours[a.triangle][a.side] = b.triangle;
      neighbours[b.triangle][b.side] = a.triangle;
      ++e;
    }
  }
}

Side SplitMesh::twin(const Side& s) const {
  const int other = neighbours[s.triangle][s.side];
  if (other < 0) return {};
  const int start = to(s);
  for (int k = 0; k < 3; ++k) {
    if (triangles[other][k] == start && neighbours[other][k] == s.triangle) return {other, k};
  }
  return {};
}

std::vector<Side> SplitMesh::fan(int vertex) const {
  const int first = one_triangle_[vertex];
  int k = 0;
  while (triangles[first][k] != vertex) ++k;
  Side walk{first, k};
  // Clockwise: over the side that starts at the vertex.
  while (!is_boundary(walk)) {
    const Side across = twin(walk);
    walk = {across.triangle, (across.side + 1) % 3};
    if (walk.triangle == first) break;
  }
  std::vector<Side> out = {walk};
  // Counterclockwise: over the side that ends at the vertex.
  while (true) {
    const Side ending{out.back().triangle, (out.back().side + 2) % 3};
    const Side across = twin(ending);
    if (across.triangle < 0 || across.triangle == out.front().triangle) return out;
    out.push_back(across);
  }
}

Side SplitMesh::find_side(int from, int to) const {
  for (const Side& s : fan(from)) {
    if (this->to(s) == to) return s;
  }
  return {};
}

void SplitMesh::set_neighbour(int triangle, int old_neighbour, int neighbour) {
  if (triangle < 0) return;
  for (int& n : neighbours[triangle]) {
    if (n != old_neighbour) continue;
    n = neighbour;
    return;
  }
}

/// Divides the triangle (a, b, c), side ab, into (a, vertex, c), which keeps its index, and (vertex, b, c); returns the latter.
int SplitMesh::divide(const Side& side, int vertex) {
  const int t = side.triangle, k = side.side;
  const int b = to(side), c = opposite(side);
  const int across_bc = neighbours[t][(k + 1) % 3], across_ab = neighbours[t][k];
  const int added = triangle_count();
  triangles[t][(k + 1) % 3] = vertex;
  neighbours[t][(k + 1) % 3] = added;
  triangles.push_back({vertex, b, c});
  neighbours.push_back({across_ab, across_bc, t});
  sources.push_back(sources[t]);
  set_neighbour(across_bc, t, added);
  if (one_triangle_[b] == t) one_triangle_[b] = added;
  return added;
}

int SplitMesh::split(const Side& side, double along, const Vec2& uv) {
  const Side other = twin(side);
  const int vertex = vertex_count();
  supports.push_back(between(supports[from(side)], supports[to(side)], along));
  uvs.push_back(uv);
  one_triangle_.push_back(side.triangle);
  // side: a -> b is kept as a -> vertex; the other triangle's b -> a is kept as b -> vertex.
  const int added = divide(side, vertex);
  if (other.triangle < 0) return vertex;
  const int other_added = divide(other, vertex);
  neighbours[side.triangle][side.side] = other_added;
  neighbours[other.triangle][other.side] = added;
  return vertex;
}

std::vector<int> SplitMesh::cut(const std::vector<Side>& sides) {
  std::vector<int> touched;
  for (const Side& s : sides) {
    const Side other = twin(s);
    touched.push_back(from(s));
    touched.push_back(to(s));
    if (other.triangle < 0) continue;
    neighbours[s.triangle][s.side] = -1;
    neighbours[other.triangle][other.side] = -1;
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  std::vector<std::vector<int>> around(vertex_count());
  std::vector<char> is_touched(vertex_count(), 0);
  std::vector<int> originals;
  for (int v : touched) is_touched[v] = 1;
  for (int t = 0; t < triangle_count(); ++t) {
    for (int v : triangles[t]) {
      if (is_touched[v]) around[v].push_back(t);
    }
  }
  for (int v : touched) {
    bool first = true;
    std::vector<int> left = around[v];
    while (!left.empty()) {
      one_triangle_[v] = left.front();
      const std::vector<Side> group = fan(v);
      for (const Side& s : group) std::erase(left, s.triangle);
      if (first) {
        first = false;
        continue;
      }
      for (const Side& s : group) triangles[s.triangle][s.side] = vertex_count();
      one_triangle_.push_back(group.front().triangle);
      uvs.push_back(Vec2(uvs[v]));
      supports.push_back(Support(supports[v]));
      originals.push_back(v);
    }
    for (int t : around[v]) {
      if (std::find(triangles[t].begin(), triangles[t].end(), v) != triangles[t].end()) one_triangle_[v] = t;
    }
  }
  return originals;
}

std::vector<std::vector<Side>> SplitMesh::boundary_loops() const {
  std::vector<std::vector<Side>> loops;
  std::vector<std::array<char, 3>> seen(triangles.size(), {0, 0, 0});
  for (int t = 0; t < triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (neighbours[t][k] >= 0 || seen[t][k]) continue;
      auto& loop = loops.emplace_back();
      Side walk{t, k};
      do {
        seen[walk.triangle][walk.side] = 1;
        loop.push_back(walk);
        walk = fan(to(walk)).front();
      } while (!seen[walk.triangle][walk.side]);
    }
  }
  return loops;
}

std::vector<std::vector<int>> SplitMesh::vertex_loops() const {
  std::vector<std::pair<double, std::vector<int>>> loops;
  for (const auto& sides : boundary_loops()) {
    auto& [length, loop] = loops.emplace_back(0, std::vector<int>());
    for (const Side& s : sides) {
      length -= (uvs[to(s)] - uvs[from(s)]).norm();
      loop.push_back(from(s));
    }
  }
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::vector<int>> out;
  for (auto& [length, loop] : loops) out.push_back(std::move(loop));
  return out;
}

Chart SplitMesh::to_chart(const Chart& source) const {
  Chart out;
  out.uvs = uvs;
  out.triangles = triangles;
  out.boundary_loops = vertex_loops();
  std::vector<RestTriangle> parts;
  for (int t = 0; t < triangle_count(); ++t) {
    const int s = sources[t];
    out.triangle_faces.push_back(source.triangle_faces[s]);
    parts.push_back(rest_of_part(source, s, {supports[triangles[t][0]], supports[triangles[t][1]], supports[triangles[t][2]]}));
  }
  out.surface = Surface(std::move(parts));
  out.number = source.number;
  out.guards = guards_of_whole_faces(source, triangles, sources, supports);
  return out;
}

double side_of_square(const SplitMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * doubled_area(mesh.uvs[t[0]], mesh.uvs[t[1]], mesh.uvs[t[2]]);
  return std::sqrt(std::max(0.0, area));
}

}  // namespace atlas_refine
