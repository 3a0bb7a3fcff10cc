// A layout on the grid: the values that the search for a packing works on.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "measure/distortion.h"
#include "pack/raster.h"
#include "pack/watch.h"
#include "support/rng.h"

namespace atlas_refine {

/// One chart in all the turns that are tried.
struct GridChart {
  std::vector<Raster> rasters;
};

/// Where each chart lies: which of its rasters, and the cell of its min corner.
struct GridLayout {
  std::vector<int> turns;
  std::vector<Cell> places;
  int width = 0;  ///< cells that are used
  int height = 0;
  std::int64_t work = 0;  ///< words looked at to find it
};

/// Area of the box that charts of this extent need, of the asked aspect where
/// it is not 0.
inline double box_area(double width, double height, double aspect) {
  return box_of_aspect({Vec2::Zero(), Vec2(width, height)}, aspect).area();
}

/// How the greedy placement goes about it.
struct GreedyRule {
  std::vector<int> order;       ///< charts in the order they are placed
  int strip_width = 0;          ///< cells; no chart may be wider in all its turns
  double height_weight = 1;     ///< a chart goes where y + height_weight * (its height) is smallest
  bool many = false;            ///< hundreds of charts: an index of free squares pays
  bool resume = false;          ///< a chart is searched a place from where some of its size went last: near-linear in charts
  double most_area = INFINITY;  ///< of the box, in cells: once it is larger the layout is of no use, and left unfinished
  double aspect = 0;            ///< of that box
  double turn_noise = 0;        ///< the weight grows by up to this, drawn anew for every turn of every chart
  Rng rng{0};
};

/// Places charts one after another, each in the turn and at the place that the
/// rule likes best.
GridLayout place_greedily(const std::vector<GridChart>& charts, const GreedyRule& rule, Watch& watch);

}  // namespace atlas_refine
