#include "pair.hpp"

#include <algorithm>

namespace abut::oracle {

template <int D>
SamplePair<D> random_pair(Random& random, Kind kind_a, Kind kind_b) {
    const double size_a = random.power_of_two(-10, 13);
    const double size_b = random.chance(0.8) ? size_a * random.power_of_two(-2, 2) : random.power_of_two(-10, 13);
    const double smaller = std::min(size_a, size_b);
    const double away = random.chance(0.5) ? 0 : random.power_of_two(0, 14);
    const DVec<D> center_a = random.direction<D>() * (away * std::max(size_a, size_b));
    const Random for_a(random.bits()), for_b(random.bits());
    const Sample<D> a = SampleGenerator<D>(for_a, center_a, size_a).make(kind_a);
    Sample<D> b = SampleGenerator<D>(for_b, center_a, size_b).make(kind_b);

    const DVec<D> n = random.direction<D>();
    const double gap = gap_along(a.solid, b.solid, n) - a.solid.radius - b.solid.radius;
    DVec<D> center_b = center_a + n * (smaller * random.uniform(-2, 0.05) - gap);
    b = SampleGenerator<D>(for_b, center_b, size_b).make(kind_b);
    if (random.chance(0.5)) {
        const Truth<D> now = truth(a.solid, b.solid, Arithmetic::floating_point);
        const double target_distance = smaller * random.power_of_two(-20, -9) * (random.chance(0.6) ? -1 : 1);
        center_b += now.normal * (target_distance - now.distance);
        b = SampleGenerator<D>(for_b, center_b, size_b).make(kind_b);
    }
    return {a, b};
}

template SamplePair<2> random_pair(Random&, Kind, Kind);
template SamplePair<3> random_pair(Random&, Kind, Kind);

}  // namespace abut::oracle
