#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/query/ray_through.hpp>

namespace abut {

using namespace detail;

namespace {

/// All points p with dot(normal, p) + offset == 0.
struct Plane {
    DVec<3> normal;
    double offset;

    double height(const DVec<3>& point) const { return dot(normal, point) + offset; }
};

/// The plane whose height function is clip coordinate `i`.
Plane row(const glm::mat4& m, int i) {
    return {{static_cast<double>(m[0][i]), static_cast<double>(m[1][i]), static_cast<double>(m[2][i])},
            static_cast<double>(m[3][i])};
}

/// The plane of all points whose clip coordinate `i` is `value` times w, which are seen at that value.
Plane plane_at(const glm::mat4& m, int i, double value) {
    const Plane own = row(m, i), w = row(m, 3);
    return {own.normal - w.normal * value, own.offset - w.offset * value};
}

/// Maps [low, high] to [-1, 1].
double across(float value, float low, float high) {
    const double width = static_cast<double>(high) - static_cast<double>(low);
    return 2 * ((static_cast<double>(value) - static_cast<double>(low)) / width) - 1;
}

constexpr double max_float = static_cast<double>(std::numeric_limits<float>::max());

}  // namespace

/// No matrix is inverted. The points seen at one position on the screen form a line, in which the planes of its column
/// and of its row intersect; the near plane cuts off its beginning and the far plane its end.
Ray<3> ray_through(const Vec2& mouse, const Aabb2& viewport, const glm::mat4& view_projection, const ClipSpace& clip) {
    detail::enter_library();
    const Ray<3> nothing{Vec3(0), Vec3(1, 0, 0), 0};
    const double x = across(mouse.x, viewport.min.x, viewport.max.x);
    const double y = across(mouse.y, viewport.min.y, viewport.max.y) * (clip.y_down ? 1 : -1);
    const double near_depth = static_cast<double>(clip.near_depth), far_depth = static_cast<double>(clip.far_depth);
    const Plane column = plane_at(view_projection, 0, x), line = plane_at(view_projection, 1, y);
    const Plane first = plane_at(view_projection, 2, near_depth), last = plane_at(view_projection, 2, far_depth);

    // 1. The direction of the line, and its point on the near plane (Cramer's rule).
    const DVec<3> along = cross(column.normal, line.normal);
    const double speed = dot(first.normal, along);
    const double scale = length(column.normal) * length(line.normal) * length(first.normal);
    if (!(std::abs(speed) > 1e-12 * scale) || !std::isfinite(scale)) return nothing;
    const DVec<3> origin = (cross(line.normal, first.normal) * -column.offset +
                            cross(first.normal, column.normal) * -line.offset + along * -first.offset) /
                           speed;
    if (!(largest(origin) <= max_float)) return nothing;

    // 2. The sign of the direction: depth goes from near to far, and w gives its sign.
    const double w = row(view_projection, 3).height(origin);
    const double deeper = (far_depth - near_depth) * speed * w;
    if (!(std::abs(deeper) > 0)) return nothing;
    const DVec<3> direction = normalized(along) * (deeper > 0 ? 1.0 : -1.0);

    // 3. The length: a far plane that is not ahead gives an infinite ray.
    const double length = -last.height(origin) / dot(last.normal, direction);
    const bool ends = length >= 0 && length <= max_float;
    return {to_float(origin), to_float(direction),
            ends ? static_cast<float>(length) : std::numeric_limits<float>::infinity()};
}

}  // namespace abut
