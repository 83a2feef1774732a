#pragma once

// Random pairs, near one another often enough that about half of them overlap.

#include "distance.hpp"
#include "sample.hpp"

#include <cstdlib>

namespace abut::oracle {

/// How many random cases a test runs: `few` of them, a hundred times as many where the environment sets ABUT_LONG.
inline int amount(int few) {
    return std::getenv("ABUT_LONG") != nullptr ? 100 * few : few;
}

template <int D>
struct SamplePair {
    Sample<D> a, b;
};

/// Sizes from 1e-3 to 1e4, mostly alike; centers up to some ten thousand sizes from the origin. Half of the pairs are
/// coherent: a small step, a thousandth of a size or much less, into or out of touching.
template <int D>
SamplePair<D> random_pair(Random& random, Kind kind_a, Kind kind_b);

}  // namespace abut::oracle
