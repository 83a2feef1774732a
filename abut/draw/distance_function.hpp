#pragma once

// Draws the zero level set of a signed distance function by marching simplices. The implementation of `draw`.

#include <abut/draw/canvas.hpp>
#include <abut/shape/view/distance_function.hpp>

namespace abut::detail {

template <int D>
void draw_function(Canvas<D>& canvas, const DistanceFunction<D>& function, const Style& style);

}  // namespace abut::detail
