// Densities against their mean.
#include "reduce/kept_density.h"

#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

/// The largest UV area for the wanted one: charts count in the mean by what they are to be, so that those that grow do not move
/// it.
double most_growth(const std::vector<double>& areas, const std::vector<double>& wanted) {
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    sum += std::sqrt(std::max(0.0, areas[c]) * wanted[c]);  // wanted * density; scraps have areas by rounding only
    count += wanted[c];
  }
  const double mean = count > 0 ? sum / count : 0;
  return kMostDense * kMostDense * mean * mean;
}

}  // namespace

double used_by_outgrown(const std::vector<double>& areas, const std::vector<double>& wanted) {
  const double most = most_growth(areas, wanted);
  double beyond = 0, sum = 0;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (wanted[c] == 0) continue;
    beyond += std::max(0.0, areas[c] - most * wanted[c]);
    sum += areas[c];
  }
  return sum > 0 ? beyond / (kMostOutgrown * sum) : 0;
}

std::vector<int> outgrown_charts(const std::vector<double>& areas, const std::vector<double>& wanted) {
  const double most = most_growth(areas, wanted);
  std::vector<int> out;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (wanted[c] > 0 && areas[c] > most * wanted[c]) out.push_back(static_cast<int>(c));
  }
  return out;
}

}  // namespace atlas_refine
