// Local search over motorcycle graphs: every candidate is decomposed, packed and scored.
#include "layout/search_layout.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "geometry/split_mesh.h"
#include "layout/motorcycles.h"
#include "layout/pack_rectangles.h"
#include "measure/distortion.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr double kSlack = 1.002;              // layouts are to hold so much more than the bound: stage 3 starts from them
constexpr double kMoreThanGap = 1.2;          // kept beyond the gap: stage 3 starts with a little freedom
constexpr double kLeastPadding = 2e-4;        // of the box diagonal, where no gap is asked for: borders must not touch
constexpr double kLongestSides = 20;          // aspect of a rectangle; longer ones are long and narrow
constexpr int kChains = 8;                    // independent searches, so that threads do not change the result
constexpr double kHot = 0.01;                 // accepted loss of score at the start of a chain
constexpr int kFinalists = 4;                 // layouts whose packing is annealed
constexpr int kAnnealing = 60000;             // position evaluations per finalist, shared by its rectangles
constexpr std::size_t kAffordable = 30000;    // rectangles packed in one later round,
constexpr std::size_t kLeastCandidates = 24;  // in at least so many layouts
constexpr int kExtraCorners[] = {4, 12, 32};

/// What a layout is judged by.
struct Score {
  double value = -1e9;
  double pe = 0;
};

struct Candidate {
  std::vector<MotorcycleGraph> graphs;
  std::vector<Decomposition> decompositions;
  RectanglePacking packing;
  Score score;
};

class Search {
 public:
  Search(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources, const LayoutOptions& options,
         Monitor& monitor)
      : aligned_(aligned), sources_(sources), options_(options), monitor_(monitor) {
    for (std::size_t c = 0; c < aligned.size(); ++c) {
      Chart chart = sources[c];
      if (aligned[c].way == AxisAlignedChart::Way::AsItIs) {
        chart.uvs = aligned[c].mesh.uvs;
        kept_.push_back({{uv_box({chart})}, {uv_area(chart)}, {}, 0});
      } else {
        kept_.emplace_back();
      }
    }
  }

  Layout run() {
    Layout best;
    for (std::size_t g = 0; g < options_.gaps.size(); ++g) {
      const Layout layout = search(options_.gaps[g], 0, static_cast<int>(g));
      if (best.pieces.empty() || layout.pe > best.pe) best = layout;
      if (best.pe >= target() || highest_pe() < target()) return best;
    }
    for (const int extra : kExtraCorners) {
      const Layout layout = search(options_.gaps.back(), extra, extra);
      if (layout.pe > best.pe) best = layout;
      if (best.pe >= target()) return best;
    }
    return best;
  }

 private:
  double target() const { return std::min(kSlack * options_.pe_bound, 0.5 * (1 + options_.pe_bound)); }

  /// What no layout exceeds: the boxes of charts that are packed as they are hold more than the charts.
  double highest_pe() const {
    double boxes = area_;
    for (const Decomposition& d : kept_) {
      for (std::size_t k = 0; k < d.rectangles.size(); ++k) boxes += d.rectangles[k].area() - d.areas[k];
    }
    return area_ / boxes;
  }

  Layout search(const Gap& gap, int extra_corners, int round) {
    quads_.clear();
    cut_length_unit_ = 0;
    area_ = 0;
    for (std::size_t c = 0; c < aligned_.size(); ++c) {
      const bool as_it_is = aligned_[c].way == AxisAlignedChart::Way::AsItIs;
      quads_.push_back(as_it_is ? QuadMesh{} : make_quad_mesh(aligned_[c], sources_[c], extra_corners));
      cut_length_unit_ += 0.5 * quads_.back().boundary_length;
      for (double area : quads_.back().face_areas) area_ += area;
      for (double area : kept_[c].areas) area_ += area;
    }
    set_padding(gap, likely_box());
    std::vector<Candidate> finalists = run_chains(round);
    Candidate best = std::move(finalists.front());
    for (Candidate& candidate : finalists) {
      if (candidate.score.value > best.score.value) best = std::move(candidate);
    }
    // A larger gap makes a larger box: what was packed for another box is packed again.
    for (int k = 0; k < 4 && padding_ < padding(gap, best.packing.box); ++k) {
      set_padding(gap, best.packing.box);
      padding_ *= 1 + 0.002 * k;
      pack_well(best, round, k);
    }
    return layout_of(best, gap, extra_corners);
  }

  Vec2 likely_box() const {
    const double aspect = options_.box_aspect > 0 ? options_.box_aspect : 1;
    const double height = std::sqrt(area_ / 0.85 / aspect);
    return {aspect * height, height};
  }
  void set_padding(const Gap& gap, const Vec2& box) { padding_ = padding(gap, box); }
  static double padding(const Gap& gap, const Vec2& box) {
    return std::max(kMoreThanGap * gap.length(box), kLeastPadding * box.norm());
  }

