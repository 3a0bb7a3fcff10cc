// Images of cuts beside the cuts that there are.
#include "needed/symmetric_cuts.h"

#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

constexpr double kAsLong = 0.1;  // of a cut's length: far from the image of another it is put there where that is hardly longer
constexpr double kNearly = 1;    // times its length: so far, all together, the ends of a cut are from those of the other's image

/// How far the ends are from each other, as a part of the length; `reversed`: the first from the second.
double apart(const CutPlace& a, const CutPlace& b, bool reversed) {
  const int first = reversed ? 1 : 0;
  return ((a.chord.at[0] - b.chord.at[first]).norm() + (a.chord.at[1] - b.chord.at[1 - first]).norm()) / a.chord.length();
}

bool near(const CutPlace& a, const CutPlace& b) {
  return a.chart == b.chart && std::min(apart(a, b, false), apart(a, b, true)) < kNearly;
}

/// The cut made its own image: along the plane or, straight across it, from one of its ends to that one's image.
std::optional<CutPlace> straightened(const CutPlace& cut, const CutPlace& image, std::size_t end, const MirroredCuts& mirrored) {
  if (apart(cut, image, false) < apart(cut, image, true)) return mirrored.along(cut);
  CutPlace out = cut;
  out.chord.ends = {cut.chord.ends[end], image.chord.ends[end]};
  out.chord.at = {cut.chord.at[end], image.chord.at[end]};
  if (out.chord.ends[0] == out.chord.ends[1]) return std::nullopt;
  return out;
}

/// The later cut that best stands for the image of one: the first that is near it, else the one whose length is most alike; their
/// count where there is none.
std::size_t partner_of(const std::vector<CutPlace>& cuts, const std::vector<char>& done, std::size_t one, const CutPlace& image) {
  std::size_t alike = cuts.size();
  const auto apart = [&](std::size_t k) { return std::abs(cuts[k].chord.length() - image.chord.length()); };
  for (std::size_t k = one + 1; k < cuts.size(); ++k) {
    if (done[k]) continue;
    if (near(cuts[k], image)) return k;
    if (alike == cuts.size() || apart(k) < apart(alike)) alike = k;
  }
  return alike;
}

/// `first`: which of two, and which end of one, the others go by.
std::vector<CutPlace> symmetric_set(std::vector<CutPlace> cuts, std::size_t first, const MirroredCuts& mirrored) {
  std::vector<char> done(cuts.size(), 0);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto image = done[i] ? std::nullopt : mirrored.image(cuts[i]);
    if (!image || same(*image, cuts[i])) continue;
    if (near(cuts[i], *image)) {
      if (const auto straight = straightened(cuts[i], *image, first, mirrored)) cuts[i] = *straight;
      continue;
    }
    const std::size_t j = partner_of(cuts, done, i, *image);
    if (j == cuts.size()) continue;
    const auto back = mirrored.image(cuts[j]);
    const bool by_other = first == 1 && back;
    CutPlace& moved = by_other ? cuts[i] : cuts[j];
    const CutPlace& to = by_other ? *back : *image;
    if (!near(moved, to) && to.chord.length() > (1 + kAsLong) * moved.chord.length()) continue;
    moved = to;
    done[j] = 1;
  }
  return cuts;
}

}  // namespace

bool same(const CutPlace& a, const CutPlace& b) {
  const bool straight = a.chord.at[0] == b.chord.at[0] && a.chord.at[1] == b.chord.at[1];
  const bool reversed = a.chord.at[0] == b.chord.at[1] && a.chord.at[1] == b.chord.at[0];
  return a.chart == b.chart && (straight || reversed);
}

int symmetric_count(const std::vector<CutPlace>& cuts, const MirroredCuts& mirrored) {
  return static_cast<int>(std::count_if(cuts.begin(), cuts.end(), [&](const CutPlace& cut) {
    const auto image = mirrored.image(cut);
    return image && std::any_of(cuts.begin(), cuts.end(), [&](const CutPlace& other) { return same(*image, other); });
  }));
}

std::vector<std::vector<CutPlace>> symmetric_sets(const std::vector<CutPlace>& cuts, const MirroredCuts& mirrored) {
  std::vector<std::vector<CutPlace>> out;
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
    std::vector<CutPlace> set = symmetric_set(cuts, first, mirrored);
    if (symmetric_count(set, mirrored) > symmetric_count(cuts, mirrored)) out.push_back(std::move(set));
  }
  return out;
}

}  // namespace atlas_refine
