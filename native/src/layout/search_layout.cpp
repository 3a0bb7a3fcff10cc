// Local search over motorcycle graphs: every candidate is decomposed, packed and scored.
#include "layout/search_layout.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <tuple>

#include "layout/motorcycles.h"
#include "layout/pack_rectangles.h"
#include "measure/distortion.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

constexpr double kSlack = 1.002;              // layouts are to hold so much more than the bound: stage 3 starts from them
constexpr double kMoreThanGap = 1.2;          // kept beyond the gap: stage 3 starts with a little freedom
constexpr double kLeastPadding = 2e-4;        // of the box diagonal, where no gap is asked for: borders must not touch
constexpr double kLongestSides = 20;          // aspect of a rectangle; longer ones, unless their chart is, are long and narrow
constexpr int kChains = 8;                    // independent searches, so that threads do not change the result
constexpr double kHot = 0.01;                 // accepted loss of score at the start of a chain
constexpr int kFinalists = 4;                 // layouts whose packing is annealed
constexpr int kAnnealing = 60000;             // position evaluations per finalist, shared by its rectangles
constexpr std::size_t kAffordable = 30000;    // rectangles packed in one later round,
constexpr std::size_t kLeastCandidates = 24;  // in at least so many layouts
constexpr int kExtraCorners[] = {4, 12, 32};
constexpr double kLikelyPe = 0.85;  // of a layout, for its first padding

/// What a layout is judged by.
struct Score {
  double value = -1e9;
  double pe = 0;
  double growth = 0;  // of the boundary, as a fraction of that of all charts
};

struct Candidate {
  std::vector<MotorcycleGraph> graphs;  // per chart
  std::vector<Decomposition> decompositions;
  RectanglePacking packing;
  Score score;
};

/// Scores that differ by rounding are one: the layout must not depend on the order or the turn of the input.
double told(const Score& score) { return std::round(1e9 * score.value); }
bool is_better(const Candidate& a, const Candidate& b) { return told(a.score) > told(b.score); }

/// What the candidates of one round have in common.
struct Round {
  int number;  // for its random choices
  Gap gap;
  int extra_corners;
  std::vector<QuadMesh> quads;              // per chart
  const std::vector<Decomposition>& boxed;  // per chart: its box where it is packed as it is, else empty
  std::vector<double> longest;              // per chart: aspect of rectangles up to which they are not long and narrow
  std::vector<char> too_long;               // per chart: for the box, which has a given aspect
  std::vector<int> order;                   // of charts, by their shapes: numbers of the input do not matter
  double area = 0;                          // of all charts
  double cut_length_unit = 0;
};

double aspect_of(const Box& box) { return box.size().maxCoeff() / box.size().minCoeff(); }

/// Layouts are to hold this.
double pe_target(const LayoutOptions& options) { return std::min(kSlack * options.pe_bound, 0.5 * (1 + options.pe_bound)); }

double padding_of(const Gap& gap, const Vec2& box) {
  return std::max(kMoreThanGap * gap.length(box), kLeastPadding * box.norm());
}

/// The boxes of charts that are packed as they are; nothing for the others.
std::vector<Decomposition> boxes_of(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources) {
  std::vector<Decomposition> boxes(aligned.size());
  for (std::size_t c = 0; c < aligned.size(); ++c) {
    if (aligned[c].way != AxisAlignedChart::Way::AsItIs) continue;
    Chart chart = sources[c];
    chart.uvs = aligned[c].mesh.uvs;
    boxes[c] = {{uv_box({chart})}, {uv_area(chart)}, {}, 0};
  }
  return boxes;
}

/// What no layout exceeds: the boxes of charts that are packed as they are hold more than the charts.
double highest_pe(const Round& round) {
  double boxes = round.area;
  for (const Decomposition& d : round.boxed) {
    for (std::size_t k = 0; k < d.rectangles.size(); ++k) boxes += d.rectangles[k].area() - d.areas[k];
  }
  return round.area / boxes;
}

