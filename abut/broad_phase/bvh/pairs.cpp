// Simultaneous traversal of two trees, or of one tree with itself. The depth of the recursion is at most twice that of
// a tree. Highway compiles this file once for each SIMD target and dispatches at run time.

#include <abut/broad_phase/bvh/queries.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/bvh/pairs.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/broad_phase/bvh/overlap_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// A box, as one lane of eight.
template <int D>
struct BoxLane {
    const BvhRows<D>* rows;
    std::uint32_t lane;
};

template <int D>
class PairTraversal {
public:
    PairTraversal(const BvhTree<D>& a, const BvhTree<D>& b, PairBuffer& pairs)
        : a_(a), b_(b), same_(&a == &b), pairs_(pairs) {}

    /// Reports the pairs below one node. Returns false if the visitor stops the search.
    bool below(std::uint32_t ref) const {
        if (is_leaf(ref)) return below_leaf(a_.leaf(ref));
        const BvhNode<D>& node = a_.node(ref);
        for (std::uint32_t i = 0; i < bvh_lanes && node.child[i] != bvh_none; ++i) {
            if (!below(node.child[i])) return false;
            for (std::uint32_t m = overlapping_lanes<D>(node, node, i) & after(i); m != 0; m &= m - 1) {
                const auto j = static_cast<std::uint32_t>(std::countr_zero(m));
                if (!between(node.child[i], {&node, i}, node.child[j], {&node, j})) return false;
            }
        }
        return true;
    }

    /// Reports the pairs of an item below one node and an item below another. Returns false if the visitor stops the
    /// search.
    bool between(std::uint32_t ref_a, BoxLane<D> box_a, std::uint32_t ref_b, BoxLane<D> box_b) const {
        if (is_leaf(ref_a)) {
            if (is_leaf(ref_b)) return leaves(a_.leaf(ref_a), b_.leaf(ref_b), box_b);
            const BvhNode<D>& b = b_.node(ref_b);
            for (std::uint32_t m = overlapping_lanes<D>(b, *box_a.rows, box_a.lane); m != 0; m &= m - 1) {
                const auto j = static_cast<std::uint32_t>(std::countr_zero(m));
                if (!between(ref_a, box_a, b.child[j], {&b, j})) return false;
            }
            return true;
        }
        const BvhNode<D>& a = a_.node(ref_a);
        for (std::uint32_t m = overlapping_lanes<D>(a, *box_b.rows, box_b.lane); m != 0; m &= m - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(m));
            if (is_leaf(ref_b)) {
                if (!between(a.child[i], {&a, i}, ref_b, box_b)) return false;
                continue;
            }
            const BvhNode<D>& b = b_.node(ref_b);
            for (std::uint32_t n = overlapping_lanes<D>(b, a, i); n != 0; n &= n - 1) {
                const auto j = static_cast<std::uint32_t>(std::countr_zero(n));
                if (!between(a.child[i], {&a, i}, b.child[j], {&b, j})) return false;
            }
        }
        return true;
    }

private:
    /// The bits of the lanes after this one.
    static std::uint32_t after(std::uint32_t lane) { return 0xFEu << lane; }

    bool below_leaf(const BvhLeaf<D>& leaf) const {
        for (std::uint32_t i = 0; i < bvh_lanes && leaf.index[i] != bvh_none; ++i)
            if (!report(leaf.index[i], leaf, overlapping_lanes<D>(leaf, leaf, i) & after(i))) return false;
        return true;
    }

    bool leaves(const BvhLeaf<D>& a, const BvhLeaf<D>& b, BoxLane<D> box_b) const {
        for (std::uint32_t m = overlapping_lanes<D>(a, *box_b.rows, box_b.lane); m != 0; m &= m - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(m));
            if (!report(a.index[i], b, overlapping_lanes<D>(b, a, i))) return false;
        }
        return true;
    }

    bool report(std::uint32_t index, const BvhLeaf<D>& others, std::uint32_t bits) const {
        for (; bits != 0; bits &= bits - 1) {
            const std::uint32_t other = others.index[std::countr_zero(bits)];
            if (!(same_ ? pairs_.add_sorted(index, other) : pairs_.add(index, other))) return false;
        }
        return true;
    }

    const BvhTree<D>&a_, &b_;
    bool same_;
    PairBuffer& pairs_;
};

template <int D>
bool pairs_of(const BvhTree<D>& a, const BvhTree<D>& b, const BvhPairTask<D>& task, PairBuffer& pairs) {
    const PairTraversal<D> traversal(a, b, pairs);
    if (task.b == bvh_none) return traversal.below(task.a);
    BvhRows<D> boxes;
    boxes.set(0, task.box_a);
    boxes.set(1, task.box_b);
    return traversal.between(task.a, {&boxes, 0}, task.b, {&boxes, 1});
}

ABUT_NAME_DIMENSIONS(pairs_of);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(pairs_of);

template <int D>
bool find_pairs(const BvhTree<D>& a, const BvhTree<D>& b, const BvhPairTask<D>& task, PairBuffer& pairs) {
    return dispatched_pairs_of<D>()(a, b, task, pairs);
}
template bool find_pairs(const BvhTree<2>&, const BvhTree<2>&, const BvhPairTask<2>&, PairBuffer&);
template bool find_pairs(const BvhTree<3>&, const BvhTree<3>&, const BvhPairTask<3>&, PairBuffer&);

}  // namespace abut::detail
#endif
