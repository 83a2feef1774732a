// Insertion and removal of single items, after Guttman, "R-trees: a Dynamic Index Structure for Spatial Searching",
// 1984. An item descends to the leaf whose boxes grow least, and nodes that overflow are split in two. The next update
// repairs the loss of quality.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh/descent.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>
#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace abut::detail {
namespace {

/// The entries of a node that overflows: eight and a new one.
constexpr std::uint32_t overflow_count = bvh_lanes + 1;

/// A split of a node that overflows: the first `left` entries of `order` go left.
struct NodeSplit {
    std::array<std::uint32_t, overflow_count> order;
    std::uint32_t left;
};

/// Splits the boxes so that the sum of area times count over both sides is minimal. Each side has at least three boxes.
template <int D>
NodeSplit split_overflow(const std::array<Aabb<D>, overflow_count>& boxes) {
    constexpr std::uint32_t min_count = 3;
    NodeSplit best{};
    double min_cost = std::numeric_limits<double>::infinity();
    std::array<Vec<D>, overflow_count> centers;
    for (std::uint32_t i = 0; i < overflow_count; ++i) centers[i] = center(boxes[i]);
    for (int axis = 0; axis < D; ++axis) {
        NodeSplit candidate{};
        for (std::uint32_t i = 0; i < overflow_count; ++i) {
            std::uint32_t position = i;
            for (; position > 0 && centers[candidate.order[position - 1]][axis] > centers[i][axis]; --position)
                candidate.order[position] = candidate.order[position - 1];
            candidate.order[position] = i;
        }
        std::array<double, overflow_count> right_cost{};
        Aabb<D> box = Aabb<D>::empty();
        for (std::uint32_t i = overflow_count; i-- > min_count;) {
            box = merged(box, boxes[candidate.order[i]]);
            right_cost[i] = box_size(box).area * (overflow_count - i);
        }
        box = Aabb<D>::empty();
        for (candidate.left = 1; candidate.left <= overflow_count - min_count; ++candidate.left) {
            box = merged(box, boxes[candidate.order[candidate.left - 1]]);
            if (candidate.left < min_count) continue;
            const double cost = box_size(box).area * candidate.left + right_cost[candidate.left];
            if (cost >= min_cost) continue;
            min_cost = cost;
            best = candidate;
        }
    }
    return best;
}

/// Whether a box touches no side of another from inside.
template <int D>
bool is_strictly_inside(const Aabb<D>& box, const Aabb<D>& outer) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && outer.min[i] < box.min[i] && box.max[i] < outer.max[i];
    return result;
}

}  // namespace

template <int D>
std::uint32_t BvhTree<D>::insert(const Aabb<D>& box) {
    std::uint32_t index = bvh_none;
    while (!free_.empty() && index == bvh_none) {
        // An update may have put an erased item to use again.
        if (positions_[free_.front()] == position_free) index = free_.front();
        std::pop_heap(free_.begin(), free_.end(), std::greater<>());
        free_.pop_back();
    }
    if (index == bvh_none) {
        ABUT_ASSERT(size() < std::size_t{1} << 31);
        index = static_cast<std::uint32_t>(size());
        positions_.push_back(position_none);
    }
    positions_[index] = position_none;
    // The capacity suffices to rebuild the tree, and for splits until then: split leaves are less full than built ones.
    constexpr std::uint32_t spare = 64;
    const auto count = static_cast<std::uint32_t>(size());
    if (leaves_.size() < std::max(bvh_max_leaves(count) + bvh_lanes, leaves_live_ + spare) ||
        nodes_.size() < nodes_live_ + spare)
        reserve(std::max({count + count / 2, 6 * (leaves_live_ + spare), 20 * (nodes_live_ + spare)}));
    const Aabb<D> stored = usable(box);
    if (!is_empty(stored)) add(index, stored);
    return index;
}

