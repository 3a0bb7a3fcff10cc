// Skyline best fit over many strip widths.
#include "layout/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace atlas_refine {
namespace {

constexpr int kStrips = 14;  // strip widths tried, between boxes of these aspects
constexpr double kNarrowest = 0.55, kWidest = 1.8;
constexpr double kLikelyDensity = 0.88;
constexpr int kNotableSides = 4;  // widths are also taken from the sides of so many largest rectangles

/// Where a rectangle goes in the gap that it fills.
enum class Side { Left, ByHigher, ByLower };

Vec2 box_around(const Vec2& size, double aspect) {
  if (aspect == 0) return size;
  const double height = std::max(size.y(), size.x() / aspect);
  return {aspect * height, height};
}

/// One strip at a time; the buffers are kept.
class Skyline {
 public:
  explicit Skyline(const std::vector<Vec2>& sizes) : sizes_(sizes) {
    for (int r = 0; r < static_cast<int>(sizes.size()); ++r) {
      entries_.push_back({sizes[r].x(), sizes[r].y(), r, false});
      if (sizes[r].x() != sizes[r].y()) entries_.push_back({sizes[r].y(), sizes[r].x(), r, true});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.width != b.width ? a.width > b.width : a.height != b.height ? a.height > b.height : a.rectangle < b.rectangle;
    });
  }

  /// Largest extent of the packing, infinite where a rectangle is too wide.
  Vec2 pack(double strip, Side side, RectanglePacking& out) {
    const int count = static_cast<int>(sizes_.size());
    used_.assign(count, 0);
    next_.resize(entries_.size() + 1);
    std::iota(next_.begin(), next_.end(), 0);
    line_.assign(1, {0, strip, 0});
    out.positions.resize(count);
    out.turned.resize(count);
    Vec2 extent = Vec2::Zero();
    for (int placed = 0; placed < count;) {
      const std::size_t low = lowest();
      const int entry = widest_within(line_[low].width);
      if (entry == static_cast<int>(entries_.size())) {
        if (line_.size() == 1) return Vec2::Constant(std::numeric_limits<double>::infinity());
        raise(low);
        continue;
      }
      const Entry& e = entries_[entry];
      used_[e.rectangle] = 1;
      ++placed;
      const double x = place(low, e, side);
      out.positions[e.rectangle] = {x, placed_at_};
      out.turned[e.rectangle] = e.turned;
      extent = extent.cwiseMax(Vec2(x + e.width, placed_at_ + e.height));
    }
    return extent;
  }

 private:
  struct Entry {
    double width, height;
    int rectangle;
    bool turned;
  };
  struct Step {
    double x, width, height;
  };

  std::size_t lowest() const {
    std::size_t low = 0;
    for (std::size_t k = 1; k < line_.size(); ++k) {
      if (line_[k].height < line_[low].height) low = k;
    }
    return low;
  }
  int skip_used(int entry) {
    int end = entry;
    while (end < static_cast<int>(entries_.size()) && used_[entries_[end].rectangle]) end = std::max(end + 1, next_[end + 1]);
    for (int k = entry; k < end;) {
      const int after = std::max(k + 1, next_[k]);
      next_[k] = end;
      k = after;
    }
    return end;
  }
  int widest_within(double width) {
    const auto first = std::partition_point(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.width > width; });
    return skip_used(std::max(static_cast<int>(first - entries_.begin()), next_[first - entries_.begin()]));
  }
  double wall(std::size_t k, int way) const {
    const std::size_t other = k + way;
    return other < line_.size() ? line_[other].height : std::numeric_limits<double>::infinity();
  }
  /// Lifts a step that nothing fits into to its lower neighbour.
  void raise(std::size_t k) {
    const double height = std::min(k > 0 ? wall(k, -1) : std::numeric_limits<double>::infinity(), wall(k, 1));
    line_[k].height = height;
    merge(k);
  }
  void merge(std::size_t k) {
    if (k + 1 < line_.size() && line_[k + 1].height == line_[k].height) {
      line_[k].width += line_[k + 1].width;
      line_.erase(line_.begin() + k + 1);
    }
    if (k > 0 && line_[k - 1].height == line_[k].height) {
      line_[k - 1].width += line_[k].width;
      line_.erase(line_.begin() + k);
    }
  }
  double place(std::size_t k, const Entry& e, Side side) {
    const double left = k > 0 ? wall(k, -1) : std::numeric_limits<double>::infinity(), right = wall(k, 1);
    const bool at_left = side == Side::Left || (side == Side::ByHigher ? left >= right : left <= right);
    Step& step = line_[k];
    placed_at_ = step.height;
    const double x = at_left ? step.x : step.x + step.width - e.width;
    const Step top{x, e.width, step.height + e.height};
    step.width -= e.width;
    if (at_left) step.x += e.width;
    if (step.width <= 0) {
      line_[k] = top;
      merge(k);
    } else if (at_left) {
      line_.insert(line_.begin() + k, top);
      merge(k);
    } else {
      line_.insert(line_.begin() + k + 1, top);
      merge(k + 1);
    }
    return x;
  }

  const std::vector<Vec2>& sizes_;
  std::vector<Entry> entries_;
  std::vector<int> next_;
  std::vector<char> used_;
  std::vector<Step> line_;
  double placed_at_ = 0;
};

