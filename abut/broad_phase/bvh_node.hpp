#pragma once

// The parts of a Bvh: nodes of eight children and leaves of eight items, boxes side by side. Not for users.

#include <abut/math/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut {

inline constexpr std::uint32_t bvh_lanes = 8;
inline constexpr std::uint32_t bvh_none = 0xFFFFFFFF;

/// A node or a leaf, by its number and a bit that tells which.
inline constexpr std::uint32_t bvh_leaf_bit = 0x80000000;
inline constexpr bool is_leaf(std::uint32_t ref) {
    return (ref & bvh_leaf_bit) != 0;
}

/// No tree is deeper: 64 levels split where it costs least, 32 that halve would do for 2^32 items, and insertions raise
/// the root once in a few thousand of them, and each time more rarely.
inline constexpr int bvh_binned_depth = 64;
inline constexpr int bvh_depth = bvh_binned_depth + 32 + 32;

/// Eight boxes; those that are used come first. The numbers of an unused one are NaN: it touches nothing, and no test
/// need ask how many there are.
template <int D>
struct alignas(32) BvhRows {
    float min[D][bvh_lanes];
    float max[D][bvh_lanes];

    Aabb<D> box(std::uint32_t lane) const {
        Aabb<D> result;
        for (int i = 0; i < D; ++i) {
            result.min[i] = min[i][lane];
            result.max[i] = max[i][lane];
        }
        return result;
    }
    void set(std::uint32_t lane, const Aabb<D>& box) {
        for (int i = 0; i < D; ++i) {
            min[i][lane] = box.min[i];
            max[i][lane] = box.max[i];
        }
    }
    void clear(std::uint32_t lane) {
        for (int i = 0; i < D; ++i) min[i][lane] = max[i][lane] = std::numeric_limits<float>::quiet_NaN();
    }
    /// What it holds together; Aabb::empty() where it holds nothing.
    Aabb<D> bounds() const {
        Aabb<D> result = Aabb<D>::empty();
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
            if (min[0][lane] <= max[0][lane]) result = merged(result, box(lane));
        return result;
    }
};

template <int D>
struct alignas(32) BvhLeaf : BvhRows<D> {
    std::uint32_t index[bvh_lanes];  ///< in the span that the user gave; bvh_none where unused

    std::uint32_t count() const {
        std::uint32_t result = 0;
        while (result < bvh_lanes && index[result] != bvh_none) ++result;
        return result;
    }
    static BvhLeaf nothing() {
        BvhLeaf result;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            result.clear(lane);
            result.index[lane] = bvh_none;
        }
        return result;
    }
};

template <int D>
struct alignas(32) BvhNode : BvhRows<D> {
    std::uint32_t child[bvh_lanes];  ///< bvh_none where unused
    std::uint32_t parent;            ///< bvh_none of a root
    std::uint32_t items;             ///< below it, when they were last counted
    double built;                    ///< the areas of its children together, when it was built
    double area;                     ///< the same now

    std::uint32_t count() const {
        std::uint32_t result = 0;
        while (result < bvh_lanes && child[result] != bvh_none) ++result;
        return result;
    }
    static BvhNode nothing() {
        BvhNode result;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            result.clear(lane);
            result.child[lane] = bvh_none;
        }
        result.parent = bvh_none;
        result.items = 0;
        result.built = result.area = 0;
        return result;
    }
};

static_assert(sizeof(BvhLeaf<3>) == 224 && sizeof(BvhNode<3>) == 256);
static_assert(sizeof(BvhLeaf<2>) == 160 && sizeof(BvhNode<2>) == 192);

/// An item while a tree is built: a box as two whole registers. In 2D the third coordinates are 0.
struct alignas(16) BvhItem {
    float min[3];
    std::uint32_t index;
    float max[3];
    std::uint32_t unused;
};

/// A root and all that hangs on it. What has no bound would reach into every split of the rest, and has a tree of its
/// own.
template <int D>
struct BvhRoot {
    std::uint32_t ref = bvh_none;
    Aabb<D> box = Aabb<D>::empty();
};

}  // namespace abut
