// The one place that knows which formats there are.
#include "io/mesh_file.h"

#include <algorithm>
#include <cctype>

#include "atlas_refine/error.h"
#include "io/file_kind.h"
#include "io/input_file.h"
#include "io/obj_file.h"

namespace atlas_refine::io {

std::unique_ptr<const MeshFile> read_mesh_file(const std::filesystem::path& path) {
  try {
    std::string text = read_text(path, "an OBJ file");
    if (const std::string_view kind = foreign_kind(text); !kind.empty())
      throw InputError(path, "is " + std::string(kind) + ", not an OBJ file");
    return std::make_unique<ObjFile>(ObjFile::parse(std::move(text)));
  } catch (const RefineError& error) {
    throw InputError(path, error.what());
  }
}

bool names_mesh_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".obj";
}

}  // namespace atlas_refine::io
