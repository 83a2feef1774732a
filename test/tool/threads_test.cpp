// The same report with any number of threads.

#include "../oracle/random.hpp"
#include "scene_of.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::tool {
namespace {

using oracle::Random;

// Boxes and bodies that aren't convex that slide through one another.
Scene crowd(std::uint64_t seed) {
    Random random(seed);
    Scene scene;
    for (int i = 0; i < 40; ++i) {
        const auto place = [&] { return random.uniform(-3, 3); };
        const glm::dvec3 at(place(), place(), place());
        const std::uint32_t node = test::add_body(scene, "Body " + std::to_string(i), at, i % 5 < 3, 0.5f);
        if (i % 2 == 0) test::add_slide(scene, node, {place(), place(), place(), place()});
    }
    return scene;
}

CheckResult<3> check_with(const Scene& scene, float clearance, std::size_t threads) {
    SceneObjects objects(scene);
    const std::vector<double> times = key_times(scene);
    EXPECT_FALSE(objects.go_to(times.front()));
    CheckOptions options;
    options.limits.clearance = clearance;
    options.threads = threads;
    Result<CheckResult<3>> result = check<3>(objects, times, options, [](std::size_t, std::size_t) {});
    EXPECT_TRUE(result);
    return *std::move(result);
}

TEST(Threads, TheSameFindingsWithAnyNumber) {
    const Scene scene = crowd(29);
    for (const float clearance : {0.0f, 0.05f}) {
        const CheckResult<3> one = check_with(scene, clearance, 1);
        EXPECT_GT(one.findings.size(), 30u);
        EXPECT_TRUE(std::any_of(one.findings.begin(), one.findings.end(), [](const auto& f) { return f.between; }));
        for (const std::size_t threads : {2u, 3u, 8u}) {
            const CheckResult<3> many = check_with(scene, clearance, threads);
            EXPECT_EQ(many.tested, one.tested);
            EXPECT_EQ(many.swept, one.swept);
            ASSERT_EQ(many.findings.size(), one.findings.size());
            for (std::size_t i = 0; i < one.findings.size(); ++i) {
                const ContactFinding<3>&a = one.findings[i], &b = many.findings[i];
                EXPECT_EQ(
                    std::tie(a.a, a.b, a.first, a.last, a.deepest, a.distance, a.time, a.last_time, a.deepest_time),
                    std::tie(b.a, b.b, b.first, b.last, b.deepest, b.distance, b.time, b.last_time, b.deepest_time));
                EXPECT_EQ(a.normal, b.normal);
                EXPECT_EQ(a.points, b.points);
            }
        }
    }
}

}  // namespace
}  // namespace abut::tool
