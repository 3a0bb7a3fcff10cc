// The one place that knows which formats there are.
#include "io/mesh_file.h"

#include "atlas_refine/error.h"
#include "io/input_file.h"
#include "io/obj_file.h"

namespace atlas_refine::io {

std::unique_ptr<const MeshFile> read_mesh_file(const std::filesystem::path& path) {
  try {
    return std::make_unique<ObjFile>(ObjFile::parse(read_text(path, "an OBJ file")));
  } catch (const RefineError& error) {
    throw InputError(path, error.what());
  }
}

}  // namespace atlas_refine::io
