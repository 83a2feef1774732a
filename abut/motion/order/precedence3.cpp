// Two disjoint shapes are ordered along the direction if their projections on a plane across it overlap. Any separating
// plane decides which one is above.

#include <abut/broad_phase/bvh.hpp>
#include <abut/motion/order/pair_tolerance.hpp>
#include <abut/motion/order/precedence.hpp>
#include <abut/motion/order/projection.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <memory>

namespace abut::detail {
namespace {

MovingBox<3> moving_box(const Aabb3& box, const DVec<3>& up, double length) {
    const DVec<3> min(box.min), max(box.max);
    return {(min + max) * 0.5, (max - min) * 0.5, up, length};
}

}  // namespace

std::vector<Precedence> precedences(std::span<const Convex<3>> shapes, const DVec<3>& up) {
    const DVec<3> x = perpendicular(up), y = cross(up, x);
    std::vector<std::unique_ptr<const Projection>> projections;
    std::vector<Aabb3> boxes;
    Aabb3 all = Aabb3::empty();
    for (const Convex<3>& shape : shapes) {
        projections.push_back(std::make_unique<Projection>(shape, x, y));
        boxes.push_back(bounds(shape));
        all = merged(all, boxes.back());
    }
    Bvh<3> tree;
    tree.build(boxes);
    const double far = length(DVec<3>(all.max) - DVec<3>(all.min));

    const auto is_blocked_by = [&](std::uint32_t lower, std::uint32_t upper) {
        const Convex<3>&a = shapes[lower], &b = shapes[upper];
        if (!(dot(DVec<3>(closest(a, b).normal), up) > 0)) return false;
        return projected_depth(*projections[lower], *projections[upper]) > tolerance_for(a, b);
    };
    std::vector<Precedence> result;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const std::size_t first = result.size();
        tree.sweep(moving_box(boxes[i], up, far), [&](std::uint32_t j) {
            if (j != i && is_blocked_by(i, j)) result.push_back({i, j});
        });
        std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                  [](const Precedence& a, const Precedence& b) { return a.upper < b.upper; });
    }
    return result;
}

}  // namespace abut::detail
