#pragma once

// The tolerance of a pair of convex shapes at any position. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/convex/tolerance.hpp>

namespace abut::detail {

template <int D>
double tolerance_for(const Convex<D>& a, const Convex<D>& b) {
    const double size_a = size(a), size_b = size(b);
    const double apart = largest(reference_point(b) - reference_point(a));
    return tolerance_for(std::min(size_a, size_b), apart + size_a + size_b);
}

}  // namespace abut::detail