  /// The best layouts of all chains, best first, their packings annealed.
  std::vector<Candidate> run_chains(int round) {
    std::vector<int> corner_charts;
    for (std::size_t c = 0; c < quads_.size(); ++c) {
      if (!quads_[c].corners.empty()) corner_charts.push_back(static_cast<int>(c));
    }
    const int chains = corner_charts.empty() ? 1 : std::min(kChains, options_.rectangles.candidates);
    const int steps = corner_charts.empty() ? 1 : std::max(1, candidates(round) / chains);
    std::vector<Candidate> best(chains);
    std::atomic<int> done = 0;
    parallel_ranges(chains, options_.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        best[k] = run_chain(corner_charts, steps, Rng(options_.seed, 100 + round, k), k == 0);
        monitor_.report(0.8 * ++done / chains);
      }
    });
    std::stable_sort(best.begin(), best.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score.value > b.score.value; });
    best.resize(std::min<std::size_t>(best.size(), kFinalists));
    parallel_ranges(static_cast<int>(best.size()), options_.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) pack_well(best[k], round, 10 + k);
    });
    return best;
  }

  /// The first round tries as many as were asked for; those after it that miss the bound fewer where there are many rectangles.
  int candidates(int round) const {
    std::size_t faces = 1;
    for (const QuadMesh& quads : quads_) faces += quads.corners.size() + 1;
    const int affordable = static_cast<int>(std::max<std::size_t>(kLeastCandidates, kAffordable / faces));
    return round == 0 ? options_.rectangles.candidates : std::min(options_.rectangles.candidates, affordable);
  }

  Candidate run_chain(const std::vector<int>& corner_charts, int steps, Rng rng, bool greedy) const {
    Candidate present;
    for (std::size_t c = 0; c < quads_.size(); ++c) {
      present.graphs.push_back(greedy ? shortest_graph(quads_[c]) : random_graph(quads_[c], rng));
      present.decompositions.push_back(decompose(static_cast<int>(c), present.graphs.back()));
    }
    pack(present);
    Candidate best = present;
    for (int k = 1; k < steps; ++k) {
      monitor_.check();
      const int c = corner_charts[rng.below(static_cast<int>(corner_charts.size()))];
      Candidate trial = present;
      mutate(quads_[c], trial.graphs[c], rng);
      trial.decompositions[c] = decompose(c, trial.graphs[c]);
      pack(trial);
      const double heat = kHot * (1 - static_cast<double>(k) / steps);
      if (trial.score.value < present.score.value + heat * std::log(1 - rng.uniform())) continue;
      present = std::move(trial);
      if (present.score.value > best.score.value) best = present;
    }
    return best;
  }

  Decomposition decompose(int c, const MotorcycleGraph& graph) const {
    return kept_[c].rectangles.empty() ? drive(quads_[c], graph) : kept_[c];
  }

  static std::vector<Vec2> sizes(const Candidate& candidate) {
    std::vector<Vec2> out;
    for (const Decomposition& d : candidate.decompositions) {
      for (const Box& box : d.rectangles) out.push_back(box.size());
    }
    return out;
  }

  void pack(Candidate& candidate) const {
    candidate.packing = pack_rectangles(sizes(candidate), padding_, options_.box_aspect);
    score(candidate);
  }
  void pack_well(Candidate& candidate, int round, int k) const {
    const std::vector<Vec2> all = sizes(candidate);
    const int n = static_cast<int>(all.size());
    const auto iterations = static_cast<int>(std::min<long>(20000, 100L * kAnnealing / (n * static_cast<long>(n))));
    Rng rng(options_.seed, 200 + round, k);
    candidate.packing =
        anneal_packing(all, padding_, options_.box_aspect, pack_rectangles(all, padding_, options_.box_aspect), iterations, rng);
    score(candidate);
  }

  /// Eq. (11); layouts below the bound come after all others, and so do those with long and narrow rectangles.
  void score(Candidate& candidate) const {
    double cut = 0, longest = 1;
    for (const Decomposition& d : candidate.decompositions) {
      cut += d.cut_length;
      if (d.trails.empty()) continue;  // what is not cut is as long as it is
      for (const Box& box : d.rectangles) longest = std::max(longest, box.size().maxCoeff() / box.size().minCoeff());
    }
    candidate.score.pe = area_ / candidate.packing.box.prod();
    const double growth = cut_length_unit_ > 0 ? cut / cut_length_unit_ : 0;
    candidate.score.value = candidate.score.pe - options_.rectangles.omega * (1 + growth);
    if (candidate.score.pe < target()) candidate.score.value -= 1 + 10 * (target() - candidate.score.pe);
    if (longest > kLongestSides) candidate.score.value -= 100;
  }

  Layout layout_of(const Candidate& candidate, const Gap& gap, int extra_corners) const {
    Layout out;
    std::size_t k = 0;
    for (std::size_t c = 0; c < candidate.decompositions.size(); ++c) {
      out.trails.push_back(candidate.decompositions[c].trails);
      for (const Box& box : candidate.decompositions[c].rectangles) {
        out.pieces.push_back({static_cast<int>(c), box, candidate.packing.turned[k] != 0, candidate.packing.positions[k]});
        ++k;
      }
    }
    out.box = candidate.packing.box;
    out.pe = candidate.score.pe;
    out.gap = gap;
    out.extra_corners = extra_corners;
    return out;
  }

  const std::vector<AxisAlignedChart>& aligned_;
  const std::vector<Chart>& sources_;
  const LayoutOptions& options_;
  Monitor& monitor_;
  std::vector<Decomposition> kept_;  // of charts that are packed as they are
  std::vector<QuadMesh> quads_;
  double area_ = 0, cut_length_unit_ = 0, padding_ = 0;
};

}  // namespace

Layout search_layout(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                     const LayoutOptions& options, Monitor& monitor) {
  return Search(aligned, sources, options, monitor).run();
}

}  // namespace atlas_refine
