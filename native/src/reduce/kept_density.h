// Charts that are to keep their texel densities, and how much of a packing they only hold by growing out of them.
#pragma once

#include <vector>

namespace atlas_refine {

/// A chart has outgrown its density where it is more than so many times as dense as all charts are in the mean.
inline constexpr double kMostDense = 1.5;
/// The part of the charts' area that may be held by what charts have beyond that. What does not bend costs only so much for each
/// texel, however large it grows: beside long stiff charts a few small ones would fill the box up to any bound. A lone one that
/// fills a void where hundreds jam is not what holds a bound: native/README.md has what files have.
inline constexpr double kMostOutgrown = 0.02;

/// That part as a part of its limit: above 1 it is exceeded. UV areas of charts as they are, and as they are to be, in whatever
/// units; charts that are to have none do not count.
double used_by_outgrown(const std::vector<double>& areas, const std::vector<double>& wanted);

/// The charts that have outgrown their density.
std::vector<int> outgrown_charts(const std::vector<double>& areas, const std::vector<double>& wanted);

}  // namespace atlas_refine
