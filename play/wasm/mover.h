#pragma once

// The character controller.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// A character of the plane.
typedef struct abut_play_mover2 abut_play_mover2;

/// A character of space.
typedef struct abut_play_mover3 abut_play_mover3;

/// Members of abut::MoverOptions; `up` is the second axis.
typedef struct abut_play_mover_options {
    float step_height;
    float steepest;
    float stick;
} abut_play_mover_options;

/// Members of abut::Moved.
typedef struct abut_play_moved2 {
    abut_vec2 position;
    abut_vec2 motion;
    abut_vec2 ground_normal;
    abut_id ground;
    abut_flag grounded;
    abut_flag crushed;
} abut_play_moved2;

/// Members of abut::Moved.
typedef struct abut_play_moved3 {
    abut_vec3 position;
    abut_vec3 motion;
    abut_vec3 ground_normal;
    abut_id ground;
    abut_flag grounded;
    abut_flag crushed;
} abut_play_moved3;

/// A character that has not moved yet.
ABUT_API abut_code abut_play_mover2_create(abut_play_mover_options options, abut_play_mover2** out);
ABUT_API abut_code abut_play_mover3_create(abut_play_mover_options options, abut_play_mover3** out);

/// Frees it.
ABUT_API void abut_play_mover2_release(ABUT_OPTIONAL abut_play_mover2* mover);
ABUT_API void abut_play_mover3_release(ABUT_OPTIONAL abut_play_mover3* mover);

/// Moves a convex shape, given relative to the position, and slides it along the items of the world.
ABUT_API abut_code abut_play_mover2_move(abut_play_mover2* mover, const abut_world2* world, const abut_shape2* shape,
                                         abut_vec2 position, abut_vec2 motion, abut_play_moved2* moved);
ABUT_API abut_code abut_play_mover3_move(abut_play_mover3* mover, const abut_world3* world, const abut_shape3* shape,
                                         abut_vec3 position, abut_vec3 motion, abut_play_moved3* moved);

/// The contacts of the last move: point and normal of each, and 1 for ground or 0.
ABUT_API abut_code abut_play_mover2_touches(const abut_play_mover2* mover, abut_buffer* out);
ABUT_API abut_code abut_play_mover3_touches(const abut_play_mover3* mover, abut_buffer* out);

ABUT_C_END
