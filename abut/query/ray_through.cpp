#include <abut/math/dvec.hpp>
#include <abut/query/ray_through.hpp>

namespace abut {
namespace {

/// All points p with dot(normal, p) + offset == 0.
struct Plane {
    DVec<3> normal;
    double offset;

    double height(const DVec<3>& point) const { return dot(normal, point) + offset; }
};

/// What gives clip coordinate `i` of a point.
Plane row(const glm::mat4& m, int i) {
    return {{static_cast<double>(m[0][i]), static_cast<double>(m[1][i]), static_cast<double>(m[2][i])},
            static_cast<double>(m[3][i])};
}

/// Where clip coordinate `i` is `value` times w, as it is for all points that are seen at that value.
Plane seen_at(const glm::mat4& m, int i, double value) {
    const Plane own = row(m, i), w = row(m, 3);
    return {own.normal - w.normal * value, own.offset - w.offset * value};
}

/// Where in its range a number lies, from -1 to 1.
double across(float value, float low, float high) {
    const double width = static_cast<double>(high) - static_cast<double>(low);
    return 2 * ((static_cast<double>(value) - static_cast<double>(low)) / width) - 1;
}

constexpr double most = static_cast<double>(std::numeric_limits<float>::max());

}  // namespace

/// No matrix is inverted. The points seen at one place of the screen are those of a line, in which the planes of its
/// column and of its row meet; the near plane cuts off its beginning and the far plane its end.
Ray<3> ray_through(const Vec2& mouse, const Aabb2& viewport, const glm::mat4& view_projection, const ClipSpace& clip) {
    const Ray<3> nothing{Vec3(0), Vec3(1, 0, 0), 0};
    const double x = across(mouse.x, viewport.min.x, viewport.max.x);
    const double y = across(mouse.y, viewport.min.y, viewport.max.y) * (clip.y_down ? 1 : -1);
    const double near_depth = static_cast<double>(clip.near_depth), far_depth = static_cast<double>(clip.far_depth);
    const Plane column = seen_at(view_projection, 0, x), line = seen_at(view_projection, 1, y);
    const Plane first = seen_at(view_projection, 2, near_depth), last = seen_at(view_projection, 2, far_depth);

    // 1. The line's direction, and where it comes through the near plane (Cramer's rule).
    const DVec<3> along = cross(column.normal, line.normal);
    const double speed = dot(first.normal, along);
    const double scale = length(column.normal) * length(line.normal) * length(first.normal);
    if (!(std::abs(speed) > 1e-12 * scale) || !std::isfinite(scale)) return nothing;
    const DVec<3> origin = (cross(line.normal, first.normal) * -column.offset +
                            cross(first.normal, column.normal) * -line.offset + along * -first.offset) /
                           speed;
    if (!(largest(origin) <= most)) return nothing;

    // 2. Which way: depth goes from near to far, where w tells which sign it has.
    const double w = row(view_projection, 3).height(origin);
    const double deeper = (far_depth - near_depth) * speed * w;
    if (!(std::abs(deeper) > 0)) return nothing;
    const DVec<3> direction = normalized(along) * (deeper > 0 ? 1.0 : -1.0);

    // 3. How far: a far plane that is not ahead is beyond all bounds.
    const double length = -last.height(origin) / dot(last.normal, direction);
    const bool ends = length >= 0 && length <= most;
    return {to_float(origin), to_float(direction),
            ends ? static_cast<float>(length) : std::numeric_limits<float>::infinity()};
}

}  // namespace abut
