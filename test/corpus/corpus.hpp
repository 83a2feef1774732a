#pragma once

// Makes and judges one pair of the corpus.

#include "judge.hpp"

namespace abut::corpus {

using detail::axis;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::to_float;

/// The relative tolerance of depths of user-defined and curved shapes, above the minimum.
inline constexpr double depth_tolerance = 1e-3;

template <int D>
Known known_of(const SamplePair<D>& pair) {
    const Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::floating_point);
    const double size_a = oracle::size(pair.a.solid), size_b = oracle::size(pair.b.solid);
    const bool by_support = pair.a.kind == Kind::cloud || pair.b.kind == Kind::cloud;
    return {truth.distance, oracle::tolerance_for(pair.a.solid, pair.b.solid),
            by_support ? depth_tolerance * std::min(size_a, size_b) : 0, truth.duality_gap, size_a + size_b};
}

/// A point near the surface, and a ray to the center from outside.
template <int D>
void judge_point_and_ray(const PolytopeSide<D>& side, Random random, Verdict& verdict) {
    const Polytope<D>& solid = side.sample.solid;
    const double size = oracle::size(solid);
    const DVec<D> middle = oracle::middle(solid);
    const DVec<D> direction = random.direction<D>();
    const double reach = random.uniform(0, 2);
    const Vec<D> point =
        to_float(middle + direction * ((side.extent(direction) - dot(direction, middle - side.origin)) * reach));
    const double rounding = 16 * oracle::ulp(2 * size) + oracle::transform_error(solid);
    const double margin = 1e-5 * size + rounding;
    const double there = side.signed_distance(DVec<D>(point));
    if (std::abs(there) > margin)
        verdict.expect(Fault::contains, contains(side.sample.view, point) == (there < 0) ? 0 : std::abs(there), margin,
                       "a point in or out of A");

    const Vec<D> from = to_float(middle + random.direction<D>() * (size * random.uniform(1.5, 3)));
    const double inside = side.signed_distance(middle);
    const double coarse = margin + 4 * oracle::rounding_of<D>(from);
    if (inside > -2 * coarse || side.signed_distance(DVec<D>(from)) < coarse) return;
    const DVec<D> along = normalized(middle - DVec<D>(from));
    const auto hit = raycast(Ray<D>{from, to_float(along), static_cast<float>(4 * size)}, side.sample.view);
    verdict.expect(Fault::raycast, hit.has_value(), "misses the middle of A");
    if (!hit) return;
    const bool finite = all_finite<D>(hit->point) && all_finite<D>(hit->normal) && std::isfinite(hit->distance);
    verdict.expect(Fault::not_finite, finite, "raycast");
    if (!finite) return;
    verdict.expect(Fault::raycast, std::abs(side.signed_distance(DVec<D>(hit->point))), coarse,
                   "a hit off the surface");
    verdict.expect(Fault::raycast, dot(DVec<D>(hit->normal), along), 1e-6, "a normal along the ray");
}

template <int D>
void judge_samples(const SamplePair<D>& pair, const QueryOptions<D>& options, std::uint64_t seed, Verdict& verdict) {
    const DVec<D> origin = oracle::middle(pair.a.solid);
    const PolytopeSide<D> a(pair.a, origin), b(pair.b, origin);
    const Known known = known_of(pair);
    Judge<D, PolytopeSide<D>, PolytopeSide<D>>(pair.a.view, pair.b.view, a, b, known, verdict).judge(options);
    judge_point_and_ray(a, Random(seed), verdict);
}

template <int D>
struct HalfSpacePair {
    Sample<D> sample;
    HalfSpace<D> half_space;
    bool sample_first;
};

