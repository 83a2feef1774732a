#include <abut/bake/field/primitive_bvh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

template <int D>
struct Centroid {
    Vec<D> middle;
    std::uint32_t primitive = 0;
};

void set_lane(PrimitiveLeaf<2>& leaf, std::size_t lane, const PrimitiveCorners<2>& corners) {
    const DVec<2> from(corners[0]), along = DVec<2>(corners[1]) - from;
    for (std::size_t i = 0; i < 2; ++i) {
        leaf.from[i][lane] = from[static_cast<int>(i)];
        leaf.along[i][lane] = along[static_cast<int>(i)];
    }
    leaf.inverse[lane] = 1 / dot(along, along);
}

void set_lane(PrimitiveLeaf<3>& leaf, std::size_t lane, const PrimitiveCorners<3>& corners) {
    std::array<DVec<3>, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = DVec<3>(corners[i]);
    const std::array<double, 3> sides{length_squared(p[1] - p[0]), length_squared(p[2] - p[1]),
                                      length_squared(p[0] - p[2])};
    std::rotate(p.begin(), p.begin() + (std::max_element(sides.begin(), sides.end()) - sides.begin()), p.end());
    const DVec<3> along = p[1] - p[0], other = p[2] - p[0];
    const DVec<3> x = normalized(along), z = normalized(cross(along, other)), y = cross(z, x);
    for (std::size_t i = 0; i < 3; ++i) {
        const int k = static_cast<int>(i);
        leaf.corner[i][lane] = p[0][k];
        leaf.axis[0][i][lane] = x[k];
        leaf.axis[1][i][lane] = y[k];
        leaf.axis[2][i][lane] = z[k];
    }
    leaf.length[lane] = length(along);
    leaf.x[lane] = dot(other, x);
    leaf.y[lane] = dot(other, y);
    leaf.inverse_first[lane] = 1 / length_squared(other);
    leaf.inverse_second[lane] = 1 / length_squared(p[2] - p[1]);
}

/// Orders primitives by recursive median splits until at most eight are left. All leaves but the last are full, and
/// eight consecutive leaves, and eight such groups, are close together.
template <int D>
void arrange(std::vector<Centroid<D>>& items) {
    struct Part {
        std::size_t begin, end;
    };
    std::vector<Part> stack{{0, items.size()}};
    while (!stack.empty()) {
        const auto [begin, end] = stack.back();
        stack.pop_back();
        if (end - begin <= primitive_lanes) continue;
        Vec<D> low = items[begin].middle, high = low;
        for (std::size_t i = begin; i < end; ++i)
            for (int k = 0; k < D; ++k) {
                low[k] = std::min(low[k], items[i].middle[k]);
                high[k] = std::max(high[k], items[i].middle[k]);
            }
        int axis = 0;
        for (int k = 1; k < D; ++k)
            if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
        std::size_t half = primitive_lanes;
        while (2 * half < end - begin) half *= 2;
        const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(begin + half), at(end), [axis](const Centroid<D>& a, const Centroid<D>& b) {
            return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.primitive < b.primitive;
        });
        stack.push_back({begin, begin + half});
        stack.push_back({begin + half, end});
    }
}

template <int D>
PrimitiveBoxes<D> no_boxes() {
    PrimitiveBoxes<D> result;
    for (auto& row : result.min) row.fill(std::numeric_limits<float>::infinity());
    for (auto& row : result.max) row.fill(-std::numeric_limits<float>::infinity());
    return result;
}

}  // namespace

template <int D>
PrimitiveBvh<D> build_primitive_bvh(std::span<const PrimitiveCorners<D>> primitives) {
    std::vector<Centroid<D>> items(primitives.size());
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
        Vec<D> sum(0.0f);
        for (const Vec<D>& corner : primitives[i]) sum += corner * (1.0f / D);
        items[i] = {sum, i};
    }
    arrange(items);

    PrimitiveBvh<D> tree;
    const std::size_t leaves = (items.size() + primitive_lanes - 1) / primitive_lanes;
    tree.leaves.resize(leaves);
    tree.levels.emplace_back((leaves + primitive_lanes - 1) / primitive_lanes, no_boxes<D>());
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
        PrimitiveBoxes<D>& boxes = tree.levels[0][leaf / primitive_lanes];
        const std::size_t place = leaf % primitive_lanes;
        for (std::size_t lane = 0; lane < primitive_lanes; ++lane) {
            const std::uint32_t primitive = items[std::min(leaf * primitive_lanes + lane, items.size() - 1)].primitive;
            tree.leaves[leaf].primitive[lane] = primitive;
            set_lane(tree.leaves[leaf], lane, primitives[primitive]);
            for (const Vec<D>& corner : primitives[primitive])
                for (std::size_t k = 0; k < D; ++k) {
                    boxes.min[k][place] = std::min(boxes.min[k][place], corner[static_cast<int>(k)]);
                    boxes.max[k][place] = std::max(boxes.max[k][place], corner[static_cast<int>(k)]);
                }
        }
    }
    while (tree.levels.back().size() > 1) {
        const std::vector<PrimitiveBoxes<D>>& below = tree.levels.back();
        std::vector<PrimitiveBoxes<D>> level((below.size() + primitive_lanes - 1) / primitive_lanes, no_boxes<D>());
        for (std::size_t i = 0; i < below.size(); ++i)
            for (std::size_t k = 0; k < D; ++k) {
                PrimitiveBoxes<D>& boxes = level[i / primitive_lanes];
                boxes.min[k][i % primitive_lanes] = *std::min_element(below[i].min[k].begin(), below[i].min[k].end());
                boxes.max[k][i % primitive_lanes] = *std::max_element(below[i].max[k].begin(), below[i].max[k].end());
            }
        tree.levels.push_back(std::move(level));
    }
    DVec<D> extent(0.0);
    for (std::size_t k = 0; k < D; ++k) {
        const PrimitiveBoxes<D>& top = tree.levels.back()[0];
        for (std::size_t place = 0; place < primitive_lanes; ++place)
            for (std::size_t other = 0; other < primitive_lanes; ++other) {
                const double from = static_cast<double>(top.min[k][place]), to = static_cast<double>(top.max[k][other]);
                if (from < to && std::isfinite(from) && std::isfinite(to))
                    extent[static_cast<int>(k)] = std::max(extent[static_cast<int>(k)], to - from);
            }
    }
    tree.diameter_bound = length(extent);
    return tree;
}

template PrimitiveBvh<2> build_primitive_bvh<2>(std::span<const PrimitiveCorners<2>>);
template PrimitiveBvh<3> build_primitive_bvh<3>(std::span<const PrimitiveCorners<3>>);

}  // namespace abut::detail
