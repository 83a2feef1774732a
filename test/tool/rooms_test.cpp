// `abut check` in rooms of modular pieces: exactly the pairs that overlap, and no depth above what is possible.

#include "../oracle/is_long.hpp"
#include "../oracle/kit_pairs.hpp"
#include "scene_of.hpp"
#include "tool/check/check.hpp"
#include "tool/objects/scene_objects.hpp"
#include "tool_runs.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

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
        for (const ContactFinding<3>& finding : result->findings) found[{finding.a, finding.b}] = -finding.distance;
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

class RoomFiles : public test::ToolRuns {};

/// The room as a binary glTF file, with coordinates that are read back exactly.
std::string file_of(const Room& room) {
    test::GltfBuilder file;
    std::vector<int> meshes;
    for (const scenes::KitPiece& piece : room.pieces)
        meshes.push_back(file.add_mesh(piece.name, test::Triangles{piece.points, piece.triangles}));
    std::string nodes;
    for (std::size_t i = 0; i < room.placements.size(); ++i) {
        const scenes::KitPlacement& placement = room.placements[i];
        const Vec3& at = placement.position;
        std::array<char, 128> place;
        std::snprintf(place.data(), place.size(), ",\"mesh\":%d,\"translation\":[%.17g,%.17g,%.17g]",
                      meshes[placement.piece], static_cast<double>(at.x), static_cast<double>(at.y),
                      static_cast<double>(at.z));
        file.add_node(std::to_string(100 + i), place.data());
        nodes += (i == 0 ? "" : ",") + std::to_string(i);
    }
    file.add_text(",\"scenes\":[{\"nodes\":[" + nodes + "]}],\"scene\":0");
    return file.glb();
}

TEST_F(RoomFiles, TheToolTellsExactlyTheOverlaps) {
    const int rooms = oracle::is_long() ? 60 : 6;
    std::size_t overlapping = 0, touching = 0;
    for (int room_number = 0; room_number < rooms; ++room_number) {
        const std::uint64_t seed = 900 + static_cast<std::uint64_t>(room_number);
        SCOPED_TRACE(seed);
        const Room room(seed);
        const std::string file = write("room.glb", file_of(room)).string();
        const test::Json report = checked({file, "--allow", "0"}, 1);
        ASSERT_EQ(report.at("objects"), room.placements.size());
        std::map<std::pair<std::size_t, std::size_t>, double> found;
        for (const test::Json& contact : report.at("contacts")) {
            const auto number = [&](const char* key) { return std::stoul(contact.at(key).get<std::string>()) - 100; };
            found[std::minmax({number("a"), number("b")})] = -contact.at("distance").get<double>();
        }
        std::size_t expected = 0;
        for (std::size_t i = 0; i < room.placements.size(); ++i)
            for (std::size_t j = i + 1; j < room.placements.size(); ++j) {
                const auto reported = found.find({i, j});
                // Convex shapes are right to within the tolerance of distances.
                const double tolerance = room.are_convex(i, j) ? 5e-5 : 0;
                if (room.overlap(i, j)) {
                    ++expected;
                    ASSERT_TRUE(reported != found.end()) << i << " " << j;
                    EXPECT_LE(reported->second, room.box_depth(i, j) * (1 + 1e-6) + 1e-7 + tolerance) << i << " " << j;
                } else if (reported != found.end()) {
                    EXPECT_LE(reported->second, tolerance) << i << " " << j;
                    found.erase(reported);
                } else if (room.box_depth(i, j) >= 0) {
                    ++touching;
                }
            }
        EXPECT_EQ(found.size(), expected);
        overlapping += expected;
    }
    EXPECT_GT(overlapping, 10u * static_cast<std::size_t>(rooms));
    EXPECT_GT(touching, 10u * static_cast<std::size_t>(rooms));
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
        for (const ContactFinding<3>& finding : result->findings) EXPECT_NEAR(finding.distance, x - 3, 1e-6);
    }
}

}  // namespace
}  // namespace abut::tool
