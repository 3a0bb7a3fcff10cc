// The search for a packing: cheap starts first, and on to the next means only
// while the target is not reached.
#include "pack/grid_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/box_tree.h"
#include "pack/budget.h"
#include "pack/compaction.h"
#include "pack/separation.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

/// Beyond this many charts a still finer grid brings what compaction does, in less time; a second start brings nothing more, and
/// looking for each chart's place from the bottom on takes too long.
constexpr int kTooManyToCompact = 500;
constexpr int kFinalists = 4;
/// Work of making the box of one of them smaller, about 0.15 s, and that of a fair search's only one: of so much a chart.
constexpr std::int64_t kShrinkingWork = 20'000'000, kFairWork = 10'000'000, kFairWorkOfChart = 500'000;
/// Of the greedy starts, where all boxes so far are so many times too large: charts will be bent, from any packing about as well.
constexpr double kPartOfStarts = 0.25, kOutOfReach = 1.3;
constexpr int kBatch = 32, kRoughBatch = 8;  // greedy starts between two looks at the target
constexpr int kFew = 3;                      // charts: greedy placements are as good as any
constexpr int kRoughStarts = 33;             // of rough and fair searches, with that one which tells what they cost
/// Work of all greedy starts in words looked at: more than atlases of any number of charts need, half a second of tall strips.
constexpr std::int64_t kGreedyWork = budget(200'000'000);
/// Cells along the side for sixty charts. More charts need a finer grid, or most of it is what rounding adds to each.
constexpr double kCells = 256, kCellsOfMany = 512, kCellsOfTooMany = 768, kRoughCells = 96;
constexpr double kMostCells = 8192;  ///< bounds the memory
/// Cells are so large that no chart is longer than this many sides of the grid: a needle's length is no measure of the area.
constexpr double kLongestChart = 16;

double boundary_length(const Outline& outline) {
  double length = 0;
  for (const auto& loop : outline.loops) {
    for (size_t k = 0; k < loop.size(); ++k) length += (loop[k] - loop[(k + 1) % loop.size()]).norm();
  }
  return length;
}

double length_of(const Outline& outline) {
  Box box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  for (const auto& loop : outline.loops) {
    for (const Vec2& p : loop) box = united(box, {p, p});
  }
  return box.diagonal();
}

/// The charts on a grid whose cell suits their number.
struct Grid {
  double cells_per_side;  ///< of the square that the charts would fill to four
                          ///< fifths
  double cell;
  std::vector<GridChart> charts;
  int widest_aslant = 0;  ///< of the charts that are longer than the box' sides should be
};

/// In all turns that are tried where there are so many charts, those aslant last.
GridChart on_grid(const Outline& outline, int charts, const std::vector<Turn>& aslant, const PackOptions& options, double cell) {
  std::vector<Turn> turns = turns_to_try(outline, charts > kManyCharts ? 1 : 2);
  GridChart out;
  turns.insert(turns.end(), aslant.begin(), aslant.end());
  for (const Turn& turn : turns) out.rasters.push_back(rasterise(outline, turn, 0.5 * options.gap, cell));
  return out;
}

