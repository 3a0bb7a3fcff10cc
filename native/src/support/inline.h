// Functions that are compiled anew into each caller: a caller that is compiled for more than the processor's baseline takes them
// along.
#pragma once

#define ATLAS_REFINE_INLINE inline __attribute__((always_inline))
