#pragma once

// The tree of a Bvh: build, refit, and changes of single items. Internal.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/bvh/subtree.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut::detail {

struct BvhTopology;

template <int D>
class BvhTree {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor);
    /// Rebuilds a tree of the same boxes from its topology. Any topology gives a valid tree of limited depth that has
    /// all boxes, or false, and the tree stays as it was.
    bool build(std::span<const Aabb<D>> boxes, const BvhTopology& topology);
    BvhTopology topology() const;
    void update(std::span<const Aabb<D>> boxes, Executor* executor);
    std::uint32_t insert(const Aabb<D>& box);
    void erase(std::uint32_t index);
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return positions_.size(); }
    Aabb<D> bounds() const { return merged(roots_[0].box, roots_[1].box); }
    /// The sum of the areas of all nodes and leaves except the roots, divided by the area of the bounds.
    double cost() const;

    const BvhNode<D>& node(std::uint32_t ref) const { return nodes_[ref]; }
    const BvhLeaf<D>& leaf(std::uint32_t ref) const { return leaves_[ref & ~bvh_leaf_bit]; }
    /// Root 0 has the bounded boxes, root 1 the boxes that are unbounded on some side.
    const BvhRoot<D>& root(std::size_t kind) const { return roots_[kind]; }

private:
    /// Positions of items that are not in the tree: empty ones, and erased ones with a free index.
    static constexpr std::uint32_t position_none = 0xFFFFFFFF, position_free = 0xFFFFFFFE;

    /// A subtree that is to be built by itself.
    struct SubtreeJob {
        std::uint32_t begin, end;  ///< its items, in a build
        std::uint32_t ref;         ///< in an update the node that it replaces; else bvh_none
        std::uint32_t parent, lane;
        int depth;
        bool bounded;
    };
    /// A range of items near the root, which is split in two if it is too large for one job.
    struct UpperRange {
        BvhRange<D> range;
        std::uint32_t left;  ///< the index of its left half, before that of its right half; 0 if the range is one job
    };
    struct BoundsAndCount {
        Aabb<D> box = Aabb<D>::empty();
        std::uint32_t items = 0;
    };
    /// A cut through the tree: subtrees that are refitted in parallel, in the order of the tree.
    struct TreeCut {
        std::array<std::uint32_t, bvh_lanes * bvh_lanes> refs;
        std::array<BoundsAndCount, bvh_lanes * bvh_lanes> results;
        std::uint32_t count = 0;
    };

    void rebuild(std::span<const Aabb<D>> boxes, Executor* executor);
    void reserve(std::uint32_t items);
    BvhItem* clear_for_build(std::uint32_t items);
    void split_into_jobs(BvhItem* items, bool bounded, std::uint32_t begin, std::uint32_t end, Executor* executor);
    void make_upper_node(std::uint32_t range_index, bool bounded, std::uint32_t parent, std::uint32_t lane);
    void run_jobs(const BvhItem* items, Executor* executor);
    double cost_below(std::uint32_t ref) const;
    void collect(std::uint32_t ref, BvhSubtree<D>& subtree) const;
    void attach_subtree(BvhSubtree<D>& subtree, const SubtreeJob& job);
    void copy_subtree(const BvhSubtree<D>& subtree, const SubtreeJob& job);
    std::uint32_t allocate_node();
    std::uint32_t allocate_leaf();
    void free_node(std::uint32_t node);
    void free_leaf(std::uint32_t leaf);

    void refit(std::span<const Aabb<D>> boxes, Executor* executor);
    BoundsAndCount refit_below(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded);
    BoundsAndCount refit_above(std::uint32_t ref, int levels, TreeCut& cut, bool is_refitted);
    template <class Refit>
    BoundsAndCount refit_node(BvhNode<D>& node, Refit refit);
    void prefetch(std::uint32_t ref, std::span<const Aabb<D>> boxes) const;
    BoundsAndCount refit_leaf(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded);
    void find_decayed_subtrees(std::uint32_t ref, int depth, bool bounded, double& area, double& built_area);
    bool insert_missing(std::span<const Aabb<D>> boxes);

    bool has_capacity() const;
    bool enlarge(std::uint32_t slot, std::uint32_t lane, const Aabb<D>& box);
    void add(std::uint32_t index, const Aabb<D>& box);
    void attach_sibling(std::uint32_t ref, std::uint32_t sibling);
    void set_box(std::uint32_t node, std::uint32_t lane, const Aabb<D>& box);
    void set_child(std::uint32_t node, std::uint32_t lane, std::uint32_t child, const Aabb<D>& box);
    void write_item(std::uint32_t slot, std::uint32_t lane, std::uint32_t index, const Aabb<D>& box);
    void remove_from_leaf(std::uint32_t slot, std::uint32_t lane);
    void remove(std::uint32_t index);
    void shrink(std::uint32_t ref, const Aabb<D>& removed);
    void unlink(std::uint32_t ref);
    Aabb<D> box_of(std::uint32_t ref) const;
    std::uint32_t lane_of(std::uint32_t ref) const;
    std::uint32_t& parent_of(std::uint32_t ref) {
        return is_leaf(ref) ? leaf_parents_[ref & ~bvh_leaf_bit] : nodes_[ref].parent;
    }

    std::array<BvhRoot<D>, 2> roots_;
    std::vector<BvhNode<D>> nodes_;
    std::vector<BvhLeaf<D>> leaves_;
    std::vector<std::uint32_t> leaf_parents_;
    std::vector<std::uint32_t> positions_;            // of the items: leaf * bvh_lanes + lane
    std::vector<std::uint32_t> free_;                 // a min-heap of erased indices; some may be in use again
    std::uint32_t nodes_used_ = 0, leaves_used_ = 0;  // those beyond were never used
    std::uint32_t nodes_live_ = 0, leaves_live_ = 0;
    std::uint32_t next_node_ = bvh_none, next_leaf_ = bvh_none;  // the heads of the free lists
    std::uint32_t items_ = 0;                                    // the number of items in the tree
    std::vector<UpperRange> upper_ranges_;
    std::vector<SubtreeJob> jobs_;
    std::vector<BvhSubtree<D>> subtrees_;  // one for each thread of a build
};

}  // namespace abut::detail
