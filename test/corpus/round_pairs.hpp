#pragma once

// Pairs with at least one shape that is no polytope with a radius, and their signed distance by a search over
// directions.

#include "pairs.hpp"
#include "round_shape.hpp"

namespace abut::corpus {

using detail::DVec;
using detail::normalized;

template <int D>
struct RoundPair {
    RoundShape<D> a, b;

    /// The overlap along n, from A; a gap is negative.
    double overlap_along(const DVec<D>& n) const {
        const DVec<D>& origin = a.place.offset;
        return a.extent(n, origin) + b.extent(-n, origin);
    }
};

template <int D>
RoundPair<D> round_pair(Random& random) {
    const int kind_a = static_cast<int>(random.below(5)), kind_b = static_cast<int>(random.below(round_kind_count));
    const Sizes sizes = some_sizes(random);
    const double thinnest = random.chance(0.7) ? random.power_of_two(-2, 0) : random.power_of_two(-20, -2);
    const DVec<D> center = some_center<D>(random, sizes);
    const Random for_a(random.bits()), for_b(random.bits());
    RoundPair<D> pair{round_shape<D>(for_a, kind_a, center, sizes.a, thinnest),
                      round_shape<D>(for_b, kind_b, center, sizes.b, 1)};
    if (random.chance(0.1)) return pair;  // concentric
    const DVec<D> n = random.direction<D>();
    const double smaller = std::min(pair.a.size(), pair.b.size()), away = random.uniform(-1.5, 0.05);
    const double part = random.power_of_two(-20, -7);
    const double wanted = random.chance(0.5) ? away : random.chance(0.5) ? part : -part;
    pair.b = round_shape<D>(for_b, kind_b, center + n * (wanted * smaller + pair.overlap_along(n)), sizes.b, 1);
    return random.chance(0.5) ? pair : RoundPair<D>{pair.b, pair.a};
}

/// The minimal overlap over unit vectors: the best of many, refined by decreasing steps from the best few. `hint` is
/// one of them. If it separates the shapes, the minimum is unique.
template <int D>
double least_overlap(const RoundPair<D>& pair, const DVec<D>& hint) {
    struct Start {
        double value;
        DVec<D> n;
    };
    std::vector<Start> starts{{pair.overlap_along(hint), hint}};
    Random random(1);
    if (starts[0].value >= 0) {
        const auto offer = [&](const DVec<D>& n) {
            starts.push_back({pair.overlap_along(n), n});
            starts.push_back({pair.overlap_along(-n), -n});
        };
        for (const RoundShape<D>* shape : {&pair.a, &pair.b}) {
            for (const DVec<D>& column : shape->place.column) offer(normalized(column));
            offer(shape->axis_of_discs());
        }
        for (int i = 0; i < (D == 2 ? 200 : 750); ++i) offer(random.direction<D>());
    }
    const std::size_t few = std::min<std::size_t>(8, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(few), starts.end(),
                      [](const Start& a, const Start& b) { return a.value < b.value; });
    double least = starts[0].value;
    for (std::size_t i = 0; i < few; ++i) {
        Start now = starts[i];
        for (double step = 0.1; step > 1e-8;) {
            const DVec<D> n = normalized(now.n + random.in_cube<D>() * step);
            const double value = pair.overlap_along(n);
            if (value < now.value)
                now = {value, n};
            else
                step *= 0.97;
        }
        least = std::min(least, now.value);
    }
    return least;
}

}  // namespace abut::corpus
