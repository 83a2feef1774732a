// Builds the tree from nothing. The upper levels are split first, breadth first; each of the remaining ranges then
// becomes a subtree, which one thread builds. During the build the items lie at the end of the memory of the leaves:
// leaves overwrite items that are no longer needed.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>
#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <new>

namespace abut::detail {

template <int D>
void BvhTree<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 31);
    positions_.assign(boxes.size(), position_none);
    free_.clear();
    rebuild(boxes, executor);
}

/// Preserves the free indices.
template <int D>
void BvhTree<D>::rebuild(std::span<const Aabb<D>> boxes, Executor* executor) {
    const auto size = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t& position : positions_)
        if (position != position_free) position = position_none;
    BvhItem* items = clear_for_build(size);
    std::uint32_t bounded = 0;
    items_ = 0;
    for (const bool selects_bounded : {true, false}) {
        for (std::uint32_t i = 0; i < size; ++i) {
            const Aabb<D> box = usable(boxes[i]);
            if (is_empty(box) || is_bounded(box) != selects_bounded) continue;
            new (items + items_++) BvhItem(item_of(box, i));
        }
        if (selects_bounded) bounded = items_;
    }
    jobs_.clear();
    split_into_jobs(items, true, 0, bounded, executor);
    split_into_jobs(items, false, bounded, items_, executor);
    run_jobs(items, executor);
}

/// Reserves memory to build a tree of so many items, with space for the items at the end of the leaves. After many
/// changes of single items leaves and nodes are less full than built ones: 4.4 items in a leaf and 4.5 children in a
/// node, the minimum during 24 moves of each of 10,000 items to anywhere.
template <int D>
void BvhTree<D>::reserve(std::uint32_t items) {
    const std::size_t for_items = std::size_t{items} * sizeof(BvhItem) / sizeof(BvhLeaf<D>);
    const std::size_t leaves = std::max(std::size_t{items} * 15 / 64, for_items) + 2 * bvh_lanes;
    if (leaves_.size() < leaves) {
        leaves_.resize(leaves);
        leaf_parents_.resize(leaves);
    }
    const std::size_t nodes = items / 15 + 2 * bvh_lanes;
    if (nodes_.size() < nodes) nodes_.resize(nodes);
    if (subtrees_.empty()) subtrees_.resize(1);
    for (BvhSubtree<D>& subtree : subtrees_) subtree.reserve(std::min(items, bvh_subtree_items));
    jobs_.reserve(nodes_.size());
}

/// Empties the tree, reserves memory for a build, and returns the space for the items.
template <int D>
BvhItem* BvhTree<D>::clear_for_build(std::uint32_t items) {
    if (leaves_.size() < bvh_max_leaves(items) + bvh_lanes) {
        // Clearing them avoids a copy of their contents.
        leaves_.clear();
        nodes_.clear();
    }
    reserve(items);
    roots_ = {};
    nodes_used_ = leaves_used_ = nodes_live_ = leaves_live_ = 0;
    next_node_ = next_leaf_ = bvh_none;
    return reinterpret_cast<BvhItem*>(leaves_.data() + leaves_.size()) - items;
}

/// Splits the items into jobs and makes the nodes above them.
template <int D>
void BvhTree<D>::split_into_jobs(BvhItem* items, bool bounded, std::uint32_t begin, std::uint32_t end,
                                 Executor* executor) {
    if (begin == end) return;
    upper_ranges_.clear();
    upper_ranges_.push_back({whole_range<D>(items, begin, end, 0), 0});
    roots_[bounded ? 0 : 1].box = upper_ranges_[0].range.box;
    for (std::size_t first = 0, last = 1; first < last; first = last, last = upper_ranges_.size()) {
        for (std::size_t i = first; i < last; ++i) {
            if (upper_ranges_[i].range.count() <= bvh_subtree_items) continue;
            upper_ranges_[i].left = static_cast<std::uint32_t>(upper_ranges_.size());
            upper_ranges_.resize(upper_ranges_.size() + 2);
        }
        run_parallel(executor, static_cast<std::uint32_t>(last - first), [&](std::uint32_t i) {
            const UpperRange upper = upper_ranges_[first + i];
            if (upper.left == 0) return;
            split(items, bounded, upper.range, upper_ranges_[upper.left].range, upper_ranges_[upper.left + 1].range);
        });
    }
    make_upper_node(0, bounded, bvh_none, bounded ? 0 : 1);
}

