// Two squares that lie far apart in the UV map are brought to a packing efficiency of 0.9.
#include <atlas_refine/refine.h>

#include <iostream>

int main() {
  atlas_refine::Atlas atlas;
  atlas.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}};
  atlas.face_offsets = {0, 4, 8};
  atlas.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
  atlas.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {7, 7}, {8, 7}, {8, 8}, {7, 8}};
  atlas_refine::RefineOptions options;
  options.pe_bound = 0.9;
  try {
    const atlas_refine::RefineResult result = atlas_refine::refine(atlas, options);
    std::cout << to_string(result.intervention) << ": PE " << result.before.pe << " -> " << result.after.pe << "\n";
  } catch (const atlas_refine::RefineError& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
