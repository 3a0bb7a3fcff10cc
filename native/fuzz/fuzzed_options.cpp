// Every option, at values that matter.
#include "fuzzed_options.h"

#include <array>
#include <sstream>

namespace atlas_refine::fuzz {

namespace {

std::vector<char> flags(FuzzedDataProvider& data, int count) {
  std::vector<char> out;
  for (int f = 0; f < count; ++f) out.push_back(data.ConsumeIntegralInRange(0, 3) == 0);
  return out;
}

std::vector<std::array<int, 2>> edges(FuzzedDataProvider& data, const Atlas& atlas) {
  std::vector<std::array<int, 2>> out;
  for (int k = data.ConsumeIntegralInRange(0, 4); k > 0; --k) {
    const int face = data.ConsumeIntegralInRange(0, atlas.face_count() - 1);
    const int first = atlas.face_offsets[face];
    out.push_back({atlas.corner_vertices[first], atlas.corner_vertices[first + 1]});
  }
  return out;
}

void choose_faces(FuzzedDataProvider& data, const Atlas& atlas, RefineOptions& options) {
  const int faces = atlas.face_count();
  if (data.ConsumeIntegralInRange(0, 5) == 0) options.keep_shape = flags(data, faces);
  if (data.ConsumeIntegralInRange(0, 5) == 0) options.locked = flags(data, faces);
  if (data.ConsumeIntegralInRange(0, 5) == 0) {
    for (int f = 0; f < faces; ++f) options.groups.push_back(data.ConsumeIntegralInRange(0, 2));
  }
  if (data.ConsumeIntegralInRange(0, 5) == 0) {
    for (int f = 0; f < faces; ++f) options.importance.push_back(data.ConsumeBool() ? 1 : 100);
  }
  options.no_seam = edges(data, atlas);
  options.prefer_seam = edges(data, atlas);
}

void choose_cuts(FuzzedDataProvider& data, RefineOptions& options) {
  options.seams = data.PickValueInArray({Seams::None, Seams::Needed, Seams::Rectangles});
  options.effort = Effort::Fast;
  options.seam_cost = data.PickValueInArray({0.0, 0.1});
  if (data.ConsumeBool()) options.max_boundary_growth = data.PickValueInArray({0.0, 0.2});
  options.cut = data.ConsumeBool() ? Cut::Edges : Cut::Split;
  options.open_closed = data.ConsumeBool();
  options.triangulate = data.ConsumeBool();
  RectangleOptions& rectangles = options.rectangles;
  rectangles.sigma = data.PickValueInArray({0.001, 0.004, 0.02, 0.1});
  rectangles.candidates = data.ConsumeIntegralInRange(1, 20);
  rectangles.omega = data.PickValueInArray({0.0, 0.1, 1.0});
  rectangles.until_input = data.ConsumeBool();
}

/// What the Blender add-on asks for: a texture, a size in it, tiles.
void choose_textures(FuzzedDataProvider& data, RefineOptions& options) {
  options.in_texture = data.ConsumeBool();
  if (data.ConsumeIntegralInRange(0, 3) == 0) options.uv_density = data.PickValueInArray({1e-6, 0.05, 0.5, 100.0});
  if (options.groups.empty()) return;
  if (data.ConsumeBool()) options.group_origins = {Vec2(0, 0), Vec2(1, 0), Vec2(9, 98)};
  if (data.ConsumeIntegralInRange(0, 3) == 0) options.group_aspects = {1.0, 0.5};
  if (options.gap && data.ConsumeIntegralInRange(0, 3) == 0) options.group_gaps = {0.0, 0.01};
  if (options.uv_density > 0 && data.ConsumeBool()) options.group_densities = {0.1, 0.0};
}

}  // namespace

RefineOptions fuzzed_options(FuzzedDataProvider& data, const Atlas& atlas) {
  RefineOptions options{.threads = 1};
  options.pe_bound = data.PickValueInArray({0.05, 0.5, 0.8, 0.9, 0.99});
  options.box_aspect = data.PickValueInArray({0.0, 0.0, 1.0, 2.0, 0.01, 100.0});
  if (data.ConsumeBool()) options.gap = Gap{.value = data.PickValueInArray({0.0, 1e-9, 0.002, 0.02, 0.1})};
  if (options.gap && data.ConsumeBool()) options.gap->unit = Gap::Unit::LongSide;
  if (data.ConsumeIntegralInRange(0, 3) == 0) options.max_distortion = data.PickValueInArray({1.0, 1.01, 1.2, 10.0});
  if (data.ConsumeIntegralInRange(0, 7) == 0) options.max_stretch = data.PickValueInArray({1.0, 1.1, 2.0});
  options.relax = data.ConsumeBool();
  options.best_effort = data.ConsumeBool();
  options.density = data.ConsumeBool() ? Density::Keep : Density::Equal;
  options.stored = data.ConsumeBool() ? Stored::Float32 : Stored::Double;
  options.reference = data.ConsumeBool() ? Reference::Input : Reference::Surface;
  options.stacks = data.ConsumeBool() ? Stacks::Separate : Stacks::Keep;
  options.collapsed = data.ConsumeBool() ? Collapsed::Embed : Collapsed::Leave;
  options.rotate = data.PickValueInArray({Rotate::Any, Rotate::QuarterTurns, Rotate::None});
  options.align_axes = data.ConsumeBool();
  choose_cuts(data, options);
  choose_faces(data, atlas, options);
  choose_textures(data, options);
  return options;
}

std::string words(const RefineOptions& options) {
  std::ostringstream out;
  const auto flag = [&](bool set, const char* name) { out << (set ? std::string(" ") + name : ""); };
  const RectangleOptions& rectangles = options.rectangles;
  out << "--pe-bound " << options.pe_bound << " --aspect " << options.box_aspect;
  if (options.gap) out << " --gap " << options.gap->value;
  flag(options.gap && options.gap->unit == Gap::Unit::LongSide, "(of the long side)");
  if (options.max_distortion) out << " --max-distortion " << *options.max_distortion;
  if (options.max_stretch) out << " --max-stretch " << *options.max_stretch;
  flag(options.relax, "--relax");
  flag(options.best_effort, "--best-effort");
  flag(options.density == Density::Keep, "--density keep");
  flag(options.stored == Stored::Float32, "(float32)");
  flag(options.reference == Reference::Input, "--reference input");
  flag(options.stacks == Stacks::Separate, "--stacks separate");
  flag(options.collapsed == Collapsed::Embed, "--collapsed embed");
  flag(options.rotate == Rotate::QuarterTurns, "--rotate 90");
  flag(options.rotate == Rotate::None, "--rotate none");
  flag(options.align_axes, "--align-axes");
  flag(options.seams == Seams::Rectangles, "--seams rectangles");
  flag(options.seams == Seams::Needed, "--seams needed --effort fast");
  out << " --seam-cost " << options.seam_cost;
  if (options.max_boundary_growth) out << " --max-boundary-growth " << *options.max_boundary_growth;
  flag(options.cut == Cut::Edges, "--cut edges");
  flag(options.open_closed, "--open-closed");
  flag(options.triangulate, "--triangulate");
  flag(rectangles.until_input, "--until-input");
  out << " --sigma " << rectangles.sigma << " --candidates " << rectangles.candidates << " --omega " << rectangles.omega;
  const auto list = [&](const char* name, const auto& values) {
    if (values.empty()) return;
    out << ' ' << name;
    for (const auto& value : values) out << ' ' << static_cast<double>(value);
  };
  flag(options.in_texture, "(in the texture)");
  if (options.uv_density > 0) out << " (UV density " << options.uv_density << ')';
  list("(groups)", options.groups);
  for (const Vec2& corner : options.group_origins) out << " (tile " << corner.x() << ' ' << corner.y() << ')';
  list("(aspects of groups)", options.group_aspects);
  list("(gaps of groups)", options.group_gaps);
  list("(densities of groups)", options.group_densities);
  list("(keep shape)", options.keep_shape);
  list("(locked)", options.locked);
  list("(importance)", options.importance);
  for (const auto& [a, b] : options.no_seam) out << " (no seam " << a << ' ' << b << ')';
  for (const auto& [a, b] : options.prefer_seam) out << " (prefer seam " << a << ' ' << b << ')';
  return out.str();
}

}  // namespace atlas_refine::fuzz
