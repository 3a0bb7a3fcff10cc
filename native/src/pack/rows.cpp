// One row after the other, from the highest on: always the chart that wastes least next.
#include "pack/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "measure/distortion.h"
#include "pack/row_poses.h"

namespace atlas_refine {
namespace {

constexpr double kLowest = 0.75;  // of a row's height: charts that are lower leave too much free above them
// Poses that are looked at for each place. The more there are, the better the first rows become and the worse the last.
constexpr std::array kChoices = {200, 12};
constexpr int kMostWork = 4000;     // and the ends of edges that are compared for it
constexpr int kWidths = 3;          // of rows that are tried
constexpr double kRest = 0.3;       // of a row's height: what is left at its end and as wide is filled with lower rows
constexpr double kFar = 1.05;       // times the box that is enough: another width does not bring that
constexpr double kLikelyPe = 0.92;  // of hulls with half the gap around them: what the first width is meant for

struct RowLayout {
  std::vector<Placement> placements;
  Vec2 size = Vec2::Zero();
};

/// Which of many, told by their numbers, are left.
class Left {
 public:
  explicit Left(std::size_t count) : next_(count) { std::iota(next_.begin(), next_.end(), 1); }

  /// The first from `k` on for which is_gone() does not hold, nor ever did; their number where there is none.
  template <class IsGone>
  int from(int k, const IsGone& is_gone) {
    int left = k;
    while (left < static_cast<int>(next_.size()) && is_gone(left)) left = next_[left];
    for (int at = k; at < left;) at = std::exchange(next_[at], left);
    return left;
  }

 private:
  std::vector<int> next_;  ///< after each the next one that may be left
};

/// The charts that stand in no row yet.
class Waiting {
 public:
  explicit Waiting(const RowPoses& poses)
      : poses_(poses), gone_(poses.by_height.size(), false), charts_(poses.by_height.size()), all_(poses.all.size()) {}

  std::size_t count() const { return gone_.size() - taken_; }
  double fraction_taken() const { return static_cast<double>(taken_) / static_cast<double>(gone_.size()); }
  void take(int chart) {
    gone_[chart] = true;
    ++taken_;
  }

  /// Of the highest chart that is at most so high; nothing where there is none.
  std::optional<double> next_height(double most) {
    const std::vector<int>& charts = poses_.by_height;
    const auto higher = [&](int chart, double height) { return poses_.least_height[chart] > height; };
    const auto first = std::lower_bound(charts.begin(), charts.end(), most, higher) - charts.begin();
    const int k = charts_.from(static_cast<int>(first), [&](int at) { return gone_[charts[at]]; });
    if (k == static_cast<int>(charts.size())) return std::nullopt;
    return poses_.least_height[charts[k]];
  }

  int first_pose(double most_height) {
    const auto higher = [](const RowPose& pose, double height) { return pose.size.y() > height; };
    return pose_from(
        static_cast<int>(std::lower_bound(poses_.all.begin(), poses_.all.end(), most_height, higher) - poses_.all.begin()));
  }
  /// From the k-th on.
  int pose_from(int k) {
    return all_.from(k, [&](int at) { return gone_[poses_.all[at].chart]; });
  }

 private:
  const RowPoses& poses_;
  std::vector<char> gone_;
  std::size_t taken_ = 0;
  Left charts_, all_;  ///< by their height
};

/// What is to be filled, up to the end of the rows.
struct Room {
  double left, floor, top;
};

class Filling {
 public:
  Filling(const RowPoses& poses, double gap, double width, double most_free, int choice)
      : poses_(poses), gap_(gap), width_(width), most_free_(most_free), choice_(choice), waiting_(poses) {
    layout_.placements.resize(poses.by_height.size());
  }

  /// Nothing where a chart is longer than a row, and where rows leave too much free.
  std::optional<RowLayout> run(Watch& watch) {
    double floor = 0;
    while (waiting_.count() > 0) {
      watch.poll(waiting_.fraction_taken());
      const auto height = fill_row({0, floor, INFINITY});
      if (!height) return std::nullopt;
      layout_.size.y() = floor + *height;
      floor = layout_.size.y() + gap_;
      if (width_ * floor - area_ > most_free_) return std::nullopt;
    }
    return std::move(layout_);
  }

 private:
  struct Standing {
    const RowPose* pose;
    double x;

    double end() const { return x + pose->size.x(); }
  };