/// Whether the capacity suffices for one more item, whatever splits it causes.
template <int D>
bool BvhTree<D>::has_capacity() const {
    return leaves_live_ < leaves_.size() && nodes_live_ + bvh_lanes <= nodes_.size();
}

template <int D>
bool BvhTree<D>::set(std::uint32_t index, const Aabb<D>& box) {
    ABUT_ASSERT(index < size() && positions_[index] != position_free);
    if (index >= size()) return false;
    const Aabb<D> stored = usable(box);
    const std::uint32_t slot = positions_[index] / bvh_lanes, lane = positions_[index] % bvh_lanes;
    if (positions_[index] >= position_free) {
        if (is_empty(stored)) return true;
        if (!has_capacity()) return false;
        add(index, stored);
        return true;
    }
    const Aabb<D> before = leaves_[slot].box(lane);
    // After a small move it stays in its leaf, as long as only one node above the leaf has to be enlarged.
    if (overlaps(stored, before) && is_bounded(stored) == is_bounded(before) && enlarge(slot, lane, stored))
        return true;
    remove(index);
    positions_[index] = position_none;
    if (is_empty(stored)) return true;
    if (!has_capacity()) return false;
    add(index, stored);
    return true;
}

/// Replaces a box of a leaf if that enlarges at most one node above the leaf. Else changes nothing and returns false.
template <int D>
bool BvhTree<D>::enlarge(std::uint32_t slot, std::uint32_t lane, const Aabb<D>& box) {
    const std::uint32_t ref = slot | bvh_leaf_bit, parent = parent_of(ref);
    BvhRoot<D>& root = roots_[is_bounded(box) ? 0 : 1];
    if (parent == bvh_none) {
        root.box = merged(root.box, box);
    } else if (const std::uint32_t at = lane_of(ref); !contains(nodes_[parent].box(at), box)) {
        const std::uint32_t above = nodes_[parent].parent;
        if (above == bvh_none)
            root.box = merged(root.box, box);
        else if (!contains(nodes_[above].box(lane_of(parent)), box))
            return false;
        nodes_[parent].set(at, merged(nodes_[parent].box(at), box));
    }
    leaves_[slot].set(lane, box);
    return true;
}

template <int D>
void BvhTree<D>::erase(std::uint32_t index) {
    ABUT_ASSERT(index < size());
    if (index >= size() || positions_[index] == position_free) return;
    if (positions_[index] != position_none) remove(index);
    positions_[index] = position_free;
    free_.push_back(index);
    std::push_heap(free_.begin(), free_.end(), std::greater<>());
}

template <int D>
void BvhTree<D>::write_item(std::uint32_t slot, std::uint32_t lane, std::uint32_t index, const Aabb<D>& box) {
    leaves_[slot].set(lane, box);
    leaves_[slot].index[lane] = index;
    positions_[index] = slot * bvh_lanes + lane;
}

/// Removes an item of a leaf; the last item takes its lane.
template <int D>
void BvhTree<D>::remove_from_leaf(std::uint32_t slot, std::uint32_t lane) {
    BvhLeaf<D>& leaf = leaves_[slot];
    const std::uint32_t last = leaf.count() - 1;
    if (lane != last) write_item(slot, lane, leaf.index[last], leaf.box(last));
    leaf.clear(last);
    leaf.index[last] = bvh_none;
}

