// Skyline best fit over many strip widths.
#include "layout/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr int kStrips = 14;  // strip widths tried, between boxes of these aspects
constexpr double kNarrowest = 0.55, kWidest = 1.8;
constexpr double kLikelyDensity = 0.88;
constexpr int kNotableSides = 4;  // widths are also taken from the sides of so many largest rectangles

/// Where a rectangle goes in the gap that it fills.
enum class Side { Left, ByHigher, ByLower };

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Rectangles as they may be laid, wide ones first; those that are used up are skipped.
class Stock {
 public:
  struct Entry {
    double width, height;
    int rectangle;
    bool turned;
  };

  explicit Stock(const std::vector<Vec2>& sizes) : used_(sizes.size()) {
    for (int r = 0; r < static_cast<int>(sizes.size()); ++r) {
      entries_.push_back({sizes[r].x(), sizes[r].y(), r, false});
      if (sizes[r].x() != sizes[r].y()) entries_.push_back({sizes[r].y(), sizes[r].x(), r, true});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.width != b.width ? a.width > b.width : a.height != b.height ? a.height > b.height : a.rectangle < b.rectangle;
    });
  }

  void fill() {
    std::fill(used_.begin(), used_.end(), 0);
    next_.resize(entries_.size() + 1);
    std::iota(next_.begin(), next_.end(), 0);
  }

  /// Takes out the widest one that fits; null where none does.
  const Entry* take(double width) {
    const auto first = std::partition_point(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.width > width; });
    const int entry = skip_used(std::max(static_cast<int>(first - entries_.begin()), next_[first - entries_.begin()]));
    if (entry == static_cast<int>(entries_.size())) return nullptr;
    used_[entries_[entry].rectangle] = 1;
    return &entries_[entry];
  }

 private:
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

  std::vector<Entry> entries_;
  std::vector<int> next_;  // a later entry before which all are used
  std::vector<char> used_;
};

/// The upper border of what has been laid, as steps from left to right.
class Skyline {
 public:
  struct Step {
    double x, width, height;
  };

  void start(double strip) { line_.assign(1, {0, strip, 0}); }

  std::size_t lowest() const {
    std::size_t low = 0;
    for (std::size_t k = 1; k < line_.size(); ++k) {
      if (line_[k].height < line_[low].height) low = k;
    }
    return low;
  }
  const Step& step(std::size_t k) const { return line_[k]; }

  /// Lifts a step that nothing fits into to its lower neighbour; false where it has none.
  bool raise(std::size_t k) {
    if (line_.size() == 1) return false;
    line_[k].height = std::min(left_wall(k), right_wall(k));
    merge(k);
    return true;
  }

  /// Lays a rectangle on step k and returns its min corner.
  Vec2 place(std::size_t k, double width, double height, Side side) {
    const double left = left_wall(k), right = right_wall(k);
    const bool at_left = side == Side::Left || (side == Side::ByHigher ? left >= right : left <= right);
    Step& step = line_[k];
    const Vec2 corner(at_left ? step.x : step.x + step.width - width, step.height);
    const Step top{corner.x(), width, step.height + height};
    step.width -= width;
    if (at_left) step.x += width;
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
    return corner;
  }

 private:
  double left_wall(std::size_t k) const { return k > 0 ? line_[k - 1].height : kInfinite; }
  double right_wall(std::size_t k) const { return k + 1 < line_.size() ? line_[k + 1].height : kInfinite; }
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

  std::vector<Step> line_;
};

/// Fills a strip; returns the largest extent of the packing, infinite where a rectangle is too wide.
Vec2 pack_strip(Stock& stock, Skyline& skyline, double strip, Side side, RectanglePacking& out) {
  stock.fill();
  skyline.start(strip);
  Vec2 extent = Vec2::Zero();
  for (std::size_t placed = 0; placed < out.positions.size();) {
    const std::size_t low = skyline.lowest();
    const Stock::Entry* entry = stock.take(skyline.step(low).width);
    if (!entry) {
      if (!skyline.raise(low)) return Vec2::Constant(kInfinite);
      continue;
    }
    const Vec2 corner = skyline.place(low, entry->width, entry->height, side);
    out.positions[entry->rectangle] = corner;
    out.turned[entry->rectangle] = entry->turned;
    extent = extent.cwiseMax(corner + Vec2(entry->width, entry->height));
    ++placed;
  }
  return extent;
}

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
  Stock stock(padded);
  Skyline skyline;
  RectanglePacking best, trial{std::vector<Vec2>(sizes.size()), std::vector<char>(sizes.size()), {}};
  double best_area = kInfinite;
  for (const double width : strip_widths(padded, box_aspect)) {
    for (const Side side : {Side::Left, Side::ByHigher, Side::ByLower}) {
      const Vec2 extent = pack_strip(stock, skyline, width, side, trial);
      if (!std::isfinite(extent.x())) continue;
      trial.box = box_of_aspect({Vec2::Zero(), extent - Vec2::Constant(padding)}, box_aspect).size();
      if (trial.box.prod() >= best_area) continue;
      best_area = trial.box.prod();
      best = trial;
    }
  }
  return best;
}

}  // namespace atlas_refine
