#pragma once

// Random pairs of shapes, so near to each other that about half of them overlap.

#include "distance.hpp"
#include "is_long.hpp"
#include "sample.hpp"

namespace abut::oracle {

/// The number of random cases of a test: `few`, or `when_long` times as many if the environment sets ABUT_LONG.
inline int case_count(int few, int when_long = 40) {
    return is_long() ? when_long * few : few;
}

template <int D>
struct SamplePair {
    Sample<D> a, b;
};

/// Sizes are from 1e-3 to 1e4 and mostly similar; centers are up to some ten thousand sizes from the origin. Half of
/// the pairs nearly touch: their distance or depth is at most a thousandth of a size.
template <int D>
SamplePair<D> random_pair(Random& random, Kind kind_a, Kind kind_b);

}  // namespace abut::oracle
