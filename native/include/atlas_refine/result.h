// What one call of refine() gives back: UVs, divided faces, and what was done and measured.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/measures.h"
#include "atlas_refine/options.h"

namespace atlas_refine {

/// What was done. With Seams::None the least of the first three that holds the bound; with `relax` charts are squeezed, unless
/// the input is at the bound and no less distorted atlas was found. With Seams::Needed the same, or cut. With Seams::Rectangles
/// charts are cut, unless the input is at the bound (as before), no chart needs a cut (a warning says so), or the cuts came to
/// nothing (a fallback says why): then it is one of the first three. Charts that have no corner to cut from and would be crushed
/// are cut as with Seams::Needed (a fallback says so).
enum class Intervention { Unchanged, Moved, Squeezed, Cut };
const char* to_string(Intervention intervention);

/// Why the last optimisation ended.
enum class Ended {
  NotRun,           ///< charts were left as they are or only moved
  AtOptimum,        ///< the objective is at its optimum under the bound
  Enough,           ///< the objective is back at the input's: the paper's stop
  Stalled,          ///< no further progress: there may be a better result
  OutOfIterations,  ///< likewise
  DistortionLimit,  ///< the bound is out of reach within max_distortion or max_stretch
  Stopped,          ///< the callback answered Finish: the best so far, or the input where nothing better was found
};
/// Stable lower-case name ("not_run", "at_optimum", ...), used in reports and in Python.
const char* to_string(Ended ended);

/// What became of a chart of the input.
enum class Fate {
  Refined,  ///< took part: left as it was, moved, bent or cut
  Left,     ///< stays as it is outside the atlas, which may use its place: no UVs with area, or no way to make it valid
  Stacked,  ///< lies on another chart and went with it
  Kept,     ///< only moved, as asked
  Locked,   ///< stayed where it is, as asked
};
/// Stable lower-case name ("refined", ...), used in reports and in Python.
const char* to_string(Fate fate);

/// One chart of the input, in the order of its smallest face, and what became of it.
struct ChartReport {
  int faces = 0;
  double area = 0;           ///< on the surface, model units squared
  bool mirrored = false;     ///< was turned over
  bool re_embedded = false;  ///< overlapped or touched itself and was embedded anew
  Fate fate = Fate::Refined;
  std::string reason;            ///< why it was left; empty for all others
  int stacked_on = -1;           ///< the chart that it went with
  double distortion_before = 0;  ///< E_d of the chart alone at its own best scale
  double distortion_after = 0;
  double stretch_max = 0;  ///< largest stretch max(s1, 1 / s2) after, at the atlas' global scale
  /// Texel density: sqrt(UV area / surface area) of the chart / the same of the whole atlas; 1 = as dense as the atlas.
  double density_before = 0;
  double density_after = 0;
};

/// What was mended in charts before they were refined.
struct Repair {
  std::string what;                ///< in words
  std::vector<int> charts;         ///< of the input
  std::vector<int> faces;          ///< of the input, that were at fault; empty where the charts as a whole were
  double distortion_to_input = 1;  ///< E_2 of the mended charts to the input's UVs, over the faces that were not at fault
};
/// "charts 3, 5: mirrored, turned over"
std::string describe(const Repair& repair);

/// One atlas of several (RefineOptions::groups).
struct GroupReport {
  int group = 0;     ///< its number in RefineOptions::groups
  std::string name;  ///< in RefineOptions::group_names
  int charts = 0;
  Intervention intervention = Intervention::Unchanged;
  bool bound_met = false;
  std::string reason;  ///< why its charts keep the UVs of the input; empty where they are refined
  Measures before, after;
  Gap gap;
};

/// One chart of the output, where charts were cut: a part of a chart of the input.
struct PieceReport {
  int chart = 0;          ///< index into RefineResult::charts
  int faces = 0;          ///< of the output
  double area = 0;        ///< on the surface, model units squared
  double distortion = 0;  ///< E_d of the piece alone at its own best scale
  double stretch_max = 0;
};

/// How the paper's road went; only with Intervention::Cut.
struct RectangleReport {
  int tutte_charts = 0;   ///< charts that Tutte's embedding onto a rectangle had to save: the deformation had failed
  int boxed_charts = 0;   ///< charts packed by their bounding box as they were: not deformed to the axes
  int holes_cut = 0;      ///< boundary loops that were joined to the outer one; with Cut::Edges none
  int extra_corners = 0;  ///< added to each chart because the bound was missed without
  int trails = 0;         ///< that the charts were cut along; with Cut::Edges the trails that paths of edges were sought for
  double packed_pe = 0;   ///< of the rectangles, before the distortion was reduced
};

/// One outcome that the search for cuts came across: no other has both less boundary and less distortion.
struct TradeOff {
  double boundary_growth = 0;  ///< as RefineResult::boundary_growth, of the charts that take part
  double distortion = 0;       ///< E_d
  int cuts = 0;
};

/// How the search for cuts went; only with Seams::Needed, where the input was not good enough as it is.
struct CutReport {
  int cuts = 0;                     ///< from border to border, or to a point inside
  int tried = 0;                    ///< sets of cuts whose outcome was forecast
  std::vector<TradeOff> trade_off;  ///< by growth, the result among them; with several groups empty
  int chosen = -1;                  ///< index into it of the result; -1 where it is empty
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// Processor time of one kind of work, of all threads together.
struct PhaseTime {
  std::string phase;  ///< "order", "factor", "solve", "assemble", "contacts", "line_search", "pack", ..., "other"
  double seconds = 0;
};

/// Where the time of a call went, and how the steps under contact did. It depends on the machine, and nothing else on it.
struct Profile {
  std::vector<PhaseTime> phases;  ///< all of them, always in the same order
  int steps = 0;                  ///< Newton steps under contact: on fine and on coarse charts, forecasts too
  double mean_step = 0;           ///< the mean part of them that was taken; 0 without any
};

/// A vertex that was added: a point of one input face, given by three of its corners.
struct NewVertex {
  std::array<int, 3> corners;  ///< input corners, all of one face
  Vec3 weights;                ///< >= 0, sum 1; on an edge of the face the third one is 0
};

/// The mesh after cutting. The input's vertices come first, unchanged; faces that no cut crosses keep their corners, and gain one
/// where a new vertex lies on one of their edges. Faces are ordered by the input face they are part of.
struct CutMesh {
  std::vector<int> face_offsets;     ///< as Atlas::face_offsets
  std::vector<int> corner_vertices;  ///< as Atlas::corner_vertices; input vertices, then new ones
  std::vector<int> face_sources;     ///< one per face: the input face it is part of
  /// One per corner: the input corners, all of the face that its face is part of, whose weighted mean the corner is; sources
  /// of weight 0 repeat the heaviest. A corner that was one of the input's has it three times, with the weights 1, 0, 0.
  std::vector<std::array<int, 3>> corner_sources;
  std::vector<Vec3> corner_weights;           ///< >= 0, sum 1
  std::vector<NewVertex> new_vertices;        ///< vertex k of them has the index (input vertices + k)
  std::vector<std::array<int, 2>> new_seams;  ///< edges (vertex pairs) that cuts run, or charts were parted, along; each once
};

struct RefineResult {
  std::vector<Vec2> corner_uvs;  ///< one per corner of `cut` or, without it, of the input; its own, bit for bit, where Unchanged
  std::optional<CutMesh> cut;    ///< where faces were divided (Cut::Split); with Seams::None only where a chart was opened so
  /// Edges of the input, as pairs of its vertices, that were cut, or along which what was folded was parted, where no face was
  /// divided (Cut::Edges); each once.
  std::vector<std::array<int, 2>> new_seams;
  Intervention intervention = Intervention::Unchanged;
  /// False only with best_effort or Ended::Stopped, where PE is below the bound or, with Seams::Needed, max_distortion or
  /// max_stretch missed, and where some group of several keeps its UVs because no result of it holds. Else both hold in all that
  /// was refined.
  bool bound_met = false;
  /// Of the charts that take part, stacked ones once. With several groups PE, box and gaps are the least of theirs, distortions
  /// their means by area.
  Measures before;
  Measures after;
  int added_seams =
      0;  ///< edges that were whole in the UV map and are torn: cuts, each part of an edge once, and folds that were parted
  /// What all cuts add to the boundary of the charts on the surface, where both sides of a seam count, as a fraction of it.
  double boundary_growth = 0;
  Triangulations triangulations;  ///< of the result; what was positive under a division in the input still is, else a warning
  Gap gap;                        ///< the gap that is guaranteed in the result; the least of several groups
  double price = 0;               ///< lambda: marginal objective for one unit of log PE at the bound; 0 where it does not bind
  int iterations = 0;             ///< Newton iterations, all stages but for forecasts of cuts
  Ended ended = Ended::NotRun;
  std::vector<ChartReport> charts;  ///< one per chart of the input
  std::vector<int> face_charts;     ///< one per face of the input: index into `charts`
  std::vector<PieceReport> pieces;  ///< one per chart of the output; empty unless Intervention::Cut
  std::optional<RectangleReport> rectangles;
  std::optional<CutReport> cuts;       ///< with Seams::Needed, and rectangles cut across necks instead; sums of several groups
  std::vector<GroupReport> groups;     ///< empty without RefineOptions::groups
  std::vector<Repair> repairs;         ///< what was mended and where
  std::vector<std::string> fallbacks;  ///< one line each: what was tried first, and what was done instead
  std::vector<std::string> warnings;   ///< one line each: what a user should know of the result
  std::vector<StageTime> timings;      ///< in order; what a stage took in several groups or attempts is one sum
  Profile profile;
};

}  // namespace atlas_refine
