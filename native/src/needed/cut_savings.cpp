// Rates of what outlines tell, and of what is near a cut, each with a prior.
#include "needed/cut_savings.h"

#include <algorithm>
#include <cmath>

#include "needed/symmetric_cuts.h"

namespace atlas_refine {
namespace {

// What a cut saves beside others of what it saved by itself, before any was forecast beside others; that counts as so much of
// the logarithm.
constexpr double kInherited = 0.8, kPrior = 3;
constexpr double kLikelyShare = 0.15;   // of the distortion near a cut that relaxes, before any was forecast
constexpr double kMostShare = 0.9;      // of all distortion that one cut may release
constexpr double kPriorStrain = 0.005;  // of E_d, that outlines tell; what they have told counts more from then on
constexpr double kPriorNear = 0.2;      // the same of distortion near cuts, as a part of all
constexpr double kPriorFreed = 0.2;     // and of what holes cost that are opened, which is thought to go

}  // namespace

bool has(const std::vector<CutPlace>& cuts, const CutPlace& place) {
  return std::any_of(cuts.begin(), cuts.end(), [&](const CutPlace& cut) { return same(cut, place); });
}

bool same(const std::vector<CutPlace>& a, const std::vector<CutPlace>& b) {
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const CutPlace& cut) { return has(b, cut); });
}

bool has_any(const std::vector<std::vector<CutPlace>>& sets, const std::vector<CutPlace>& cuts) {
  return std::any_of(sets.begin(), sets.end(), [&](const auto& other) { return same(other, cuts); });
}

void Savings::learn(const CutPlace& place, double before, double less_strain, double foreseen, double gain) {
  const double saved = std::max(0.0, 1 - std::exp(-gain));
  if (place.opens_hole()) {
    freeable_ += place.freed / std::exp(before);
    freed_ += saved;
  } else if (less_strain > 0) {
    strain_ += less_strain;
    for_strain_ += std::exp(before) * saved;
  } else {
    near_ += place.released / std::exp(before);
    relaxed_ += saved;
  }
  if (foreseen > 0 && !place.opens_hole()) {
    foreseen_ += foreseen;
    came_ += std::max(0.0, gain);
  }
  const auto known = find(place);
  if (known == known_.end()) {
    known_.push_back({place, gain});
  } else {
    known_[known - known_.begin()].gain = gain;
  }
}

double Savings::foresee(const CutPlace& place, double less_strain, double before) const {
  const auto known = find(place);
  if (known != known_.end() && less_strain == 0) return known->gain;
  const double near = place.opens_hole() ? (kPriorFreed + freed_) / (kPriorFreed + freeable_) * place.freed
                                         : (kPriorNear * kLikelyShare + relaxed_) / (kPriorNear + near_) * place.released;
  const double packed = (kPriorStrain + for_strain_) / (kPriorStrain + strain_) * std::max(0.0, less_strain);
  return -std::log(1 - std::min(kMostShare, (near + packed) / std::exp(before)));
}

double Savings::faith() const { return (kPrior * kInherited + came_) / (kPrior + foreseen_); }

void Savings::add_useful(std::vector<CutPlace>& places) const {
  for (const Saving& saving : known_) {
    if (saving.gain > kLeastGain && !has(places, saving.place)) places.push_back(saving.place);
  }
}

std::vector<Savings::Saving>::const_iterator Savings::find(const CutPlace& place) const {
  return std::find_if(known_.begin(), known_.end(), [&](const Saving& s) { return same(s.place, place); });
}

}  // namespace atlas_refine
