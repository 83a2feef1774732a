#pragma once

// How far an answer about two shapes may be off. For .cpp files.

#include <abut/convex/support.hpp>

namespace abut {

/// 1e-5 of the smaller one's size, and 16 ulp of the largest coordinate seen from the first.
template <int D>
double margin_of_doubt(const Convex<D>& a, const Convex<D>& b) {
    const double size_a = size(a), size_b = size(b);
    const double apart = largest(reference_point(b) - reference_point(a));
    constexpr double ulps = 16 * 0x1p-24;
    return 1e-5 * std::min(size_a, size_b) + ulps * (apart + size_a + size_b);
}

}  // namespace abut
