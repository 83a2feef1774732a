// Linear sweeps of one shape against another.

#include "linear.hpp"

#include "../narrow/narrow.hpp"
#include <abut/query/sweep.hpp>

#include <algorithm>

namespace abut::bench {

using namespace detail;

namespace {

/// Approximate minimum distance or maximum depth.
template <class A, class B>
float min_distance_along(const A& a, const Pose<dimension<A>>& pose, const Vec<dimension<A>>& motion, const B& there) {
    constexpr int moments = 64;
    float min_distance = std::numeric_limits<float>::infinity();
    for (int i = 0; i <= moments; ++i) {
        const Pose<dimension<A>> now{pose.position + motion * (static_cast<float>(i) / moments), pose.rotation};
        min_distance = std::min(min_distance, closest(scenes::placed(a, now), there).distance);
    }
    return min_distance;
}

/// Motions from outside to a point in or near the other shape and as far beyond it; grazing motions are left out.
template <class A, class B>
LinearScene<dimension<A>> linear_scene(const Kind<A>& kind_a, const Kind<B>& kind_b, std::size_t count = pair_count) {
    constexpr int D = dimension<A>;
    oracle::Random random(seed);
    const std::vector<A> all_a = drawn(kind_a, random);
    const std::vector<B> all_b = drawn(kind_b, random);
    LinearScene<D> scene;
    scene.pairs.shapes.assign(all_a.begin(), all_a.end());
    scene.pairs.shapes.insert(scene.pairs.shapes.end(), all_b.begin(), all_b.end());
    while (scene.motions.size() < count) {
        const std::size_t a = random.below(static_cast<std::uint32_t>(all_a.size()));
        const std::size_t b = random.below(static_cast<std::uint32_t>(all_b.size()));
        const Pose<D> pose_b{to_float<D>(random.in_cube<D>() * 10.0), random.rotation<D>()};
        const Pose<D> pose_a{pose_b.position + to_float<D>(random.direction<D>() * 5.0), random.rotation<D>()};
        const Vec<D> through = pose_b.position + to_float<D>(random.in_cube<D>() * 2.0);
        const Vec<D> motion = 2.0f * (through - pose_a.position);
        const auto there = scenes::placed(all_b[b], pose_b);
        if (closest(scenes::placed(all_a[a], pose_a), there).distance < 0.1f) continue;
        if (std::abs(min_distance_along(all_a[a], pose_a, motion, there)) < 0.05f) continue;
        scene.pairs.pairs.push_back({{a, pose_a}, {all_a.size() + b, pose_b}});
        scene.motions.push_back(motion);
    }
    return scene;
}

template <class A, class B>
Side abut_linear(const LinearScene<dimension<A>>& scene) {
    auto own = std::make_shared<const OwnPairs<A, B>>(scene.pairs);
    return {"abut", each_pair(std::move(own), [motions = scene.motions](const auto& pair, std::size_t place) {
                const auto hit = sweep(pair.first, motions[place], pair.second);
                return hit ? double{hit->distance} : no_touch;
            })};
}

// The peers stop slightly early, Box2D by 0.005 along the normal.

Job job(std::vector<Side> sides) {
    return {.items = pair_count, .values = pair_count, .tolerance = 0.05, .sides = std::move(sides)};
}

template <class A, class B>
Job in_space(const Kind<A>& kind_a, const Kind<B>& kind_b) {
    const LinearScene<3> scene = linear_scene(kind_a, kind_b);
    return job({abut_linear<A, B>(scene), straying(bullet_linear(scene), 0.1),
                straying(bullet_linear_by_simplex(scene), 0.2), straying(bullet_linear_by_gjk(scene), 0.4)});
}
Job boxes_in_space() {
    const LinearScene<3> scene = linear_scene(boxes<3>, boxes<3>);
    Job result = in_space(boxes<3>, boxes<3>);
    result.sides.push_back(straying(fcl_linear(scene), 0.15));
    return result;
}
template <class S>
Job in_plane(const Kind<S>& kind) {
    const LinearScene<2> scene = linear_scene(kind, kind);
    return job(
        {abut_linear<S, S>(scene), straying(box2d_linear(scene), 0.05), straying(box2d_linear_by_impact(scene), 0.05)});
}

}  // namespace

std::vector<Bench> motion_linear_benches() {
    return {
        {"motion/sweep/box-box", boxes_in_space},
        {"motion/sweep/capsule-box", [] { return in_space(capsules, boxes<3>); }},
        {"motion/sweep/sphere-box", [] { return in_space(spheres, boxes<3>); }},
        {"motion/sweep/capsule-capsule", [] { return in_space(capsules, capsules); }},
        {"motion/sweep/hull32", [] { return in_space(hulls<32>, hulls<32>); }},
        {"motion/sweep/hull256", [] { return in_space(hulls<256>, hulls<256>); }},
        {"motion/sweep/box2-box2", [] { return in_plane(boxes<2>); }},
        {"motion/sweep/polygon3-8", [] { return in_plane(polygons); }},
        {"motion/sweep/circle-circle", [] { return in_plane(circles); }},
    };
}

}  // namespace abut::bench
