#pragma once

// The tree behind a Bvh, and how it changes. Not for users.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/bvh_part.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

template <int D>
class BvhTree {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor);
    void update(std::span<const Aabb<D>> boxes, Executor* executor);
    std::uint32_t insert(const Aabb<D>& box);
    void erase(std::uint32_t index);
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return places_.size(); }
    Aabb<D> bounds() const { return merged(roots_[0].box, roots_[1].box); }
    /// The areas of all nodes and leaves but the roots, as parts of the area of all.
    double cost() const;

    const BvhNode<D>& node(std::uint32_t ref) const { return nodes_[ref]; }
    const BvhLeaf<D>& leaf(std::uint32_t ref) const { return leaves_[ref & ~bvh_leaf_bit]; }
    /// 0: of what is bounded; 1: of what has no bound on some side.
    const BvhRoot<D>& root(std::size_t kind) const { return roots_[kind]; }

private:
    /// Where an item is that is not in the tree, for it is empty, or it was erased and its index is free.
    static constexpr std::uint32_t place_none = 0xFFFFFFFF, place_free = 0xFFFFFFFE;

    /// A subtree that is to be put together by itself.
    struct Job {
        std::uint32_t begin, end;  ///< its items, in a build
        std::uint32_t ref;         ///< the node that it replaces, in an update; else bvh_none
        std::uint32_t parent, lane;
        int depth;
        bool bounded;
    };
    /// A range of a build, parted in two where it is large.
    struct Top {
        BvhRange<D> range;
        std::uint32_t left;  ///< of its parts, the right one next to it; 0 where it is one job
    };
    struct Counted {
        Aabb<D> box = Aabb<D>::empty();
        std::uint32_t items = 0;
    };
    /// Subtrees that are refitted side by side, in the order of the tree.
    struct Cut {
        std::array<std::uint32_t, bvh_lanes * bvh_lanes> refs;
        std::array<Counted, bvh_lanes * bvh_lanes> results;
        std::uint32_t count = 0;
    };

    void build_anew(std::span<const Aabb<D>> boxes, Executor* executor);
    void reserve(std::uint32_t items);
    BvhItem* make_room(std::uint32_t items);
    void plan(BvhItem* items, bool bounded, std::uint32_t begin, std::uint32_t end, Executor* executor);
    void plan_node(std::uint32_t top, bool bounded, std::uint32_t parent, std::uint32_t lane);
    void run_jobs(const BvhItem* items, Executor* executor);
    double cost_below(std::uint32_t ref) const;
    void gather(std::uint32_t ref, BvhPart<D>& part) const;
    void settle(BvhPart<D>& part, const Job& job);
    void place(const BvhPart<D>& part, const Job& job);
    std::uint32_t take_node();
    std::uint32_t take_leaf();
    void free_node(std::uint32_t node);
    void free_leaf(std::uint32_t leaf);

    void refit(std::span<const Aabb<D>> boxes, Executor* executor);
    Counted refit_below(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded);
    Counted refit_above(std::uint32_t ref, int levels, Cut& cut, bool done);
    template <class Refit>
    Counted refit_node(BvhNode<D>& node, Refit refit);
    void prefetch(std::uint32_t ref, std::span<const Aabb<D>> boxes) const;
    Counted refit_leaf(std::uint32_t ref, std::span<const Aabb<D>> boxes, bool bounded);
    void plan_repairs(std::uint32_t ref, int depth, bool bounded, double& area, double& built);
    bool take_in_newcomers(std::span<const Aabb<D>> boxes);

    bool has_room() const;
    bool widen(std::uint32_t slot, std::uint32_t lane, const Aabb<D>& box, int levels);
    void add(std::uint32_t index, const Aabb<D>& box);
    void attach(std::uint32_t ref, std::uint32_t other);
    void hang(std::uint32_t node, std::uint32_t lane, std::uint32_t child, const Aabb<D>& box);
    void put(std::uint32_t slot, std::uint32_t lane, std::uint32_t index, const Aabb<D>& box);
    void take_out(std::uint32_t slot, std::uint32_t lane);
    void remove(std::uint32_t index);
    Aabb<D> box_of(std::uint32_t ref) const;
    std::uint32_t lane_of(std::uint32_t ref) const;
    std::uint32_t& parent_of(std::uint32_t ref) {
        return is_leaf(ref) ? leaf_parents_[ref & ~bvh_leaf_bit] : nodes_[ref].parent;
    }

    std::array<BvhRoot<D>, 2> roots_;
    std::vector<BvhNode<D>> nodes_;
    std::vector<BvhLeaf<D>> leaves_;
    std::vector<std::uint32_t> leaf_parents_;
    std::vector<std::uint32_t> places_;  // of the items: leaf and lane
    std::vector<std::uint32_t>
        free_;  // indices that were erased, a heap with the least on top; some may be in use again
    std::uint32_t nodes_used_ = 0, leaves_used_ = 0;  // beyond these, none was ever used
    std::uint32_t nodes_live_ = 0, leaves_live_ = 0;
    std::uint32_t next_node_ = bvh_none, next_leaf_ = bvh_none;  // lists of those that are free
    std::uint32_t items_ = 0;                                    // in the tree
    std::vector<Top> tops_;
    std::vector<Job> jobs_;
    std::vector<BvhPart<D>> parts_;
};

}  // namespace abut
