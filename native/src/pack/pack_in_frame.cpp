// Bottom-left placement over a bitmap of the obstacles; the scale by trial and bisection.
#include "pack/pack_in_frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pack/canonical_outlines.h"
#include "pack/layout.h"
#include "pack/occupancy.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kRules = 24;            // orders in which the charts are placed, tried at each scale
constexpr double kShrink = 0.93;      // from one scale to the next
constexpr int kBisections = 3;        // between the last that failed and the first that did not
constexpr double kLeastShare = 1e-4;  // of the frame's area, that charts cover at the least scale

/// The frame in cells: charts dilated by half the gap may lie in all of them.
Window make_window(const FrameOptions& options, std::size_t charts) {
  Window frame;
  frame.cell = options.frame.maxCoeff() / std::clamp(256 * std::sqrt(static_cast<double>(charts) / 15), 512.0, 1536.0);
  frame.corner = Vec2::Constant(options.margin - 0.5 * options.gap);
  const Vec2 cells = (options.frame - 2 * frame.corner) / frame.cell;
  frame.width = static_cast<int>(std::floor(cells.x()));
  frame.height = static_cast<int>(std::floor(cells.y()));
  return frame;
}

Occupancy taken_by(const Window& frame, const std::vector<Outline>& obstacles, double gap) {
  Occupancy taken(frame.width);
  for (const Outline& obstacle : obstacles) {
    const Raster raster = rasterise_in(frame, obstacle, 0.5 * gap);
    if (!raster.runs.empty()) taken.add(raster, {0, 0});
  }
  return taken;
}

std::vector<Outline> scaled(std::vector<Outline> outlines, double scale) {
  for (Outline& outline : outlines) {
    for (auto& loop : outline.loops) {
      for (Vec2& p : loop) p *= scale;
    }
  }
  return outlines;
}

class FrameSearch {
 public:
  FrameSearch(const std::vector<Outline>& outlines, const std::vector<Outline>& obstacles, const FrameOptions& options)
      : outlines_(outlines),
        options_(options),
        watch_(options.tick),
        frame_(make_window(options, outlines.size())),
        taken_(taken_by(frame_, obstacles, options.gap)) {}

