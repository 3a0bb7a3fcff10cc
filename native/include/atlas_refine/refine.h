// Atlas Refine: bring a UV atlas to a packing efficiency bound. This is the library's main entry.
//
//   atlas_refine::RefineOptions options;
//   options.pe_bound = 0.85;
//   auto result = atlas_refine::refine(atlas, options);   // result.corner_uvs replaces atlas.corner_uvs
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/atlas.h"
#include "atlas_refine/debug_sink.h"
#include "atlas_refine/error.h"
#include "atlas_refine/measures.h"
#include "atlas_refine/progress.h"

namespace atlas_refine {

/// Where new seams may come from. None: charts bend inside a shrinking box (the squeeze), no seam is added.
enum class Seams { None };

/// Which relative scale the charts get. Equal: one texel density for the whole surface, as eq. (9) measures E_d.
/// Keep: each chart keeps the scale it has in the input.
enum class Density { Equal, Keep };

/// The number format the caller will store; the certificate is made on values rounded to it.
enum class Stored { Double, Float32 };

/// The guaranteed smallest distance between two charts.
struct Gap {
  enum class Unit { BoxDiagonal, LongSide };
  double value = 0.0025;          ///< fraction of the unit, in [0, 0.1]
  Unit unit = Unit::BoxDiagonal;  ///< the paper's padding unit; LongSide fits "N texels of a texture of S": N / S

  /// Absolute length for a box of these sides.
  double length(const Vec2& box) const { return value * (unit == Unit::BoxDiagonal ? box.norm() : box.maxCoeff()); }
};

struct RefineOptions {
  double pe_bound = 0.80;  ///< in (0, 1); reached or the call throws BoundNotReached
  Seams seams = Seams::None;
  double box_aspect = 0;   ///< width / height of the output box; 0 = free, 1 = square
  std::optional<Gap> gap;  ///< hard where given; else 0.0025 of the diagonal, reduced only as far as the bound needs
  std::optional<double> max_distortion;  ///< largest E_d allowed, >= 1
  bool best_effort = false;              ///< return the best valid atlas found instead of throwing BoundNotReached
  Density density = Density::Equal;
  Stored stored = Stored::Double;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has; the result does not depend on it
};

/// What had to be done, the least of these that holds the bound.
enum class Intervention { Unchanged, Moved, Squeezed };
const char* to_string(Intervention intervention);

struct ChartReport {
  int faces = 0;
  bool mirrored = false;         ///< was turned over
  bool re_embedded = false;      ///< overlapped itself and was embedded anew
  double distortion_before = 0;  ///< E_d of the chart alone at its own best scale
  double distortion_after = 0;
  double stretch_max = 0;  ///< largest stretch max(s1, 1 / s2) after, at the atlas' global scale
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

struct RefineResult {
  std::vector<Vec2> corner_uvs;  ///< as Atlas::corner_uvs; the input's own values, bit for bit, where Unchanged
  Intervention intervention = Intervention::Unchanged;
  bool bound_met = false;  ///< false only with best_effort
  Measures before;
  Measures after;
  Gap gap;             ///< the gap that is guaranteed in the result
  double price = 0;    ///< lambda: marginal E_d for one unit of log PE at the bound; 0 where it does not bind
  int iterations = 0;  ///< Newton iterations, all stages
  std::vector<ChartReport> charts;
  std::vector<std::string> repairs;  ///< one line each: what was mended and where
  std::vector<std::string> warnings;
  std::vector<StageTime> timings;
};

/// Brings `atlas` to `options.pe_bound`. Only UVs change; faces, corners and their order are the input's.
/// Throws RefineError: BadOption, BadInput, BoundNotReached, NotCertified, Cancelled. Nothing is modified on failure.
/// The UVs of a changed atlas lie in [0, 1]^2, box corner at the origin, longer box side 1.
RefineResult refine(const Atlas& atlas, const RefineOptions& options = {}, const ProgressFn& progress = {},
                    DebugSink* debug = nullptr);

/// The program's version, "major.minor.patch".
const char* version();

}  // namespace atlas_refine
