// The fast GJK against the robust one, over easy and difficult hulls; with every SIMD target, to the last bit.

#include "../../oracle/pair.hpp"
#include "../../oracle/simd_targets.hpp"
#include "../hull/point_sets.hpp"
#include <abut/convex/gjk/gjk.hpp>
#include <abut/convex/gjk/gjk_fast.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/triangle.hpp>

#include <bit>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// Two hulls, or a hull and a box or a triangle, at a random distance; every third pair nearly touches.
struct HullPair {
    explicit HullPair(std::uint64_t seed) {
        Random random(seed);
        const double size = random.power_of_two(-10, 13);
        hull_a = hull_of(random, size);
        hull_b = hull_of(random, random.chance(0.8) ? size : random.power_of_two(-10, 13));
        const Pose3 pose_a{to_float<3>(random.in_cube<3>() * (10 * size)), random.rotation<3>()};
        Pose3 pose_b{pose_a.position, random.rotation<3>()};
        a = view(at(hull_a, pose_a));
        const std::uint32_t other = random.below(6);
        const auto place_b = [&] {
            if (other == 0)
                b = view(at(Box3{Vec3(0), Vec3(static_cast<float>(size)), no_rotation<3>}, pose_b));
            else if (other == 1)
                b = view(at(Triangle3{Vec3(0), hull_b.points().front(), hull_b.points().back()}, pose_b));
            else
                b = view(at(hull_b, pose_b));
        };
        place_b();
        const DVec<3> n = random.direction<3>();
        const double touching = dot(core_support(a, n).position - core_support(b, -n).position, n);
        const double gap = random.chance(0.34)
                               ? random.uniform(-1, 1) * random.power_of_two(-30, -2)
                               : random.uniform(-1, 1) * random.power_of_two(-2, random.chance(0.2) ? 8 : 1);
        pose_b.position += to_float<3>(n * (touching + gap * size));
        place_b();
    }

    static Polyhedron hull_of(Random& random, double size) {
        const test::Kind& kind = test::kinds[random.below(static_cast<std::uint32_t>(test::kinds.size()))];
        std::vector<Vec3> points = kind.make(random);
        for (Vec3& point : points) point *= static_cast<float>(size);
        return *Polyhedron::build(points);
    }

    Polyhedron hull_a, hull_b;
    Convex<3> a, b;
};

TEST(GjkFast, FindsTheDistanceOfGjk) {
    int found = 0, apart = 0;
    const int count = oracle::case_count(1000);
    for (int i = 0; i < count; ++i) {
        SCOPED_TRACE(i);
        const HullPair pair(static_cast<std::uint64_t>(i));
        const GjkResult<3> reference = gjk(CoreDifference<3>(pair.a, pair.b));
        if (reference.lower_bound > 1e-5 * size(pair.a)) ++apart;
        Cache inside, cache;
        SignedDistance<3> fast, again;
        if (!fast_distance(pair.a, pair.b, {.cache = &cache}, fast, inside)) continue;
        ++found;
        EXPECT_TRUE(reference.converged());
        const double tolerance = 1e-9 * (reference.upper_bound + size(pair.a) + size(pair.b));
        EXPECT_NEAR(fast.distance, reference.upper_bound, tolerance);
        // A slab between the two, as wide as the distance, is the proof.
        const double to_a = dot(support(pair.a, fast.normal) - fast.on_a, fast.normal);
        const double to_b = dot(support(pair.b, -fast.normal) - fast.on_b(), -fast.normal);
        EXPECT_LE(std::abs(to_a), tolerance);
        EXPECT_LE(std::abs(to_b), tolerance);
        ASSERT_TRUE(fast_distance(pair.a, pair.b, {.cache = &cache}, again, inside));
        EXPECT_NEAR(again.distance, fast.distance, 1e-12 * (fast.distance + size(pair.a)));
    }
    EXPECT_GT(apart, count / 3);
    EXPECT_GT(found, apart * 9 / 10);
}

TEST(GjkFast, DecidesOnlyWhatIsCertain) {
    int overlapping = 0, separated = 0;
    const int count = oracle::case_count(1000);
    for (int i = 0; i < count; ++i) {
        SCOPED_TRACE(i);
        const HullPair pair(static_cast<std::uint64_t>(i));
        const double distance = signed_distance(pair.a, pair.b).distance;
        Cache cache;
        for (int round = 0; round < 2; ++round) {
            const auto fast = fast_overlap(pair.a, pair.b, {.cache = &cache});
            if (!fast) continue;
            ++(*fast ? overlapping : separated);
            EXPECT_EQ(*fast, distance <= 0) << distance;
        }
    }
    EXPECT_GT(overlapping, count * 3 / 10);
    EXPECT_GT(separated, count * 3 / 10);
}

TEST(GjkFast, IsNoHarmFromTheCacheOfAnotherPair) {
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(i);
        const HullPair pair(static_cast<std::uint64_t>(i));
        Random random(static_cast<std::uint64_t>(i));
        Cache cache;
        cache.count = random.below(6);
        for (std::uint32_t& corner : cache.corner_a) corner = random.below(20);
        for (std::uint32_t& corner : cache.corner_b) corner = random.below(20);
        Cache inside, none;
        SignedDistance<3> with, without;
        if (!fast_distance(pair.a, pair.b, {.cache = &cache}, with, inside)) continue;
        if (!fast_distance(pair.a, pair.b, {}, without, none)) continue;
        EXPECT_NEAR(with.distance, without.distance, 2e-9 * without.distance);
    }
}

class GjkFastByTarget : public oracle::BySimdTarget {
protected:
    /// All answers of 200 pairs, bit by bit.
    static std::vector<std::uint64_t> bits() {
        std::vector<std::uint64_t> result;
        const auto note = [&](double number) { result.push_back(std::bit_cast<std::uint64_t>(number)); };
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const HullPair pair(seed);
            Cache cache, inside;
            SignedDistance<3> gap;
            if (fast_distance(pair.a, pair.b, {.cache = &cache}, gap, inside)) {
                note(gap.distance);
                for (int i = 0; i < 3; ++i) note(gap.normal[i]);
                for (int i = 0; i < 3; ++i) note(gap.on_a[i]);
            }
            for (const Cache& simplex : {cache, inside}) {
                result.push_back(simplex.count);
                result.insert(result.end(), simplex.corner_a.begin(), simplex.corner_a.end());
                result.insert(result.end(), simplex.corner_b.begin(), simplex.corner_b.end());
            }
        }
        return result;
    }
};

TEST_P(GjkFastByTarget, EndsInTheSameBits) {
    static const std::vector<std::uint64_t> first = bits();
    EXPECT_EQ(bits(), first);
}

INSTANTIATE_TEST_SUITE_P(Targets, GjkFastByTarget, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
