#pragma once

// The data of a Compound. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/compound.hpp>

#include <optional>
#include <set>
#include <span>
#include <vector>

namespace abut {

template <int D>
struct Compound<D>::Data {
    std::vector<AnyShape<D>> children;
    std::vector<View<D>> views;
    Bvh<D> tree;

    std::set<std::uint32_t> removed;  ///< indices without a child; the boxes there are empty
    std::uint32_t changes = 0;        ///< of the tree since it was last updated

    /// Sets the children and their views; the tree is to be built of the boxes.
    std::optional<Problem> set(std::span<const AnyShape<D>> shapes, std::vector<Aabb<D>>& boxes);
    /// Counts a change of the tree, and updates the tree if there were many, or if the change didn't succeed. So it
    /// stays about as good as a new one, and its depth bounded.
    void count_change(bool succeeded);
};

}  // namespace abut