  /// As far left as those before it leave room.
  double place_of(const RowPose& pose) {
    double x = settled_;
    for (const Standing& other : unsettled_) {
      work_ += static_cast<int>(other.pose->right.size() * pose.left.size());
      x = std::max(x, other.x + row_distance(other.pose->right, pose.left, gap_));
    }
    return x;
  }

  /// The best of what may come next, the highest that are left or so.
  std::optional<Standing> choose() {
    const auto& all = poses_.all;
    std::optional<Standing> best;
    double least = INFINITY;
    work_ = 0;
    int k = waiting_.first_pose(height_);
    for (int seen = 0; seen < choice_ && work_ < kMostWork; ++seen, k = waiting_.pose_from(k + 1)) {
      if (k == static_cast<int>(all.size()) || all[k].size.y() < kLowest * height_) break;
      // The row is as high as its first chart.
      if (unsettled_.empty() && all[k].size.y() < height_) break;
      const double x = place_of(all[k]);
      if (x + all[k].size.x() > width_) continue;
      const double waste = (x + all[k].mean_end(height_) - front_) / all[k].area;
      if (best && waste >= least) continue;
      best = Standing{&all[k], x};
      least = waste;
    }
    return best;
  }

  void stand(const Standing& chosen, double floor) {
    const Placement& motion = chosen.pose->motion;
    layout_.placements[chosen.pose->chart] = {motion.cosine, motion.sine, motion.offset + Vec2(chosen.x, floor)};
    layout_.size.x() = std::max(layout_.size.x(), chosen.end());
    waiting_.take(chosen.pose->chart);
    area_ += chosen.pose->area;
    front_ = chosen.x + chosen.pose->mean_end(height_);
    // Those that end left of this one are in nobody's way any more.
    std::erase_if(unsettled_, [&](const Standing& other) {
      if (other.end() + gap_ > chosen.x) return false;
      settled_ = std::max(settled_, other.end() + gap_);
      return true;
    });
    unsettled_.push_back(chosen);
  }

  /// Its height; nothing where no chart fits.
  std::optional<double> fill_row(const Room& room) {
    const auto height = waiting_.next_height(std::min(room.top - room.floor, width_ - room.left));
    if (!height) return std::nullopt;
    height_ = *height;
    unsettled_.clear();
    settled_ = front_ = room.left;
    while (const auto chosen = choose()) stand(*chosen, room.floor);
    if (unsettled_.empty()) return std::nullopt;
    double end = settled_;
    for (const Standing& last : unsettled_) end = std::max(end, last.end() + gap_);
    if (width_ - end > kRest * *height) fill_rest({end, room.floor, room.floor + *height});
    return height;
  }

  /// With lower rows.
  void fill_rest(Room room) {
    while (const auto height = fill_row(room)) room.floor += *height + gap_;
  }

  const RowPoses& poses_;
  double gap_, width_, most_free_;
  int choice_;
  Waiting waiting_;
  RowLayout layout_;
  int work_ = 0;                     ///< for the present place
  double area_ = 0;                  ///< of the charts that stand
  double height_ = 0;                ///< of the row
  double front_ = 0;                 ///< its end in the mean of its height
  double settled_ = 0;               ///< right of this those that are in nobody's way leave room
  std::vector<Standing> unsettled_;  ///< the others
};

}  // namespace

std::vector<Placement> pack_in_rows(const std::vector<Outline>& outlines, const RowOptions& options, Watch& watch) {
  constexpr double kLeastGap = 1e-6;  // of a square that the charts fill: they must not touch
  constexpr double kRounding = 1e-9;
  const double gap = std::max((1 + kRounding) * options.gap, kLeastGap);
  const RowPoses poses(outlines, gap);
  const double aspect = options.box_aspect > 0 ? options.box_aspect : 1, most_free = kFar * options.enough - poses.area;
  for (const int choice : kChoices) {
    double width = std::sqrt(aspect * poses.grown / kLikelyPe);
    for (int k = 0; k < kWidths; ++k) {
      auto layout = Filling(poses, gap, width, most_free, choice).run(watch);
      if (!layout) break;
      const Box box{Vec2::Zero(), layout->size};
      if (box_of_aspect(box, options.box_aspect).area() <= options.enough) return std::move(layout->placements);
      width *= std::sqrt(aspect * layout->size.y() / layout->size.x());
    }
  }
  return {};
}

}  // namespace atlas_refine
