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
SamplePair<D> random_pair(Random& random, Kind kind_a, Kind kind_b) {
    const double size_a = random.power_of_two(-10, 13);
    const double size_b = random.chance(0.8) ? size_a * random.power_of_two(-2, 2) : random.power_of_two(-10, 13);
    const double smaller = std::min(size_a, size_b);
    const double away = random.chance(0.5) ? 0 : random.power_of_two(0, 14);
    const DVec<D> center_a = random.direction<D>() * (away * std::max(size_a, size_b));
    const Random for_a(random.bits()), for_b(random.bits());
    const Sample<D> a = Maker<D>(for_a, center_a, size_a).make(kind_a);
    Sample<D> b = Maker<D>(for_b, center_a, size_b).make(kind_b);

    const DVec<D> n = random.direction<D>();
    const double gap = gap_along(a.solid, b.solid, n) - a.solid.radius - b.solid.radius;
    DVec<D> center_b = center_a + n * (smaller * random.uniform(-2, 0.05) - gap);
    b = Maker<D>(for_b, center_b, size_b).make(kind_b);
    if (random.chance(0.5)) {
        const Truth<D> now = truth(a.solid, b.solid, Arithmetic::rough);
        const double wanted = smaller * random.power_of_two(-20, -9) * (random.chance(0.6) ? -1 : 1);
        center_b += now.normal * (wanted - now.distance);
        b = Maker<D>(for_b, center_b, size_b).make(kind_b);
    }
    return {a, b};
}

}  // namespace abut::oracle
