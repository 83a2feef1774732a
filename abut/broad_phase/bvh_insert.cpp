// Single items in and out, after Guttman, "R-trees: a Dynamic Index Structure for Spatial Searching", 1984: down to
// where it makes the boxes grow least, and what overflows is parted in two. What that has spoilt, the next update
// repairs.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh_jobs.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace abut {
namespace {

constexpr std::uint32_t nine = bvh_lanes + 1;

/// How eight boxes and one more are parted: the first so many in an order go left.
struct Parting {
    std::array<std::uint32_t, nine> order;
    std::uint32_t left;
};

/// Into two of three at least, so that their areas, each times what it holds, are least.
template <int D>
Parting part(const std::array<Aabb<D>, nine>& boxes) {
    constexpr std::uint32_t fewest = 3;
    Parting best{};
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < D; ++axis) {
        Parting now{};
        std::array<float, nine> middles;
        for (std::uint32_t i = 0; i < nine; ++i) {
            const float middle = middles[i] = center(boxes[i])[axis];
            std::uint32_t place = i;
            for (; place > 0 && middles[now.order[place - 1]] > middle; --place)
                now.order[place] = now.order[place - 1];
            now.order[place] = i;
        }
        std::array<double, nine> right_cost{};
        Aabb<D> box = Aabb<D>::empty();
        for (std::uint32_t i = nine; i-- > 0;) {
            box = merged(box, boxes[now.order[i]]);
            right_cost[i] = box_size(box).area * (nine - i);
        }
        box = Aabb<D>::empty();
        for (now.left = 1; now.left <= nine - fewest; ++now.left) {
            box = merged(box, boxes[now.order[now.left - 1]]);
            const double cost = box_size(box).area * now.left + right_cost[now.left];
            if (now.left < fewest || cost >= least) continue;
            least = cost;
            best = now;
        }
    }
    return best;
}

/// Half the surfaces of eight boxes, by their extents; the axes on which one is endless count as none.
template <int D>
void areas_of(double (&extent)[D][bvh_lanes], double (&area)[bvh_lanes]) {
    for (auto& of_axis : extent)
        for (double& each : of_axis) each = each < std::numeric_limits<double>::infinity() ? each : 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
        if constexpr (D == 2)
            area[lane] = extent[0][lane] + extent[1][lane];
        else
            area[lane] = extent[0][lane] * extent[1][lane] + extent[1][lane] * extent[2][lane] +
                         extent[2][lane] * extent[0][lane];
    }
}

/// The child that grows least by a box; of several the smallest.
template <int D>
std::uint32_t best_lane(const BvhNode<D>& node, const Aabb<D>& box) {
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity(), smallest = least;
    // All lanes side by side; what is in those that are not used is not looked at.
    double extent[D][bvh_lanes], wider[D][bvh_lanes], areas[bvh_lanes], wider_areas[bvh_lanes];
    for (int i = 0; i < D; ++i)
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            const float low = node.min[i][lane], high = node.max[i][lane];
            const float lower = box.min[i] < low ? box.min[i] : low, higher = high < box.max[i] ? box.max[i] : high;
            extent[i][lane] = static_cast<double>(high) - static_cast<double>(low);
            wider[i][lane] = static_cast<double>(higher) - static_cast<double>(lower);
        }
    areas_of<D>(extent, areas);
    areas_of<D>(wider, wider_areas);
    for (std::uint32_t lane = 0; lane < bvh_lanes && node.child[lane] != bvh_none; ++lane) {
        if (!(node.min[0][lane] <= node.max[0][lane])) continue;
        const double area = areas[lane], growth = wider_areas[lane] - area;
        if (growth > least || (growth == least && area >= smallest)) continue;
        least = growth;
        smallest = area;
        best = lane;
    }
    return best;
}

}  // namespace