/// Large charts first; in single precision, where sums in another order agree.
std::vector<int> by_size(const Round& round) {
  std::vector<std::tuple<float, float, std::size_t>> size;
  for (std::size_t c = 0; c < round.quads.size(); ++c) {
    double area = 0;
    for (double part : round.quads[c].face_areas) area += part;
    for (double part : round.boxed[c].areas) area += part;
    size.emplace_back(static_cast<float>(area / round.area),
                      static_cast<float>(round.quads[c].boundary_length / std::sqrt(round.area)), round.quads[c].trails.size());
  }
  std::vector<int> order(size.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
  return order;
}

void add_quad_meshes(Round& round, const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                     const std::vector<SidePrices>& prices) {
  for (std::size_t c = 0; c < aligned.size(); ++c) {
    const bool boxed = !round.boxed[c].rectangles.empty();
    const SidePrices own = prices.empty() ? SidePrices() : prices[c];
    round.quads.push_back(boxed ? QuadMesh{} : make_quad_mesh(aligned[c], sources[c], round.extra_corners, own));
    round.cut_length_unit += 0.5 * round.quads.back().boundary_length;
    for (double area : round.quads.back().face_areas) round.area += area;
    for (double area : round.boxed[c].areas) round.area += area;
  }
  round.order = by_size(round);
}

void find_long_charts(Round& round, const std::vector<AxisAlignedChart>& aligned, const LayoutOptions& options) {
  const double side = sides_of_area(round.area / kLikelyPe, options.box_aspect).maxCoeff();
  for (const AxisAlignedChart& chart : aligned) {
    const Box box = box_of_points(chart.mesh.uvs);
    round.longest.push_back(std::max(kLongestSides, aspect_of(box)));
    round.too_long.push_back(options.box_aspect > 0 && box.size().maxCoeff() > side);
  }
}

/// The first round tries as many as were asked for; those after it that miss the bound fewer where there are many rectangles.
int candidate_count(const Round& round, const LayoutOptions& options) {
  std::size_t faces = 1;
  for (const QuadMesh& quads : round.quads) faces += quads.corners.size() + 1;
  const int affordable = static_cast<int>(std::max<std::size_t>(kLeastCandidates, kAffordable / faces));
  return round.number == 0 ? options.rectangles.candidates : std::min(options.rectangles.candidates, affordable);
}

std::vector<Vec2> sizes_of(const Candidate& candidate, const Round& round) {
  std::vector<Vec2> out;
  for (const int c : round.order) {
    for (const Box& box : candidate.decompositions[c].rectangles) out.push_back(box.size());
  }
  return out;
}

/// Eq. (11); layouts below the bound come after all others, and so do those with long and narrow rectangles.
Score score_of(const Candidate& candidate, const Round& round, const LayoutOptions& options) {
  double cut = 0;
  bool any_narrow = false;
  for (std::size_t c = 0; c < candidate.decompositions.size(); ++c) {
    const Decomposition& d = candidate.decompositions[c];
    cut += d.cut_length;
    if (d.trails.empty()) continue;  // what is not cut is as long as it is
    for (const Box& box : d.rectangles) any_narrow |= aspect_of(box) > round.longest[c];
  }
  Score score;
  score.pe = round.area / candidate.packing.box.prod();
  score.growth = round.cut_length_unit > 0 ? cut / round.cut_length_unit : 0;
  score.value = score.pe - options.rectangles.omega * (1 + score.growth);
  if (score.pe < pe_target(options)) score.value -= 1 + 10 * (pe_target(options) - score.pe);
  if (any_narrow) score.value -= 100;
  return score;
}

void pack(Candidate& candidate, const Round& round, const LayoutOptions& options, double padding) {
  candidate.packing = pack_rectangles(sizes_of(candidate, round), padding, options.box_aspect);
  candidate.score = score_of(candidate, round, options);
}

RectanglePacking annealed(const std::vector<Vec2>& sizes, double padding, double box_aspect, Rng rng) {
  const long n = static_cast<long>(sizes.size());
  const auto iterations = static_cast<int>(std::min<long>(20000, 100L * kAnnealing / (n * n)));
  return anneal_packing(sizes, padding, box_aspect, pack_rectangles(sizes, padding, box_aspect), iterations, rng);
}

/// Annealed besides.
void pack_well(Candidate& candidate, const Round& round, const LayoutOptions& options, double padding, int k) {
  const Rng rng(options.seed, 200 + round.number, k);
  candidate.packing = annealed(sizes_of(candidate, round), padding, options.box_aspect, rng);
  candidate.score = score_of(candidate, round, options);
}

Decomposition decompose(const Round& round, int chart, const MotorcycleGraph& graph) {
  return round.boxed[chart].rectangles.empty() ? drive(round.quads[chart], graph) : round.boxed[chart];
}

/// What a search begins with. As long as one chart is whole that is longer than the box cuts of others gain nothing: so all such
/// are cut at once.
enum class Start { Shortest, Across, Random };

Start start_of(int chain, const Round& round) {
  if (chain == 0) return Start::Shortest;
  const bool any_too_long = std::find(round.too_long.begin(), round.too_long.end(), 1) != round.too_long.end();
  return chain == 1 && any_too_long && round.extra_corners > 0 ? Start::Across : Start::Random;
}

/// One annealed search.
class Chain {
 public:
  Chain(const Round& round, const LayoutOptions& options, double padding, Rng rng)
      : round_(round), options_(options), padding_(padding), rng_(rng) {
    for (const int c : round.order) {
      if (!round.quads[c].corners.empty()) charts_.push_back(c);
    }
  }

  /// The best of `steps` candidates.
  Candidate run(int steps, Start start, Monitor& monitor) {
    Candidate present = first(start), best = present;
    for (int k = 1; k < steps; ++k) {
      monitor.check();
      Candidate trial = changed(present);
      const double heat = kHot * (1 - static_cast<double>(k) / steps);
      if (trial.score.value < present.score.value + heat * std::log(1 - rng_.uniform())) continue;
      present = std::move(trial);
      if (is_better(present, best)) best = present;
    }
    return best;
  }

 private:
  Candidate first(Start start) {
    Candidate out{std::vector<MotorcycleGraph>(round_.quads.size()), std::vector<Decomposition>(round_.quads.size()), {}, {}};
    for (const int c : round_.order) {
      const QuadMesh& quads = round_.quads[c];
      const bool across = start == Start::Across && round_.too_long[c];
      if (start == Start::Random) out.graphs[c] = random_graph(quads, rng_);
      if (start != Start::Random) out.graphs[c] = across ? graph_across(quads) : shortest_graph(quads);
      out.decompositions[c] = decompose(round_, c, out.graphs[c]);
    }
    pack(out, round_, options_, padding_);
    return out;
  }
  Candidate changed(const Candidate& present) {
    const int c = charts_[rng_.below(static_cast<int>(charts_.size()))];
    Candidate out = present;
    mutate(round_.quads[c], out.graphs[c], rng_);
    out.decompositions[c] = decompose(round_, c, out.graphs[c]);
    pack(out, round_, options_, padding_);
    return out;
  }

  const Round& round_;
  const LayoutOptions& options_;
  double padding_;
  Rng rng_;
  std::vector<int> charts_;  // that can be cut
};

/// The best layouts of all chains, best first, their packings annealed.
std::vector<Candidate> run_chains(const Round& round, const LayoutOptions& options, double padding, Monitor& monitor) {
  const bool any_corner =
      std::any_of(round.quads.begin(), round.quads.end(), [](const QuadMesh& quads) { return !quads.corners.empty(); });
  const int chains = any_corner ? std::min(kChains, options.rectangles.candidates) : 1;
  const int steps = any_corner ? std::max(1, candidate_count(round, options) / chains) : 1;
  std::vector<Candidate> best(chains);
  std::atomic<int> done = 0;
  parallel_ranges(chains, options.threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      best[k] = Chain(round, options, padding, Rng(options.seed, 100 + round.number, k)).run(steps, start_of(k, round), monitor);
      monitor.report(0.8 * ++done / chains);
    }
  });
  std::stable_sort(best.begin(), best.end(),
                   [](const Candidate& a, const Candidate& b) { return told(a.score) > told(b.score); });
  best.resize(std::min<std::size_t>(best.size(), kFinalists));
  parallel_ranges(static_cast<int>(best.size()), options.threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) pack_well(best[k], round, options, padding, 10 + k);
  });
  return best;
}

