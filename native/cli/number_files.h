// Files of numbers: one for each face (--importance, --keep-shape, --locked), or two for each edge (--no-seam, --prefer-seam).
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace atlas_refine::cli {

/// Positive numbers separated by blanks or line ends, as many as there are faces. Throws io::InputError that names the line.
std::vector<double> read_importance(const std::filesystem::path& path, int face_count);
/// The same, with numbers that are 0 or 1.
std::vector<char> read_flags(const std::filesystem::path& path, int face_count);
/// Pairs of vertices, which count from 0; as many as there are.
std::vector<std::array<int, 2>> read_edges(const std::filesystem::path& path, int vertex_count);

}  // namespace atlas_refine::cli
