#pragma once

#include <cstdint>

namespace abut {

/// The number of the point for which `measure` is greatest, the first of them if there are several; of at least one.
template <class Points, class Measure>
std::uint32_t farthest_of(const Points& points, Measure measure) {
    std::uint32_t best = 0;
    double most = measure(points[0]);
    for (std::uint32_t i = 1; i < points.size(); ++i) {
        const double value = measure(points[i]);
        if (value > most) {
            most = value;
            best = i;
        }
    }
    return best;
}

}  // namespace abut
