#pragma once

// The small physics engine of scenes/small_physics.hpp: boxes under gravity on a level, all contacts by a World.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// Boxes of the plane on a level.
typedef struct abut_play_physics2 abut_play_physics2;

/// Boxes of space on a level.
typedef struct abut_play_physics3 abut_play_physics3;

/// No boxes and no level. `filter_edges` is the option of the World.
ABUT_API abut_code abut_play_physics2_create(bool filter_edges, abut_play_physics2** out);
ABUT_API abut_code abut_play_physics3_create(bool filter_edges, abut_play_physics3** out);

/// Frees it.
ABUT_API void abut_play_physics2_release(ABUT_OPTIONAL abut_play_physics2* physics);
ABUT_API void abut_play_physics3_release(ABUT_OPTIONAL abut_play_physics3* physics);

/// Adds a part of the level.
ABUT_API abut_code abut_play_physics2_add_fixed(abut_play_physics2* physics, const abut_shape2* shape);
ABUT_API abut_code abut_play_physics3_add_fixed(abut_play_physics3* physics, const abut_shape3* shape);

/// Adds a box of density 1 at rest.
ABUT_API abut_code abut_play_physics2_add_box(abut_play_physics2* physics, abut_pose2 pose, abut_vec2 half);
ABUT_API abut_code abut_play_physics3_add_box(abut_play_physics3* physics, abut_pose3 pose, abut_vec3 half);

/// Gives a box another velocity.
ABUT_API abut_code abut_play_physics2_set_velocity(abut_play_physics2* physics, uint32_t box, abut_vec2 velocity);
ABUT_API abut_code abut_play_physics3_set_velocity(abut_play_physics3* physics, uint32_t box, abut_vec3 velocity);

/// One step of so many seconds.
ABUT_API abut_code abut_play_physics2_step(abut_play_physics2* physics, float seconds);
ABUT_API abut_code abut_play_physics3_step(abut_play_physics3* physics, float seconds);

/// The position, the rotation and the velocity of each box: 6 numbers in the plane and 10 in space.
ABUT_API abut_code abut_play_physics2_boxes(const abut_play_physics2* physics, abut_buffer* out);
ABUT_API abut_code abut_play_physics3_boxes(const abut_play_physics3* physics, abut_buffer* out);

/// The points of the contacts of the last step: the position, the normal on the box above it, the depth, and 1 if the
/// level touches a box there or 0. 6 numbers in the plane and 8 in space.
ABUT_API abut_code abut_play_physics2_contacts(const abut_play_physics2* physics, abut_buffer* out);
ABUT_API abut_code abut_play_physics3_contacts(const abut_play_physics3* physics, abut_buffer* out);

/// The number of contact points of the last step that were there in the step before, as a share of all; 1 without any.
ABUT_API abut_code abut_play_physics2_persistence(const abut_play_physics2* physics, float* out);
ABUT_API abut_code abut_play_physics3_persistence(const abut_play_physics3* physics, float* out);

ABUT_C_END
