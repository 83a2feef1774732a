#include <abut/math/dvec.hpp>
#include <abut/motion/shadow.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <vector>

namespace abut {

Shadow::Shadow(const Convex<3>& shape, const DVec<3>& x, const DVec<3>& y)
    : shape_(&shape), origin_(reference_point(shape)), x_(x), y_(y) {
    const bool has_corners = shape.inner_radius == 0 && (shape.core == Core::points || shape.core == Core::box);
    if (has_corners) {
        std::vector<Vec2> corners;
        const std::uint32_t count = shape.core == Core::box ? 8 : shape.count;
        for (std::uint32_t i = 0; i < count; ++i)
            corners.push_back(to_float(seen(shape.place.point(own_corner(shape, i)) - origin_)));
        polygon_ = *Polygon::build(corners);
        outline_ = abut::convex(polygon_);
        outline_.radius = shape.radius;
    } else {
        outline_.core = Core::function;
        outline_.object = this;
        outline_.function = [](const void* object, const Vec2& direction) {
            return static_cast<const Shadow*>(object)->farthest(direction);
        };
    }
    outline_.place.offset = seen(origin_);
}

Vec2 Shadow::farthest(const Vec2& direction) const {
    const DVec<3> lifted = x_ * static_cast<double>(direction.x) + y_ * static_cast<double>(direction.y);
    return to_float(seen(support(*shape_, lifted) - origin_));
}

double depth_aside(const Shadow& a, const Shadow& b) {
    return -static_cast<double>(closest(a.outline(), b.outline()).distance);
}

double depth_aside(const Convex<2>& a, const Convex<2>& b, const DVec<2>& along) {
    const DVec<2> right(along.y, -along.x), left = right * -1.0;
    const auto reach = [&](const Convex<2>& shape, const DVec<2>& way) { return dot(support(shape, way), way); };
    return std::min(reach(a, right) + reach(b, left), reach(a, left) + reach(b, right));
}

double depth_aside(const Convex<3>& a, const Convex<3>& b, const DVec<3>& along) {
    const DVec<3> x = perpendicular(along), y = cross(along, x);
    return depth_aside(Shadow(a, x, y), Shadow(b, x, y));
}

}  // namespace abut
