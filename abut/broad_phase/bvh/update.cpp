// The update: refits the tree, and rebuilds the subtrees that have decayed. Moving items enlarge small nodes first and
// large nodes later, in proportion to the motion divided by the size of the node. So each subtree is rebuilt as often
// as it needs, and the whole tree only when the large nodes have decayed.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>
#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/assert.hpp>

#include <hwy/cache_control.h>

namespace abut::detail {
namespace {

/// The maximum sum of the areas of a node's children, relative to the sum when it was built. It varies with the node,
/// so that subtrees that were built in one frame are not all rebuilt in one frame.
double max_area(std::uint32_t node, double built_area) {
    const double hash = static_cast<double>(node * 0x9E3779B9u) * 0x1p-32;
    return built_area * (1.06 + 0.1 * hash);
}

/// The maximum sum of the areas of all large nodes, relative to the sum when they were built.
constexpr double max_large_area_ratio = 1.08;

}  // namespace

template <int D>
void BvhTree<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    refit(boxes, executor);
    if (items_ < size() && !insert_missing(boxes)) return rebuild(boxes, executor);
    // The tree is rebuilt if its leaves have fewer than four items on average.
    if (leaves_live_ > items_ / 4 + bvh_lanes) return rebuild(boxes, executor);
    jobs_.clear();
    for (const std::size_t kind : {0u, 1u}) {
        double area = 0, built_area = 0;
        if (roots_[kind].ref != bvh_none) find_decayed_subtrees(roots_[kind].ref, 0, kind == 0, area, built_area);
        if (area > max_large_area_ratio * built_area) return rebuild(boxes, executor);
    }
    run_jobs(nullptr, executor);
}

template <int D>
void BvhTree<D>::refit(std::span<const Aabb<D>> boxes, Executor* executor) {
    items_ = 0;
    for (BvhRoot<D>& root : roots_) {
        if (root.ref == bvh_none) continue;
        const bool bounded = &root == &roots_[0];
        BoundsAndCount all;
        if (executor == nullptr || is_leaf(root.ref)) {
            all = refit_below(root.ref, boxes, bounded);
        } else {
            TreeCut cut;
            refit_above(root.ref, 2, cut, false);
            const std::uint32_t count = cut.count;
            run_parallel(executor, count,
                         [&](std::uint32_t i) { cut.results[i] = refit_below(cut.refs[i], boxes, bounded); });
            cut.count = 0;
            all = refit_above(root.ref, 2, cut, true);
        }
        root.box = all.box;
        items_ += all.items;
    }
}

template <int D>
typename BvhTree<D>::BoundsAndCount BvhTree<D>::refit_below(std::uint32_t ref, std::span<const Aabb<D>> boxes,
                                                            bool bounded) {
    if (is_leaf(ref)) return refit_leaf(ref, boxes, bounded);
    BvhNode<D>& node = nodes_[ref];
    for (const std::uint32_t child : node.child) prefetch(child, boxes);
    return refit_node(node, [&](std::uint32_t child) { return refit_below(child, boxes, bounded); });
}

/// Visits the nodes above a cut through the tree: first to collect the subtrees below the cut, and again, after these
/// are refitted, to refit the nodes above.
template <int D>
typename BvhTree<D>::BoundsAndCount BvhTree<D>::refit_above(std::uint32_t ref, int levels, TreeCut& cut,
                                                            bool is_refitted) {
    if (levels == 0 || is_leaf(ref)) {
        cut.refs[cut.count] = ref;
        return is_refitted ? cut.results[cut.count++] : (++cut.count, BoundsAndCount());
    }
    if (is_refitted)
        return refit_node(nodes_[ref], [&](std::uint32_t child) { return refit_above(child, levels - 1, cut, true); });
    for (const std::uint32_t child : nodes_[ref].child)
        if (child != bvh_none) refit_above(child, levels - 1, cut, false);
    return {};
}

