// svg_sink(): one picture per stage, a stretch heat map with chart outlines and the box.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "atlas_refine/debug_sink.h"
#include "atlas_refine/error.h"

namespace atlas_refine {

namespace {

constexpr double kLongSide = 960;  // pixels of the longer side of the box
constexpr double kMargin = 28;
constexpr double kFooter = 78;       // room for the caption and the colour bar
constexpr double kLeastWidth = 560;  // the footer must fit under narrow boxes
constexpr int kUnitsPerPixel = 10;   // coordinates are whole tenths of a pixel
constexpr int kLevels = 32;          // colours of the heat map
constexpr double kLargestStretch = 2;

struct Colour {
  double r, g, b;
};

/// Lightness falls steadily from a cool white through teal, blue and violet to a dark plum.
constexpr std::array<Colour, 7> kColours = {
    {{238, 246, 247}, {183, 224, 220}, {118, 190, 203}, {72, 143, 184}, {72, 92, 158}, {87, 44, 120}, {74, 10, 66}}};

std::string hex(const Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(std::lround(colour.r)) & 255u,
                static_cast<unsigned>(std::lround(colour.g)) & 255u, static_cast<unsigned>(std::lround(colour.b)) & 255u);
  return text;
}

/// Colour at t in [0, 1].
Colour colour_at(double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (kColours.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kColours.size() - 2);
  const double f = at - static_cast<double>(i);
  const Colour &a = kColours[i], &b = kColours[i + 1];
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

/// Stretch is a ratio, so its logarithm is what counts.
double heat(double stretch) { return std::isfinite(stretch) ? std::log(std::max(stretch, 1.0)) / std::log(kLargestStretch) : 1; }

int level_of(double stretch) { return std::clamp(static_cast<int>(heat(stretch) * kLevels), 0, kLevels - 1); }

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

/// Where the picture's parts lie, in pixels.
class Frame {
 public:
  explicit Frame(const AtlasSnapshot& snapshot) : min_(snapshot.box_min), max_(snapshot.box_max) {
    const Vec2 size = max_ - min_;
    const double longest = std::max(size.x(), size.y());
    scale_ = longest > 0 && std::isfinite(longest) ? kLongSide / longest : 1;
    box_width_ = std::isfinite(size.x()) ? size.x() * scale_ : 0;
    box_height_ = std::isfinite(size.y()) ? size.y() * scale_ : 0;
    left_ = (width() - box_width_) / 2;
  }

  double width() const { return std::max(box_width_, kLeastWidth) + 2 * kMargin; }
  double height() const { return box_height_ + 2 * kMargin + kFooter; }
  double left() const { return left_; }
  double box_width() const { return box_width_; }
  double box_height() const { return box_height_; }
  double footer() const { return kMargin + box_height_; }

  /// v points up in the UV plane and down on the page. Whole units of 1 / kUnitsPerPixel pixels.
  std::array<long, 2> page(const Vec2& uv) const {
    return {std::lround((left_ + (uv.x() - min_.x()) * scale_) * kUnitsPerPixel),
            std::lround((kMargin + (max_.y() - uv.y()) * scale_) * kUnitsPerPixel)};
  }

 private:
  Vec2 min_, max_;
  double scale_, box_width_, box_height_, left_;
};

/// A closed polygon in relative coordinates, points that round to the same place left out.
void write_loop(std::ostream& out, const std::vector<std::array<long, 2>>& points) {
  std::array<long, 2> at = points.front();
  out << 'M' << at[0] << ' ' << at[1] << 'l';
  bool first = true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const long dx = points[i][0] - at[0], dy = points[i][1] - at[1];
    if (dx == 0 && dy == 0) continue;
    if (!first && dx >= 0) out << ' ';
    out << dx;
    if (dy >= 0) out << ' ';
    out << dy;
    first = false;
    at = points[i];
  }
  if (first) out << "0 0";
  out << 'z';
}

/// The outlines of a set of triangles: edges that two of them share cancel, the others are chained to closed loops.
class Region {
 public:
  void add(const std::array<int, 3>& triangle) {
    for (int i = 0; i < 3; ++i) edges_.push_back({triangle[i], triangle[(i + 1) % 3]});
  }