template <int D>
std::uint32_t BvhTree<D>::insert(const Aabb<D>& box) {
    std::uint32_t index = bvh_none;
    while (!free_.empty() && index == bvh_none) {
        // What was erased may be in use again, by an update.
        if (places_[free_.front()] == place_free) index = free_.front();
        std::pop_heap(free_.begin(), free_.end(), std::greater<>());
        free_.pop_back();
    }
    if (index == bvh_none) {
        ABUT_ASSERT(size() < std::size_t{1} << 31);
        index = static_cast<std::uint32_t>(size());
        places_.push_back(place_none);
    }
    places_[index] = place_none;
    // Room to build all anew, and for what is parted meanwhile: leaves that are parted are less full than built ones.
    constexpr std::uint32_t spare = 64;
    const auto count = static_cast<std::uint32_t>(size());
    if (leaves_.size() < std::max(bvh_leaves_granted(count) + bvh_lanes, leaves_live_ + spare) ||
        nodes_.size() < nodes_live_ + spare)
        reserve(std::max({count + count / 2, 10 * (leaves_live_ + spare), 30 * (nodes_live_ + spare)}));
    const Aabb<D> holds = usable(box);
    if (!is_empty(holds)) add(index, holds);
    return index;
}

/// For one item more, whatever is parted for it.
template <int D>
bool BvhTree<D>::has_room() const {
    return leaves_live_ < leaves_.size() && nodes_live_ + bvh_lanes <= nodes_.size();
}

template <int D>
bool BvhTree<D>::set(std::uint32_t index, const Aabb<D>& box) {
    ABUT_ASSERT(index < size() && places_[index] != place_free);
    if (index >= size()) return false;
    const Aabb<D> holds = usable(box);
    const std::uint32_t slot = places_[index] / bvh_lanes, lane = places_[index] % bvh_lanes;
    if (places_[index] >= place_free) {
        if (is_empty(holds)) return true;
        if (!has_room()) return false;
        add(index, holds);
        return true;
    }
    const bool stays = !is_empty(holds) && is_bounded(holds) == is_bounded(leaves_[slot].box(lane));
    // Near where it was it stays in its leaf, which is no larger than the node above it then.
    if (stays && widen(slot, lane, holds, 1)) return true;
    if (stays && !has_room()) return widen(slot, lane, holds, bvh_depth);
    remove(index);
    places_[index] = place_none;
    if (is_empty(holds)) return true;
    if (!has_room()) return false;
    add(index, holds);
    return true;
}

/// Puts a box in the place of one in a leaf, if no more than so many levels of nodes above it must be widened for it.
template <int D>
bool BvhTree<D>::widen(std::uint32_t slot, std::uint32_t lane, const Aabb<D>& box, int levels) {
    std::array<std::uint32_t, bvh_depth> refs, lanes;
    std::uint32_t ref = slot | bvh_leaf_bit;
    std::size_t wider = 0;
    for (;; ++wider) {
        const std::uint32_t parent = parent_of(ref);
        if (parent == bvh_none) {
            BvhRoot<D>& root = roots_[is_bounded(box) ? 0 : 1];
            if (!contains(root.box, box) && wider > static_cast<std::size_t>(levels)) return false;
            root.box = merged(root.box, box);
            break;
        }
        const std::uint32_t in_parent = lane_of(ref);
        if (contains(nodes_[parent].box(in_parent), box)) break;
        if (wider == static_cast<std::size_t>(levels)) return false;
        refs[wider] = parent;
        lanes[wider] = in_parent;
        ref = parent;
    }
    leaves_[slot].set(lane, box);
    for (std::size_t i = 0; i < wider; ++i) {
        BvhNode<D>& node = nodes_[refs[i]];
        const Aabb<D> before = node.box(lanes[i]);
        node.set(lanes[i], is_empty(before) ? box : merged(before, box));
    }
    return true;
}

template <int D>
void BvhTree<D>::erase(std::uint32_t index) {
    ABUT_ASSERT(index < size());
    if (index >= size() || places_[index] == place_free) return;
    if (places_[index] != place_none) remove(index);
    places_[index] = place_free;
    free_.push_back(index);
    std::push_heap(free_.begin(), free_.end(), std::greater<>());
}

