#pragma once

// Draws the border of a half-space within a box, and in 2D its interior. The implementation of `draw`.

#include <abut/draw/canvas.hpp>
#include <abut/shape/half_space.hpp>

namespace abut::detail {

void draw_half_space(Canvas<2>& canvas, const HalfSpaceView<2>& solid, const Style& style);
void draw_half_space(Canvas<3>& canvas, const HalfSpaceView<3>& solid, const Style& style);

}  // namespace abut::detail