  std::vector<std::vector<int>> outlines() {
    cancel_shared_edges();
    std::vector<bool> used(edges_.size(), false);
    std::vector<std::vector<int>> loops;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (used[i]) continue;
      std::vector<int>& loop = loops.emplace_back();
      for (std::size_t e = i; e < edges_.size(); e = unused_from(edges_[e][1], used)) {
        used[e] = true;
        loop.push_back(edges_[e][0]);
      }
    }
    return loops;
  }

 private:
  void cancel_shared_edges() {
    std::sort(edges_.begin(), edges_.end());
    std::vector<std::array<int, 2>> open;
    for (const auto& edge : edges_) {
      if (!std::binary_search(edges_.begin(), edges_.end(), std::array<int, 2>{edge[1], edge[0]})) open.push_back(edge);
    }
    edges_ = std::move(open);
  }

  /// First unused edge that starts at the vertex, or the number of edges.
  std::size_t unused_from(int vertex, const std::vector<bool>& used) const {
    std::size_t e = std::lower_bound(edges_.begin(), edges_.end(), std::array<int, 2>{vertex, -1}) - edges_.begin();
    while (e < edges_.size() && edges_[e][0] == vertex && used[e]) ++e;
    return e < edges_.size() && edges_[e][0] == vertex ? e : edges_.size();
  }

  std::vector<std::array<int, 2>> edges_;
};

class Picture {
 public:
  Picture(const AtlasSnapshot& snapshot, std::ostream& out) : snapshot_(snapshot), out_(out), frame_(snapshot) {}

  void write() {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << frame_.width() << ' ' << frame_.height()
         << "\" width=\"" << frame_.width() << "\" height=\"" << frame_.height()
         << "\" font-family=\"Helvetica, Arial, sans-serif\">\n"
         << "<rect width=\"100%\" height=\"100%\" rx=\"10\" fill=\"#ffffff\"/>\n"
         << "<rect x=\"" << frame_.left() << "\" y=\"" << kMargin << "\" width=\"" << frame_.box_width() << "\" height=\""
         << frame_.box_height() << "\" fill=\"#f4f2ee\"/>\n";
    out_ << "<g transform=\"scale(" << 1.0 / kUnitsPerPixel << ")\" stroke-linejoin=\"round\">\n";
    write_heat_map();
    write_outlines();
    for (const PictureMark& mark : snapshot_.marks) write_mark(mark);
    out_ << "</g>\n<rect x=\"" << frame_.left() << "\" y=\"" << kMargin << "\" width=\"" << frame_.box_width() << "\" height=\""
         << frame_.box_height() << "\" fill=\"none\" stroke=\"#8a8378\" stroke-width=\"1.2\"/>\n";
    write_caption();
    write_colour_bar();
    out_ << "</svg>\n";
  }

 private:
  void write_loops(const std::vector<std::vector<int>>& loops) {
    std::vector<std::array<long, 2>> points;
    for (const std::vector<int>& loop : loops) {
      points.clear();
      for (int v : loop) points.push_back(frame_.page(snapshot_.uvs[v]));
      if (!points.empty()) write_loop(out_, points);
    }
  }

  /// One path for each colour. The thin stroke of the same colour closes the hairlines between neighbouring paths.
  void write_heat_map() {
    std::vector<Region> regions(kLevels);
    for (std::size_t t = 0; t < snapshot_.triangles.size(); ++t) {
      regions[level_of(snapshot_.stretch[t])].add(snapshot_.triangles[t]);
    }
    for (int level = 0; level < kLevels; ++level) {
      const std::vector<std::vector<int>> outlines = regions[level].outlines();
      if (outlines.empty()) continue;
      const std::string colour = hex(colour_at((level + 0.5) / kLevels));
      out_ << "<path fill=\"" << colour << "\" stroke=\"" << colour << "\" stroke-width=\"6\" d=\"";
      write_loops(outlines);
      out_ << "\"/>\n";
    }
  }

  void write_outlines() {
    out_ << "<path fill=\"none\" stroke=\"#27303c\" stroke-width=\"13\" d=\"";
    write_loops(snapshot_.boundary_loops);
    out_ << "\"/>\n";
  }