template <int D>
void BvhTree<D>::add(std::uint32_t index, const Aabb<D>& box) {
    BvhRoot<D>& root = roots_[is_bounded(box) ? 0 : 1];
    ++items_;
    root.box = merged(root.box, box);
    if (root.ref == bvh_none) {
        const std::uint32_t leaf = allocate_leaf();
        leaves_[leaf] = BvhLeaf<D>::empty();
        root.ref = leaf | bvh_leaf_bit;
        parent_of(root.ref) = bvh_none;
    }
    const std::uint32_t ref = descend(nodes_.data(), root.ref, box);
    const std::uint32_t slot = ref & ~bvh_leaf_bit, count = leaves_[slot].count();
    if (count < bvh_lanes) return write_item(slot, count, index, box);

    std::array<Aabb<D>, overflow_count> boxes;
    std::array<std::uint32_t, overflow_count> indices;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
        boxes[lane] = leaves_[slot].box(lane);
        indices[lane] = leaves_[slot].index[lane];
    }
    boxes[bvh_lanes] = box;
    indices[bvh_lanes] = index;
    const NodeSplit split = split_overflow<D>(boxes);
    const std::uint32_t sibling = allocate_leaf();
    leaves_[slot] = leaves_[sibling] = BvhLeaf<D>::empty();
    for (std::uint32_t i = 0; i < overflow_count; ++i) {
        const bool left = i < split.left;
        const std::uint32_t from = split.order[i];
        write_item(left ? slot : sibling, left ? i : i - split.left, indices[from], boxes[from]);
    }
    attach_sibling(ref, sibling | bvh_leaf_bit);
}

/// Links the new half of a split beside the old one. Nodes that overflow are split as well, up to the root.
template <int D>
void BvhTree<D>::attach_sibling(std::uint32_t ref, std::uint32_t sibling) {
    for (;;) {
        const std::uint32_t parent = parent_of(ref);
        const Aabb<D> box = box_of(ref), sibling_box = box_of(sibling);
        if (parent == bvh_none) {
            const std::uint32_t new_root = allocate_node();
            nodes_[new_root] = BvhNode<D>::empty();
            set_child(new_root, 0, ref, box);
            set_child(new_root, 1, sibling, sibling_box);
            for (BvhRoot<D>& root : roots_)
                if (root.ref == ref) root.ref = new_root;
            return;
        }
        nodes_[parent].set(lane_of(ref), box);
        const std::uint32_t count = nodes_[parent].count();
        if (count < bvh_lanes) return set_child(parent, count, sibling, sibling_box);

        std::array<Aabb<D>, overflow_count> boxes;
        std::array<std::uint32_t, overflow_count> children;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            boxes[lane] = is_empty(nodes_[parent].box(lane)) ? Aabb<D>::empty() : nodes_[parent].box(lane);
            children[lane] = nodes_[parent].child[lane];
        }
        boxes[bvh_lanes] = sibling_box;
        children[bvh_lanes] = sibling;
        const NodeSplit split = split_overflow<D>(boxes);
        const std::uint32_t second = allocate_node(), above = nodes_[parent].parent;
        nodes_[parent] = nodes_[second] = BvhNode<D>::empty();
        nodes_[parent].parent = above;
        // The built area of 0 makes the next update rebuild the subtree.
        for (std::uint32_t i = 0; i < overflow_count; ++i) {
            const bool left = i < split.left;
            const std::uint32_t from = split.order[i];
            set_child(left ? parent : second, left ? i : i - split.left, children[from], boxes[from]);
        }
        ref = parent;
        sibling = second;
    }
}

template <int D>
void BvhTree<D>::set_child(std::uint32_t node, std::uint32_t lane, std::uint32_t child, const Aabb<D>& box) {
    nodes_[node].child[lane] = child;
    set_box(node, lane, box);
    parent_of(child) = node;
}

template <int D>
void BvhTree<D>::set_box(std::uint32_t node, std::uint32_t lane, const Aabb<D>& box) {
    if (is_empty(box))
        nodes_[node].clear(lane);
    else
        nodes_[node].set(lane, box);
}

/// Removes an item that is in the tree. A leaf with few items left is dissolved, and they are added elsewhere:
/// otherwise many moves would leave many leaves with one item each.
template <int D>
void BvhTree<D>::remove(std::uint32_t index) {
    constexpr std::uint32_t min_count = 2;
    --items_;
    const std::uint32_t slot = positions_[index] / bvh_lanes, lane = positions_[index] % bvh_lanes;
    const Aabb<D> box = leaves_[slot].box(lane);
    remove_from_leaf(slot, lane);
    const std::uint32_t ref = slot | bvh_leaf_bit, count = leaves_[slot].count();
    const bool dissolves = count < min_count && parent_of(ref) != bvh_none && has_capacity();
    if (count > 0 && !dissolves) return shrink(ref, box);
    const BvhLeaf<D> rest = leaves_[slot];
    unlink(ref);
    for (std::uint32_t i = 0; i < count; ++i) {
        --items_;
        add(rest.index[i], rest.box(i));
    }
}

