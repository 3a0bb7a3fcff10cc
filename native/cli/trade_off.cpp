// CSV and SVG of the trade-offs.
#include "trade_off.h"

#include <algorithm>
#include <cstdio>

namespace atlas_refine::cli {
namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
  char line[512];
  std::snprintf(line, sizeof line, format, args...);
  return line;
}

struct Point {
  double x, y;
  bool chosen = false;
};

constexpr double kWidth = 320, kHeight = 240;  // of one diagram, without its margins
constexpr int kTicks = 4;

/// A diagram with axes, ticks and one curve; its left lower corner is at (left, bottom).
std::string diagram(double left, double bottom, const std::string& title, const std::string& x_name, double x_factor,
                    const std::vector<Point>& points) {
  const auto by_x = [](const Point& a, const Point& b) { return a.x < b.x; };
  const auto by_y = [](const Point& a, const Point& b) { return a.y < b.y; };
  const auto [x0, x1] = std::minmax_element(points.begin(), points.end(), by_x);
  const auto [y0, y1] = std::minmax_element(points.begin(), points.end(), by_y);
  const double x_span = std::max(1e-9, x1->x - x0->x), y_span = std::max(1e-9, y1->y - y0->y);
  const auto x = [&, low = x0->x](double value) { return left + kWidth * (value - low) / x_span; };
  const auto y = [&, low = y0->y](double value) { return bottom - kHeight * (value - low) / y_span; };
  std::string out = print("<text x='%.1f' y='%.1f' class='title'>%s</text>\n", left, bottom - kHeight - 18, title.c_str());
  for (int k = 0; k <= kTicks; ++k) {
    const double at_x = x0->x + x_span * k / kTicks, at_y = y0->y + y_span * k / kTicks;
    out += print("<text x='%.1f' y='%.1f' text-anchor='middle'>%.1f</text>\n", x(at_x), bottom + 16, x_factor * at_x);
    out += print("<text x='%.1f' y='%.1f' text-anchor='end'>%.4f</text>\n", left - 6, y(at_y) + 4, at_y);
    out += print("<path d='M%.1f %.1fh%.1f' class='grid'/>\n", left, y(at_y), kWidth);
  }
  out += print("<text x='%.1f' y='%.1f' text-anchor='middle'>%s</text>\n", left + kWidth / 2, bottom + 34, x_name.c_str());
  out += "<path class='curve' d='";
  for (std::size_t k = 0; k < points.size(); ++k) out += print("%s%.1f %.1f", k == 0 ? "M" : "L", x(points[k].x), y(points[k].y));
  out += "'/>\n";
  for (const Point& p : points)
    out += print("<circle cx='%.1f' cy='%.1f' r='%d'%s/>\n", x(p.x), y(p.y), p.chosen ? 6 : 3, p.chosen ? " class='chosen'" : "");
  return out;
}

}  // namespace

std::string trade_off_csv(double pe_bound, const std::vector<TradeOff>& seams, const std::vector<PackingPoint>& packing) {
  std::string out = "kind,pe,boundary_growth,distortion,cuts\n";
  for (const TradeOff& t : seams) out += print("seams,%.4f,%.6f,%.6f,%d\n", pe_bound, t.boundary_growth, t.distortion, t.cuts);
  for (const PackingPoint& p : packing) out += print("packing,%.4f,0,%.6f,0\n", p.pe, p.distortion);
  return out;
}

std::string trade_off_svg(double pe_bound, const std::vector<TradeOff>& seams, const std::vector<PackingPoint>& packing,
                          int chosen) {
  std::vector<Point> of_seams, of_packing;
  for (int k = 0; k < static_cast<int>(seams.size()); ++k)
    of_seams.push_back({seams[k].boundary_growth, seams[k].distortion, k == chosen});
  for (const PackingPoint& p : packing) of_packing.push_back({p.pe, p.distortion});
  const double left = 70, bottom = kHeight + 50, apart = kWidth + 110;
  std::string out = print(
      "<svg xmlns='http://www.w3.org/2000/svg' width='%.0f' height='%.0f' font-family='sans-serif' font-size='11'>\n"
      "<style>.title{font-size:14px;font-weight:bold}.grid{stroke:#ddd}.curve{fill:none;stroke:#2b6a99;stroke-width:1.5}"
      "circle{fill:#2b6a99}circle.chosen{fill:#c0392b}</style>\n<rect width='100%%' height='100%%' fill='white'/>\n",
      2 * apart, bottom + 50);
  if (!of_seams.empty())
    out += diagram(left, bottom, print("E_d at a packing efficiency of %.2f", pe_bound), "boundary growth, %", 100, of_seams);
  if (!of_packing.empty()) out += diagram(left + apart, bottom, "E_d without cuts", "packing efficiency, %", 100, of_packing);
  return out + "</svg>\n";
}

}  // namespace atlas_refine::cli
