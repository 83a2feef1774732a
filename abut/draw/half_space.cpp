#include <abut/convex/face.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/draw/convex.hpp>
#include <abut/draw/half_space.hpp>

#include <vector>

namespace abut::detail {
namespace {

/// A point of the border near the box's center, and the largest distance of the border from it within the box.
template <int D>
struct BorderCenter {
    DVec<D> point;
    double reach;
};

template <int D>
BorderCenter<D> center_of_border(const HalfSpaceView<D>& solid, const Aabb<D>& box) {
    const DVec<D> center = (DVec<D>(box.min) + DVec<D>(box.max)) * 0.5;
    return {center + solid.normal * (solid.offset - dot(solid.normal, center)), length(DVec<D>(box.max) - center)};
}

/// The part of a face in the box.
template <int D>
std::vector<Vec<D>> clipped(Face<D> face, const Aabb<D>& box) {
    for (int i = 0; i < D; ++i) {
        clip(face, axis<D>(i), static_cast<double>(box.max[i]), 0);
        clip(face, axis<D>(i, -1), -static_cast<double>(box.min[i]), 0);
    }
    std::vector<Vec<D>> result;
    for (std::size_t i = 0; i < face.count; ++i) result.push_back(to_float(face.points[i]));
    return result;
}

}  // namespace

void draw_half_space(Canvas<2>& canvas, const HalfSpaceView<2>& solid, const Style& style) {
    const Aabb<2> box = canvas.shown();
    const auto [point, reach] = center_of_border(solid, box);
    const DVec<2> along = perpendicular(solid.normal);
    Face<2> line_or_square;
    line_or_square.push_back(point - along * reach, 0);
    line_or_square.push_back(point + along * reach, 1);
    const std::vector<Vec2> border = clipped(line_or_square, box);
    if (style.fill.visible()) {
        std::vector<Vec2> inside = border;
        for (const Vec2& corner : {box.min, Vec2(box.max.x, box.min.y), box.max, Vec2(box.min.x, box.max.y)})
            if (dot(solid.normal, DVec<2>(corner)) < solid.offset) inside.push_back(corner);
        std::vector<Vec2> area;
        if (inside.size() > 2)
            for (const std::uint32_t i : hull_loop(inside)) area.push_back(inside[i]);
        if (area.size() > 2) canvas.polygon(area, fill_only(style));
    }
    if (border.size() == 2) canvas.line(border[0], border[1], style);
}

void draw_half_space(Canvas<3>& canvas, const HalfSpaceView<3>& solid, const Style& style) {
    const Aabb<3> box = canvas.shown();
    const auto [point, reach] = center_of_border(solid, box);
    const DVec<3> u = perpendicular(solid.normal) * reach, v = cross(solid.normal, u);
    // A square whose inscribed circle has the radius `reach`.
    const DVec<3> corners[4] = {-u - v, u - v, u + v, v - u};
    Face<3> line_or_square;
    for (const DVec<3>& corner : corners) line_or_square.push_back(point + corner, 0);
    const std::vector<Vec3> border = clipped(line_or_square, box);
    if (border.size() > 2) canvas.polygon(border, style);
}

}  // namespace abut::detail
