#include <abut/draw/canvas.hpp>
#include <abut/draw/outline.hpp>

namespace abut {

using namespace detail;

template <int D>
void Canvas<D>::polygon(std::span<const Vec<D>> points, const Style& style) {
    if (!style.stroke.visible()) return;
    for (std::size_t i = 0; i < points.size(); ++i) line(points[i], points[(i + 1) % points.size()], style);
}

template <int D>
void Canvas<D>::ball(const Vec<D>& center, float radius, const Style& style) {
    const Convex<D> ball = round_points<D>({center}, radius);
    if constexpr (D == 2) {
        polygon(outline(ball), style);
    } else {
        Style unfilled = style;
        unfilled.fill = transparent;
        for (int i = 0; i < 3; ++i)
            polygon(outline(ball, OutlinePlane<3>{axis<3>((i + 1) % 3), axis<3>((i + 2) % 3)}), unfilled);
    }
}

template <int D>
void Canvas<D>::text(const Vec<D>&, std::string_view, const Style&) {}

template class Canvas<2>;
template class Canvas<3>;

}  // namespace abut
