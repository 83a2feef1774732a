// Traversal of a tree with eight children a node, for the items that a box overlaps, that a ray touches, or that are
// near a box. Nodes are tested in float, conservatively; items by their own boxes, in double. Included once for each
// Highway target.

#if defined(ABUT_BVH_TRAVERSAL) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_BVH_TRAVERSAL
#undef ABUT_BVH_TRAVERSAL
#else
#define ABUT_BVH_TRAVERSAL
#endif

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh/reach_simd-inl.h>
#include <abut/broad_phase/visit.hpp>

#include <bit>
#include <limits>

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// A traversal pushes at most the seven siblings of each node on its path, and the two roots.
constexpr std::size_t max_stack_size = bvh_depth * (bvh_lanes - 1) + 2;

/// Removes the lowest set bit and returns its lane.
inline std::uint32_t next_lane(std::uint32_t& bits) {
    const auto result = static_cast<std::uint32_t>(std::countr_zero(bits));
    bits &= bits - 1;
    return result;
}

/// Visits the items whose boxes overlap `box`. leaf_of(ref) returns the boxes of a leaf and their indices.
template <int D, class Tree, class LeafOf>
void visit_overlapping(const Tree& tree, LeafOf leaf_of, const Aabb<D>& box, ItemCall visit) {
    std::uint32_t stack[max_stack_size];
    std::size_t stack_size = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[stack_size++] = tree.root(kind).ref;
    while (stack_size > 0) {
        const std::uint32_t ref = stack[--stack_size];
        if (is_leaf(ref)) {
            const BvhLeaf<D>& leaf = leaf_of(ref);
            for (std::uint32_t bits = overlapping_lanes<D>(leaf, box); bits != 0;)
                if (!visit(leaf.index[next_lane(bits)])) return;
            continue;
        }
        const auto& node = tree.node(ref);
        // The first child is pushed last.
        for (std::uint32_t bits = overlapping_lanes<D>(node, box); bits != 0;) {
            const auto lane = static_cast<std::uint32_t>(std::bit_width(bits)) - 1;
            bits ^= 1u << lane;
            stack[stack_size++] = node.child[lane];
        }
    }
}

/// A stack entry: a node or leaf that may be within reach, and a lower bound of its measure.
struct BvhStackEntry {
    float measure;
    std::uint32_t ref;
};

/// An entry that is within no reach.
constexpr BvhStackEntry no_entry{std::numeric_limits<float>::quiet_NaN(), bvh_none};

/// Returns the nearest of the children in `bits` and pushes the others in the order of their lanes: sorting them takes
/// longer than it saves.
inline BvhStackEntry push_all_but_nearest(std::uint32_t bits, const float (&measures)[bvh_lanes],
                                          const std::uint32_t (&refs)[bvh_lanes], BvhStackEntry* stack,
                                          std::size_t& stack_size) {
    if (bits == 0) return no_entry;
    std::uint32_t lane = next_lane(bits);
    BvhStackEntry nearest{measures[lane], refs[lane]};
    while (bits != 0) {
        lane = next_lane(bits);
        const BvhStackEntry other{measures[lane], refs[lane]};
        const bool is_nearer = other.measure < nearest.measure;
        stack[stack_size++] = is_nearer ? nearest : other;
        nearest = is_nearer ? other : nearest;
    }
    return nearest;
}

/// Removes the lane with the smallest measure from `bits` and returns it.
inline std::uint32_t take_nearest(std::uint32_t& bits, const float (&measures)[bvh_lanes]) {
    std::uint32_t remaining = bits;
    std::uint32_t nearest = next_lane(remaining);
    while (remaining != 0) {
        const std::uint32_t lane = next_lane(remaining);
        if (measures[lane] < measures[nearest]) nearest = lane;
    }
    bits &= ~(1u << nearest);
    return nearest;
}

/// Whether the box of an item is within reach, tested in double. A FloatReach needs no second test.
template <int D>
bool is_confirmed(const FloatReach&, const BvhLeaf<D>&, std::uint32_t) {
    return true;
}
template <int D, class Reach>
bool is_confirmed(const Reach& reach, const BvhLeaf<D>& leaf, std::uint32_t lane) {
    double measure = 0;
    return reach.measure(leaf.box(lane), measure);
}

/// Visits the items within reach, roughly nearest first, and shrinks the reach by the results of the visitor.
/// `test` is the conservative SIMD test of eight boxes.
template <int D, class Tree, class LeafOf, class Reach, class Test>
void visit_within(const Tree& tree, LeafOf leaf_of, Reach& reach, const Test& test, ReachCall visit) {
    if (reach.is_exhausted()) return;
    BvhStackEntry stack[max_stack_size];
    std::size_t stack_size = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[stack_size++] = {0, tree.root(kind).ref};
    float max_measure = float_max_measure(reach), measures[bvh_lanes];
    while (stack_size > 0) {
        BvhStackEntry next = stack[--stack_size];
        while (next.measure <= max_measure && !is_leaf(next.ref)) {
            const auto& node = tree.node(next.ref);
            hwy::Prefetch(node.child);  // the references lie apart from the boxes and are needed next
            next = push_all_but_nearest(test(node, max_measure, measures), measures, node.child, stack, stack_size);
        }
        if (!(next.measure <= max_measure)) continue;
        const auto& leaf = leaf_of(next.ref);
        for (std::uint32_t bits = test(leaf, max_measure, measures); bits != 0;) {
            const std::uint32_t lane = take_nearest(bits, measures);
            if (measures[lane] > max_measure) break;
            if (!is_confirmed(reach, leaf, lane)) continue;
            reach.shrink(visit(leaf.index[lane]));
            if (reach.is_exhausted()) return;
            max_measure = float_max_measure(reach);
        }
    }
}

template <int D, class Tree, class LeafOf>
void visit_along(const Tree& tree, LeafOf leaf_of, RayReach<D> reach, ReachCall visit) {
    if (RayLanes<D, true>::is_in_range(reach))
        visit_within<D>(tree, leaf_of, reach, RayLanes<D, true>(reach), visit);
    else
        visit_within<D>(tree, leaf_of, reach, ScalarLanes<D, RayReach<D>>(reach), visit);
}

template <int D, class Tree, class LeafOf>
void visit_along_ray(const Tree& tree, LeafOf leaf_of, const Ray<D>& ray, ReachCall visit) {
    if (RayLanes<D, false>::is_in_range(ray)) {
        FloatReach reach(ray.length);
        visit_within<D>(tree, leaf_of, reach, RayLanes<D, false>(ray), visit);
    } else {
        visit_along<D>(tree, leaf_of, RayReach<D>(ray), visit);
    }
}

template <int D, class Tree, class LeafOf>
void visit_near(const Tree& tree, LeafOf leaf_of, BoxReach<D> reach, ReachCall visit) {
    if (BoxLanes<D>::is_in_range(reach))
        visit_within<D>(tree, leaf_of, reach, BoxLanes<D>(reach), visit);
    else
        visit_within<D>(tree, leaf_of, reach, ScalarLanes<D, BoxReach<D>>(reach), visit);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
