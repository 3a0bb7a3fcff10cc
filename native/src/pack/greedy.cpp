// Bottom-left placement of charts in a strip.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "pack/layout.h"
#include "pack/occupancy.h"

namespace atlas_refine {
namespace {

/// Rows below which rasters of about one size no longer find a place: so many steps to twice the size.
class FullRows {
 public:
  int& of(const Raster& raster) { return rows_[{step(raster.width), step(raster.height)}]; }

 private:
  static int step(int cells) { return static_cast<int>(std::lround(4 * std::log2(cells))); }

  std::map<std::pair<int, int>, int> rows_;
};

}  // namespace

GridLayout place_greedily(const std::vector<GridChart>& charts, const GreedyRule& rule, Watch& watch) {
  GridLayout layout;
  layout.turns.assign(charts.size(), 0);
  layout.places.assign(charts.size(), {});
  Occupancy strip(rule.strip_width);
  Rng rng = rule.rng;
  FullRows full;
  int placed = 0;
  for (const int chart : rule.order) {
    watch.poll(static_cast<double>(placed++) / charts.size());
    double best_cost = INFINITY;
    int best_x = 0;
    const auto& rasters = charts[chart].rasters;
    for (int turn = 0; turn < static_cast<int>(rasters.size()); ++turn) {
      const double extra = (rule.height_weight + rule.turn_noise * rng.uniform()) * rasters[turn].height;
      const double room = std::min(best_cost - extra, static_cast<double>(std::numeric_limits<int>::max()));
      if (room < 0) continue;
      Cell place;
      int nothing_below = 0;
      int& lowest = rule.resume ? full.of(rasters[turn]) : nothing_below;
      const int highest = static_cast<int>(std::floor(room));
      if (!strip.find_lowest(rasters[turn], highest, place, lowest)) {
        lowest = std::max(lowest, std::min(highest, strip.height()));
        continue;
      }
      lowest = place.y;
      const double cost = place.y + extra;
      if (cost > best_cost || (cost == best_cost && place.x >= best_x)) continue;
      best_cost = cost;
      best_x = place.x;
      layout.turns[chart] = turn;
      layout.places[chart] = place;
    }
    const Raster& raster = rasters[layout.turns[chart]];
    strip.add(raster, layout.places[chart]);
    layout.width = std::max(layout.width, layout.places[chart].x + raster.width);
  }
  layout.height = strip.height();
  layout.work = strip.work();
  return layout;
}

}  // namespace atlas_refine
