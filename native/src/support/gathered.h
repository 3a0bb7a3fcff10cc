// Parallel loops whose results are joined in the order of the indices: the same on any number of threads.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "support/parallel.h"
#include "support/thread_pool.h"

namespace atlas_refine {

/// What body(begin, end, out) adds to `out` for ranges that cover [0, count), in ascending order. On the threads of the pool, in
/// the calling one alone where there are fewer than twice the `grain`.
template <class Value, class Body>
std::vector<Value> gathered(int count, int grain, Body&& body) {
  constexpr int kPartsPerThread = 4;
  const int threads = present_threads();
  const int parts = threads > 1 ? std::clamp(count / grain, 1, kPartsPerThread * threads) : 1;
  std::vector<std::vector<Value>> of_part(parts);
  if (parts == 1) {
    body(0, count, of_part[0]);
    return std::move(of_part[0]);
  }
  parallel_ranges(parts, threads, 1, [&](int first, int last) {
    const auto begin_of = [&](int part) { return static_cast<int>(static_cast<long long>(count) * part / parts); };
    for (int part = first; part < last; ++part) body(begin_of(part), begin_of(part + 1), of_part[part]);
  });
  for (int part = 1; part < parts; ++part) of_part[0].insert(of_part[0].end(), of_part[part].begin(), of_part[part].end());
  return std::move(of_part[0]);
}

/// The least of `most` and of body(begin, end) for ranges that cover [0, count).
template <class Body>
double least_of(int count, int grain, double most, Body&& body) {
  const auto add = [&](int begin, int end, std::vector<double>& out) { out.push_back(body(begin, end)); };
  for (const double own : gathered<double>(count, grain, add)) most = std::min(most, own);
  return most;
}

}  // namespace atlas_refine
