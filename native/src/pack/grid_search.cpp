// The search for a packing on the grid.
#include "pack/grid_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pack/separation.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

/// Width of the box that a layout needs, in cells, and its area.
struct BoxRule {
  double aspect;

  double area(double width, double height) const {
    if (aspect <= 0) return width * height;
    const double wide = std::max(width, aspect * height);
    return wide * wide / aspect;
  }
};

std::vector<GridChart> rasterise_all(const std::vector<Outline>& outlines, double radius, double cell, int boxes, int threads) {
  std::vector<GridChart> charts(outlines.size());
  parallel_ranges(static_cast<int>(outlines.size()), threads, 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      for (Turn turn : small_box_turns(convex_hull(outlines[i]), boxes)) {
        for (int quarter = 0; quarter < 4; ++quarter, turn = turn.quarter_turned()) {
          charts[i].rasters.push_back(rasterise(outlines[i], turn, radius, cell));
        }
      }
    }
  });
  return charts;
}

/// A random rule: charts by size with some noise, a strip between tall and wide.
GreedyRule random_rule(const std::vector<GridChart>& charts, double cells_per_side, double aspect, Rng rng) {
  const int n = static_cast<int>(charts.size());
  GreedyRule rule;
  const double noise = rng.below(4) == 0 ? 0.0 : 0.4;
  std::vector<double> size(n);
  int widest = 0;
  for (int i = 0; i < n; ++i) {
    const Raster& first = charts[i].rasters[0];
    size[i] = static_cast<double>(first.width) * first.height * std::exp(noise * rng.uniform(-1, 1));
    widest = std::max(widest, std::min(first.width, first.height));
  }
  rule.order.resize(n);
  std::iota(rule.order.begin(), rule.order.end(), 0);
  std::sort(rule.order.begin(), rule.order.end(), [&](int a, int b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
  const double width = aspect > 0 ? rng.uniform(0.95, 1.1) * std::sqrt(aspect) : rng.uniform(0.7, 1.4);
  rule.strip_width = std::max(widest, static_cast<int>(cells_per_side * width));
  rule.height_weight = rng.uniform(0.3, 1.2);
  return rule;
}

void measure_box(const std::vector<GridChart>& charts, Layout& layout) {
  layout.width = layout.height = 0;
  for (size_t i = 0; i < charts.size(); ++i) {
    const Raster& raster = charts[i].rasters[layout.turns[i]];
    layout.width = std::max(layout.width, layout.places[i].x + raster.width);
    layout.height = std::max(layout.height, layout.places[i].y + raster.height);
  }
}

/// Shrinks the layout's box again and again, by less after every few failures, until the work is used up.
Layout shrink_box(const std::vector<GridChart>& charts, Layout best, const BoxRule& box, std::uint64_t seed, double budget) {
  const int n = static_cast<int>(charts.size());
  Separation separation(charts, Rng(seed, 1));
  separation.budget = static_cast<std::int64_t>(budget);
  double shrink = 0.01;
  int fails = 0;
  const int refails = 3;
  for (int round = 0; separation.work() < separation.budget; ++round) {
    Layout trial = best;
    int w = best.width, h = best.height;
    Rng rng(seed, 2, round);
    if (box.aspect > 0) {
      const double wide = std::max<double>(w, h * box.aspect) * (1 - shrink / 2);
      w = static_cast<int>(std::ceil(wide)) - 1;
      h = static_cast<int>(std::ceil(wide / box.aspect)) - 1;
    } else {
      int& side = rng.below(2) ? w : h;
      side -= std::max<int>(1, std::lround(shrink * side));
    }
    if (fails) {
      for (int q = 0; q < 1 + rng.below(2); ++q) std::swap(trial.places[rng.below(n)], trial.places[rng.below(n)]);
    }
    if (separation.run(trial, w, h)) {
      measure_box(charts, trial);
      best = trial;
      fails = 0;
    } else if (++fails > refails) {
      shrink = std::max(0.001, shrink / 2);
      fails = 1;
    }
  }
  return best;
}

}  // namespace

std::vector<Placement> search_on_grid(const std::vector<Outline>& outlines, double area, double dilated_area,
                                      const PackOptions& options) {
  const int n = static_cast<int>(outlines.size());
  const double cells_per_side = 256;
  const double cell = std::sqrt(dilated_area / 0.8) / cells_per_side;
  const int threads = resolve_threads(options.threads);
  const auto charts = rasterise_all(outlines, 0.5 * options.gap, cell, 2, threads);
  const BoxRule box{options.box_aspect};
  const int starts = n > 400 ? 4 : 32;
  std::vector<Layout> layouts(starts);
  parallel_ranges(starts, threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      layouts[k] = place_greedily(charts, random_rule(charts, cells_per_side, options.box_aspect, Rng(options.seed, 0, k)));
      if (begin == 0 && options.tick) options.tick(0.3 * (k + 1) / end);
    }
  });
  const auto smaller = [&](const Layout& a, const Layout& b) {
    return box.area(a.width, a.height) < box.area(b.width, b.height);
  };
  Layout best = *std::min_element(layouts.begin(), layouts.end(), smaller);
  const auto reached = [&] { return area >= options.target_pe * box.area(best.width * cell, best.height * cell); };
  if (!reached() && n <= 200) {
    const int tasks = 4;
    std::stable_sort(layouts.begin(), layouts.end(), smaller);
    std::vector<Layout> shrunk(tasks);
    const int spread = 1;
    parallel_ranges(tasks, threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        shrunk[k] = shrink_box(charts, layouts[k * spread], box, options.seed + k, 20e6);
        if (begin == 0 && options.tick) options.tick(0.3 + 0.7 * (k + 1) / end);
      }
    });
    best = *std::min_element(shrunk.begin(), shrunk.end(), smaller);
  }
  std::vector<Placement> placements;
  for (int i = 0; i < n; ++i) {
    const Raster& raster = charts[i].rasters[best.turns[i]];
    placements.push_back({raster.turn.cosine, raster.turn.sine, Vec2(best.places[i].x, best.places[i].y) * cell - raster.origin});
  }
  return placements;
}

}  // namespace atlas_refine
