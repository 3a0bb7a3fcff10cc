// What is said of charts, with where in the files they are: their numbers alone lead nowhere.
#pragma once

#include <string>

#include "collection.h"

namespace atlas_refine::cli {

/// "chart 3 (9 faces, the first b.obj: face 55 of 'Head', line 402): turned over".
std::string repair_words(const Repair& repair, const RefineResult& result, const Collection& files);

/// One of the library's lines about charts, where it is one, with the place of the first of them; else as it is.
std::string with_place(const std::string& line, const RefineResult& result, const Collection& files);

}  // namespace atlas_refine::cli
