#pragma once

// The steps of the engines, as JSON, and the distance of moving shapes.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The steps of `closest`, `contact`, `sweep` of A by a translation, or `intersection`: question 0 to 3. A list of
/// objects, each with its `kind` ("gjk", "penetration", "axis", "clip" or "sweep") and the members of the step in
/// abut/convex/gjk/trace.hpp.
ABUT_API abut_code abut_play_trace2(uint32_t question, const abut_shape2* a, const abut_shape2* b, abut_vec2 motion,
                                    abut_buffer* out);
ABUT_API abut_code abut_play_trace3(uint32_t question, const abut_shape3* a, const abut_shape3* b, abut_vec3 motion,
                                    abut_buffer* out);

/// The stops of a sweep with rotation: a list of objects with `time`, `distance` and `normal`. The search advances from
/// one to the next, and proves that nothing touches between them. WRONG_SHAPE if a shape isn't convex.
ABUT_API abut_code abut_play_sweep_stops2(const abut_shape2* a, abut_motion2 motion_a, const abut_shape2* b,
                                          abut_motion2 motion_b, abut_buffer* out);
ABUT_API abut_code abut_play_sweep_stops3(const abut_shape3* a, abut_motion3 motion_a, const abut_shape3* b,
                                          abut_motion3 motion_b, abut_buffer* out);

/// The signed distances of two moving shapes, as floats, at so many even times of their motions, from 0 to 1. At
/// least 2.
ABUT_API abut_code abut_play_distances2(const abut_shape2* a, abut_motion2 motion_a, const abut_shape2* b,
                                        abut_motion2 motion_b, uint32_t count, abut_buffer* out);
ABUT_API abut_code abut_play_distances3(const abut_shape3* a, abut_motion3 motion_a, const abut_shape3* b,
                                        abut_motion3 motion_b, uint32_t count, abut_buffer* out);

ABUT_C_END