/// Strip widths that deserve a try: evenly spread aspects, and what the largest rectangles would fill.
std::vector<double> strip_widths(const std::vector<Vec2>& sizes, double aspect) {
  double area = 0, widest = 0;
  for (const Vec2& s : sizes) {
    area += s.prod();
    widest = std::max(widest, s.minCoeff());
  }
  const double square = std::sqrt(area / kLikelyDensity);
  const double low = aspect > 0 ? 0.9 * aspect : kNarrowest, high = aspect > 0 ? 1.12 * aspect : kWidest;
  std::vector<double> widths;
  for (int k = 0; k < kStrips; ++k)
    widths.push_back(square * std::sqrt(low * std::pow(high / low, static_cast<double>(k) / (kStrips - 1))));
  std::vector<Vec2> largest = sizes;
  std::sort(largest.begin(), largest.end(), [](const Vec2& a, const Vec2& b) { return a.prod() > b.prod(); });
  largest.resize(std::min<std::size_t>(largest.size(), kNotableSides));
  std::vector<double> sides = {0};
  for (const Vec2& s : largest) sides.insert(sides.end(), {s.x(), s.y()});
  for (std::size_t a = 0; a < sides.size(); ++a) {
    for (std::size_t b = a + 1; b < sides.size(); ++b) {
      const double width = sides[a] + sides[b];
      if (width >= square * std::sqrt(low) && width <= square * std::sqrt(high)) widths.push_back(width);
    }
  }
  for (double& width : widths) width = std::max(width, widest) * (1 + 1e-12);
  if (sizes.size() == 1) widths = {sizes[0].x() * (1 + 1e-12), sizes[0].y() * (1 + 1e-12)};
  std::sort(widths.begin(), widths.end());
  widths.erase(std::unique(widths.begin(), widths.end()), widths.end());
  return widths;
}

}  // namespace

RectanglePacking pack_rectangles(const std::vector<Vec2>& sizes, double padding, double box_aspect) {
  std::vector<Vec2> padded;
  for (const Vec2& s : sizes) padded.push_back(s + Vec2::Constant(padding));
  Skyline skyline(padded);
  RectanglePacking best, trial;
  double best_area = std::numeric_limits<double>::infinity();
  for (const double width : strip_widths(padded, box_aspect)) {
    for (const Side side : {Side::Left, Side::ByHigher, Side::ByLower}) {
      const Vec2 extent = skyline.pack(width, side, trial);
      if (!std::isfinite(extent.x())) continue;
      trial.box = box_around(extent - Vec2::Constant(padding), box_aspect);
      if (trial.box.prod() >= best_area) continue;
      best_area = trial.box.prod();
      best = trial;
    }
  }
  return best;
}

}  // namespace atlas_refine
