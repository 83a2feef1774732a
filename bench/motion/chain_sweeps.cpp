// Linear sweeps of a circle and a box at a chain: rough ground of 2,000 segments.

#include "chain_sweeps.hpp"

#include "../../test/oracle/random.hpp"
#include <abut/query/sweep.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/placed.hpp>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::uint64_t seed = 1;
constexpr int segment_count = 2000;
constexpr std::size_t cast_count = 4096;

// Box2D's cast stops early by 0.005 along the normal, and its impact of a circle late by 0.015: at flat angles, more
// along the motion.
constexpr double tolerance = 0.1, few = 0.05;

/// Casts from 5 to 30 above the ground to a place on it up to 30 beside, and half as far again.
SharedChainSweeps chain_sweeps(const SweptShape2& shape) {
    oracle::Random random(seed);
    auto result = std::make_shared<ChainSweeps>();
    result->shape = shape;
    constexpr int half = segment_count / 2;
    for (int i = -half; i <= half; ++i)
        result->points.emplace_back(static_cast<float>(i), random.uniform_float(-0.5, 0.5));
    for (std::size_t i = 0; i < cast_count; ++i) {
        const float x = random.uniform_float(100 - half, half - 100), y = random.uniform_float(5, 30);
        const float aside = random.uniform_float(-30, 30), target = random.uniform_float(-0.5, 0.5);
        result->casts.push_back({{x, y}, 1.5f * Vec2(aside, target - y)});
    }
    return result;
}

Side abut_chain_sweeps(const SharedChainSweeps& scene) {
    return {"abut", [scene, chain = *Chain::build(scene->points, false)](std::span<double> values) {
                std::visit(
                    [&]<class S>(const S& swept) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const ChainCast& cast = scene->casts[i];
                            const auto hit = sweep(at(swept, Pose2{cast.from, {}}), cast.motion, chain);
                            values[i] = hit ? static_cast<double>(hit->distance) : -1.0;
                        }
                    },
                    scene->shape);
            }};
}

Job sweeps_at_chain(const SweptShape2& shape) {
    const SharedChainSweeps scene = chain_sweeps(shape);
    std::vector<Side> sides{abut_chain_sweeps(scene), box2d_chain_sweeps(scene), box2d_chain_sweeps_by_impact(scene)};
    for (std::size_t i = 1; i < sides.size(); ++i) sides[i].strays = few;
    return {.items = cast_count, .values = cast_count, .tolerance = tolerance, .sides = std::move(sides)};
}

}  // namespace

std::vector<Bench> chain_sweep_benches() {
    constexpr float radius = 0.25f;
    return {
        {"motion/sweep/chain/circle",
         [] {
             return sweeps_at_chain(Circle{Vec2(0), radius});
         }},
        {"motion/sweep/chain/box",
         [] {
             return sweeps_at_chain(Box2{Vec2(0), Vec2(radius)});
         }},
    };
}

}  // namespace abut::bench