Grid make_grid(const std::vector<Outline>& outlines, double area, const PackOptions& options, Watch& watch) {
  const int n = static_cast<int>(outlines.size());
  double dilated_area = area, longest = 0;
  for (const Outline& outline : outlines) {
    dilated_area += 0.5 * options.gap * boundary_length(outline);
    longest = std::max(longest, length_of(outline) + options.gap);
  }
  // With half the gap around it each chart has the parts of a disk at its corners (see room_for_gap). Few charts take little by
  // them: there they are the least area only, as any other cell would make another packing of every atlas, by chance.
  const double disks = 0.25 * std::numbers::pi * options.gap * options.gap * n;
  dilated_area = n > kManyCharts ? dilated_area + disks : std::max(dilated_area, disks);
  Grid grid;
  const double cells = n > kTooManyToCompact ? kCellsOfTooMany : n > kManyCharts ? kCellsOfMany : kCells;
  const double least = options.search == PackSearch::Thorough ? kCells : kRoughCells;
  grid.cells_per_side = std::clamp(cells * std::sqrt(n / 60.0), least, kMostCells);
  grid.cell = std::max(std::sqrt(dilated_area / 0.8), longest / kLongestChart) / grid.cells_per_side;
  // Rough layouts are no nearer to the truth with turns aslant, and less alike.
  const double aspect = options.search == PackSearch::Rough ? 0 : options.box_aspect;
  const std::vector<std::vector<Turn>> aslant = turns_aslant(outlines, aspect, area / options.target_pe);
  grid.charts.resize(n);
  parallel_ranges(n, resolve_threads(options.threads), 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      watch.poll(static_cast<double>(i) / n);
      grid.charts[i] = on_grid(outlines[i], n, aslant[i], options, grid.cell);
    }
  });
  for (int i = 0; i < n; ++i) {
    const std::vector<Raster>& rasters = grid.charts[i].rasters;
    for (std::size_t k = rasters.size() - aslant[i].size(); k < rasters.size(); ++k)
      grid.widest_aslant = std::max(grid.widest_aslant, rasters[k].width);
  }
  return grid;
}

