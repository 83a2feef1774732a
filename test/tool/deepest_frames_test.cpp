// The deepest contacts of bodies that move, found without the depth at each frame.

#include "../oracle/random.hpp"
#include "scene_of.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace abut::tool {
namespace {

using oracle::Random;

constexpr int frames = 60;

std::vector<double> times() {
    std::vector<double> result;
    for (int i = 0; i < frames; ++i) result.push_back(i / 30.0);
    return result;
}

/// Moves a node through a place in the middle of the time, and turns it.
void add_tumble(Scene& scene, std::uint32_t node, Random& random, bool grows) {
    const glm::dvec3 middle(scene.nodes[node].local[3]);
    const auto number = [&] { return random.uniform(-1, 1); };
    const glm::dvec3 way(number(), number(), number()), axis = glm::normalize(glm::dvec3(number(), number(), 1));
    Animation animation;
    animation.motions.resize(1);
    animation.motions[0].node = node;
    for (const double time : times()) {
        NodeMotion& motion = animation.motions[0];
        motion.translation.times.push_back(time);
        motion.translation.values.push_back(middle + way * (time - 1));
        motion.rotation.times.push_back(time);
        motion.rotation.values.push_back(glm::angleAxis(2 * time, axis));
        if (!grows) continue;
        motion.scale.times.push_back(time);
        motion.scale.values.emplace_back(1, 1 + 0.2 * time, 1);
    }
    animation.length = times().back();
    scene.animations.push_back(std::move(animation));
    schedule(scene);
}

Scene tumbling_bodies(std::uint64_t seed, bool grow) {
    Random random(seed);
    Scene scene;
    for (int i = 0; i < 12; ++i) {
        const auto place = [&] { return random.uniform(-1.2, 1.2); };
        const glm::dvec3 at(place(), place(), place());
        const std::uint32_t node = test::add_body(scene, "Body " + std::to_string(i), at, i % 4 == 0, 0.6f);
        if (i % 3 != 0) add_tumble(scene, node, random, grow && i % 2 == 0);
    }
    return scene;
}

struct Expected {
    std::size_t first = 0, last = 0;
    float distance = std::numeric_limits<float>::infinity();
};

/// The contacts by the depths at all frames, by pair and first frame.
std::map<std::pair<Pair, std::size_t>, Expected> by_all_depths(const Scene& scene) {
    SceneObjects objects(scene);
    std::map<std::pair<Pair, std::size_t>, Expected> result;
    std::map<Pair, Expected> open;
    for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames); ++frame) {
        EXPECT_FALSE(objects.go_to(times()[frame]));
        for (std::uint32_t i = 0; i < objects.size(); ++i)
            for (std::uint32_t j = i + 1; j < objects.size(); ++j) {
                const Pair pair(i, j);
                const auto contact = pair_contact(ObjectAt<3>(objects[i]), ObjectAt<3>(objects[j]), {});
                if (!contact) {
                    open.erase(pair);
                    continue;
                }
                Expected& now = open.try_emplace(pair, Expected{frame, frame}).first->second;
                now.last = frame;
                now.distance = std::min(now.distance, contact->distance);
                result[{pair, now.first}] = now;
            }
    }
    return result;
}

void expect_the_deepest(const Scene& scene) {
    const auto expected = by_all_depths(scene);
    for (const std::size_t threads : {1u, 3u}) {
        SceneObjects objects(scene);
        ASSERT_FALSE(objects.go_to(0));
        CheckOptions options;
        options.threads = threads;
        const Result<CheckResult<3>> result = check<3>(objects, times(), options, [](std::size_t, std::size_t) {});
        ASSERT_TRUE(result);
        std::size_t count = 0;
        for (const ContactFinding<3>& found : result->findings) {
            if (found.between) continue;
            ++count;
            const auto known = expected.find({Pair(found.a, found.b), found.first});
            ASSERT_NE(known, expected.end()) << found.a << ' ' << found.b << ' ' << found.first;
            EXPECT_EQ(found.last, known->second.last);
            // To within a thousandth of the depth.
            EXPECT_GE(found.distance, known->second.distance);
            EXPECT_LE(found.distance, known->second.distance * 0.998f) << found.a << ' ' << found.b;
            EXPECT_GE(found.deepest, found.first);
            EXPECT_LE(found.deepest, found.last);
        }
        EXPECT_EQ(count, expected.size());
        EXPECT_EQ(result->left_out, 0u);
    }
}

TEST(DeepestFrames, AreThoseByAllDepths) {
    for (const std::uint64_t seed : {2911u, 2912u, 2913u}) {
        SCOPED_TRACE(seed);
        const Scene scene = tumbling_bodies(seed, false);
        EXPECT_GT(by_all_depths(scene).size(), 20u);
        expect_the_deepest(scene);
    }
}

TEST(DeepestFrames, OfBodiesThatChangeTheirShape) {
    constexpr std::uint64_t seed = 2914;
    SCOPED_TRACE(seed);
    expect_the_deepest(tumbling_bodies(seed, true));
}

}  // namespace
}  // namespace abut::tool
