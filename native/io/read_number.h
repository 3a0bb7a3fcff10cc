// Numbers as OBJ files have them.
#pragma once

#include <optional>
#include <string_view>

namespace atlas_refine::io {

/// Nothing where the text is no number. Infinities and NaN are numbers, as C libraries write them, those of Windows too: 1.#IND,
/// -1.#QNAN, 1.#INF00.
std::optional<double> read_number(std::string_view text);

}  // namespace atlas_refine::io
