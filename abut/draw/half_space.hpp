#pragma once

// How a half-space is drawn: what of its border, and in 2D of its inside, lies in a box. Behind `draw`.

#include <abut/draw/canvas.hpp>
#include <abut/shape/half_space.hpp>

namespace abut {

void draw_solid(Canvas<2>& canvas, const Solid<2>& solid, const Style& style);
void draw_solid(Canvas<3>& canvas, const Solid<3>& solid, const Style& style);

}  // namespace abut
