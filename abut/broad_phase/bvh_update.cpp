// The tree of frame after frame: refitted, and put together anew where that has made it worse. What drifts spoils the
// small nodes first and the large ones later, each as fast as its items move against its size: so parts are repaired as
// often as they need it, and everything is built anew only where the large nodes have decayed.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh_jobs.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>

#include <hwy/cache_control.h>

namespace abut {
namespace {

/// How much larger than when it was built a node may be in the areas of its children. Not the same for all, or all that
/// were built in one frame would be repaired in one frame.
double area_allowed(std::uint32_t node, double built) {
    const double some = static_cast<double>(node * 0x9E3779B9u) * 0x1p-32;
    return built * (1.06 + 0.1 * some);
}

/// The same for all large nodes together.
constexpr double large_area_allowed = 1.08;

}  // namespace

template <int D>
void BvhTree<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    refit(boxes, executor);
    if (items_ < size() && !take_in_newcomers(boxes)) return build_anew(boxes, executor);
    // Leaves that hold few are too many.
    if (leaves_live_ > items_ / 4 + bvh_lanes) return build_anew(boxes, executor);
    jobs_.clear();
    for (const std::size_t kind : {0u, 1u}) {
        double area = 0, built = 0;
        if (roots_[kind].ref != bvh_none) plan_repairs(roots_[kind].ref, 0, kind == 0, area, built);
        if (area > large_area_allowed * built) return build_anew(boxes, executor);
    }
    run_jobs(nullptr, executor);
}

template <int D>
void BvhTree<D>::refit(std::span<const Aabb<D>> boxes, Executor* executor) {
    items_ = 0;
    for (BvhRoot<D>& root : roots_) {
        if (root.ref == bvh_none) continue;
        const bool bounded = &root == &roots_[0];
        Counted all;
        if (executor == nullptr || is_leaf(root.ref)) {
            all = refit_below(root.ref, boxes, bounded);
        } else {
            Cut cut;
            refit_above(root.ref, 2, cut, false);
            const std::uint32_t count = cut.count;
            run_side_by_side(executor, count,
                             [&](std::uint32_t i) { cut.results[i] = refit_below(cut.refs[i], boxes, bounded); });
            cut.count = 0;
            all = refit_above(root.ref, 2, cut, true);
        }
        root.box = all.box;
        items_ += all.items;
    }
}

template <int D>
typename BvhTree<D>::Counted BvhTree<D>::refit_below(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded) {
    if (is_leaf(ref)) return refit_leaf(ref, boxes, bounded);
    BvhNode<D>& node = nodes_[ref];
    for (const std::uint32_t child : node.child) prefetch(child, boxes);
    return refit_node(node, [&](std::uint32_t child) { return refit_below(child, boxes, bounded); });
}

/// What lies above a cut through the tree: once to make the cut, and once when all below it is done.
template <int D>
typename BvhTree<D>::Counted BvhTree<D>::refit_above(std::uint32_t ref, int levels, Cut& cut, bool done) {
    if (levels == 0 || is_leaf(ref)) {
        cut.refs[cut.count] = ref;
        return done ? cut.results[cut.count++] : (++cut.count, Counted());
    }
    if (done)
        return refit_node(nodes_[ref], [&](std::uint32_t child) { return refit_above(child, levels - 1, cut, true); });
    for (const std::uint32_t child : nodes_[ref].child)
        if (child != bvh_none) refit_above(child, levels - 1, cut, false);
    return {};
}

template <int D>
template <class Refit>
typename BvhTree<D>::Counted BvhTree<D>::refit_node(BvhNode<D>& node, Refit refit) {
    Counted result;
    for (std::uint32_t lane = 0; lane < bvh_lanes && node.child[lane] != bvh_none; ++lane) {
        const Counted below = refit(node.child[lane]);
        if (below.items == 0)
            node.clear(lane);
        else
            node.set(lane, below.box);
        result.box = merged(result.box, below.box);
        result.items += below.items;
    }
    node.items = result.items;
    node.area = area_of(node);
    return result;
}

/// Lets go of what is empty now, and of what belongs into the other tree.
template <int D>
typename BvhTree<D>::Counted BvhTree<D>::refit_leaf(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded) {
    const std::uint32_t slot = ref & ~bvh_leaf_bit;
    BvhLeaf<D>& leaf = leaves_[slot];
    Counted result;
    for (std::uint32_t lane = 0; lane < bvh_lanes && leaf.index[lane] != bvh_none;) {
        const std::uint32_t index = leaf.index[lane];
        const Aabb<D> box = usable(boxes[index]);
        if (is_empty(box) || is_bounded(box) != bounded) {
            places_[index] = place_none;
            take_out(slot, lane);
            continue;
        }
        leaf.set(lane++, box);
        result.box = merged(result.box, box);
        ++result.items;
    }
    return result;
}

/// Asks for the boxes of a leaf, which lie anywhere in memory, before they are needed.
template <int D>
void BvhTree<D>::prefetch(std::uint32_t ref, std::span<const Aabb<D>> boxes) const {
    if (ref == bvh_none || !is_leaf(ref)) return;
    for (const std::uint32_t index : leaf(ref).index)
        if (index != bvh_none) hwy::Prefetch(&boxes[index]);
}

/// Lists the largest subtrees that are one part and have decayed, and sums up what is larger.
template <int D>
void BvhTree<D>::plan_repairs(std::uint32_t ref, int depth, bool bounded, double& area, double& built) {
    if (is_leaf(ref)) return;
    const BvhNode<D>& node = nodes_[ref];
    if (node.items == 0) return;
    if (node.items > bvh_part_items) {
        area += node.area;
        built += node.built;
    } else if (node.area > area_allowed(ref, node.built)) {
        const std::uint32_t parent = node.parent;
        std::uint32_t lane = bounded ? 0 : 1;
        if (parent != bvh_none) lane = lane_of(ref);
        jobs_.push_back({0, 0, ref, parent, lane, depth, bounded});
        return;
    }
    for (const std::uint32_t child : node.child)
        if (child != bvh_none) plan_repairs(child, depth + 1, bounded, area, built);
}

/// What was not in the tree and holds something now. False where it is so much that all had better be built anew.
template <int D>
bool BvhTree<D>::take_in_newcomers(std::span<const Aabb<D>> boxes) {
    const std::uint32_t most = items_ / 8;
    std::uint32_t taken = 0;
    for (std::uint32_t i = 0; i < size(); ++i) {
        if (places_[i] < place_free) continue;
        const Aabb<D> box = usable(boxes[i]);
        if (is_empty(box)) continue;
        if (++taken > most || !has_room()) return false;
        add(i, box);
    }
    return true;
}

template void BvhTree<2>::update(std::span<const Aabb<2>>, Executor*);
template void BvhTree<3>::update(std::span<const Aabb<3>>, Executor*);

}  // namespace abut
