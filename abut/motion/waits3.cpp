// Of two shapes that don't overlap, one is above the other where a line along the direction goes through both: where
// their shadows on a plane across the direction overlap. Which one it is, any plane that parts the two tells.

#include <abut/broad_phase/bvh.hpp>
#include <abut/motion/margin.hpp>
#include <abut/motion/waits.hpp>
#include <abut/query/closest.hpp>
#include <abut/shape/polygon.hpp>

#include <algorithm>
#include <memory>

namespace abut {
namespace {

/// A shape as seen along the direction: a polygon with a ball around it, or what its support function tells.
class Shadow {
public:
    Shadow(const Convex<3>& shape, const DVec<3>& x, const DVec<3>& y)
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
    Shadow(const Shadow&) = delete;
    Shadow& operator=(const Shadow&) = delete;

    const Convex<2>& outline() const { return outline_; }

private:
    DVec<2> seen(const DVec<3>& v) const { return {dot(v, x_), dot(v, y_)}; }
    Vec2 farthest(const Vec2& direction) const {
        const DVec<3> lifted = x_ * static_cast<double>(direction.x) + y_ * static_cast<double>(direction.y);
        return to_float(seen(support(*shape_, lifted) - origin_));
    }

    const Convex<3>* shape_;
    DVec<3> origin_, x_, y_;
    Polygon polygon_;
    Convex<2> outline_;
};

MovingBox<3> on_its_way(const Aabb3& box, const DVec<3>& up, double length) {
    const DVec<3> min(box.min), max(box.max);
    return {(min + max) * 0.5, (max - min) * 0.5, up, length};
}

}  // namespace

std::vector<Wait> waits(std::span<const Convex<3>> shapes, const DVec<3>& up) {
    const DVec<3> x = perpendicular(up), y = cross(up, x);
    std::vector<std::unique_ptr<const Shadow>> shadows;
    std::vector<Aabb3> boxes;
    Aabb3 all = Aabb3::empty();
    for (const Convex<3>& shape : shapes) {
        shadows.push_back(std::make_unique<Shadow>(shape, x, y));
        boxes.push_back(bounds(shape));
        all = merged(all, boxes.back());
    }
    Bvh<3> tree;
    tree.build(boxes);
    const double far = length(DVec<3>(all.max) - DVec<3>(all.min));

    const auto waits_for = [&](std::uint32_t lower, std::uint32_t upper) {
        const Convex<3>&a = shapes[lower], &b = shapes[upper];
        if (!(dot(DVec<3>(closest(a, b).normal), up) > 0)) return false;
        const Closest<2> aside = closest(shadows[lower]->outline(), shadows[upper]->outline());
        return static_cast<double>(aside.distance) < -margin_of_doubt(a, b);
    };
    std::vector<Wait> result;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const std::size_t first = result.size();
        tree.sweep(on_its_way(boxes[i], up, far), [&](std::uint32_t j) {
            if (j != i && waits_for(i, j)) result.push_back({i, j});
        });
        std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                  [](const Wait& a, const Wait& b) { return a.upper < b.upper; });
    }
    return result;
}

}  // namespace abut
