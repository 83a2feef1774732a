#pragma once

// Comparisons of vectors for tests.

#include <abut/math/dvec.hpp>

#include <gtest/gtest.h>

namespace abut::oracle {

using detail::DVec;
using detail::length;

template <int D>
std::string text(const glm::vec<D, float>& v) {
    std::string result = "(";
    for (int i = 0; i < D; ++i) result += (i > 0 ? " " : "") + std::to_string(v[i]);
    return result + ")";
}

template <int D>
testing::AssertionResult near(const glm::vec<D, float>& a, const glm::vec<D, float>& b, double tolerance = 1e-6) {
    if (length(DVec<D>(a) - DVec<D>(b)) <= tolerance) return testing::AssertionSuccess();
    return testing::AssertionFailure() << text(a) << " is not " << text(b);
}

/// Whether a vector has length 1, and so no NaN.
template <int D>
testing::AssertionResult is_unit(const glm::vec<D, float>& normal) {
    if (std::abs(length(DVec<D>(normal)) - 1) <= 1e-6) return testing::AssertionSuccess();
    return testing::AssertionFailure() << text(normal) << " is not of length 1";
}

}  // namespace abut::oracle
