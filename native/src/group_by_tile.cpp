// UDIM tiles as groups.
#include <cmath>
#include <map>
#include <optional>

#include "atlas_refine/tiles.h"
#include "input/check_atlas.h"
#include "input/split_charts.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

using Tile = std::pair<double, double>;  // row, column

std::string name_of(const Tile& tile) {
  const auto [row, column] = tile;
  const bool numbered = column >= 0 && column < 10 && row >= 0 && row < 900;
  const auto whole = [](double value) { return std::to_string(static_cast<long long>(value)); };
  return numbered ? whole(1001 + column + 10 * row) : "tile (" + whole(column) + ", " + whole(row) + ")";
}

/// The tile that all faces lie in. Its upper sides are the next tile's, but only a face that lies on one altogether could have
/// the middle of its chart there; without such faces charts need not be known.
std::optional<Tile> only_tile(const Atlas& atlas) {
  if (atlas.face_count() == 0) return std::nullopt;
  const Box box = box_of_points(atlas.corner_uvs);
  const Tile tile = {std::floor(box.min.y()), std::floor(box.min.x())};
  const Vec2 end(tile.second + 1, tile.first + 1);
  if ((box.max.array() > end.array()).any()) return std::nullopt;
  for (int f = 0; f < atlas.face_count(); ++f) {
    Vec2 least = end;
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) least = least.cwiseMin(atlas.corner_uvs[c]);
    if ((least.array() >= end.array()).any()) return std::nullopt;
  }
  return tile;
}

}  // namespace

TileGroups group_by_tile(const Atlas& atlas) {
  check_arrays(atlas);
  const Atlas usable = is_usable(atlas) ? atlas : set_unusable_aside(atlas).atlas;
  if (const auto tile = only_tile(usable)) {
    return {.groups = std::vector<int>(atlas.face_count(), 0),
            .origins = {Vec2(tile->second, tile->first)},
            .names = {name_of(*tile)}};
  }
  const ChartSet set = split_charts(usable);
  std::vector<Tile> tiles;
  std::map<Tile, int> numbers;
  for (const Chart& chart : charts_as_placed(set)) {
    const Box box = box_of_points(chart.uvs);
    const Vec2 centre = 0.5 * (box.min + box.max);
    tiles.push_back({std::floor(centre.y()), std::floor(centre.x())});
    numbers[tiles.back()] = 0;
  }
  TileGroups out{.groups = std::vector<int>(atlas.face_count(), 0), .origins = {}, .names = {}};
  for (auto& [tile, number] : numbers) {
    number = static_cast<int>(out.origins.size());
    out.origins.emplace_back(tile.second, tile.first);
    out.names.push_back(name_of(tile));
  }
  for (int f = 0; f < atlas.face_count(); ++f) out.groups[f] = numbers[tiles[set.corners[atlas.face_offsets[f]].chart]];
  return out;
}

}  // namespace atlas_refine
