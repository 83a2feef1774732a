#pragma once

// Shared by the narrow phase benches: random scenes, and abut's sides.

#include "../../scenes/moving_pairs.hpp"
#include "../bench.hpp"
#include "../each_pair.hpp"
#include "../peers.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace abut::bench {

using scenes::Along;
using scenes::ConvexPairs;
using scenes::Gaps;

constexpr std::size_t pair_count = 1024;
/// Too many for branch prediction to memorise: for 1024 repeated pairs a processor learns each branch.
constexpr std::size_t many = 65536;
constexpr std::size_t hull_count = 32;  // count of distinct hulls on each side
constexpr std::uint64_t seed = 1;

/// Random shapes.
template <class S>
struct Kind {
    using Shape = S;
    S (*draw)(oracle::Random&);
    std::size_t count;
};
inline constexpr Kind<Sphere> spheres{scenes::random_ball<3>, pair_count};
inline constexpr Kind<Capsule3> capsules{scenes::random_capsule, pair_count};
template <int D>
inline constexpr Kind<Box<D>> boxes{scenes::random_box<D>, pair_count};
template <std::size_t Corners>
inline constexpr Kind<Polyhedron> hulls{[](oracle::Random& random) { return scenes::random_hull(random, Corners); },
                                        hull_count};

inline constexpr Kind<Circle> circles{scenes::random_ball<2>, pair_count};
inline constexpr Kind<Polygon> polygons{
    // of 3 to 8 vertices
    [](oracle::Random& random) { return scenes::random_polygon(random, 3 + random.below(6)); }, pair_count};

template <class S>
std::vector<S> drawn(const Kind<S>& kind, oracle::Random& random) {
    std::vector<S> result;
    while (result.size() < kind.count) result.push_back(kind.draw(random));
    return result;
}

template <class A, class B>
ConvexPairs<dimension<A>> resting(const Kind<A>& a, const Kind<B>& b, const Gaps& gaps,
                                  std::size_t count = pair_count) {
    oracle::Random random(seed);
    std::vector<A> all_a = drawn(a, random);
    std::vector<B> all_b = drawn(b, random);
    scenes::PairMaker<dimension<A>, A, B> maker(std::move(all_a), std::move(all_b), random);
    return scenes::resting_pairs(maker, count, gaps);
}

/// The distances of pairs midway, and their range over all frames.
struct Course {
    Gaps midway, always;
    Along along = Along::any;
};
inline constexpr Course always_apart{{0.3, 1}, {0.01, 2}};
inline constexpr Course touching{{-0.25, -0.05}, {-0.4, -0.005, 0.001}, Along::surface};
inline constexpr Course mostly_apart{{-0.05, 0.3}, {-0.3, 0.6, 0.001}};  // about 10 % touch at any time

template <class A, class B>
ConvexPairs<dimension<A>> moving(const Kind<A>& a, const Kind<B>& b, const Course& course) {
    oracle::Random random(seed);
    std::vector<A> all_a = drawn(a, random);
    std::vector<B> all_b = drawn(b, random);
    scenes::PairMaker<dimension<A>, A, B> maker(std::move(all_a), std::move(all_b), random);
    return scenes::moving_pairs(maker, pair_count, course.midway, course.always, course.along, random);
}

template <class S>
using PlacedShape = decltype(scenes::placed(std::declval<const S&>(), Pose<dimension<S>>()));

/// The pairs of a scene in their static types A and B, as a game holds them.
template <class A, class B>
struct OwnPairs {
    explicit OwnPairs(const ConvexPairs<dimension<A>>& from) : scene(from) {
        for (const auto& [a, b] : scene.pairs) pairs.emplace_back(own<A>(a), own<B>(b));
    }
    template <class S>
    PlacedShape<S> own(const scenes::Placed<dimension<S>>& item) const {
        return scenes::placed(std::get<S>(scene.shapes[item.shape]), item.pose);
    }

    ConvexPairs<dimension<A>> scene;
    std::vector<std::pair<PlacedShape<A>, PlacedShape<B>>> pairs;
};

/// Runs question(a, b, options); coherent frames have a cache per pair.
template <class A, class B, class Question>
Side abut_side(const ConvexPairs<dimension<A>>& scene, Question question) {
    auto own = std::make_shared<const OwnPairs<A, B>>(scene);
    if (scene.frames == 1)
        return {"abut", each_pair(std::move(own), [question](const auto& pair, std::size_t) mutable {
                    return question(pair.first, pair.second, QueryOptions<dimension<A>>());
                })};
    return {"abut", each_pair(std::move(own), [question, caches = std::vector<Cache>(scene.count())](
                                                  const auto& pair, std::size_t place) mutable {
                return question(pair.first, pair.second, QueryOptions<dimension<A>>{.cache = &caches[place]});
            })};
}

template <class A, class B>
Side abut_closest(const ConvexPairs<dimension<A>>& scene) {
    return abut_side<A, B>(scene, [](const auto& a, const auto& b, const auto& options) -> double {
        return closest(a, b, options).distance;
    });
}
template <class A, class B>
Side abut_overlaps(const ConvexPairs<dimension<A>>& scene) {
    return abut_side<A, B>(scene, [](const auto& a, const auto& b, const auto& options) -> double {
        return overlaps(a, b, options) ? 1 : 0;
    });
}
template <class A, class B>
Side abut_contact(const ConvexPairs<dimension<A>>& scene) {
    return abut_side<A, B>(scene, [](const auto& a, const auto& b, const auto& options) -> double {
        const auto found = contact(a, b, options);
        return found ? found.depth : -1;
    });
}

/// A peer with a known fraction of wrong values.
inline Side straying(Side side, double share) {
    side.strays = share;
    return side;
}

template <int D>
Job job(const ConvexPairs<D>& scene, std::vector<Side> sides) {
    return {.items = scene.count(), .values = scene.count(), .rounds = scene.frames, .sides = std::move(sides)};
}

std::vector<Bench> closest_benches();
std::vector<Bench> overlaps_benches();
std::vector<Bench> contact_benches();
std::vector<Bench> plane_benches();
std::vector<Bench> raycast_benches();
std::vector<Bench> solid_benches();

}  // namespace abut::bench
