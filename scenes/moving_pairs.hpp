#pragma once

// Pairs of convex shapes over many frames: each moves slightly per frame, back and forth.

#include "convex_pairs.hpp"

#include <algorithm>
#include <cstdlib>

#include <glm/geometric.hpp>

namespace abut::scenes {

inline constexpr std::size_t moving_frames = 64;
inline constexpr float turn_per_frame = 0.01f;

/// The motion of B per frame.
template <int D>
struct Step {
    Vec<D> move;
    Vec<D> axis;  ///< unit rotation axis; in 2D the sign of its first coordinate is the direction
};

inline Rotation<2> turned(const Vec2& axis, float radians) {
    return Turn::by(axis.x > 0 ? radians : -radians);
}
inline Rotation<3> turned(const Vec3& axis, float radians) {
    return turn_about(axis, radians);
}

/// The pair in each frame. At the middle of its oscillation it is as given; the phase determines that frame.
template <int D>
std::vector<PlacedPair<D>> swung(const PlacedPair<D>& midway, const Step<D>& step, std::size_t phase) {
    constexpr int half = moving_frames / 2;
    std::vector<PlacedPair<D>> result;
    for (std::size_t frame = 0; frame < moving_frames; ++frame) {
        const int direction = static_cast<int>((frame + phase) % moving_frames) - half;
        const float steps = static_cast<float>(std::abs(direction) - half / 2);
        const Pose<D> turn{Vec<D>(0), turned(step.axis, steps * turn_per_frame)};
        Pose<D>& pose = result.emplace_back(midway).b.pose;
        pose = {pose.position + steps * step.move, (turn * Pose<D>{Vec<D>(0), pose.rotation}).rotation};
    }
    return result;
}

/// Converts the pairs' own frames to those of the scene.
template <int D>
void interleave(const std::vector<std::vector<PlacedPair<D>>>& of_pairs, ConvexPairs<D>& scene) {
    scene.frames = moving_frames;
    for (std::size_t frame = 0; frame < moving_frames; ++frame)
        for (const std::vector<PlacedPair<D>>& pair : of_pairs) scene.pairs.push_back(pair[frame]);
}

enum class Along { any, surface };  ///< direction of motion: any, or perpendicular to the line of closest approach

/// Pairs with a distance from `midway` at the middle of the oscillation, and from `always` in all frames. They move
/// 0.01 to 0.02 per frame.
template <int D, class A, class B>
ConvexPairs<D> moving_pairs(PairMaker<D, A, B>& maker, std::size_t count, const Gaps& midway, const Gaps& always,
                            Along along, oracle::Random& random) {
    std::vector<std::vector<PlacedPair<D>>> found;
    while (found.size() < count) {
        const PlacedPair<D> middle = maker.make(midway);
        Vec<D> direction = detail::to_float<D>(random.direction<D>());
        if (along == Along::surface) {
            const Vec<D> normal = maker.closest(middle).normal;
            direction = glm::normalize(direction - glm::dot(direction, normal) * normal);
        }
        const Step<D> step{random.uniform_float(0.01, 0.02) * direction, detail::to_float<D>(random.direction<D>())};
        const std::vector<PlacedPair<D>> pair = swung(middle, step, random.below(moving_frames));
        if (std::ranges::all_of(pair, [&](const auto& at) { return always.allow(maker.closest(at).distance); }))
            found.push_back(pair);
    }
    ConvexPairs<D> result{.shapes = maker.shapes(), .pairs = {}};
    interleave(found, result);
    return result;
}

struct StackedBoxes {
    Box3 below, above;
    PlacedPair<3> pair;
};

/// B rests on a face of A, rotated about its normal, with a depth of 0.01 to 0.03.
inline StackedBoxes stacked_boxes(std::size_t number, oracle::Random& random) {
    const Box3 below = random_box<3>(random), above = random_box<3>(random);
    const Pose3 pose{detail::to_float<3>(random.in_cube<3>() * 10.0), random.rotation<3>()};
    const Vec3 offset{random.uniform_float(-0.2, 0.2), below.half.y + above.half.y - random.uniform_float(0.01, 0.03),
                      random.uniform_float(-0.2, 0.2)};
    const glm::quat about_normal = turn_about({0, 1, 0}, random.uniform_float(0, 6.28));
    return {below, above, {{2 * number, pose}, {2 * number + 1, pose * Pose3{offset, about_normal}}}};
}

inline ConvexPairs<3> resting_stacks(std::size_t count, oracle::Random& random) {
    ConvexPairs<3> result;
    for (std::size_t i = 0; i < count; ++i) {
        const StackedBoxes stack = stacked_boxes(i, random);
        result.shapes.insert(result.shapes.end(), {stack.below, stack.above});
        result.pairs.push_back(stack.pair);
    }
    return result;
}

/// Boxes that slide on one another and don't fall off.
inline ConvexPairs<3> sliding_stacks(std::size_t count, oracle::Random& random) {
    ConvexPairs<3> result;
    std::vector<std::vector<PlacedPair<3>>> found;
    while (found.size() < count) {
        const StackedBoxes stack = stacked_boxes(found.size(), random);
        const Rotation<3>& rotation = stack.pair.a.pose.rotation;
        const Vec2 direction = random.uniform_float(0.01, 0.02) * detail::to_float<2>(random.direction<2>());
        const Step<3> step{rotate(rotation, {direction.x, 0, direction.y}), rotate(rotation, {0, 1, 0})};
        const std::vector<PlacedPair<3>> pair = swung(stack.pair, step, random.below(moving_frames));
        const auto lies = [&](const PlacedPair<3>& at) {
            const float gap = closest(placed(stack.below, at.a.pose), placed(stack.above, at.b.pose)).distance;
            return -0.04f < gap && gap < -0.009f;
        };
        if (!std::ranges::all_of(pair, lies)) continue;
        result.shapes.insert(result.shapes.end(), {stack.below, stack.above});
        found.push_back(pair);
    }
    interleave(found, result);
    return result;
}

}  // namespace abut::scenes
