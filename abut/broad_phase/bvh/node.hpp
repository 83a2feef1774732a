#pragma once

// Nodes of eight children and leaves of eight items, with their boxes as a structure of arrays (SoA). Internal.

#include <abut/math/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::detail {

inline constexpr std::uint32_t bvh_lanes = 8;
inline constexpr std::uint32_t bvh_none = 0xFFFFFFFF;

/// A reference to a node or a leaf is its index; this bit marks leaves.
inline constexpr std::uint32_t bvh_leaf_bit = 0x80000000;
inline constexpr bool is_leaf(std::uint32_t ref) {
    return (ref & bvh_leaf_bit) != 0;
}

/// The maximum depth of a tree: at most 64 levels are split by SAH, 32 levels of median splits suffice for 2^32 items,
/// and insertions add a level once in a few thousand of them, and ever more rarely.
inline constexpr int bvh_binned_depth = 64;
inline constexpr int bvh_depth = bvh_binned_depth + 32 + 32;

/// Eight boxes, the used ones first. The bounds of an unused box are NaN, so that it overlaps nothing and tests don't
/// need the count.
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
    /// The bounds of its boxes; Aabb::empty() if there are none.
    Aabb<D> bounds() const {
        Aabb<D> result = Aabb<D>::empty();
        // The comparisons are false for an unused box.
        for (int i = 0; i < D; ++i)
            for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
                result.min[i] = min[i][lane] < result.min[i] ? min[i][lane] : result.min[i];
                result.max[i] = result.max[i] < max[i][lane] ? max[i][lane] : result.max[i];
            }
        return result;
    }
};

template <int D>
struct alignas(32) BvhLeaf : BvhRows<D> {
    std::uint32_t index[bvh_lanes];  ///< in the user's span; bvh_none if unused

    std::uint32_t count() const {
        std::uint32_t result = 0;
        for (const std::uint32_t item : index) result += item != bvh_none ? 1u : 0u;
        return result;
    }
    static BvhLeaf empty() {
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
    std::uint32_t child[bvh_lanes];  ///< bvh_none if unused
    std::uint32_t parent;            ///< bvh_none for a root
    std::uint32_t items;             ///< in its subtree, at the last count
    double built_area;               ///< the sum of the areas of its children, when it was built
    double area;                     ///< the current sum

    std::uint32_t count() const {
        std::uint32_t result = 0;
        for (const std::uint32_t ref : child) result += ref != bvh_none ? 1u : 0u;
        return result;
    }
    static BvhNode empty() {
        BvhNode result;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            result.clear(lane);
            result.child[lane] = bvh_none;
        }
        result.parent = bvh_none;
        result.items = 0;
        result.built_area = result.area = 0;
        return result;
    }
};

static_assert(sizeof(BvhLeaf<3>) == 224 && sizeof(BvhNode<3>) == 256);
static_assert(sizeof(BvhLeaf<2>) == 160 && sizeof(BvhNode<2>) == 192);

/// An item during a build: its box fills two SIMD registers. In 2D the third coordinates are 0.
struct alignas(16) BvhItem {
    float min[3];
    std::uint32_t index;
    float max[3];
    std::uint32_t unused;
};

/// A root and the bounds of its tree. Unbounded boxes have a tree of their own, for they would straddle every split.
template <int D>
struct BvhRoot {
    std::uint32_t ref = bvh_none;
    Aabb<D> box = Aabb<D>::empty();
};

}  // namespace abut::detail