template <int D>
void BvhTree<D>::make_upper_node(std::uint32_t range_index, bool bounded, std::uint32_t parent, std::uint32_t lane) {
    const BvhRange<D>& range = upper_ranges_[range_index].range;
    if (upper_ranges_[range_index].left == 0) {
        jobs_.push_back({range.begin, range.end, bvh_none, parent, lane, range.depth, bounded});
        return;
    }
    std::array<std::uint32_t, bvh_lanes> child{range_index};
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next != bvh_none && count < bvh_lanes; ++count) {
        std::copy_backward(child.data() + next + 1, child.data() + count, child.data() + count + 1);
        const std::uint32_t left = upper_ranges_[child[next]].left;
        child[next] = left;
        child[next + 1] = left + 1;
        next = bvh_none;
        double max_area = -1;
        for (std::uint32_t i = 0; i <= count; ++i) {
            const double area = box_size(upper_ranges_[child[i]].range.box).area;
            if (upper_ranges_[child[i]].left == 0 || area <= max_area) continue;
            max_area = area;
            next = i;
        }
    }
    const std::uint32_t node = allocate_node();
    if (parent == bvh_none)
        roots_[lane].ref = node;
    else
        nodes_[parent].child[lane] = node;
    nodes_[node] = BvhNode<D>::empty();
    nodes_[node].parent = parent;
    nodes_[node].items = range.count();
    for (std::uint32_t i = 0; i < count; ++i) {
        nodes_[node].set(i, upper_ranges_[child[i]].range.box);
        make_upper_node(child[i], bounded, node, i);
    }
    nodes_[node].area = nodes_[node].built_area = children_area(nodes_[node]);
}

/// Runs the jobs in batches: threads build the subtrees, then one thread attaches them in order, then threads copy them
/// into the tree. So the tree doesn't depend on the number of threads.
template <int D>
void BvhTree<D>::run_jobs(const BvhItem* items, Executor* executor) {
    const std::size_t max_threads = executor == nullptr ? 1 : std::clamp<std::size_t>(executor->workers(), 1, 16);
    const std::size_t batch_size = std::min(max_threads, std::max<std::size_t>(jobs_.size(), 1));
    while (subtrees_.size() < batch_size)
        subtrees_.emplace_back().reserve(std::min(static_cast<std::uint32_t>(size()), bvh_subtree_items));
    for (std::size_t first = 0; first < jobs_.size(); first += batch_size) {
        const auto count = static_cast<std::uint32_t>(std::min(batch_size, jobs_.size() - first));
        run_parallel(executor, count, [&](std::uint32_t i) {
            const SubtreeJob& job = jobs_[first + i];
            BvhSubtree<D>& subtree = subtrees_[i];
            subtree.items.clear();
            subtree.node_slots.clear();
            subtree.leaf_slots.clear();
            if (job.ref == bvh_none)
                subtree.items.assign(items + job.begin, items + job.end);
            else
                collect(job.ref, subtree);
            build_subtree(subtree, job.bounded, job.depth);
        });
        for (std::uint32_t i = 0; i < count; ++i) attach_subtree(subtrees_[i], jobs_[first + i]);
        run_parallel(executor, count, [&](std::uint32_t i) { copy_subtree(subtrees_[i], jobs_[first + i]); });
    }
}

/// Allocates the nodes and leaves of a subtree, reusing those that it replaces, and links its root to its parent.
template <int D>
void BvhTree<D>::attach_subtree(BvhSubtree<D>& subtree, const SubtreeJob& job) {
    for (; subtree.node_slots.size() > subtree.nodes.size(); subtree.node_slots.pop_back())
        free_node(subtree.node_slots.back());
    for (; subtree.leaf_slots.size() > subtree.leaves.size(); subtree.leaf_slots.pop_back())
        free_leaf(subtree.leaf_slots.back());
    while (subtree.node_slots.size() < subtree.nodes.size()) subtree.node_slots.push_back(allocate_node());
    while (subtree.leaf_slots.size() < subtree.leaves.size()) subtree.leaf_slots.push_back(allocate_leaf());
    const std::uint32_t ref = is_leaf(subtree.root) ? subtree.leaf_slots[0] | bvh_leaf_bit : subtree.node_slots[0];
    if (job.parent == bvh_none)
        roots_[job.lane].ref = ref;
    else
        nodes_[job.parent].child[job.lane] = ref;
    parent_of(ref) = job.parent;
}

