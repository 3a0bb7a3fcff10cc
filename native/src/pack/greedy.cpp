// Bottom-left placement of charts in a strip.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "pack/layout.h"
#include "pack/occupancy.h"

namespace atlas_refine {
namespace {

/// For rasters of about one size where the last few of them went: the next is searched from the lowest of these places on. One
/// that fits badly does not keep the others out of the holes below it.
class RecentPlaces {
 public:
  int lowest(const Raster& raster) {
    const Rows& rows = rows_[size_of(raster)];
    return *std::min_element(rows.begin(), rows.end());
  }

  void note(const Raster& raster, int row) {
    Rows& rows = rows_[size_of(raster)];
    std::shift_left(rows.begin(), rows.end(), 1);
    rows.back() = row;
  }

 private:
  using Rows = std::array<int, 8>;  // places: more find little more, and take longer

  static int step(int cells) { return static_cast<int>(std::lround(4 * std::log2(cells))); }  // so many to twice the size
  static std::pair<int, int> size_of(const Raster& raster) { return {step(raster.width), step(raster.height)}; }

  std::map<std::pair<int, int>, Rows> rows_;
};

}  // namespace

GridLayout place_greedily(const std::vector<GridChart>& charts, const GreedyRule& rule, Watch& watch) {
  GridLayout layout;
  layout.turns.assign(charts.size(), 0);
  layout.places.assign(charts.size(), {});
  Occupancy strip(rule.strip_width, rule.many);
  Rng rng = rule.rng;
  RecentPlaces recent;
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
      const int lowest = rule.resume ? recent.lowest(rasters[turn]) : 0;
      const int highest = static_cast<int>(std::floor(room));
      const bool found = strip.find_lowest(rasters[turn], highest, place, lowest);
      recent.note(rasters[turn], found ? place.y : std::max(lowest, std::min(highest, strip.height())));
      if (!found) continue;
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
    if (box_area(layout.width, strip.height(), rule.aspect) > rule.most_area) break;
  }
  layout.height = strip.height();
  layout.work = strip.work();
  return layout;
}

}  // namespace atlas_refine