template <int D>
void BvhTree<D>::put(std::uint32_t slot, std::uint32_t lane, std::uint32_t index, const Aabb<D>& box) {
    leaves_[slot].set(lane, box);
    leaves_[slot].index[lane] = index;
    places_[index] = slot * bvh_lanes + lane;
}

/// An item of a leaf; the last takes its place.
template <int D>
void BvhTree<D>::take_out(std::uint32_t slot, std::uint32_t lane) {
    BvhLeaf<D>& leaf = leaves_[slot];
    const std::uint32_t last = leaf.count() - 1;
    if (lane != last) put(slot, lane, leaf.index[last], leaf.box(last));
    leaf.clear(last);
    leaf.index[last] = bvh_none;
}

template <int D>
void BvhTree<D>::add(std::uint32_t index, const Aabb<D>& box) {
    BvhRoot<D>& root = roots_[is_bounded(box) ? 0 : 1];
    ++items_;
    root.box = merged(root.box, box);
    if (root.ref == bvh_none) {
        const std::uint32_t leaf = take_leaf();
        leaves_[leaf] = BvhLeaf<D>::nothing();
        root.ref = leaf | bvh_leaf_bit;
        parent_of(root.ref) = bvh_none;
    }
    std::uint32_t ref = root.ref;
    while (!is_leaf(ref)) {
        BvhNode<D>& node = nodes_[ref];
        const std::uint32_t lane = best_lane(node, box);
        const Aabb<D> before = node.box(lane);
        node.set(lane, is_empty(before) ? box : merged(before, box));
        ++node.items;
        ref = node.child[lane];
    }
    const std::uint32_t slot = ref & ~bvh_leaf_bit, count = leaves_[slot].count();
    if (count < bvh_lanes) return put(slot, count, index, box);

    std::array<Aabb<D>, nine> boxes;
    std::array<std::uint32_t, nine> indices;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
        boxes[lane] = leaves_[slot].box(lane);
        indices[lane] = leaves_[slot].index[lane];
    }
    boxes[bvh_lanes] = box;
    indices[bvh_lanes] = index;
    const Parting parting = part<D>(boxes);
    const std::uint32_t other = take_leaf();
    leaves_[slot] = leaves_[other] = BvhLeaf<D>::nothing();
    for (std::uint32_t i = 0; i < nine; ++i) {
        const bool left = i < parting.left;
        const std::uint32_t from = parting.order[i];
        put(left ? slot : other, left ? i : i - parting.left, indices[from], boxes[from]);
    }
    attach(ref, other | bvh_leaf_bit);
}

/// Hangs up what was parted off beside what is left. What overflows by that is parted too, up to the root.
template <int D>
void BvhTree<D>::attach(std::uint32_t ref, std::uint32_t other) {
    for (;;) {
        const std::uint32_t parent = parent_of(ref);
        const Aabb<D> box = box_of(ref), other_box = box_of(other);
        if (parent == bvh_none) {
            const std::uint32_t top = take_node();
            nodes_[top] = BvhNode<D>::nothing();
            hang(top, 0, ref, box);
            hang(top, 1, other, other_box);
            nodes_[top].items = items_;
            for (BvhRoot<D>& root : roots_)
                if (root.ref == ref) root.ref = top;
            return;
        }
        nodes_[parent].set(lane_of(ref), box);
        const std::uint32_t count = nodes_[parent].count();
        if (count < bvh_lanes) return hang(parent, count, other, other_box);

        std::array<Aabb<D>, nine> boxes;
        std::array<std::uint32_t, nine> children;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            boxes[lane] = is_empty(nodes_[parent].box(lane)) ? Aabb<D>::empty() : nodes_[parent].box(lane);
            children[lane] = nodes_[parent].child[lane];
        }
        boxes[bvh_lanes] = other_box;
        children[bvh_lanes] = other;
        const Parting parting = part<D>(boxes);
        const std::uint32_t second = take_node(), above = nodes_[parent].parent, items = nodes_[parent].items;
        nodes_[parent] = nodes_[second] = BvhNode<D>::nothing();
        nodes_[parent].parent = above;
        // About as many, until they are counted. Nothing was built so: the next update repairs it.
        nodes_[parent].items = nodes_[second].items = items / 2 + 1;
        for (std::uint32_t i = 0; i < nine; ++i) {
            const bool left = i < parting.left;
            const std::uint32_t from = parting.order[i];
            hang(left ? parent : second, left ? i : i - parting.left, children[from], boxes[from]);
        }
        ref = parent;
        other = second;
    }
}

