// What one call of refine() is asked for. Defaults are what an unattended run should use.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Where new seams may come from. None: charts bend inside a shrinking box (the squeeze), no seam is added. Rectangles: the
/// paper's road; charts become axis-aligned and are cut into rectangles along motorcycle trails (sections 3.1 and 3.2).
enum class Seams { None, Rectangles };

/// What E_d is measured against while it is reduced (section 3.4, "Distortion type"): the surface, or the input's UVs.
enum class Reference { Surface, Input };

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

/// What only Seams::Rectangles reads.
struct RectangleOptions {
  double sigma = 0.004;  ///< eq. (3): width of the boundary smoothing / length of the chart's boundary, in (0, 0.1]
  int candidates = 500;  ///< layouts that are packed and scored, N_motor of section 3.2, in [1, 1000000]
  double omega = 0.1;    ///< eq. (11): what boundary length costs against PE, in [0, 1]
  bool until_input =
      false;  ///< stop as soon as E_d is back at the input's, as the paper does; else go on until the bound stops it
};

struct RefineOptions {
  double pe_bound = 0.80;  ///< in (0, 1); reached or the call throws BoundNotReached
  Seams seams = Seams::None;
  double box_aspect = 0;   ///< width / height of the texture, which [0, 1]^2 stands for; 0 = a free box, 1 = square
  std::optional<Gap> gap;  ///< hard where given; else 0.0025 of the diagonal, reduced only as far as the bound needs
  std::optional<double> max_distortion;  ///< largest E_d allowed, >= 1
  bool relax = false;                    ///< go on to the least distortion under the bound where less would already hold it
  bool best_effort = false;              ///< return the best valid atlas found instead of throwing BoundNotReached
  Density density = Density::Equal;
  Stored stored = Stored::Double;
  RectangleOptions rectangles;
  Reference reference = Reference::Surface;
  std::vector<double> importance;  ///< one weight > 0 per face for its part in E_d (section 4, "Local control"); empty = all 1
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has; the result does not depend on it
};

}  // namespace atlas_refine