Layout layout_of(const Candidate& candidate, const Round& round) {
  Layout out;
  for (const Decomposition& d : candidate.decompositions) out.trails.push_back(d.trails);
  std::size_t k = 0;
  for (const int c : round.order) {
    for (const Box& box : candidate.decompositions[c].rectangles) {
      out.pieces.push_back({c, box, candidate.packing.turned[k] != 0, candidate.packing.positions[k]});
      ++k;
    }
  }
  out.box = candidate.packing.box;
  out.pe = candidate.score.pe;
  out.growth = candidate.score.growth;
  out.gap = round.gap;
  out.extra_corners = round.extra_corners;
  return out;
}

/// Cuts of one length into as many pieces are one: told by their trails they may differ in order, or be mirror images.
bool cut_alike(const Layout& a, const Layout& b) {
  constexpr double kRounding = 1e-9;
  return a.pieces.size() == b.pieces.size() && std::abs(a.growth - b.growth) < kRounding;
}

/// A larger gap makes a larger box: what was packed for another box is packed again.
void keep_gap(Candidate& candidate, const Round& round, const LayoutOptions& options, double padding) {
  for (int k = 0; k < 4 && padding < padding_of(round.gap, candidate.packing.box); ++k) {
    padding = padding_of(round.gap, candidate.packing.box) * (1 + 0.002 * k);
    pack_well(candidate, round, options, padding, k);
  }
}

