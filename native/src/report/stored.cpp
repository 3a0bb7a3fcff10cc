// From a layout to the numbers that are stored.
#include "report/stored.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/certificate.h"
#include "measure/distortion.h"
#include "report/measure_atlas.h"
#include "report/texture.h"

namespace atlas_refine {

Vec2 as_stored(const Vec2& uv, Stored stored) {
  if (stored == Stored::Double) return uv;
  // GCC 12 drops the plain round trip where it vectorises two of them.
  volatile float u = static_cast<float>(uv.x()), v = static_cast<float>(uv.y());
  return {u, v};
}

namespace {

/// UVs for each unit of the pieces: the box fills the texture, unless they are to have a size that is smaller.
Vec2 sides_of_unit(const std::vector<Chart>& pieces, const Vec2& box, const RefineOptions& options) {
  const double asked = options.uv_density, own = asked > 0 ? texel_density(pieces) : 0;
  if (options.box_aspect == 0) return Vec2::Constant(asked > 0 ? own / asked : box.maxCoeff());
  const double height = 1 - 2 * border_of(options);
  return box * std::max(1.0, asked > 0 ? own * height / (asked * box.y()) : 0.0);
}

}  // namespace

std::vector<std::vector<Vec2>> stored_uvs(const std::vector<Chart>& pieces, const Vec2& frame, const Vec2& origin,
                                          const RefineOptions& options) {
  const double aspect = options.box_aspect, border = border_of(options);
  const Vec2 corner = aspect > 0 ? Vec2(border / aspect, border) : Vec2(Vec2::Zero()), part = 1 - 2 * corner.array();
  const Box box = frame.x() > 0 ? Box{Vec2::Zero(), frame} : box_of_aspect(uv_box(pieces), aspect * part.x() / part.y());
  const Vec2 sides = sides_of_unit(pieces, box.size(), options);
  const double most = options.uv_density > 0 && aspect == 0 ? std::numeric_limits<double>::infinity() : 1.0;
  std::vector<std::vector<Vec2>> out;
  for (const Chart& piece : pieces) {
    std::vector<Vec2>& uvs = out.emplace_back();
    for (const Vec2& p : piece.uvs) {
      const Vec2 within = (p - box.min).cwiseQuotient(sides).cwiseMin(most);
      const Vec2 uv = origin + corner + within.cwiseProduct(part);
      uvs.push_back(as_stored(uv, options.stored));
    }
  }
  return out;
}

std::optional<Chart> broken_as_stored(const Chart& chart, const std::vector<int>& points, std::vector<Vec2> stored,
                                      double box_aspect) {
  Chart out = chart;
  out.uvs = std::move(stored);
  if (certify_charts({out}, {points}).valid()) return std::nullopt;
  std::vector<Chart> one = {std::move(out)};
  stretch_to_texture(one, box_aspect);
  const double scale = std::sqrt(uv_area(chart) / uv_area(one[0]));
  for (Vec2& uv : one[0].uvs) uv *= scale;
  return one[0];
}

}  // namespace atlas_refine
