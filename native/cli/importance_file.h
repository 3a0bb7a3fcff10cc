// The file of --importance: one positive number for each face.
#pragma once

#include <filesystem>
#include <vector>

namespace atlas_refine::cli {

/// Numbers separated by blanks or line ends, as many as there are faces. Throws io::InputError that names the line.
std::vector<double> read_importance(const std::filesystem::path& path, int face_count);

}  // namespace atlas_refine::cli
