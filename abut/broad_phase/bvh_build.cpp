// The tree from nothing: what is large is parted first, all that is of one size side by side; the parts then become
// subtrees, each by itself. While that goes on the items lie in the room of the leaves, at its end: leaves take what
// items have left behind.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh_jobs.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <new>

namespace abut {

template <int D>
void BvhTree<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 31);
    places_.assign(boxes.size(), place_none);
    free_.clear();
    build_anew(boxes, executor);
}

/// Keeps the indices that are free.
template <int D>
void BvhTree<D>::build_anew(std::span<const Aabb<D>> boxes, Executor* executor) {
    const auto size = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t& place : places_)
        if (place != place_free) place = place_none;
    BvhItem* items = make_room(size);
    std::uint32_t bounded = 0;
    items_ = 0;
    for (const bool wanted : {true, false}) {
        for (std::uint32_t i = 0; i < size; ++i) {
            const Aabb<D> box = usable(boxes[i]);
            if (is_empty(box) || is_bounded(box) != wanted) continue;
            new (items + items_++) BvhItem(item_of(box, i));
        }
        if (wanted) bounded = items_;
    }
    jobs_.clear();
    plan(items, true, 0, bounded, executor);
    plan(items, false, bounded, items_, executor);
    run_jobs(items, executor);
}

/// Room to build a tree of so many items, with a place for all of them at the end of the leaves.
template <int D>
void BvhTree<D>::reserve(std::uint32_t items) {
    const std::size_t for_items = std::size_t{items} * sizeof(BvhItem) / sizeof(BvhLeaf<D>);
    const std::size_t leaves = std::max<std::size_t>(bvh_leaves_granted(items), for_items) + bvh_lanes;
    if (leaves_.size() < leaves) {
        leaves_.resize(leaves);
        leaf_parents_.resize(leaves);
    }
    const std::size_t nodes = items / 20 + 2 * bvh_lanes;
    if (nodes_.size() < nodes) nodes_.resize(nodes);
    if (parts_.empty()) parts_.resize(1);
    for (BvhPart<D>& part : parts_) part.reserve(std::min(items, bvh_part_items));
    jobs_.reserve(nodes_.size());
}

/// The same, and nothing in it.
template <int D>
BvhItem* BvhTree<D>::make_room(std::uint32_t items) {
    if (leaves_.size() < bvh_leaves_granted(items) + bvh_lanes) {
        // What is in them need not be copied.
        leaves_.clear();
        nodes_.clear();
    }
    reserve(items);
    roots_ = {};
    nodes_used_ = leaves_used_ = nodes_live_ = leaves_live_ = 0;
    next_node_ = next_leaf_ = bvh_none;
    return reinterpret_cast<BvhItem*>(leaves_.data() + leaves_.size()) - items;
}

/// Parts the items into jobs, and makes the nodes above them.
template <int D>
void BvhTree<D>::plan(BvhItem* items, bool bounded, std::uint32_t begin, std::uint32_t end, Executor* executor) {
    if (begin == end) return;
    tops_.clear();
    tops_.push_back({whole_range<D>(items, begin, end, 0), 0});
    roots_[bounded ? 0 : 1].box = tops_[0].range.box;
    for (std::size_t first = 0, last = 1; first < last; first = last, last = tops_.size()) {
        for (std::size_t i = first; i < last; ++i) {
            if (tops_[i].range.count() <= bvh_part_items) continue;
            tops_[i].left = static_cast<std::uint32_t>(tops_.size());
            tops_.resize(tops_.size() + 2);
        }
        run_side_by_side(executor, static_cast<std::uint32_t>(last - first), [&](std::uint32_t i) {
            const Top top = tops_[first + i];
            if (top.left != 0) split(items, bounded, top.range, tops_[top.left].range, tops_[top.left + 1].range);
        });
    }
    plan_node(0, bounded, bvh_none, bounded ? 0 : 1);
}

