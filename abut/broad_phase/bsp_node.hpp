#pragma once

// The parts of a Bsp, and how they are put together. Not for users.

#include <abut/math/aabb.hpp>

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut {

/// A place where items are: a cell of space, with a plane across it or none. Nodes lie depth first: the side below the
/// plane of node k is node k + 1. A point whose coordinate is that of the plane is above it.
struct BspNode {
    static constexpr std::uint32_t no_axis = 3;

    float plane = 0;
    std::uint32_t above_and_axis = no_axis;  ///< the node above the plane, times 4, and the plane's axis
    std::uint32_t first = 1;  ///< where its items begin; the word before tells for how many there is room
    std::uint32_t count = 0;

    bool is_leaf() const { return axis() == static_cast<int>(no_axis); }
    int axis() const { return static_cast<int>(above_and_axis & 3u); }
    std::uint32_t above() const { return above_and_axis >> 2; }
};

/// Its box lies here, in the order of the tree, for locality.
template <int D>
struct BspItem {
    Aabb<D> box;
    std::uint32_t index;  ///< in the span that the user gave
};

static_assert(sizeof(BspNode) == 16 && sizeof(BspItem<3>) == 28 && sizeof(BspItem<2>) == 20);

template <int D>
struct BspTree {
    std::vector<BspItem<D>> items;     // in the order in which the tree comes upon them, the empty ones last
    std::vector<BspNode> nodes;        // the first is the root
    std::vector<std::uint32_t> words;  // the lists of the nodes, each after its room; before all of them a room of none
    std::vector<std::uint32_t> place;  // in `items`, of each item of the user
    std::uint32_t used = 1;            // of the words
    Aabb<D> frame;                     // what was cut when it was built: no side is infinite
};

/// No tree is deeper.
inline constexpr int bsp_depth = 64;

/// How many words the lists may take: two mentions an item, a room for each of at most n + 1 nodes and one item to
/// spare in each.
constexpr std::size_t bsp_words(std::size_t items) {
    return 4 * items + 8;
}

/// The largest float below a finite one.
inline float float_before(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x + 0.0f);
    return std::bit_cast<float>(bits > 0 ? bits - 1 : bits < 0 ? bits + 1 : static_cast<std::int32_t>(0x80000001u));
}

/// The two parts of a cell. What has floats for coordinates is in one or the other.
template <int D>
std::pair<Aabb<D>, Aabb<D>> cut(const Aabb<D>& cell, int axis, float plane) {
    std::pair<Aabb<D>, Aabb<D>> result{cell, cell};
    result.first.max[axis] = float_before(plane);
    result.second.min[axis] = plane;
    return result;
}

/// Whether a box is so wide that a cell keeps it where its plane meets it, in place of telling both parts of it.
template <int D>
bool is_wide(const Aabb<D>& box, const Aabb<D>& cell, int axis) {
    const auto extent = [axis](const Aabb<D>& b) {
        return static_cast<double>(b.max[axis]) - static_cast<double>(b.min[axis]);
    };
    return extent(box) >= 0.5 * extent(cell);
}

/// Makes the nodes and the lists for `tree.items`, which are in the user's order, and reorders these.
template <int D>
void build_tree(BspTree<D>& tree);

}  // namespace abut
