#pragma once

// Boxes as brushes of a SolidBsp.

#include <abut/shape/box.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <vector>

namespace abut::test {

/// Adds the sides of a box as a brush.
template <int D>
void add_brush(const Vec<D>& low, const Vec<D>& high, std::vector<HalfSpace<D>>& sides,
               std::vector<std::uint32_t>& ends) {
    for (int i = 0; i < D; ++i) {
        Vec<D> normal(0.0f);
        normal[i] = 1;
        sides.push_back({normal, high[i]});
        sides.push_back({-normal, -low[i]});
    }
    ends.push_back(static_cast<std::uint32_t>(sides.size()));
}

/// The union of boxes, each of them a brush.
template <int D>
SolidBsp<D> solid_of_boxes(const std::vector<Box<D>>& boxes) {
    std::vector<HalfSpace<D>> sides;
    std::vector<std::uint32_t> ends;
    for (const Box<D>& box : boxes) add_brush<D>(box.center - box.half, box.center + box.half, sides, ends);
    return *SolidBsp<D>::from_brushes(sides, ends);
}

}  // namespace abut::test
