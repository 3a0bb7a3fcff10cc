// Cuts that are nearly mirror images of each other, made so.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "seams/cut_places.h"

namespace atlas_refine {

struct MirroredCuts {
  std::function<std::optional<CutPlace>(const CutPlace&)> image;  ///< of a cut; nothing where it has none
  std::function<std::optional<CutPlace>(const CutPlace&)> along;  ///< the nearest one that runs along the plane itself
};

/// In whatever sense they run.
bool same(const CutPlace& a, const CutPlace& b);

/// Of the cuts those that have their image, or are it, among them.
int symmetric_count(const std::vector<CutPlace>& cuts, const MirroredCuts& mirrored);

/// Sets of as many cuts, of which more have their image among them: others that lie near it, or are no shorter, are put there.
/// Either half of the surface may be the one that the other goes by.
std::vector<std::vector<CutPlace>> symmetric_sets(const std::vector<CutPlace>& cuts, const MirroredCuts& mirrored);

}  // namespace atlas_refine