template <int D>
template <class Refit>
typename BvhTree<D>::BoundsAndCount BvhTree<D>::refit_node(BvhNode<D>& node, Refit refit) {
    BoundsAndCount result;
    for (std::uint32_t lane = 0; lane < bvh_lanes && node.child[lane] != bvh_none; ++lane) {
        const BoundsAndCount below = refit(node.child[lane]);
        if (below.items == 0)
            node.clear(lane);
        else
            node.set(lane, below.box);
        result.box = merged(result.box, below.box);
        result.items += below.items;
    }
    node.items = result.items;
    node.area = children_area(node);
    return result;
}

/// Removes the items that have become empty, and those that belong to the other tree (bounded or unbounded).
template <int D>
typename BvhTree<D>::BoundsAndCount BvhTree<D>::refit_leaf(std::uint32_t ref, std::span<const Aabb<D>> boxes,
                                                           bool bounded) {
    const std::uint32_t slot = ref & ~bvh_leaf_bit;
    BvhLeaf<D>& leaf = leaves_[slot];
    BoundsAndCount result;
    for (std::uint32_t lane = 0; lane < bvh_lanes && leaf.index[lane] != bvh_none;) {
        const std::uint32_t index = leaf.index[lane];
        const Aabb<D> box = usable(boxes[index]);
        if (is_empty(box) || is_bounded(box) != bounded) {
            positions_[index] = position_none;
            remove_from_leaf(slot, lane);
            continue;
        }
        leaf.set(lane++, box);
        result.box = merged(result.box, box);
        ++result.items;
    }
    return result;
}

/// Prefetches the boxes of a leaf, which are scattered in memory.
template <int D>
void BvhTree<D>::prefetch(std::uint32_t ref, std::span<const Aabb<D>> boxes) const {
    if (ref == bvh_none || !is_leaf(ref)) return;
    for (const std::uint32_t index : leaf(ref).index)
        if (index != bvh_none) hwy::Prefetch(&boxes[index]);
}

/// Makes jobs of the largest decayed subtrees that one job can build, and sums up the areas of the larger nodes.
template <int D>
void BvhTree<D>::find_decayed_subtrees(std::uint32_t ref, int depth, bool bounded, double& area, double& built_area) {
    if (is_leaf(ref)) return;
    const BvhNode<D>& node = nodes_[ref];
    if (node.items == 0) return;
    if (node.items > bvh_subtree_items) {
        area += node.area;
        built_area += node.built_area;
    } else if (node.area > max_area(ref, node.built_area)) {
        const std::uint32_t parent = node.parent;
        std::uint32_t lane = bounded ? 0 : 1;
        if (parent != bvh_none) lane = lane_of(ref);
        jobs_.push_back({0, 0, ref, parent, lane, depth, bounded});
        return;
    }
    for (const std::uint32_t child : node.child)
        if (child != bvh_none) find_decayed_subtrees(child, depth + 1, bounded, area, built_area);
}

/// Inserts the items that are not in the tree and are no longer empty. Returns false if they are so many that a rebuild
/// is faster.
template <int D>
bool BvhTree<D>::insert_missing(std::span<const Aabb<D>> boxes) {
    const std::uint32_t max_inserted = items_ / 8;
    std::uint32_t inserted = 0;
    for (std::uint32_t i = 0; i < size(); ++i) {
        if (positions_[i] < position_free) continue;
        const Aabb<D> box = usable(boxes[i]);
        if (is_empty(box)) continue;
        if (++inserted > max_inserted || !has_capacity()) return false;
        add(i, box);
    }
    return true;
}

template void BvhTree<2>::update(std::span<const Aabb<2>>, Executor*);
template void BvhTree<2>::refit(std::span<const Aabb<2>>, Executor*);
template void BvhTree<3>::refit(std::span<const Aabb<3>>, Executor*);
template void BvhTree<3>::update(std::span<const Aabb<3>>, Executor*);

}  // namespace abut::detail