std::vector<Layout> search_round(const Round& round, const LayoutOptions& options, Monitor& monitor) {
  const double padding = padding_of(round.gap, sides_of_area(round.area / kLikelyPe, options.box_aspect));
  std::vector<Candidate> finalists = run_chains(round, options, padding, monitor);
  std::stable_sort(finalists.begin(), finalists.end(), is_better);
  std::vector<Layout> out;
  for (Candidate& candidate : finalists) {
    keep_gap(candidate, round, options, padding);
    Layout layout = layout_of(candidate, round);
    const bool known = std::any_of(out.begin(), out.end(), [&](const Layout& other) { return cut_alike(other, layout); });
    if (out.empty() || (!known && layout.pe >= pe_target(options))) out.push_back(std::move(layout));
  }
  return out;
}

/// True where the same pieces lie in the same places, up to reflections of the box and, where it is free, of its axes: what the
/// pieces press against is the same.
bool packed_alike(const Layout& a, const Layout& b, bool free_box) {
  const auto places = [](const Layout& layout, bool swapped, int mirrored) {
    std::vector<Vec2> out;  // min and max corners, in the first of the two
    for (const PlacedPiece& piece : layout.pieces) {
      Vec2 low = piece.position, size = piece.box.size(), box = layout.box;
      if (piece.quarter_turn) std::swap(size.x(), size.y());
      if (swapped) std::swap(low.x(), low.y()), std::swap(size.x(), size.y()), std::swap(box.x(), box.y());
      for (int k = 0; k < 2; ++k) {
        if (mirrored >> k & 1) low[k] = box[k] - low[k] - size[k];
      }
      out.push_back(low);
      out.push_back(low + size);
    }
    return out;
  };
  const std::vector<Vec2> first = places(a, false, 0);
  constexpr double kSlid = 0.02;  // of the diagonal: what has room slides on its own
  const double tolerance = kSlid * a.box.norm();
  const auto near = [&](const Vec2& x, const Vec2& y) { return (x - y).norm() < tolerance; };
  for (int way = 0; way < (free_box ? 8 : 4); ++way) {
    const std::vector<Vec2> second = places(b, way >= 4, way % 4);
    if (std::equal(first.begin(), first.end(), second.begin(), second.end(), near)) return true;
  }
  return false;
}

}  // namespace

std::vector<Layout> search_layouts(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                                   const LayoutOptions& options, Monitor& monitor) {
  const PhaseScope scope(Phase::Layout);
  const std::vector<Decomposition> boxes = boxes_of(aligned, sources);
  std::vector<Layout> best;
  const auto holds = [&] { return best.front().pe >= pe_target(options); };  // after a search
  const auto search = [&](int number, const Gap& gap, int extra_corners) {
    Round round{number, gap, extra_corners, {}, boxes, {}, {}, {}};
    add_quad_meshes(round, aligned, sources, options.prices);
    find_long_charts(round, aligned, options);
    std::vector<Layout> layouts = search_round(round, options, monitor);
    if (best.empty() || layouts.front().pe > best.front().pe) best = std::move(layouts);
    return highest_pe(round) >= pe_target(options);
  };
  for (std::size_t g = 0; g < options.gaps.size(); ++g) {
    if (!search(static_cast<int>(g), options.gaps[g], 0) || holds()) return best;
  }
  for (const int extra : kExtraCorners) {
    search(extra, options.gaps.back(), extra);
    if (holds()) break;
  }
  return best;
}

std::vector<Layout> packed_otherwise(const Layout& layout, int ways, const LayoutOptions& options) {
  const PhaseScope scope(Phase::Layout);
  std::vector<Vec2> sizes;
  for (const PlacedPiece& piece : layout.pieces) sizes.push_back(piece.box.size());
  std::vector<Layout> out;
  for (int k = 0; k < ways; ++k) {
    const Rng rng(options.seed, 300, k);
    const RectanglePacking packing = annealed(sizes, padding_of(layout.gap, layout.box), options.box_aspect, rng);
    Layout other = layout;
    other.box = packing.box;
    other.pe = layout.pe * layout.box.prod() / packing.box.prod();
    if (other.pe < pe_target(options)) continue;
    for (std::size_t p = 0; p < sizes.size(); ++p) {
      other.pieces[p].quarter_turn = packing.turned[p] != 0;
      other.pieces[p].position = packing.positions[p];
    }
    const auto like_other = [&](const Layout& known) { return packed_alike(known, other, options.box_aspect == 0); };
    if (like_other(layout) || std::any_of(out.begin(), out.end(), like_other)) continue;
    out.push_back(std::move(other));
  }
  return out;
}

}  // namespace atlas_refine