template <int D>
void BvhTree<D>::hang(std::uint32_t node, std::uint32_t lane, std::uint32_t child, const Aabb<D>& box) {
    nodes_[node].child[lane] = child;
    if (is_empty(box))
        nodes_[node].clear(lane);
    else
        nodes_[node].set(lane, box);
    parent_of(child) = node;
}

/// An item that is in the tree. What holds nothing any more goes with it.
template <int D>
void BvhTree<D>::remove(std::uint32_t index) {
    --items_;
    const std::uint32_t slot = places_[index] / bvh_lanes;
    take_out(slot, places_[index] % bvh_lanes);
    std::uint32_t ref = slot | bvh_leaf_bit;
    for (;;) {
        const std::uint32_t parent = parent_of(ref);
        const bool empty = (is_leaf(ref) ? leaves_[slot].count() : nodes_[ref].count()) == 0;
        const Aabb<D> box = box_of(ref);
        const std::uint32_t lane = parent == bvh_none ? 0 : lane_of(ref);
        if (empty && is_leaf(ref)) free_leaf(slot);
        if (empty && !is_leaf(ref)) free_node(ref);
        if (parent == bvh_none) {
            for (BvhRoot<D>& root : roots_)
                if (root.ref == ref) root = {empty ? bvh_none : ref, box};
            return;
        }
        BvhNode<D>& node = nodes_[parent];
        --node.items;
        if (empty) {
            const std::uint32_t last = node.count() - 1;
            if (lane != last) hang(parent, lane, node.child[last], node.box(last));
            node.clear(last);
            node.child[last] = bvh_none;
        } else {
            hang(parent, lane, ref, box);
        }
        ref = parent;
    }
}

template <int D>
Aabb<D> BvhTree<D>::box_of(std::uint32_t ref) const {
    return is_leaf(ref) ? leaf(ref).bounds() : nodes_[ref].bounds();
}

template <int D>
std::uint32_t BvhTree<D>::lane_of(std::uint32_t ref) const {
    const std::uint32_t parent = is_leaf(ref) ? leaf_parents_[ref & ~bvh_leaf_bit] : nodes_[ref].parent;
    std::uint32_t lane = 0;
    while (nodes_[parent].child[lane] != ref) ++lane;
    return lane;
}

template std::uint32_t BvhTree<2>::insert(const Aabb<2>&);
template void BvhTree<2>::erase(std::uint32_t);
template bool BvhTree<2>::set(std::uint32_t, const Aabb<2>&);
template bool BvhTree<2>::has_room() const;
template void BvhTree<2>::add(std::uint32_t, const Aabb<2>&);
template void BvhTree<2>::take_out(std::uint32_t, std::uint32_t);
template std::uint32_t BvhTree<2>::lane_of(std::uint32_t) const;
template std::uint32_t BvhTree<3>::insert(const Aabb<3>&);
template void BvhTree<3>::erase(std::uint32_t);
template bool BvhTree<3>::set(std::uint32_t, const Aabb<3>&);
template bool BvhTree<3>::has_room() const;
template void BvhTree<3>::add(std::uint32_t, const Aabb<3>&);
template void BvhTree<3>::take_out(std::uint32_t, std::uint32_t);
template std::uint32_t BvhTree<3>::lane_of(std::uint32_t) const;

}  // namespace abut
