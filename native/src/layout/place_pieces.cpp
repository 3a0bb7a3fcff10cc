// Matching pieces with their places.
#include "layout/place_pieces.h"

#include <array>
#include <map>

#include "atlas_refine/error.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

struct Key {
  int chart;
  std::array<double, 4> box;
  auto operator<=>(const Key&) const = default;
};

Key key_of(int chart, const Box& box) { return {chart, {box.min.x(), box.min.y(), box.max.x(), box.max.y()}}; }

}  // namespace

std::vector<Chart> place_pieces(const Layout& layout, std::vector<Chart> pieces, const std::vector<int>& charts) {
  std::multimap<Key, const PlacedPiece*> places;
  for (const PlacedPiece& place : layout.pieces) places.emplace(key_of(place.chart, place.box), &place);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Box box = uv_box({pieces[p]});
    // Parts of a chart that overlaps itself may have one and the same box: their places are as good for either.
    const auto found = places.find(key_of(charts[p], box));
    if (found == places.end())
      throw RefineError(ErrorCode::NotCertified, "layout",
                        "the cuts of chart " + std::to_string(charts[p]) + " left a piece without a place", charts[p]);
    const PlacedPiece& place = *found->second;
    for (Vec2& uv : pieces[p].uvs) {
      uv = place.quarter_turn ? Vec2(box.max.y() - uv.y(), uv.x() - box.min.x()) : Vec2(uv - box.min);
      uv += place.position;
    }
    places.erase(found);
  }
  return pieces;
}

}  // namespace atlas_refine
