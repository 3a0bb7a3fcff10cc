// Atlas Refine: bring a UV atlas to a packing efficiency bound. This is the library's main entry.
//
//   atlas_refine::RefineOptions options;
//   options.pe_bound = 0.85;
//   auto result = atlas_refine::refine(atlas, options);   // result.corner_uvs replaces atlas.corner_uvs
#pragma once

#include <array>
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
  double sigma = 0.004;      ///< eq. (3): width of the boundary smoothing / length of the chart's boundary, in (0, 0.1]
  int candidates = 500;      ///< layouts that are packed and scored, N_motor of section 3.2, in [1, 1000000]
  double omega = 0.1;        ///< eq. (11): what boundary length costs against PE, in [0, 1]
  bool until_bound = false;  ///< reduce distortion until the bound stops it, not only to the input's E_d (Fig. 13)
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
  RectangleOptions rectangles;
  Reference reference = Reference::Surface;
  std::vector<double> importance;  ///< one weight > 0 per face for its part in E_d (section 4, "Local control"); empty = all 1
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has; the result does not depend on it
};

/// What had to be done: with Seams::None the least of the first three that holds the bound. With Seams::Rectangles charts are
/// cut, unless the atlas holds the bound already or its rectangles need no cut: then it is one of the first three.
enum class Intervention { Unchanged, Moved, Squeezed, Cut };
const char* to_string(Intervention intervention);

struct ChartReport {
  int faces = 0;
  bool mirrored = false;         ///< was turned over
  bool re_embedded = false;      ///< overlapped itself and was embedded anew
  double distortion_before = 0;  ///< E_d of the chart alone at its own best scale
  double distortion_after = 0;
  double stretch_max = 0;  ///< largest stretch max(s1, 1 / s2) after, at the atlas' global scale
};

/// How the paper's road went; only with Intervention::Cut.
struct RectangleReport {
  int tutte_charts = 0;   ///< charts that Tutte's embedding onto a rectangle had to save: the deformation had failed
  int boxed_charts = 0;   ///< charts packed by their bounding box as they were: too few triangles, or no disk
  int holes_cut = 0;      ///< boundary loops that were joined to the outer one
  int extra_corners = 0;  ///< added to each chart because the bound was missed without
  int trails = 0;         ///< that the charts were cut along
  double packed_pe = 0;   ///< of the rectangles, before the distortion was reduced
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// A vertex that was added: a point of one input face, given by three of its corners.
struct NewVertex {
  std::array<int, 3> corners;  ///< input corners, all of one face
  Vec3 weights;                ///< >= 0, sum 1; on an edge of the face the third one is 0
};

/// The mesh after cutting. The input's vertices come first, unchanged; faces that no cut crosses keep their corners, and gain one
/// where a new vertex lies on one of their edges. Faces are ordered by the input face they are part of.
struct CutMesh {
  std::vector<int> face_offsets;              ///< as Atlas::face_offsets
  std::vector<int> corner_vertices;           ///< as Atlas::corner_vertices; input vertices, then new ones
  std::vector<int> face_sources;              ///< one per face: the input face it is part of
  std::vector<NewVertex> new_vertices;        ///< vertex k of them has the index (input vertices + k)
  std::vector<std::array<int, 2>> new_seams;  ///< edges (vertex pairs) that were cut, each once
};

struct RefineResult {
  std::vector<Vec2> corner_uvs;  ///< one per corner of `cut` or, without it, of the input; its own, bit for bit, where Unchanged
  std::optional<CutMesh> cut;    ///< where faces were divided or added seams run: never with Seams::None
  Intervention intervention = Intervention::Unchanged;
  bool bound_met = false;  ///< false only with best_effort
  Measures before;
  Measures after;
  Gap gap;             ///< the gap that is guaranteed in the result
  double price = 0;    ///< lambda: marginal E_d for one unit of log PE at the bound; 0 where it does not bind
  int iterations = 0;  ///< Newton iterations, all stages
  std::vector<ChartReport> charts;
  std::optional<RectangleReport> rectangles;
  std::vector<std::string> repairs;  ///< one line each: what was mended and where
  std::vector<std::string> warnings;
  std::vector<StageTime> timings;
};

/// Brings `atlas` to `options.pe_bound`. With Seams::None only UVs change; faces, corners and their order are the input's.
/// Throws RefineError: BadOption, BadInput, BoundNotReached, NotCertified, Cancelled. Nothing is modified on failure.
/// The UVs of a changed atlas lie in [0, 1]^2, box corner at the origin, longer box side 1.
RefineResult refine(const Atlas& atlas, const RefineOptions& options = {}, const ProgressFn& progress = {},
                    DebugSink* debug = nullptr);

/// The program's version, "major.minor.patch".
const char* version();

}  // namespace atlas_refine
