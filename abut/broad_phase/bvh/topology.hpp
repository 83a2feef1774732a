#pragma once

// The topology of a Bvh: enough to rebuild its tree for the same boxes without a search for splits. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/math/detail/blob.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Leaves and nodes are numbered in the order in which a traversal comes to them.
struct BvhTopology {
    std::array<std::uint32_t, 2> roots{bvh_none, bvh_none};  ///< references, as in a node
    std::vector<std::uint32_t> items;                        ///< of all leaves, one after the other
    std::vector<std::uint8_t> counts;                        ///< the number of items of each leaf
    std::vector<std::uint32_t> children;                     ///< eight references a node
};

/// Reaches the tree of a Bvh.
struct BvhAccess {
    template <int D>
    static const BvhTree<D>& tree(const Bvh<D>& bvh) {
        return bvh.tree_;
    }
    template <int D>
    static BvhTree<D>& tree(Bvh<D>& bvh) {
        return bvh.tree_;
    }
};

/// Appends the topology of a tree, or reads one. Returns false if there are too few bytes.
void write(BlobWriter& writer, const BvhTopology& topology);
bool read(BlobReader& reader, BvhTopology& topology);

}  // namespace abut::detail