template <int D>
void BvhTree<D>::plan_node(std::uint32_t top, bool bounded, std::uint32_t parent, std::uint32_t lane) {
    const BvhRange<D>& range = tops_[top].range;
    if (tops_[top].left == 0) {
        jobs_.push_back({range.begin, range.end, bvh_none, parent, lane, range.depth, bounded});
        return;
    }
    std::array<std::uint32_t, bvh_lanes> child{top};
    std::uint32_t count = 1;
    for (std::uint32_t next = 0; next != bvh_none && count < bvh_lanes; ++count) {
        std::copy_backward(child.begin() + next + 1, child.begin() + count, child.begin() + count + 1);
        const std::uint32_t left = tops_[child[next]].left;
        child[next] = left;
        child[next + 1] = left + 1;
        next = bvh_none;
        double most = -1;
        for (std::uint32_t i = 0; i <= count; ++i) {
            const double area = box_size(tops_[child[i]].range.box).area;
            if (tops_[child[i]].left == 0 || area <= most) continue;
            most = area;
            next = i;
        }
    }
    const std::uint32_t node = take_node();
    if (parent == bvh_none)
        roots_[lane].ref = node;
    else
        nodes_[parent].child[lane] = node;
    nodes_[node] = BvhNode<D>::nothing();
    nodes_[node].parent = parent;
    nodes_[node].items = range.count();
    for (std::uint32_t i = 0; i < count; ++i) {
        nodes_[node].set(i, tops_[child[i]].range.box);
        plan_node(child[i], bounded, node, i);
    }
    nodes_[node].area = nodes_[node].built = area_of(nodes_[node]);
}

/// Some at a time: first all are put together, then one after the other says where it goes, then all go there. So the
/// tree is the same however many threads there are.
template <int D>
void BvhTree<D>::run_jobs(const BvhItem* items, Executor* executor) {
    const std::size_t most = executor == nullptr ? 1 : std::clamp<std::size_t>(executor->workers(), 1, 16);
    const std::size_t together = std::min(most, std::max<std::size_t>(jobs_.size(), 1));
    for (std::size_t more = parts_.size(); more < together; ++more)
        parts_.emplace_back().reserve(std::min(static_cast<std::uint32_t>(size()), bvh_part_items));
    for (std::size_t first = 0; first < jobs_.size(); first += together) {
        const auto count = static_cast<std::uint32_t>(std::min(together, jobs_.size() - first));
        run_side_by_side(executor, count, [&](std::uint32_t i) {
            const Job& job = jobs_[first + i];
            BvhPart<D>& part = parts_[i];
            part.items.clear();
            part.node_slots.clear();
            part.leaf_slots.clear();
            if (job.ref == bvh_none)
                part.items.assign(items + job.begin, items + job.end);
            else
                gather(job.ref, part);
            grow(part, job.bounded, job.depth);
        });
        for (std::uint32_t i = 0; i < count; ++i) settle(parts_[i], jobs_[first + i]);
        run_side_by_side(executor, count, [&](std::uint32_t i) { place(parts_[i], jobs_[first + i]); });
    }
}

/// Gives the nodes and leaves of a part their places, those that it had before if it had any, and hangs it up.
template <int D>
void BvhTree<D>::settle(BvhPart<D>& part, const Job& job) {
    for (; part.node_slots.size() > part.nodes.size(); part.node_slots.pop_back()) free_node(part.node_slots.back());
    for (; part.leaf_slots.size() > part.leaves.size(); part.leaf_slots.pop_back()) free_leaf(part.leaf_slots.back());
    while (part.node_slots.size() < part.nodes.size()) part.node_slots.push_back(take_node());
    while (part.leaf_slots.size() < part.leaves.size()) part.leaf_slots.push_back(take_leaf());
    const std::uint32_t ref = is_leaf(part.root) ? part.leaf_slots[0] | bvh_leaf_bit : part.node_slots[0];
    if (job.parent == bvh_none)
        roots_[job.lane].ref = ref;
    else
        nodes_[job.parent].child[job.lane] = ref;
    parent_of(ref) = job.parent;
}

