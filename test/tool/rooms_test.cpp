// `abut check` in rooms of modular pieces: exactly the pairs that overlap, and no depth above what is possible.

#include "../oracle/is_long.hpp"
#include "../oracle/kit_pairs.hpp"
#include "scene_of.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace abut::tool {
namespace {

struct Room {
    std::vector<scenes::KitPiece> pieces = scenes::kit();
    std::vector<scenes::KitPlacement> placements;
    Scene scene;

    explicit Room(std::uint64_t seed) : placements(scenes::kit_room(seed, pieces)) {
        for (std::size_t i = 0; i < placements.size(); ++i) {
            const scenes::KitPiece& piece = pieces[placements[i].piece];
            // Names of three digits, so that objects sorted by path keep their order.
            test::add_object(scene, std::to_string(100 + i), {piece.points, piece.triangles},
                             glm::translate(glm::dmat4(1.0), glm::dvec3(placements[i].position)));
        }
    }
    bool overlap(std::size_t i, std::size_t j) const {
        return oracle::interiors_overlap(piece(i), placements[i].position, piece(j), placements[j].position);
    }
    /// How far the boxes of two pieces overlap along the best axis: a move that parts them.
    double box_depth(std::size_t i, std::size_t j) const {
        double least = 1e9;
        for (int k = 0; k < 3; ++k) {
            const auto [low_a, high_a] = range(i, k);
            const auto [low_b, high_b] = range(j, k);
            least = std::min({least, high_a - low_b, high_b - low_a});
        }
        return least;
    }
    bool are_convex(std::size_t i, std::size_t j) const {
        return piece(i).parts.size() == 1 && piece(j).parts.size() == 1;
    }

private:
    const scenes::KitPiece& piece(std::size_t i) const { return pieces[placements[i].piece]; }
    /// The extent of a piece along an axis, exactly.
    std::pair<double, double> range(std::size_t i, int k) const {
        double low = 1e9, high = -1e9;
        for (const Vec3& p : piece(i).points) {
            const double place = static_cast<double>(p[k]) + static_cast<double>(placements[i].position[k]);
            low = std::min(low, place);
            high = std::max(high, place);
        }
        return {low, high};
    }
};

TEST(Rooms, ExactlyTheOverlapsAreFound) {
    const int rooms = oracle::is_long() ? 200 : 12;
    int overlapping = 0;
    for (int room_number = 0; room_number < rooms; ++room_number) {
        const std::uint64_t seed = 500 + static_cast<std::uint64_t>(room_number);
        SCOPED_TRACE(seed);
        const Room room(seed);
        SceneObjects objects(room.scene);
        EXPECT_FALSE(objects.go_to(0));
        ASSERT_EQ(objects.size(), room.placements.size());
        Result<CheckResult<3>> result =
            check<3>(objects, {0.0}, {.limits = {.allow = 0.0f}}, [](std::size_t, std::size_t) {});
        ASSERT_TRUE(result);
        std::map<std::pair<std::size_t, std::size_t>, float> found;
        for (const Finding<3>& finding : result->findings) found[{finding.a, finding.b}] = -finding.distance;
        for (std::size_t i = 0; i < objects.size(); ++i)
            for (std::size_t j = i + 1; j < objects.size(); ++j) {
                SCOPED_TRACE(objects[i].path + " " + objects[j].path);
                const bool expected = room.overlap(i, j);
                const auto reported = found.find({i, j});
                // Convex shapes are right to within the tolerance of distances.
                const float tolerance =
                    room.are_convex(i, j) ? 1e-5f * std::max(objects[i].radius, objects[j].radius) : 0;
                if (!expected) {
                    EXPECT_TRUE(reported == found.end() || reported->second <= tolerance);
                    continue;
                }
                ++overlapping;
                ASSERT_TRUE(reported != found.end());
                EXPECT_LE(reported->second, room.box_depth(i, j) * (1 + 1e-6) + 1e-7 + static_cast<double>(tolerance));
            }
    }
    EXPECT_GT(overlapping, 10 * rooms);
}

TEST(Rooms, FlushTPrismsAreFound) {
    // Each of these was CLEAN: every crossing is an edge in a face, so each pair of triangles is 0 deep.
    const scenes::KitPiece t = scenes::kit()[0];
    for (const double x : {3.0, 2.9, 2.8, 2.5, 2.1}) {
        Scene scene;
        test::add_object(scene, "a", {t.points, t.triangles});
        test::add_object(scene, "b", {t.points, t.triangles}, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0, 0)));
        SceneObjects objects(scene);
        EXPECT_FALSE(objects.go_to(0));
        const Result<CheckResult<3>> result = check<3>(objects, {0.0}, {}, [](std::size_t, std::size_t) {});
        ASSERT_TRUE(result);
        ASSERT_EQ(result->findings.size(), x < 3 ? 1u : 0u) << x;
        for (const Finding<3>& finding : result->findings) EXPECT_NEAR(finding.distance, x - 3, 1e-6);
    }
}

}  // namespace
}  // namespace abut::tool
