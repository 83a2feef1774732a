// Down through the nodes of a tree of eight children each, to what a box overlaps, a ray touches, or is near. What a
// ray or a distance meets is guessed in float, never too little; what an item is, its own box decides, in double.
// Included once for each kind of vector unit.

#if defined(ABUT_BVH_DOWN) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_BVH_DOWN
#undef ABUT_BVH_DOWN
#else
#define ABUT_BVH_DOWN
#endif

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh_reach-inl.h>
#include <abut/broad_phase/visit.hpp>

#include <bit>
#include <limits>

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Enough for the seven neighbours of each node on the way down.
constexpr std::size_t most_waiting = bvh_depth * (bvh_lanes - 1) + 2;

inline std::uint32_t next_lane(std::uint32_t& bits) {
    const auto result = static_cast<std::uint32_t>(std::countr_zero(bits));
    bits &= bits - 1;
    return result;
}

/// `rows_of(ref)` are the boxes of a leaf, with the index of each.
template <int D, class Tree, class RowsOf>
void overlapping(const Tree& tree, RowsOf rows_of, const Aabb<D>& box, ItemCall visit) {
    std::uint32_t stack[most_waiting];
    std::size_t waiting = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[waiting++] = tree.root(kind).ref;
    while (waiting > 0) {
        const std::uint32_t ref = stack[--waiting];
        if (is_leaf(ref)) {
            const BvhLeaf<D>& leaf = rows_of(ref);
            for (std::uint32_t bits = overlapping_lanes<D>(leaf, box); bits != 0;)
                if (!visit(leaf.index[next_lane(bits)])) return;
            continue;
        }
        const auto& node = tree.node(ref);
        // The first child on top.
        for (std::uint32_t bits = overlapping_lanes<D>(node, box); bits != 0;) {
            const auto lane = static_cast<std::uint32_t>(std::bit_width(bits)) - 1;
            bits ^= 1u << lane;
            stack[waiting++] = node.child[lane];
        }
    }
}

/// What is perhaps within reach, and how far away it is at least.
struct BvhFound {
    float measure;
    std::uint32_t ref;
};

/// Within no reach.
constexpr BvhFound nothing_found{std::numeric_limits<float>::quiet_NaN(), bvh_none};

/// The nearest of some of eight; the rest wait on the stack in the order of their lanes, as to sort them takes longer
/// than it saves.
inline BvhFound nearest_of(std::uint32_t bits, const float (&measures)[bvh_lanes],
                           const std::uint32_t (&refs)[bvh_lanes], BvhFound* stack, std::size_t& waiting) {
    if (bits == 0) return nothing_found;
    std::uint32_t lane = next_lane(bits);
    BvhFound nearest{measures[lane], refs[lane]};
    while (bits != 0) {
        lane = next_lane(bits);
        const BvhFound other{measures[lane], refs[lane]};
        const bool nearer = other.measure < nearest.measure;
        stack[waiting++] = nearer ? nearest : other;
        nearest = nearer ? other : nearest;
    }
    return nearest;
}

/// Takes the nearest out of some of eight.
inline std::uint32_t take_nearest(std::uint32_t& bits, const float (&measures)[bvh_lanes]) {
    std::uint32_t rest = bits;
    std::uint32_t nearest = next_lane(rest);
    while (rest != 0) {
        const std::uint32_t lane = next_lane(rest);
        if (measures[lane] < measures[nearest]) nearest = lane;
    }
    bits &= ~(1u << nearest);
    return nearest;
}

/// Whether an item is within reach by its box in double, where floats don't decide.
template <int D>
bool confirmed(const FloatReach&, const BvhLeaf<D>&, std::uint32_t) {
    return true;
}
template <int D, class Reach>
bool confirmed(const Reach& reach, const BvhLeaf<D>& leaf, std::uint32_t lane) {
    double measure = 0;
    return reach.measure(leaf.box(lane), measure);
}

/// Shrinks the reach.
template <int D, class Tree, class RowsOf, class Reach, class Test>
void within(const Tree& tree, RowsOf rows_of, Reach& reach, const Test& test, ReachCall visit) {
    if (reach.over()) return;
    BvhFound stack[most_waiting];
    std::size_t waiting = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[waiting++] = {0, tree.root(kind).ref};
    float most = float_most(reach), measures[bvh_lanes];
    while (waiting > 0) {
        BvhFound next = stack[--waiting];
        while (next.measure <= most && !is_leaf(next.ref)) {
            const auto& node = tree.node(next.ref);
            hwy::Prefetch(node.child);  // it lies apart from the boxes, and would be asked for only after them
            next = nearest_of(test(node, most, measures), measures, node.child, stack, waiting);
        }
        if (!(next.measure <= most)) continue;
        const BvhLeaf<D>& leaf = rows_of(next.ref);
        for (std::uint32_t bits = test(leaf, most, measures); bits != 0;) {
            const std::uint32_t lane = take_nearest(bits, measures);
            if (measures[lane] > most) break;
            if (!confirmed(reach, leaf, lane)) continue;
            reach.shrink(visit(leaf.index[lane]));
            if (reach.over()) return;
            most = float_most(reach);
        }
    }
}

template <int D, class Tree, class RowsOf>
void along(const Tree& tree, RowsOf rows_of, RayReach<D> reach, ReachCall visit) {
    if (RayLanes<D, true>::suits(reach))
        within<D>(tree, rows_of, reach, RayLanes<D, true>(reach), visit);
    else
        within<D>(tree, rows_of, reach, SlowLanes<D, RayReach<D>>(reach), visit);
}

template <int D, class Tree, class RowsOf>
void along_ray(const Tree& tree, RowsOf rows_of, const Ray<D>& ray, ReachCall visit) {
    if (RayLanes<D, false>::suits(ray)) {
        FloatReach reach(ray.length);
        within<D>(tree, rows_of, reach, RayLanes<D, false>(ray), visit);
    } else {
        along<D>(tree, rows_of, RayReach<D>(ray), visit);
    }
}

template <int D, class Tree, class RowsOf>
void near(const Tree& tree, RowsOf rows_of, BoxReach<D> reach, ReachCall visit) {
    if (BoxLanes<D>::suits(reach))
        within<D>(tree, rows_of, reach, BoxLanes<D>(reach), visit);
    else
        within<D>(tree, rows_of, reach, SlowLanes<D, BoxReach<D>>(reach), visit);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