template <int D>
void BvhTree<D>::place(const BvhPart<D>& part, const Job& job) {
    for (std::size_t i = 0; i < part.leaves.size(); ++i) {
        const BvhLeaf<D>& leaf = part.leaves[i];
        new (leaves_.data() + part.leaf_slots[i]) BvhLeaf<D>(leaf);
        for (std::uint32_t lane = 0; lane < bvh_lanes && leaf.index[lane] != bvh_none; ++lane)
            places_[leaf.index[lane]] = part.leaf_slots[i] * bvh_lanes + lane;
    }
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
        BvhNode<D>& node = nodes_[part.node_slots[i]];
        node = part.nodes[i];
        node.parent = i == 0 ? job.parent : part.node_slots[node.parent];
        for (std::uint32_t lane = 0; lane < bvh_lanes && node.child[lane] != bvh_none; ++lane) {
            std::uint32_t& child = node.child[lane];
            if (is_leaf(child)) {
                child = part.leaf_slots[child & ~bvh_leaf_bit];
                leaf_parents_[child] = part.node_slots[i];
                child |= bvh_leaf_bit;
            } else {
                child = part.node_slots[child];
            }
        }
    }
}

template <int D>
std::uint32_t BvhTree<D>::take_node() {
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
std::uint32_t BvhTree<D>::take_leaf() {
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

/// What hangs on a node, with the places of its nodes and leaves.
template <int D>
void BvhTree<D>::gather(std::uint32_t ref, BvhPart<D>& part) const {
    const BvhNode<D>& from = nodes_[ref];
    part.node_slots.push_back(ref);
    for (std::uint32_t lane = 0; lane < bvh_lanes && from.child[lane] != bvh_none; ++lane) {
        const std::uint32_t child = from.child[lane];
        if (!is_leaf(child)) {
            gather(child, part);
            continue;
        }
        const BvhLeaf<D>& items = leaf(child);
        part.leaf_slots.push_back(child & ~bvh_leaf_bit);
        for (std::uint32_t k = 0; k < bvh_lanes && items.index[k] != bvh_none; ++k)
            part.items.push_back(item_of(items.box(k), items.index[k]));
    }
}

template <int D>
double BvhTree<D>::cost_below(std::uint32_t ref) const {
    if (ref == bvh_none || is_leaf(ref)) return 0;
    double result = area_of(nodes_[ref]);
    for (const std::uint32_t child : nodes_[ref].child) result += cost_below(child);
    return result;
}

template <int D>
double BvhTree<D>::cost() const {
    const double all = box_size(bounds()).area;
    return all > 0 ? (cost_below(roots_[0].ref) + cost_below(roots_[1].ref)) / all : 0;
}

template void BvhTree<2>::build(std::span<const Aabb<2>>, Executor*);
template void BvhTree<2>::build_anew(std::span<const Aabb<2>>, Executor*);
template void BvhTree<2>::run_jobs(const BvhItem*, Executor*);
template void BvhTree<2>::reserve(std::uint32_t);
template std::uint32_t BvhTree<2>::take_node();
template std::uint32_t BvhTree<2>::take_leaf();
template void BvhTree<2>::free_node(std::uint32_t);
template void BvhTree<2>::free_leaf(std::uint32_t);
template double BvhTree<2>::cost() const;
template void BvhTree<3>::build(std::span<const Aabb<3>>, Executor*);
template void BvhTree<3>::build_anew(std::span<const Aabb<3>>, Executor*);
template void BvhTree<3>::run_jobs(const BvhItem*, Executor*);
template void BvhTree<3>::reserve(std::uint32_t);
template std::uint32_t BvhTree<3>::take_node();
template std::uint32_t BvhTree<3>::take_leaf();
template void BvhTree<3>::free_node(std::uint32_t);
template void BvhTree<3>::free_leaf(std::uint32_t);
template double BvhTree<3>::cost() const;

}  // namespace abut
