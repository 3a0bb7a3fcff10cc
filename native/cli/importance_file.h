// Files of one number for each face: those of --importance, --keep-shape and --locked.
#pragma once

#include <filesystem>
#include <vector>

namespace atlas_refine::cli {

/// Positive numbers separated by blanks or line ends, as many as there are faces. Throws io::InputError that names the line.
std::vector<double> read_importance(const std::filesystem::path& path, int face_count);
/// The same, with numbers that are 0 or 1.
std::vector<char> read_flags(const std::filesystem::path& path, int face_count);

}  // namespace atlas_refine::cli
