#pragma once

// A ray that mirrors reflect.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// Follows a ray through a world. Items whose user's number is not 0 are mirrors; the ray ends at any other, or after
/// so many hits. JSON: `points` from the start to the end, `normals` at the hits, and the indices of the `items` hit.
ABUT_API abut_code abut_play_laser2(const abut_world2* world, abut_ray2 ray, uint32_t max_hits, abut_buffer* out);

ABUT_C_END
