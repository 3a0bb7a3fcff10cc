// What a file is that is not OBJ, told from how it begins.
#pragma once

#include <string_view>

namespace atlas_refine::io {

/// "a glTF file", "a gzip file", ...; empty where the bytes may be OBJ text.
std::string_view foreign_kind(std::string_view bytes);

}  // namespace atlas_refine::io