  void write_mark(const PictureMark& mark) {
    // One colour for each direction; by kind, then by width for lines and by radius for corners.
    static constexpr std::array<std::pair<const char*, int>, 8> kStyles = {{{"#d1495b", 34},
                                                                            {"#2e86ab", 34},
                                                                            {"#edae49", 34},
                                                                            {"#3a7d44", 34},
                                                                            {"#8a8378", 9},
                                                                            {"#d1495b", 30},
                                                                            {"#27303c", 45},
                                                                            {"#d1495b", 60}}};
    const auto& [colour, size] = kStyles[static_cast<std::size_t>(mark.kind)];
    const auto from = frame_.page(mark.from), to = frame_.page(mark.to);
    if (mark.kind >= PictureMark::Kind::ConvexCorner) {
      out_ << "<circle cx=\"" << from[0] << "\" cy=\"" << from[1] << "\" r=\"" << size << "\" fill=\"" << colour << "\"/>\n";
      return;
    }
    out_ << "<path fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"" << size << "\" stroke-linecap=\"round\" d=\"M"
         << from[0] << ' ' << from[1] << 'L' << to[0] << ' ' << to[1] << "\"/>\n";
  }

  void write_caption() {
    const double y = frame_.footer() + 38;
    out_ << "<text x=\"" << kMargin << "\" y=\"" << y << "\" font-size=\"25\" font-weight=\"bold\" fill=\"#27303c\">"
         << escaped(snapshot_.stage) << "</text>\n";
    if (snapshot_.caption.empty()) return;
    out_ << "<text xml:space=\"preserve\" x=\"" << kMargin << "\" y=\"" << y + 30 << "\" font-size=\"20\" fill=\"#5b6470\">"
         << escaped(snapshot_.caption) << "</text>\n";
  }

  void write_colour_bar() {
    const double width = 260, height = 14, x = frame_.width() - kMargin - width, y = frame_.footer() + 24;
    out_ << "<defs><linearGradient id=\"stretch\">";
    for (std::size_t i = 0; i < kColours.size(); ++i) {
      out_ << "<stop offset=\"" << static_cast<double>(i) / (kColours.size() - 1) << "\" stop-color=\"" << hex(kColours[i])
           << "\"/>";
    }
    out_ << "</linearGradient></defs>\n<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << height
         << "\" rx=\"3\" fill=\"url(#stretch)\" stroke=\"#8a8378\" stroke-width=\".8\"/>\n";
    out_ << "<g font-size=\"15\" fill=\"#5b6470\" text-anchor=\"middle\">";
    const std::array<std::pair<double, const char*>, 5> ticks = {
        {{1, "1"}, {1.1, "1.1"}, {1.25, "1.25"}, {1.5, "1.5"}, {2, "2+"}}};
    for (const auto& [stretch, label] : ticks) {
      out_ << "<text x=\"" << x + heat(stretch) * width << "\" y=\"" << y + height + 17 << "\">" << label << "</text>";
    }
    out_ << "</g>\n<text x=\"" << x - 12 << "\" y=\"" << y + 13
         << "\" font-size=\"16\" fill=\"#5b6470\" text-anchor=\"end\">stretch</text>\n";
  }

  const AtlasSnapshot& snapshot_;
  std::ostream& out_;
  Frame frame_;
};

class SvgSink : public DebugSink {
 public:
  explicit SvgSink(std::filesystem::path directory) : directory_(std::move(directory)) {}

  void receive(const AtlasSnapshot& snapshot) override {
    char number[16];
    std::snprintf(number, sizeof number, "%02d-", count_++);
    const std::filesystem::path path = directory_ / (number + snapshot.stage + ".svg");
    std::ofstream file(path, std::ios::binary);
    Picture(snapshot, file).write();
    file.close();
    if (!file) throw RefineError(ErrorCode::BadOption, "svg", "cannot write " + path.string());
  }

 private:
  std::filesystem::path directory_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<DebugSink> svg_sink(const std::filesystem::path& directory) { return std::make_unique<SvgSink>(directory); }

}  // namespace atlas_refine
