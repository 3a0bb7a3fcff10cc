// Reads the text of a Wavefront OBJ file.
#pragma once

#include <string>

#include "io/obj_text.h"

namespace atlas_refine::io {

/// Throws RefineError(BadInput) that names the line where a record cannot be used.
ObjText parse_obj(std::string text);

}  // namespace atlas_refine::io
