#include <abut/math/dvec.hpp>
#include <abut/motion/order/projection.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <vector>

namespace abut::detail {

Projection::Projection(const Convex<3>& shape, const DVec<3>& x, const DVec<3>& y)
    : shape_(&shape), origin_(reference_point(shape)), x_(x), y_(y) {
    const bool has_corners = shape.inner_radius == 0 && (shape.core == Core::points || shape.core == Core::box);
    if (has_corners) {
        std::vector<Vec2> corners;
        const std::uint32_t count = shape.core == Core::box ? 8 : shape.count;
        for (std::uint32_t i = 0; i < count; ++i)
            corners.push_back(to_float(project(shape.place.point(local_corner(shape, i)) - origin_)));
        polygon_ = *Polygon::build(corners);
        projected_ = abut::convex(polygon_);
        projected_.radius = shape.radius;
    } else {
        projected_.core = Core::function;
        projected_.object = this;
        projected_.function = [](const void* object, const Vec2& direction) {
            return static_cast<const Projection*>(object)->support_point(direction);
        };
    }
    projected_.place.offset = project(origin_);
}

Vec2 Projection::support_point(const Vec2& direction) const {
    const DVec<3> lifted = x_ * static_cast<double>(direction.x) + y_ * static_cast<double>(direction.y);
    return to_float(project(support(*shape_, lifted) - origin_));
}

double projected_depth(const Projection& a, const Projection& b) {
    return -static_cast<double>(closest(a.shape(), b.shape()).distance);
}

double projected_depth(const Convex<2>& a, const Convex<2>& b, const DVec<2>& along) {
    const DVec<2> right(along.y, -along.x), left = right * -1.0;
    const auto reach = [&](const Convex<2>& shape, const DVec<2>& direction) {
        return dot(support(shape, direction), direction);
    };
    return std::min(reach(a, right) + reach(b, left), reach(a, left) + reach(b, right));
}

double projected_depth(const Convex<3>& a, const Convex<3>& b, const DVec<3>& along) {
    const DVec<3> x = perpendicular(along), y = cross(along, x);
    return projected_depth(Projection(a, x, y), Projection(b, x, y));
}

}  // namespace abut::detail
