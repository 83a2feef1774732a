#pragma once

// The data of a Compound. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/compound.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut {

template <int D>
struct Compound<D>::Data {
    std::vector<AnyShape<D>> children;
    std::vector<View<D>> views;
    Bvh<D> tree;

    /// Sets the children and their views; the tree is to be built of the boxes.
    std::optional<Problem> set(std::span<const AnyShape<D>> shapes, std::vector<Aabb<D>>& boxes);
};

}  // namespace abut