template <int D>
HalfSpacePair<D> half_space_pair(Random random) {
    const Sizes sizes = some_sizes(random);
    DVec<D> center = some_center<D>(random, sizes);
    if (random.chance(0.2)) center = random.direction<D>() * random.power_of_two(10, 20);
    const Movable<D> make{Random(random.bits()), sizes.a, static_cast<Style>(random.below(5))};
    const Sample<D> sample = make.at(center);
    DVec<D> n = random.direction<D>();
    if (random.chance(0.3)) n = axis<D>(static_cast<int>(random.below(D)), random.chance(0.5) ? 1 : -1);
    HalfSpace<D> half_space{to_float(n), 0};
    n = normalized(DVec<D>(half_space.normal));
    const DVec<D> origin = oracle::middle(sample.solid);
    const double part = oracle::size(sample.solid) * random.power_of_two(-24, 0);
    const double lowest = dot(n, origin) - PolytopeSide<D>(sample, origin).extent(-n);
    half_space.offset = static_cast<float>(lowest + (random.chance(0.5) ? part : -part));
    return {sample, half_space, random.chance(0.5)};
}

template <int D>
void judge_half_space(const HalfSpacePair<D>& pair, Verdict& verdict) {
    const DVec<D> given(pair.half_space.normal), n = normalized(given), origin = oracle::middle(pair.sample.solid);
    const PolytopeSide<D> shape(pair.sample, origin);
    const HalfSpaceSide<D> ground{n, static_cast<double>(pair.half_space.offset) / length(given), origin};
    const double size = oracle::size(pair.sample.solid);
    Known known;
    known.distance = -shape.extent(-n) - (ground.offset - dot(n, origin));
    known.margin =
        1e-5 * size + 16 * oracle::ulp(size + std::abs(known.distance)) + oracle::transform_error(pair.sample.solid);
    known.sizes = size;
    const View<D> view_of_ground = view(pair.half_space);
    if (pair.sample_first)
        Judge<D, PolytopeSide<D>, HalfSpaceSide<D>>(pair.sample.view, view_of_ground, shape, ground, known, verdict)
            .judge({});
    else
        Judge<D, HalfSpaceSide<D>, PolytopeSide<D>>(view_of_ground, pair.sample.view, ground, shape, known, verdict)
            .judge({});
}

template <int D>
void judge_round(Random random, Verdict& verdict) {
    const RoundPair<D> pair = round_pair<D>(random);
    const double size_a = pair.a.size(), size_b = pair.b.size(), smaller = std::min(size_a, size_b);
    const DVec<D> origin = pair.a.place.offset;
    const Closest<D> hint = closest(pair.a.view, pair.b.view);
    const DVec<D> n = all_finite<D>(hint.normal) ? normalized(DVec<D>(hint.normal)) : axis<D>(0);
    const double reach = size_a + length(pair.b.place.offset - origin) + 2 * size_b;

    Known known;
    known.distance = -least_overlap(pair, n);
    known.margin = 1e-5 * smaller + 16 * oracle::ulp(reach) + 1e-14 * detail::largest(origin);
    known.too_deep = depth_tolerance * smaller;
    known.sizes = size_a + size_b;
    const RoundSide<D> a{pair.a, origin}, b{pair.b, origin};
    Judge<D, RoundSide<D>, RoundSide<D>>(pair.a.view, pair.b.view, a, b, known, verdict).judge({});
}

/// Judges the pair of a family and seed; the coherent family has three pairs.
template <int D>
Verdict judged_pair(Family family, std::uint64_t seed) {
    Verdict verdict;
    if (family == Family::half_space) {
        judge_half_space<D>(half_space_pair<D>(Random(seed)), verdict);
    } else if (family == Family::round) {
        judge_round<D>(Random(seed), verdict);
    } else if (family == Family::coherent) {
        Cache cache;
        for (int step = 0; step < 3; ++step)
            judge_samples<D>(coherent_pair<D>(Random(seed), step), {.cache = &cache}, seed, verdict);
    } else {
        judge_samples<D>(sample_pair<D>(family, seed), {}, seed, verdict);
    }
    return verdict;
}

/// Makes one pair and runs all queries on it, to debug a failure.
inline Verdict check_corpus_pair(int dimension, Family family, std::uint64_t seed) {
    return dimension == 2 ? judged_pair<2>(family, seed) : judged_pair<3>(family, seed);
}

}  // namespace abut::corpus
