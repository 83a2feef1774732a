#pragma once

// Drawing of convex sets: an outline in 2D, edges and faces in 3D. The implementation of `draw`.

#include <abut/convex/support.hpp>
#include <abut/draw/canvas.hpp>

namespace abut::detail {

void draw_convex(Canvas<2>& canvas, const Convex<2>& convex, const Style& style);
void draw_convex(Canvas<3>& canvas, const Convex<3>& convex, const Style& style);

/// Draws a set for which `is_ball` is true.
template <int D>
void draw_ball(Canvas<D>& canvas, const Convex<D>& convex, const Style& style) {
    const Vec<D> center = to_float(convex.place.point(DVec<D>(convex.vertices()[0])));
    if (convex.radius > 0)
        canvas.ball(center, static_cast<float>(convex.radius), style);
    else
        canvas.point(center, style);
}

inline Style unfilled(Style style) {
    style.fill = transparent;
    return style;
}
inline Style fill_only(Style style) {
    style.stroke = transparent;
    return style;
}

}  // namespace abut::detail
