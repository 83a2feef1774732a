#pragma once

// The library draws by itself: numbers for the page's `commands`.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// The outline of a shape in 2D, its edges in 3D; with `filled` also its areas. Unbounded shapes are clipped to the
/// box.
ABUT_API abut_code abut_play_draw2(const abut_shape2* shape, abut_vec2 min, abut_vec2 max, bool filled,
                                   abut_buffer* out);
ABUT_API abut_code abut_play_draw3(const abut_shape3* shape, abut_vec3 min, abut_vec3 max, bool filled,
                                   abut_buffer* out);

/// The borders of the Voronoi regions of a shape's features.
ABUT_API abut_code abut_play_draw_voronoi2(const abut_shape2* shape, abut_vec2 min, abut_vec2 max, bool filled,
                                           abut_buffer* out);
ABUT_API abut_code abut_play_draw_voronoi3(const abut_shape3* shape, abut_vec3 min, abut_vec3 max, bool filled,
                                           abut_buffer* out);

ABUT_C_END
