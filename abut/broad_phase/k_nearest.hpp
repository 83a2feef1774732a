#pragma once

// The nearest boxes to a point, by any broad phase.

#include <abut/broad_phase/concept.hpp>
#include <abut/math/aabb.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace abut {

/// An item, and how far its box is; 0 where the point lies in it.
struct NearItem {
    float distance = 0;
    std::uint32_t item = 0;

    friend auto operator<=>(const NearItem&, const NearItem&) = default;
};

/// Keeps the k nearest of the boxes that it is offered, for a visitor of BroadPhase::closest.
template <int D>
class NearestItems {
public:
    /// Uses `out` until `sort`; what is in it is lost.
    NearestItems(const Vec<D>& point, std::size_t k, std::vector<NearItem>& out);

    /// Returns the distance beyond which no box is of interest; negative where k is 0.
    float offer(std::uint32_t item, const Aabb<D>& box);
    void sort();

private:
    Vec<D> point_;
    std::size_t k_;
    std::vector<NearItem>& out_;  // a heap: the farthest is first
};

extern template class NearestItems<2>;
extern template class NearestItems<3>;

/// The k boxes nearest to the point, or all where there are fewer, sorted by (distance, index); of boxes equally far
/// those of lower index. Distances are rounded to float before they are compared. `boxes` are those that `phase` was
/// built of or last updated with. Allocates nothing but for what `out` needs to grow to k items.
template <int D, BroadPhase<D> Phase>
void k_nearest(const Phase& phase, std::type_identity_t<std::span<const Aabb<D>>> boxes, const Vec<D>& point,
               std::size_t k, std::vector<NearItem>& out) {
    NearestItems<D> nearest(point, k, out);
    phase.closest(point, [&](std::uint32_t item) { return nearest.offer(item, boxes[item]); });
    nearest.sort();
}

}  // namespace abut
