#pragma once

// The k nearest boxes to a point, by any broad phase.

#include <abut/broad_phase/concept.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/simd/upper_halves.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace abut {

/// An item, and the distance of its box from the point.
struct NearItem {
    float distance = 0;  ///< 0 if the box contains the point
    std::uint32_t item = 0;

    friend auto operator<=>(const NearItem&, const NearItem&) = default;
};

}  // namespace abut

namespace abut::detail {

/// Collects the k nearest of the boxes that are offered to it, for a visitor of BroadPhase::closest.
template <int D>
class NearestItems {
public:
    /// Discards the contents of `out` and uses it until `sort`.
    NearestItems(const Vec<D>& point, std::size_t k, std::vector<NearItem>& out);

    /// Returns the new reach: boxes farther away can't be among the k nearest. It is negative if k is 0.
    float offer(std::uint32_t item, const Aabb<D>& box);
    void sort();

private:
    Vec<D> point_;
    std::size_t k_;
    std::vector<NearItem>& out_;  // a max-heap by distance
};

extern template class NearestItems<2>;
extern template class NearestItems<3>;

}  // namespace abut::detail

namespace abut {

/// Writes the k boxes nearest to the point to `out`, or all boxes if there are fewer, sorted by (distance, index).
/// Among boxes at equal distances, those of lower index count as nearer. Distances are rounded to float before they are
/// compared. `boxes` are the boxes of the last build or update of `phase`. Allocates only to grow `out` to k items.
template <int D, BroadPhase<D> Phase>
void k_nearest(const Phase& phase, std::type_identity_t<std::span<const Aabb<D>>> boxes, const Vec<D>& point,
               std::size_t k, std::vector<NearItem>& out) {
    detail::clear_upper_halves();
    detail::NearestItems<D> nearest(point, k, out);
    phase.closest(point, [&](std::uint32_t item) { return nearest.offer(item, boxes[item]); });
    nearest.sort();
}

}  // namespace abut
