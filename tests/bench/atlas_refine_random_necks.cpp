// What cuts come to that are chosen at random: the same candidates, budget and squeeze as needed seams have, and no choice.
//
//   atlas_refine_random_necks IN.obj PE GROWTH CUTS DRAWS
//
// Each draw cuts across necks of the charts, any of those that there are, until there are CUTS of them or none fits into GROWTH
// of the boundary. Prints one line of JSON: growth, E_d and cuts of each draw that holds the bound.
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "io/mesh_file.h"
#include "needed/cut_trials.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kAll = 1000;  // necks

/// The state with one more cut at some neck that fits; nothing where none does.
std::optional<Trial> with_another(const CutTrials& trials, const Trial& present, double growth, Rng& rng) {
  std::vector<CutPlace> places = trials.places(present, kAll, 0);
  for (std::size_t k = places.size(); k > 0; --k) {
    std::swap(places[k - 1], places[rng.below(static_cast<int>(k))]);
    std::vector<CutPlace> cuts = present.cuts;
    cuts.push_back(places[k - 1]);
    if (present.growth + trials.growth_of(cuts.back()) > growth) continue;
    auto made = trials.forecasts({cuts}, nullptr, {growth}, ProgressRange(0, 1)).front();
    if (made) return made;
  }
  return std::nullopt;
}

Json drawn(CutTrials& trials, const SqueezedTrial& whole, double growth, int cuts, std::uint64_t seed) {
  Rng rng(seed);
  Trial present = whole.trial;
  while (present.cut_count() < cuts) {
    auto next = with_another(trials, present, growth, rng);
    if (!next) break;
    present = std::move(*next);
  }
  double distortion = whole.trial.distortion;
  if (!present.cuts.empty()) {
    const auto squeezed = trials.squeezed(present, ProgressRange(0, 1));
    if (!squeezed) return nullptr;
    distortion = squeezed->trial.distortion;
  }
  return {{"boundary_growth", present.growth}, {"distortion", distortion}, {"cuts", present.cut_count()}};
}

void run(char** arguments) {
  const auto file = io::read_mesh_file(arguments[1]);
  const RefineOptions options{.pe_bound = std::atof(arguments[2]), .seams = Seams::Needed, .threads = 1};
  const InputAtlas input = read_atlas(file->atlas(), options);
  Monitor monitor;
  Journal journal(monitor, nullptr, options.box_aspect);
  const Refinement refinement{input, options, monitor, journal, 1, options};
  CutTrials trials(refinement, ProgressRange(0, 1));
  const SqueezedTrial whole = trials.without_cuts(ProgressRange(0, 1));
  Json out = Json::array();
  for (int seed = 1; seed <= std::atoi(arguments[5]); ++seed) {
    Json draw = drawn(trials, whole, std::atof(arguments[3]), std::atoi(arguments[4]), seed);
    if (!draw.is_null()) out.push_back(std::move(draw));
  }
  std::printf("%s\n", out.dump().c_str());
}

}  // namespace
}  // namespace atlas_refine

int main(int count, char** arguments) {
  if (count != 6) {
    std::fprintf(stderr, "usage: atlas_refine_random_necks IN.obj PE GROWTH CUTS DRAWS\n");
    return 2;
  }
  try {
    atlas_refine::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
