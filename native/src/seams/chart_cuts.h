// Cuts on one chart, each from border to border or to a point inside, added one after the other.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "atlas_refine/options.h"
#include "cut/cut_atlas.h"
#include "cut/side_prices.h"
#include "seams/chords.h"

namespace atlas_refine {

class ChartCuts {
 public:
  /// `piece`: a whole chart as repaired; `chart`: that of the input, whose surface it has. Both must outlive this.
  ChartCuts(const Piece& piece, const Chart& chart, const SidePrices& prices, Cut cut);

  /// Cuts near the chord: straight across triangles, which are divided, or along edges of faces; along edges wherever they lead,
  /// where it is on_surface. False, and nothing is changed, where no way leads there. Ends are numbers of border().
  bool add(const Chord& chord);

  /// The border that all cuts leave, numbered by the vertices of mesh(). Where faces may be divided, ends of cuts may also lie
  /// inside long edges of the chart's border: such places have negative numbers, and are vertices only once a cut ends there.
  Border border() const;
  /// How far each loop of border() turns left on the surface, in radians: there as in the UVs, 2 pi around the outside and -2 pi
  /// around a hole, where the surface can be laid flat there.
  std::vector<double> turns() const;
  /// With Cut::Edges, from each hole the way to another loop of border() that is shortest on the surface, however far it leads
  /// through the UVs.
  std::vector<Chord> ways_from_holes() const;
  /// Where on the chart a number of border() lies.
  Support support_of(int number) const;
  /// Whether cuts have made vertices on the chart's border.
  bool divides_border() const;
  /// Divided where cuts cross it, still whole.
  const SplitMesh& mesh() const { return mesh_; }
  const std::vector<std::vector<int>>& paths() const { return paths_; }
  /// Of the cuts, on the surface.
  double length() const;
  /// The same, each edge by its price; with Cut::Edges only.
  double cost() const;
  /// The smallest of the parts that the cuts leave, on the surface.
  double smallest_part() const;

 private:
  /// A place inside an edge of the chart's border; those of one edge follow each other.
  struct Place {
    int from, to;  ///< of the chart
    double along;
    Vec2 at;
    int vertex = -1;  ///< of the mesh, where a cut ends there
  };

  static bool on_one_edge(const Place& a, const Place& b) { return a.from == b.from && a.to == b.to; }
  void find_places();
  std::map<std::pair<int, int>, std::vector<int>> free_places() const;
  bool is_known(int number, const Vec2& at) const;
  int vertex_at(int number);
  bool cut_between(const Chord& chord);
  std::vector<int> straight(const Chord& chord);
  std::vector<int> along_edges(const Chord& chord) const;
  std::vector<int> crossing(int vertex, const Vec2& target, int end, double most_aside);
  bool is_cut(int p, int q) const;
  double length_on_surface(const Side& side) const;
  double price_on_surface(const Side& side) const;
  std::vector<Side> cut_sides() const;

  const Chart& chart_;
  const SidePrices& prices_;
  Cut cut_;
  SplitMesh mesh_;
  std::vector<Place> places_;
  std::vector<char> on_border_;  // per vertex of the mesh
  std::vector<std::vector<int>> paths_;
};

}  // namespace atlas_refine