/// Shrinks the boxes of a leaf or node and of those above, as far as a box that was removed below touched their sides.
template <int D>
void BvhTree<D>::shrink(std::uint32_t ref, const Aabb<D>& removed) {
    for (std::uint32_t parent = parent_of(ref); parent != bvh_none; ref = parent, parent = parent_of(ref)) {
        const std::uint32_t lane = lane_of(ref);
        if (is_strictly_inside(removed, nodes_[parent].box(lane))) return;
        set_box(parent, lane, box_of(ref));
    }
    BvhRoot<D>& root = roots_[roots_[0].ref == ref ? 0 : 1];
    if (!is_strictly_inside(removed, root.box)) root.box = box_of(ref);
}

/// Frees an empty leaf. A node that has one child left is freed as well, and the child takes its place.
template <int D>
void BvhTree<D>::unlink(std::uint32_t ref) {
    const std::uint32_t parent = parent_of(ref);
    if (parent == bvh_none) {
        roots_[roots_[0].ref == ref ? 0 : 1] = {};
        return free_leaf(ref & ~bvh_leaf_bit);
    }
    BvhNode<D>& node = nodes_[parent];
    const std::uint32_t lane = lane_of(ref), last = node.count() - 1;
    const Aabb<D> removed = node.box(lane);
    free_leaf(ref & ~bvh_leaf_bit);
    if (lane != last) set_child(parent, lane, node.child[last], node.box(last));
    node.clear(last);
    node.child[last] = bvh_none;
    if (last > 1) return shrink(parent, removed);
    const std::uint32_t rest = node.child[0], above = node.parent;
    parent_of(rest) = above;
    if (above == bvh_none)
        roots_[roots_[0].ref == parent ? 0 : 1].ref = rest;
    else
        nodes_[above].child[lane_of(parent)] = rest;
    free_node(parent);
    shrink(rest, removed);
}

template <int D>
Aabb<D> BvhTree<D>::box_of(std::uint32_t ref) const {
    return is_leaf(ref) ? leaf(ref).bounds() : nodes_[ref].bounds();
}

template <int D>
std::uint32_t BvhTree<D>::lane_of(std::uint32_t ref) const {
    const std::uint32_t parent = is_leaf(ref) ? leaf_parents_[ref & ~bvh_leaf_bit] : nodes_[ref].parent;
    std::uint32_t result = 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) result += nodes_[parent].child[lane] == ref ? lane : 0;
    return result;
}

template std::uint32_t BvhTree<2>::insert(const Aabb<2>&);
template void BvhTree<2>::erase(std::uint32_t);
template bool BvhTree<2>::set(std::uint32_t, const Aabb<2>&);
template bool BvhTree<2>::has_capacity() const;
template void BvhTree<2>::add(std::uint32_t, const Aabb<2>&);
template void BvhTree<2>::remove_from_leaf(std::uint32_t, std::uint32_t);
template std::uint32_t BvhTree<2>::lane_of(std::uint32_t) const;
template std::uint32_t BvhTree<3>::insert(const Aabb<3>&);
template void BvhTree<3>::erase(std::uint32_t);
template bool BvhTree<3>::set(std::uint32_t, const Aabb<3>&);
template bool BvhTree<3>::has_capacity() const;
template void BvhTree<3>::add(std::uint32_t, const Aabb<3>&);
template void BvhTree<3>::remove_from_leaf(std::uint32_t, std::uint32_t);
template std::uint32_t BvhTree<3>::lane_of(std::uint32_t) const;

}  // namespace abut::detail
