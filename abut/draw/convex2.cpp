#include <abut/draw/convex.hpp>
#include <abut/draw/outline.hpp>

namespace abut::detail {

void draw_convex(Canvas<2>& canvas, const Convex<2>& convex, const Style& style) {
    if (is_ball(convex)) return draw_ball(canvas, convex, style);
    const std::vector<Vec2> points = outline(convex);
    if (points.size() == 1)
        canvas.point(points[0], style);
    else if (points.size() == 2)
        canvas.line(points[0], points[1], style);
    else
        canvas.polygon(points, style);
}

}  // namespace abut::detail
