// Trees that are built from a topology, such as that of a file.

#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/bvh/topology.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace abut::detail {
namespace {

/// A chain of nodes: each has a leaf with one item, and the next node.
BvhTopology chain_of(std::uint32_t nodes) {
    BvhTopology result;
    result.roots[0] = 0;
    for (std::uint32_t i = 0; i <= nodes; ++i) {
        result.items.push_back(i);
        result.counts.push_back(1);
    }
    for (std::uint32_t i = 0; i < nodes; ++i) {
        const std::uint32_t next = i + 1 < nodes ? i + 1 : nodes | bvh_leaf_bit;
        result.children.insert(result.children.end(), {i | bvh_leaf_bit, next});
        result.children.resize((std::size_t{i} + 1) * bvh_lanes, bvh_none);
    }
    return result;
}

std::vector<Aabb3> boxes_of(std::uint32_t count) {
    std::vector<Aabb3> result;
    for (std::uint32_t i = 0; i < count; ++i)
        result.push_back({Vec3(static_cast<float>(i)), Vec3(static_cast<float>(i) + 0.5f)});
    return result;
}

/// The number of levels of nodes.
int depth_of(const BvhTopology& topology, std::uint32_t ref) {
    if (ref == bvh_none || is_leaf(ref)) return 0;
    int result = 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
        result = std::max(result, depth_of(topology, topology.children[std::size_t{bvh_lanes} * ref + lane]));
    return result + 1;
}

TEST(BvhTopology, IsThatOfTheTree) {
    const std::vector<Aabb3> boxes = boxes_of(21);
    Bvh<3> tree;
    ASSERT_TRUE(BvhAccess::tree(tree).build(boxes, chain_of(20)));
    const BvhTopology again = BvhAccess::tree(tree).topology();
    EXPECT_EQ(again.items, chain_of(20).items);
    EXPECT_EQ(again.children, chain_of(20).children);
}

/// A tree as deep as can be leaves no levels for insertions, so that it is built anew.
TEST(BvhTopology, OfAVeryDeepTreeIsReplaced) {
    constexpr std::uint32_t deepest = bvh_depth - 1;
    for (const std::uint32_t nodes : {deepest + 1, deepest}) {
        const std::vector<Aabb3> boxes = boxes_of(nodes + 1);
        Bvh<3> tree;
        ASSERT_EQ(BvhAccess::tree(tree).build(boxes, chain_of(nodes)), nodes == deepest);
        if (nodes > deepest) continue;
        const BvhTopology again = BvhAccess::tree(tree).topology();
        EXPECT_LT(depth_of(again, again.roots[0]), 10);
        for (std::uint32_t i = 0; i < 1000; ++i) tree.insert(boxes[nodes]);
        std::size_t found = 0;
        tree.each_overlapping(tree.bounds(), [&](std::uint32_t) { ++found; });
        EXPECT_EQ(found, boxes.size() + 1000);
    }
}

}  // namespace
}  // namespace abut::detail
