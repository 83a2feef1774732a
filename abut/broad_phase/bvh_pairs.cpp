// Pairs: two trees, or one twice, descended together. The depth of the recursion is at most twice that of a tree.

#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/pair_buffer.hpp>

#include <algorithm>

namespace abut {
namespace {

/// Of node against node, and item against node. May be true of an empty box. Counts, for a branch on every side would
/// cost more.
template <class Box, class Other>
bool meets(const Box& a, const Other& b) {
    int apart = 0;
    for (int i = 0; i < decltype(a.min)::length(); ++i)
        apart += static_cast<int>(a.min[i] > b.max[i]) + static_cast<int>(b.min[i] > a.max[i]);
    return apart == 0;
}

template <int D>
struct Tree {
    const BvhNode<D>* nodes;
    const BvhItem<D>* items;
};

template <int D>
class PairWalk {
public:
    PairWalk(const Tree<D>& a, const Tree<D>& b, bool same, PairBuffer& pairs)
        : a_(a), b_(b), same_(same), pairs_(pairs) {}

    /// The pairs below one node. Returns false where the visitor has had enough.
    bool below(std::uint32_t index) const {
        const BvhNode<D>& node = a_.nodes[index];
        if (node.count == 0) return below(index + 1) && below(node.first) && between(index + 1, node.first);
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            for (std::uint32_t j = i + 1; j < node.first + node.count; ++j)
                if (!pair(a_.items[i], a_.items[j])) return false;
        return true;
    }

    /// The pairs of an item below one node with an item below another. Returns false where the visitor has had enough.
    bool between(std::uint32_t index_a, std::uint32_t index_b) const {
        const BvhNode<D>&a = a_.nodes[index_a], &b = b_.nodes[index_b];
        if (!meets(a, b)) return true;
        if (a.count > 0 && b.count > 0) return leaves(a, b);
        if (a.count > 0) return between(index_a, index_b + 1) && between(index_a, b.first);
        if (b.count > 0) return between(index_a + 1, index_b) && between(a.first, index_b);
        return between(index_a + 1, index_b + 1) && between(index_a + 1, b.first) && between(a.first, index_b + 1) &&
               between(a.first, b.first);
    }

private:
    bool leaves(const BvhNode<D>& a, const BvhNode<D>& b) const {
        for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
            if (!meets(a_.items[i].box, b)) continue;
            for (std::uint32_t j = b.first; j < b.first + b.count; ++j)
                if (!pair(a_.items[i], b_.items[j])) return false;
        }
        return true;
    }

    bool pair(const BvhItem<D>& a, const BvhItem<D>& b) const {
        if (!overlaps(a.box, b.box)) return true;
        return same_ ? pairs_.add_sorted(a.index, b.index) : pairs_.add(a.index, b.index);
    }

    Tree<D> a_, b_;
    bool same_;
    PairBuffer& pairs_;
};

}  // namespace

template <int D>
void Bvh<D>::visit_pairs(PairsCall visit, Executor*) const {
    const Tree<D> tree{nodes_.data(), items_.data()};
    PairBuffer pairs(visit);
    if (!nodes_.empty() && PairWalk<D>(tree, tree, true, pairs).below(0)) pairs.flush();
}

template <int D>
void Bvh<D>::visit_pairs(const Bvh& other, PairsCall visit) const {
    const Tree<D> tree{nodes_.data(), items_.data()}, others{other.nodes_.data(), other.items_.data()};
    PairBuffer pairs(visit);
    if (!nodes_.empty() && !other.nodes_.empty() && PairWalk<D>(tree, others, false, pairs).between(0, 0))
        pairs.flush();
}

template void Bvh<2>::visit_pairs(PairsCall, Executor*) const;
template void Bvh<3>::visit_pairs(PairsCall, Executor*) const;
template void Bvh<2>::visit_pairs(const Bvh&, PairsCall) const;
template void Bvh<3>::visit_pairs(const Bvh&, PairsCall) const;

}  // namespace abut
