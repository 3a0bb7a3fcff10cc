// Rest shapes from the input's UVs, and importance.
#include "reduce/reference.h"

#include <cmath>

#include "geometry/rest_triangle.h"
#include "measure/distortion.h"

namespace atlas_refine {

void set_reference(std::vector<Chart>& charts, Reference reference, const std::vector<double>& importance) {
  double surface = 0;
  for (const Chart& chart : charts) {
    for (const RestTriangle& rest : chart.rest) surface += rest.area;
  }
  const double scale = std::sqrt(surface / uv_area(charts));
  for (Chart& chart : charts) {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      if (reference == Reference::Input) {
        const RestTriangle rest = rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], scale);
        if (rest.area > 0) chart.rest[t] = rest;
      }
      if (!importance.empty()) chart.rest[t].area *= importance[chart.triangle_faces[t]];
    }
  }
}

}  // namespace atlas_refine
