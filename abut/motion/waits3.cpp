// Of two shapes that don't overlap, one is above the other where a line along the direction goes through both: where
// their shadows on a plane across the direction overlap. Which one it is, any plane that parts the two tells.

#include <abut/broad_phase/bvh.hpp>
#include <abut/motion/margin.hpp>
#include <abut/motion/shadow.hpp>
#include <abut/motion/waits.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <memory>

namespace abut {
namespace {

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
        return depth_aside(*shadows[lower], *shadows[upper]) > margin_of_doubt(a, b);
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
