// The answers for solids have the same bits on every machine.

#include "../../../scenes/bumpy_ball.hpp"
#include "../../oracle/simd_targets.hpp"
#include "../hash.hpp"
#include "solid_pairs.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>

#include <optional>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

std::uint64_t hash_of_solids() {
    oracle::Random random(20269);
    Hash hash;
    const Kit kit;
    for (int i = 0; i < 600; ++i) {
        const KitPair pair(kit, random);
        const auto a = placed(kit, pair.a);
        const Pose3 pose{pair.b.position, random.chance(0.5) ? random.rotation<3>() : glm::quat(1, 0, 0, 0)};
        const auto b = at(solid(kit.meshes[pair.b.piece]), pose);
        add_closest(hash, closest(a, b));
        add_contact(hash, contact(b, a));
    }
    const scenes::BumpyBall surface = scenes::bumpy_ball(12, 0.3, 0.01, random);
    const Mesh ball = *Mesh::build(surface.points, surface.triangles);
    for (int i = 0; i < 8; ++i) {
        const Vec3 place = detail::to_float(random.direction<3>() * random.uniform(0.5, 1.8));
        add_closest(hash, closest(solid(ball), at(solid(ball), Pose3{place, random.rotation<3>()})));
        add_closest(hash, closest(solid(ball), Sphere{place, 0.25f}));
        const Capsule3 capsule{place, place * 0.5f, 0.125f};
        add_closest(hash, closest(capsule, solid(ball)));
        add_closest(hash, closest(solid(ball), Cylinder{place, place * 0.25f, 0.25f}));
        each_contact(solid(ball), capsule, [&](const Contact<3>& contact) { add_contact(hash, contact); });
        const std::optional<Hit<3>> hits[]{raycast(Ray3::between(place * 0.25f, -place), solid(ball)),
                                           sweep(capsule, place, solid(ball)), sweep(solid(ball), place, capsule)};
        for (const std::optional<Hit<3>>& hit : hits) {
            hash.add(hit ? hit->distance : -1.0f);
            if (hit) hash.add<3>(hit->normal);
        }
    }
    return hash.value();
}

class SolidGolden : public oracle::BySimdTarget {};

TEST_P(SolidGolden, AnswersHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_solids(), 10270088742529420828u);
}

INSTANTIATE_TEST_SUITE_P(Targets, SolidGolden, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut::test
