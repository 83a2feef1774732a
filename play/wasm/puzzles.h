#pragma once

// Arrangements of convex pieces to take apart, as JSON: a list of {"points": [[x, y], ...], "position": [x, y],
// "rotation": [cosine, sine]}. The points are about the piece's own center; no two pieces overlap by more than the
// tolerance. The same numbers make the same pieces on every machine.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// A square of half size 1, cut by straight lines into so many pieces.
ABUT_API abut_code abut_play_cut_square(uint32_t seed, uint32_t count, abut_buffer* out);

/// Straight sticks thrown into a square of half size 1: as many of them as find a place.
ABUT_API abut_code abut_play_thrown_sticks(uint32_t seed, uint32_t count, abut_buffer* out);

ABUT_C_END
