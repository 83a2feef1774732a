#pragma once

// Meshes that the exhibits begin with.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// A closed mesh about the origin with y up, as a mesh shape: a house (0) or a knotted tube (1) of
/// scenes/solid_meshes.hpp, or the stone of scenes/bumpy_ball.hpp (2). The longest side of its box is 4. BAD_ARGUMENT
/// for other numbers.
ABUT_API abut_code abut_play_scene_mesh(uint32_t which, abut_shape3** out);

ABUT_C_END
