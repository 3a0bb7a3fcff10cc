// What came of each atlas of a call, and of all of them together.
#pragma once

#include <optional>
#include <vector>

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "input/take_part.h"
#include "report/journal.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What came of one atlas.
struct Outcome {
  Measures before, after;  ///< but for seams
  SeamCount seams;         ///< after, where not unchanged
  Triangulations triangulations;
  Intervention intervention = Intervention::Unchanged;
  bool bound_met = false;
  std::string reason;  ///< why it is left as it is, though below the bound
  Gap gap;
  double price = 0;
  Ended ended = Ended::NotRun;
  std::optional<RectangleReport> rectangles;
  std::optional<CutReport> cuts;
  std::vector<ChartReport> charts;
  std::vector<PieceReport> pieces;
  CutAtlas atlas;                      ///< empty where unchanged
  std::vector<std::vector<Vec2>> uvs;  ///< of its pieces, as they will be stored
};

/// The outcome of one part of the input.
struct Done {
  Part part;
  Outcome outcome;
};

/// What messages call a group.
std::string name_of(int group, const RefineOptions& options);

/// Fills in all of the result but UVs, faces, seams and what the journal holds.
void summarise(const InputAtlas& whole, const Participants& participants, const RefineOptions& options,
               const std::vector<Done>& done, RefineResult& result);

/// Charts that go with others, that stay as they are, and that overlapped, in words.
void tell_of(const Participants& participants, const std::vector<Done>& done, Journal& journal);

/// Charts that were one, folded, and have come apart, in words; returns along which edges, by the corners of the input that they
/// start from. Halves that lie on each other go together as a stack and stay joined, as do charts that keep their UVs.
std::vector<int> tell_of_folds(const ChartSet& set, const Participants& participants, const std::vector<Done>& done,
                               Journal& journal);

/// The vertices of the edge that starts at a corner.
std::array<int, 2> ends_of_edge(const Atlas& atlas, int corner);

/// Adds the edges that start at these corners of the input to the new seams, as far as cuts have left them whole.
void add_new_seams(const Atlas& input, const std::vector<int>& corners, RefineResult& result);

}  // namespace atlas_refine
