#include "tool/faults/floating.hpp"

#include <abut/abut.hpp>

#include <limits>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// The height of the lowest point.
template <int D>
float bottom_of(const Aabb<D>& box, const Vec<D>& up) {
    for (int i = 0; i < D; ++i)
        if (up[i] != 0) return up[i] > 0 ? box.min[i] : -box.max[i];
    return 0;
}

// The box without limits along the up direction.
template <int D>
Aabb<D> column_of(Aabb<D> box, const Vec<D>& up) {
    for (int i = 0; i < D; ++i) {
        if (up[i] == 0) continue;
        box.min[i] = std::numeric_limits<float>::lowest();
        box.max[i] = std::numeric_limits<float>::max();
    }
    return box;
}

}  // namespace

template <int D>
std::vector<FloatingObject<D>> find_floating(const std::vector<ViewedObject<D>>& objects, const Vec<D>& up,
                                             float tolerance) {
    std::vector<Aabb<D>> boxes;
    for (const ViewedObject<D>& object : objects) boxes.push_back(object.box);
    Bvh<D> tree;
    tree.build(boxes);
    std::vector<FloatingObject<D>> result;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const float reach = tolerance * objects[i].radius;
        bool rests = false;
        tree.each_overlapping(grown(boxes[i], reach), [&](std::uint32_t j) {
            rests = j != i && closest(objects[i].shape, objects[j].shape).distance <= reach;
            return !rests;
        });
        if (rests) continue;
        const float bottom = bottom_of(boxes[i], up);
        FloatingObject<D> floating{i, i, std::numeric_limits<float>::infinity(), {}};
        tree.each_overlapping(column_of(boxes[i], up), [&](std::uint32_t j) {
            if (j == i || bottom_of(boxes[j], up) >= bottom) return;
            const Closest<D> gap = closest(objects[i].shape, objects[j].shape);
            const bool is_nearer =
                gap.distance < floating.distance || (gap.distance == floating.distance && j < floating.nearest);
            if (is_nearer) floating = {i, j, gap.distance, gap.on_a};
        });
        if (floating.nearest != i) result.push_back(floating);
    }
    return result;
}

template std::vector<FloatingObject<2>> find_floating(const std::vector<ViewedObject<2>>&, const Vec<2>&, float);
template std::vector<FloatingObject<3>> find_floating(const std::vector<ViewedObject<3>>&, const Vec<3>&, float);

}  // namespace abut::tool