/// Copies the nodes and leaves of a subtree to their slots and sets the positions of its items.
template <int D>
void BvhTree<D>::copy_subtree(const BvhSubtree<D>& subtree, const SubtreeJob& job) {
    for (std::size_t i = 0; i < subtree.leaves.size(); ++i) {
        const BvhLeaf<D>& leaf = subtree.leaves[i];
        new (leaves_.data() + subtree.leaf_slots[i]) BvhLeaf<D>(leaf);
        for (std::uint32_t lane = 0; lane < bvh_lanes && leaf.index[lane] != bvh_none; ++lane)
            positions_[leaf.index[lane]] = subtree.leaf_slots[i] * bvh_lanes + lane;
    }
    for (std::size_t i = 0; i < subtree.nodes.size(); ++i) {
        BvhNode<D>& node = nodes_[subtree.node_slots[i]];
        node = subtree.nodes[i];
        node.parent = i == 0 ? job.parent : subtree.node_slots[node.parent];
        for (std::uint32_t lane = 0; lane < bvh_lanes && node.child[lane] != bvh_none; ++lane) {
            std::uint32_t& child = node.child[lane];
            if (is_leaf(child)) {
                child = subtree.leaf_slots[child & ~bvh_leaf_bit];
                leaf_parents_[child] = subtree.node_slots[i];
                child |= bvh_leaf_bit;
            } else {
                child = subtree.node_slots[child];
            }
        }
    }
}

template <int D>
std::uint32_t BvhTree<D>::allocate_node() {
    ++nodes_live_;
    if (next_node_ != bvh_none) {
        const std::uint32_t result = next_node_;
        next_node_ = nodes_[result].parent;
        return result;
    }
    if (nodes_used_ == nodes_.size()) nodes_.resize(nodes_.size() + nodes_.size() / 2 + bvh_lanes);
    return nodes_used_++;
}

template <int D>
std::uint32_t BvhTree<D>::allocate_leaf() {
    ++leaves_live_;
    if (next_leaf_ != bvh_none) {
        const std::uint32_t result = next_leaf_;
        next_leaf_ = leaf_parents_[result];
        return result;
    }
    if (leaves_used_ == leaves_.size()) {
        leaves_.resize(leaves_.size() + leaves_.size() / 2 + bvh_lanes);
        leaf_parents_.resize(leaves_.size());
    }
    return leaves_used_++;
}

template <int D>
void BvhTree<D>::free_node(std::uint32_t node) {
    --nodes_live_;
    nodes_[node].parent = next_node_;
    next_node_ = node;
}

template <int D>
void BvhTree<D>::free_leaf(std::uint32_t leaf) {
    --leaves_live_;
    leaf_parents_[leaf] = next_leaf_;
    next_leaf_ = leaf;
}

/// Collects the items of a subtree, and the slots of its nodes and leaves.
template <int D>
void BvhTree<D>::collect(std::uint32_t ref, BvhSubtree<D>& subtree) const {
    const BvhNode<D>& from = nodes_[ref];
    subtree.node_slots.push_back(ref);
    for (std::uint32_t lane = 0; lane < bvh_lanes && from.child[lane] != bvh_none; ++lane) {
        const std::uint32_t child = from.child[lane];
        if (!is_leaf(child)) {
            collect(child, subtree);
            continue;
        }
        const BvhLeaf<D>& items = leaf(child);
        subtree.leaf_slots.push_back(child & ~bvh_leaf_bit);
        for (std::uint32_t k = 0; k < bvh_lanes && items.index[k] != bvh_none; ++k)
            subtree.items.push_back(item_of(items.box(k), items.index[k]));
    }
}

template <int D>
double BvhTree<D>::cost_below(std::uint32_t ref) const {
    if (ref == bvh_none || is_leaf(ref)) return 0;
    double result = children_area(nodes_[ref]);
    for (const std::uint32_t child : nodes_[ref].child) result += cost_below(child);
    return result;
}

template <int D>
double BvhTree<D>::cost() const {
    const double total = box_size(bounds()).area;
    return total > 0 ? (cost_below(roots_[0].ref) + cost_below(roots_[1].ref)) / total : 0;
}

template void BvhTree<2>::build(std::span<const Aabb<2>>, Executor*);
template void BvhTree<2>::rebuild(std::span<const Aabb<2>>, Executor*);
template void BvhTree<2>::run_jobs(const BvhItem*, Executor*);
template void BvhTree<2>::reserve(std::uint32_t);
template std::uint32_t BvhTree<2>::allocate_node();
template std::uint32_t BvhTree<2>::allocate_leaf();
template void BvhTree<2>::free_node(std::uint32_t);
template void BvhTree<2>::free_leaf(std::uint32_t);
template double BvhTree<2>::cost() const;
template void BvhTree<3>::build(std::span<const Aabb<3>>, Executor*);
template void BvhTree<3>::rebuild(std::span<const Aabb<3>>, Executor*);
template void BvhTree<3>::run_jobs(const BvhItem*, Executor*);
template void BvhTree<3>::reserve(std::uint32_t);
template std::uint32_t BvhTree<3>::allocate_node();
template std::uint32_t BvhTree<3>::allocate_leaf();
template void BvhTree<3>::free_node(std::uint32_t);
template void BvhTree<3>::free_leaf(std::uint32_t);
template double BvhTree<3>::cost() const;

}  // namespace abut::detail