  /// Placements at this scale, empty where none was found.
  std::vector<Placement> fit(double scale, double progress) {
    watch_.begin_part(progress, progress);
    const std::vector<GridChart> charts = rasters_at(scale);
    if (std::any_of(charts.begin(), charts.end(), [](const GridChart& chart) { return chart.rasters.empty(); })) return {};
    std::vector<GridLayout> layouts(kRules);
    parallel_ranges(kRules, options_.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) layouts[k] = place(charts, k);
    });
    const auto first =
        std::find_if(layouts.begin(), layouts.end(), [](const GridLayout& layout) { return !layout.turns.empty(); });
    return first == layouts.end() ? std::vector<Placement>() : placements_of(charts, *first, scale);
  }

 private:
  /// Of each chart those turns in which it is no larger than the frame.
  std::vector<GridChart> rasters_at(double scale) {
    const std::vector<Outline> outlines = scaled(outlines_, scale);
    const int n = static_cast<int>(outlines.size());
    std::vector<GridChart> charts(n);
    parallel_ranges(n, options_.threads, 16, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        watch_.poll(0);
        const std::vector<Vec2> hull = convex_hull(outlines[i]);
        for (const Turn& turn : turns_to_try(outlines[i], n > kManyCharts ? 1 : 2)) {
          // A needle that is far longer than the frame would fill the memory.
          const Vec2 cells = turned_box(hull, turn).size() / frame_.cell;
          if (cells.x() <= frame_.width && cells.y() <= frame_.height)
            charts[i].rasters.push_back(rasterise(outlines[i], turn, 0.5 * options_.gap, frame_.cell));
        }
      }
    });
    return charts;
  }

  /// Large charts first, with some noise.
  std::vector<int> order_of(const std::vector<GridChart>& charts, double noise, Rng& rng) const {
    std::vector<double> size;
    for (const GridChart& chart : charts) {
      const Raster& first = chart.rasters[0];
      size.push_back(static_cast<double>(first.width) * first.height * std::exp(noise * rng.uniform(-1, 1)));
    }
    std::vector<int> order(charts.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
    return order;
  }

  /// One layout; without turns where some chart found no place.
  GridLayout place(const std::vector<GridChart>& charts, int number) {
    Rng rng(options_.seed, 0, number);
    const double noise = number == 0 ? 0 : 0.5, height_weight = rng.uniform(0.3, 1.2);
    GridLayout layout;
    layout.turns.assign(charts.size(), 0);
    layout.places.assign(charts.size(), {});
    Occupancy taken = taken_;
    for (const int chart : order_of(charts, noise, rng)) {
      watch_.poll(0);
      if (!place_chart(charts[chart], height_weight, taken, layout.turns[chart], layout.places[chart])) return {};
    }
    return layout;
  }

  bool place_chart(const GridChart& chart, double height_weight, Occupancy& taken, int& turn, Cell& at) const {
    double best_cost = INFINITY;
    for (int k = 0; k < static_cast<int>(chart.rasters.size()); ++k) {
      const Raster& raster = chart.rasters[k];
      const int highest = frame_.height - raster.height;
      Cell place;
      if (highest < 0 || !taken.find_lowest(raster, highest, place)) continue;
      const double cost = place.y + height_weight * raster.height;
      if (cost > best_cost || (cost == best_cost && place.x >= at.x)) continue;
      best_cost = cost;
      turn = k;
      at = place;
    }
    if (best_cost == INFINITY) return false;
    taken.add(chart.rasters[turn], at);
    return true;
  }

  std::vector<Placement> placements_of(const std::vector<GridChart>& charts, const GridLayout& layout, double scale) const {
    std::vector<Placement> placements;
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const Raster& raster = charts[i].rasters[layout.turns[i]];
      const Vec2 corner = frame_.corner + frame_.cell * Vec2(layout.places[i].x, layout.places[i].y);
      placements.push_back({raster.turn.cosine, raster.turn.sine, (corner - raster.origin) / scale});
    }
    return placements;
  }

  const std::vector<Outline>& outlines_;
  const FrameOptions& options_;
  Watch watch_;
  Window frame_;
  Occupancy taken_;
};

double area_of(const std::vector<Outline>& outlines) {
  double twice = 0;
  for (const Outline& outline : outlines) {
    for (const auto& loop : outline.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
        twice += a.x() * b.y() - a.y() * b.x();
      }
    }
  }
  return 0.5 * twice;
}

}  // namespace

std::optional<FramePacking> pack_in_frame(const std::vector<Outline>& outlines, const std::vector<Outline>& obstacles,
                                          const FrameOptions& asked) {
  // A power of two: scales are divided by it without rounding.
  const CanonicalOutlines canonical = canonical_outlines(outlines, std::ldexp(1, std::ilogb(area_of(outlines)) / 2));
  FrameOptions options = asked;
  options.enough *= canonical.unit;
  options.gap += 2 * options.enough * canonical.off_grid;
  options.margin += options.enough * canonical.off_grid;
  FrameSearch search(canonical.outlines, obstacles, options);
  const double least = std::sqrt(kLeastShare * options.frame.prod() / area_of(canonical.outlines));
  double scale = options.enough, too_large = scale;
  std::vector<Placement> found;
  for (found = search.fit(scale, 0); found.empty(); found = search.fit(scale, 1 - scale / options.enough)) {
    too_large = scale;
    scale *= kShrink;
    if (scale < least) return std::nullopt;
  }
  for (int k = 0; k < kBisections && scale < options.enough; ++k) {
    const double middle = std::sqrt(scale * too_large);
    std::vector<Placement> larger = search.fit(middle, 0.9);
    if (larger.empty()) {
      too_large = middle;
    } else {
      scale = middle;
      found = std::move(larger);
    }
  }
  return FramePacking{scale / canonical.unit, canonical.of_input(found)};
}

}  // namespace atlas_refine