/// A random rule: charts by size with some noise, a strip between tall and wide, or of many charts one that becomes as high as it
/// should. `rule`: what all starts share, its strip as wide as a square that holds the charts.
GreedyRule random_rule(const Grid& grid, const PackOptions& options, int start, GreedyRule rule) {
  const double aspect = options.box_aspect;
  Rng rng(options.seed, 0, start);
  const int n = static_cast<int>(grid.charts.size());
  const double noise = rng.below(4) == 0 ? 0.0 : 0.4;
  std::vector<double> size(n);
  int widest = 0;
  for (int i = 0; i < n; ++i) {
    const Raster& first = grid.charts[i].rasters[0];
    size[i] = static_cast<double>(first.width) * first.height * std::exp(noise * rng.uniform(-1, 1));
    const bool turns = grid.charts[i].rasters.size() > 1;
    widest = std::max(widest, turns ? std::min(first.width, first.height) : first.width);
  }
  rule.order.resize(n);
  std::iota(rule.order.begin(), rule.order.end(), 0);
  std::sort(rule.order.begin(), rule.order.end(), [&](int a, int b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
  // Many charts fill any box; in a square a gap that is a part of its diagonal is the least.
  const bool near_square = aspect == 0 && n > kManyCharts;
  const bool as_before = start > 0 && n > kManyCharts;
  const double width = aspect > 0    ? (as_before ? rng.uniform(0.98, 1.02) : rng.uniform(0.95, 1.1)) * std::sqrt(aspect)
                       : near_square ? rng.uniform(0.95, 1.1)
                                     : rng.uniform(0.7, 1.4);
  if (start % 2 == 1) widest = std::max(widest, grid.widest_aslant);
  rule.strip_width = std::max(widest, static_cast<int>(rule.strip_width * width));
  rule.height_weight = rng.uniform(0.3, 1.2);
  rule.turn_noise = rng.uniform(0, 0.2);
  rule.many = n > kManyCharts;
  rule.resume = n > kTooManyToCompact;
  rule.rng = rng;
  return rule;
}

std::vector<Placement> placements_of(const Grid& grid, const GridLayout& layout) {
  std::vector<Placement> placements;
  for (size_t i = 0; i < grid.charts.size(); ++i) {
    const Raster& raster = grid.charts[i].rasters[layout.turns[i]];
    const Vec2 corner = Vec2(layout.places[i].x, layout.places[i].y) * grid.cell;
    placements.push_back({raster.turn.cosine, raster.turn.sine, corner - raster.origin});
  }
  return placements;
}

int starts_of(int charts, const PackOptions& options) {
  if (charts > kTooManyToCompact) return 1;
  if (charts > kManyCharts) return std::clamp(2000 / charts, 1, 8);
  return options.search != PackSearch::Thorough ? kRoughStarts : std::clamp(4000 / charts, 64, 400);
}

int batch_of(const PackOptions& options) { return options.search == PackSearch::Thorough ? kBatch : kRoughBatch; }

double least_area_in_cells(const std::vector<GridLayout>& layouts, const PackOptions& options) {
  double least = INFINITY;
  for (const GridLayout& layout : layouts) least = std::min(least, box_area(layout.width, layout.height, options.box_aspect));
  return least;
}

/// Where the first `count` of so many starts are as good as all of them; `enough` in cells.
bool suffice(const std::vector<GridLayout>& layouts, int count, int starts, double enough, const PackOptions& options) {
  const double least = least_area_in_cells(layouts, options);
  const bool out_of_reach = least > kOutOfReach * enough && options.search == PackSearch::Thorough;
  return least <= enough || (out_of_reach && count > kPartOfStarts * starts);
}

/// In cells, of a square that holds the charts: as the first start filled it, where only a few are to follow.
double likely_side(const Grid& grid, const std::vector<GridLayout>& layouts) {
  if (layouts.empty() || grid.charts.size() <= kManyCharts) return grid.cells_per_side;
  return std::sqrt(static_cast<double>(layouts[0].width) * layouts[0].height);
}

/// What the next starts share. Only the best is wanted of rough layouts: what is larger before all charts are placed is not
/// finished.
GreedyRule rule_after(const std::vector<GridLayout>& layouts, const Grid& grid, const PackOptions& options) {
  const double least = least_area_in_cells(layouts, options);
  return {.strip_width = static_cast<int>(likely_side(grid, layouts)),
          .most_area = options.search == PackSearch::Thorough ? INFINITY : least,
          .aspect = options.box_aspect};
}

/// Of so many starts, each of which costs `work`.
int affordable_starts(std::int64_t work, int starts) {
  const std::int64_t affordable = kGreedyWork / std::max<std::int64_t>(1, work);
  return static_cast<int>(std::clamp<std::int64_t>(affordable, std::min(kFinalists, starts), starts));
}

/// Infinite where there are no placements.
double area_of_box(const std::vector<Outline>& outlines, const std::vector<Placement>& placements, double aspect) {
  return placements.empty() ? INFINITY : box_of_aspect(placed_box(outlines, placements), aspect).area();
}

/// The search's state: the layouts so far, and the best placements of those
/// that were compacted.
class Search {
 public:
  Search(const std::vector<Outline>& outlines, double area, const PackOptions& options)
      : outlines_(outlines),
        options_(options),
        threads_(resolve_threads(options.threads)),
        watch_(options.tick),
        enough_(area / options.target_pe) {
    watch_.begin_part(0, 0.05);
    grid_ = make_grid(outlines, area, options, watch_);
  }

  std::vector<Placement> run() {
    const int n = static_cast<int>(outlines_.size());
    start_greedily(starts_of(n, options_));
    if (options_.search == PackSearch::Thorough && least_area_ > enough_ && n <= kTooManyToCompact) compact_best(1, 0.3, 0.4);
    if (options_.search == PackSearch::Thorough && least_area_ > enough_ && n <= kManyCharts) {
      shrink_best(kFinalists, kShrinkingWork);
      if (least_area_ > enough_) compact_best(kFinalists, 0.9, 1);
    }
    if (options_.search == PackSearch::Fair && least_area_ > enough_ && n > kFew && n <= kManyCharts) {
      shrink_best(1, std::min(kFairWork, n * kFairWorkOfChart));
      compact_best(1, 0.9, 1);
    }
    return best_;
  }

 private:
  double area_of(const GridLayout& layout) const {
    return box_area(layout.width * grid_.cell, layout.height * grid_.cell, options_.box_aspect);
  }

  /// Smallest box first; keeps the best placements up to date.
  void rank() {
    std::stable_sort(layouts_.begin(), layouts_.end(),
                     [&](const GridLayout& a, const GridLayout& b) { return area_of(a) < area_of(b); });
    offer(placements_of(grid_, layouts_[0]));
  }

  void offer(std::vector<Placement> placements) {
    const double area = area_of_box(outlines_, placements, options_.box_aspect);
    if (area >= least_area_) return;
    least_area_ = area;
    best_ = std::move(placements);
  }

  void add_greedy(int first, int count, int starts) {
    const GreedyRule shared = rule_after(layouts_, grid_, options_);
    layouts_.resize(first + count);
    parallel_ranges(count, threads_, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        watch_.begin_task(first + k, starts);
        layouts_[first + k] = place_greedily(grid_.charts, random_rule(grid_, options_, first + k, shared), watch_);
      }
    });
  }

  /// The first start tells what the others cost; they end with the batch that reaches the target.
  void start_greedily(int starts) {
    watch_.begin_part(0.05, 0.3);
    add_greedy(0, 1, starts);
    starts = affordable_starts(layouts_[0].work, starts);
    const double enough = enough_ / (grid_.cell * grid_.cell);
    for (int first = 1; first < starts && !suffice(layouts_, first, starts, enough, options_); first += batch_of(options_))
      add_greedy(first, std::min(batch_of(options_), starts - first), starts);
    rank();
  }

  void shrink_best(int count, std::int64_t work) {
    std::vector<GridLayout> shrunk(count);
    watch_.begin_part(0.4, 0.9);
    parallel_ranges(count, threads_, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        watch_.begin_task(k, count);
        const BoxGoal goal{options_.box_aspect, enough_ / (grid_.cell * grid_.cell)};
        shrunk[k] = shrink_box(grid_.charts, layouts_[k], goal, work, options_.seed + k, watch_);
      }
    });
    layouts_.insert(layouts_.end(), shrunk.begin(), shrunk.end());
    rank();
  }

  /// Of the best `count` layouts those that were not compacted yet: a search that gained nothing hands back its start.
  std::vector<GridLayout> not_compacted(int count) {
    std::vector<GridLayout> fresh;
    for (int k = 0; k < count; ++k) {
      const GridLayout& layout = layouts_[k];
      const auto same = [&](const GridLayout& other) { return other.turns == layout.turns && other.places == layout.places; };
      if (std::any_of(compacted_.begin(), compacted_.end(), same)) continue;
      compacted_.push_back(layout);
      fresh.push_back(layout);
    }
    return fresh;
  }

  void compact_best(int count, double from, double to) {
    const std::vector<GridLayout> fresh = not_compacted(count);
    std::vector<std::vector<Placement>> compacted(fresh.size());
    watch_.begin_part(from, to);
    parallel_ranges(static_cast<int>(fresh.size()), threads_, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        watch_.begin_task(k, static_cast<int>(fresh.size()));
        const CompactionOptions options{options_.gap, options_.box_aspect, 2 * grid_.cell, [&] { watch_.poll(0); }};
        compacted[k] = compact(outlines_, placements_of(grid_, fresh[k]), options);
      }
    });
    for (auto& placements : compacted) offer(std::move(placements));
  }

  const std::vector<Outline>& outlines_;
  const PackOptions& options_;
  int threads_;
  Watch watch_;
  double enough_;  ///< box area at which the target is reached
  Grid grid_;
  std::vector<GridLayout> layouts_;    ///< smallest box first
  std::vector<GridLayout> compacted_;  ///< those that need not be compacted again
  std::vector<Placement> best_;
  double least_area_ = INFINITY;
};

}  // namespace

std::vector<Placement> search_on_grid(const std::vector<Outline>& outlines, double area, const PackOptions& options) {
  return Search(outlines, area, options).run();
}

}  // namespace atlas_refine
