#pragma once

// The features of a shape, drawn: numbers for the page's `commands`.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// A vertex, edge or face of a convex shape, as `closest` names it: a point, a line, or a polygon with its area.
/// Nothing for a feature that the shape doesn't have.
ABUT_API abut_code abut_play_draw_feature2(const abut_shape2* shape, uint32_t kind, uint32_t index, abut_buffer* out);
ABUT_API abut_code abut_play_draw_feature3(const abut_shape3* shape, uint32_t kind, uint32_t index, abut_buffer* out);

/// The walls around the Voronoi region of a feature in 3D, as high as half of the shape's size.
ABUT_API abut_code abut_play_draw_region3(const abut_shape3* shape, uint32_t kind, uint32_t index, abut_buffer* out);

ABUT_C_END
