#pragma once

// How far an answer about two shapes, wherever they are, may be off. For .cpp files.

#include <abut/convex/margin.hpp>
#include <abut/convex/support.hpp>

namespace abut {

template <int D>
double margin_of_doubt(const Convex<D>& a, const Convex<D>& b) {
    const double size_a = size(a), size_b = size(b);
    const double apart = largest(reference_point(b) - reference_point(a));
    return margin_of_doubt(std::min(size_a, size_b), apart + size_a + size_b);
}

}  // namespace abut
