// Meshes with deliberate faults, and their repairs.

#include "../../scenes/solid_meshes.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/repair.hpp>
#include <abut/bake/solid.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using scenes::SolidMesh;

SolidMesh box_between(const Vec3& low, const Vec3& high) {
    SolidMesh result;
    for (int i = 0; i < 8; ++i)
        result.points.push_back(
            {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
    result.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return result;
}

/// Each triangle with separate corners, in any order.
SolidMesh soup(const SolidMesh& mesh, Random& random) {
    std::vector<std::uint32_t> order(mesh.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        const std::uint32_t other = random.below(i + 1);
        order[i] = order[other];
        order[other] = i;
    }
    SolidMesh result;
    for (const std::uint32_t i : order) {
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (int k = 0; k < 3; ++k) result.points.push_back(mesh.points[mesh.triangles[i][k]]);
        const std::uint32_t turn = random.below(3);
        result.triangles.emplace_back(first + turn, first + (turn + 1) % 3, first + (turn + 2) % 3);
    }
    return result;
}

std::size_t turn_some(SolidMesh& mesh, double share, Random& random) {
    std::size_t turned = 0;
    for (glm::uvec3& t : mesh.triangles)
        if (random.chance(share)) {
            std::swap(t.x, t.y);
            ++turned;
        }
    return turned;
}

Repaired repaired(const SolidMesh& mesh, const RepairOptions& options = {}) {
    Result<Repaired> result = repair(mesh.points, mesh.triangles, options);
    EXPECT_TRUE(result) << (result ? "" : result.problem().message);
    return result ? *result : Repaired{};
}

double volume(const Repaired& mesh) {
    return signed_volume(mesh.points, mesh.triangles);
}
double volume(const SolidMesh& mesh) {
    return signed_volume(mesh.points, mesh.triangles);
}

TEST(Repair, LeavesWhatIsGoodAsItIs) {
    SolidMesh tube = scenes::knotted_tube(60, 12);
    const Repaired result = repaired(tube);
    EXPECT_TRUE(result.closed);
    EXPECT_FALSE(changed(result.repairs));
    EXPECT_EQ(described(result.repairs), "nothing to repair");
    EXPECT_EQ(result.triangles.size(), tube.triangles.size());
    EXPECT_EQ(volume(result), volume(tube));
    const Repaired again = *repair(result.points, result.triangles);
    EXPECT_EQ(again.points, result.points);
    EXPECT_EQ(again.triangles, result.triangles);
}

TEST(Repair, MakesASurfaceOfASoup) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const SolidMesh whole = seed % 2 == 0 ? scenes::house() : scenes::knotted_tube(40, 8);
        SolidMesh broken = soup(whole, random);
        const std::size_t turned = turn_some(broken, 0.3, random);
        std::size_t doubles = 0, lines = 0;
        for (std::size_t i = 0; i < whole.triangles.size(); i += 1 + random.below(9)) {
            broken.triangles.push_back(broken.triangles[i]);
            ++doubles;
        }
        for (std::uint32_t i = 0; i < 7; ++i) {
            const std::uint32_t corner = random.below(static_cast<std::uint32_t>(broken.points.size()));
            broken.triangles.emplace_back(corner, corner, random.below(9));
            ++lines;
        }
        const Repaired result = repaired(broken);
        EXPECT_TRUE(result.closed) << described(result.repairs);
        EXPECT_NEAR(volume(result), volume(whole), 1e-9 * volume(whole));
        EXPECT_EQ(result.triangles.size(), whole.triangles.size());
        EXPECT_EQ(result.repairs.triangles_double, doubles);
        EXPECT_EQ(result.repairs.triangles_lost, lines);
        EXPECT_EQ(result.repairs.triangles_turned, turned);
        EXPECT_TRUE(changed(result.repairs));
        EXPECT_GT(result.repairs.points_joined, 0u);
        EXPECT_EQ(result.repairs.points_welded, 0u);
    }
}

TEST(Repair, WeldsWithinADistance) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const SolidMesh whole = scenes::house();
        SolidMesh broken = soup(whole, random);
        for (Vec3& point : broken.points) point += to_float(random.in_cube<3>() * 1e-3);
        EXPECT_FALSE(repaired(broken).closed);
        const Repaired result = repaired(broken, {.weld_distance = 0.02});
        EXPECT_TRUE(result.closed) << described(result.repairs);
        EXPECT_NEAR(volume(result), volume(whole), 0.01 * volume(whole));
        EXPECT_GT(result.repairs.points_welded, 0u);
        EXPECT_EQ(result.triangles.size(), whole.triangles.size());
    }
}

TEST(Repair, FacesOutwards) {
    const SolidMesh house = scenes::house();
    EXPECT_EQ(volume(repaired(inside_out(house))), volume(house));
    EXPECT_EQ(volume(repaired(inside_out(house), {.face_outwards = false})), -volume(house)) << "a room";
    // Boxes that share an edge with four triangles, one of the two inside out.
    SolidMesh two = box_between({0, 0, 0}, {1, 1, 1});
    add(two, inside_out(box_between({1, 1, 0}, {2, 2, 1})));
    const Repaired result = repaired(two);
    EXPECT_DOUBLE_EQ(volume(result), 2);
    EXPECT_EQ(result.repairs.triangles_turned, 12u);
    EXPECT_EQ(result.repairs.non_manifold_edges, 1u);
    EXPECT_TRUE(result.closed);
}

TEST(Repair, TellsCavitiesFromSolids) {
    const SolidMesh outer = box_between({0, 0, 0}, {4, 4, 4}), inner = box_between({1, 1, 1}, {3, 3, 3}),
                    core = box_between({1.5f, 1.5f, 1.5f}, {2, 2, 2});
    const auto both = [](SolidMesh a, const SolidMesh& b) {
        add(a, b);
        return a;
    };
    const SolidMesh hollow = both(outer, inside_out(inner)), solids = both(outer, inner);
    for (const SolidMesh& mesh : {hollow, inside_out(hollow)}) {
        const Repaired result = repaired(mesh);
        EXPECT_DOUBLE_EQ(volume(result), 64 - 8);
        EXPECT_EQ(result.repairs.cavities, 1u);
    }
    for (const SolidMesh& mesh : {solids, inside_out(solids)}) {
        const Repaired result = repaired(mesh);
        EXPECT_DOUBLE_EQ(volume(result), 64 + 8);
        EXPECT_EQ(result.repairs.cavities, 0u);
    }
    EXPECT_DOUBLE_EQ(volume(repaired(both(hollow, core))), 64 - 8 + 0.125);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        SolidMesh mixed = soup(both(solids, core), random);
        turn_some(mixed, 0.5, random);
        const Repaired result = repaired(mixed);
        EXPECT_DOUBLE_EQ(volume(result), 64 - 8 + 0.125) << "all mixed up: in turns";
        EXPECT_TRUE(result.closed);
    }
    // Boxes that cross are no cavities.
    EXPECT_DOUBLE_EQ(volume(repaired(both(outer, inside_out(box_between({3, 1, 1}, {5, 2, 2}))))), 64 + 2);
}

TEST(Repair, LeavesRoomsAroundThings) {
    SolidMesh level = inside_out(box_between({0, 0, 0}, {9, 9, 9}));
    add(level, box_between({1, 1, 1}, {2, 2, 2}));
    add(level, box_between({4, 4, 4}, {6, 6, 6}));
    add(level, inside_out(box_between({4.5f, 4.5f, 4.5f}, {5, 5, 5})));
    const Repaired result = repaired(level);
    EXPECT_FALSE(changed(result.repairs));
    EXPECT_EQ(result.repairs.rooms, 1u);
    EXPECT_EQ(result.repairs.cavities, 1u);
    EXPECT_DOUBLE_EQ(volume(result), -729 + 1 + 8 - 0.125);
}

TEST(Repair, FillsSmallHolesAlone) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const scenes::BumpyBall ball = scenes::bumpy_ball(16, 0.1, 0.01, random);
        SolidMesh broken{ball.points, ball.triangles};
        const double whole = volume(broken);
        for (int i = 0; i < 6; ++i)
            broken.triangles.erase(broken.triangles.begin() +
                                   random.below(static_cast<std::uint32_t>(broken.triangles.size())));
        EXPECT_FALSE(repaired(broken, {.hole_edges = 0}).closed);
        const Repaired result = repaired(broken);
        EXPECT_TRUE(result.closed) << described(result.repairs);
        EXPECT_GE(result.repairs.holes_filled, 1u);
        EXPECT_EQ(result.repairs.triangles_added, 6u) << "loops of as many edges as there were";
        EXPECT_NEAR(volume(result), whole, 0.01 * whole);
        EXPECT_EQ(edge_faults(result.triangles).non_manifold, 0u);
    }
}

TEST(Repair, LeavesMouthsAndSheetsOpen) {
    SolidMesh crate = box_between({0, 0, 0}, {1, 1, 1});
    crate.triangles.erase(crate.triangles.begin() + 2, crate.triangles.begin() + 4);
    EXPECT_EQ(repaired(crate).repairs.open_edges, 4u);
    EXPECT_EQ(described(repaired(crate).repairs), "nothing to repair; 4 open edges left");
    const Repaired lid = repaired(crate, {.hole_area = 0.25});
    EXPECT_TRUE(lid.closed);
    EXPECT_DOUBLE_EQ(volume(lid), 1);
    EXPECT_EQ(described(lid.repairs), "1 hole filled");
    EXPECT_EQ(repaired(crate, {.hole_edges = 3, .hole_area = 0.25}).repairs.holes_filled, 0u);

    const SolidMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(repaired(sheet).triangles, sheet.triangles);
    // Seen from both sides it is one sheet.
    SolidMesh both = sheet;
    add(both, inside_out(sheet));
    EXPECT_EQ(repaired(both).triangles, sheet.triangles);
    EXPECT_EQ(repaired(both).repairs.triangles_double, 2u);
}

TEST(Repair, FillsAFlatHoleWithoutFolds) {
    // A plate with a star-shaped hole in its middle: the new triangles cover exactly the star.
    SolidMesh plate;
    constexpr std::uint32_t count = 16;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> at = scenes::on_circle(4.0 * i / count);
        plate.points.push_back(to_float(DVec<3>(at.x, at.y, 0) * 10.0));
        plate.points.push_back(to_float(DVec<3>(at.x, at.y, 0) * (i % 2 == 0 ? 0.5 : 2.0)));
    }
    double star = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
        plate.triangles.insert(plate.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
        star += cross(DVec<2>(plate.points[a + 1]), DVec<2>(plate.points[b + 1])) / 2;
    }
    const Repaired result = repaired(plate);
    ASSERT_EQ(result.repairs.holes_filled, 1u);
    EXPECT_EQ(result.repairs.open_edges, count) << "the rim";
    double added = 0;
    for (std::size_t i = plate.triangles.size(); i < result.triangles.size(); ++i) {
        const glm::uvec3& t = result.triangles[i];
        const DVec<2> a(result.points[t.x]), b(result.points[t.y]), c(result.points[t.z]);
        EXPECT_GT(cross(b - a, c - a), 0) << i;
        added += cross(b - a, c - a) / 2;
    }
    EXPECT_NEAR(added, star, 1e-5);
}

TEST(Repair, ClosesCracksWhereACornerLiesOnAnEdge) {
    // The edge from corner 0 to corner 1 is cut in four on one side only.
    SolidMesh cracked = box_between({0, 0, 0}, {4, 4, 4});
    const auto replaced = std::find(cracked.triangles.begin(), cracked.triangles.end(), glm::uvec3(0, 1, 5));
    ASSERT_NE(replaced, cracked.triangles.end());
    cracked.triangles.erase(replaced);
    const auto first = static_cast<std::uint32_t>(cracked.points.size());
    for (const float x : {1.0f, 2.0f, 3.0f}) cracked.points.push_back({x, 0, 0});
    cracked.triangles.insert(cracked.triangles.end(),
                             {{0, first, 5}, {first, first + 1, 5}, {first + 1, first + 2, 5}, {first + 2, 1, 5}});
    const Repaired result = repaired(cracked, {.hole_area = 0});
    EXPECT_TRUE(result.closed) << described(result.repairs);
    EXPECT_DOUBLE_EQ(volume(result), 64);
    EXPECT_EQ(result.repairs.holes_filled, 1u);
    EXPECT_EQ(edge_faults(result.triangles).non_manifold, 0u);
}

TEST(Repair, CutsTheNeighboursOfTrianglesWithoutArea) {
    SolidMesh mesh = box_between({0, 0, 0}, {4, 4, 4});
    *std::find(mesh.triangles.begin(), mesh.triangles.end(), glm::uvec3(0, 1, 5)) = {0, 8, 5};
    mesh.points.push_back({1, 0, 0});
    mesh.triangles.insert(mesh.triangles.end(), {{8, 1, 5}, {0, 1, 8}});
    EXPECT_TRUE(edge_faults(mesh.triangles).closed);
    const Repaired result = repaired(mesh, {.hole_edges = 0});
    EXPECT_TRUE(result.closed);
    EXPECT_EQ(result.repairs.triangles_lost, 1u);
    EXPECT_EQ(result.triangles.size(), 14u);
    EXPECT_DOUBLE_EQ(volume(result), 64);
}

TEST(Repair, WallsBetweenBoxesGo) {
    SolidMesh two = box_between({0, 0, 0}, {1, 1, 1});
    add(two, box_between({1, 0, 0}, {2, 1, 1}));
    std::swap(two.triangles[10], two.triangles[22]);
    const Repaired result = repaired(two);
    // The wall's diagonals differ between the two, so that it consists of four triangles without duplicates.
    EXPECT_DOUBLE_EQ(volume(result), 2);
    SolidMesh consistent = box_between({0, 0, 0}, {1, 1, 1});
    SolidMesh right = box_between({1, 0, 0}, {2, 1, 1});
    right.triangles.erase(right.triangles.begin() + 8, right.triangles.begin() + 10);
    add(consistent, right);
    const auto wall = consistent.triangles;
    consistent.triangles.insert(consistent.triangles.end(), {{1, 7, 3}, {1, 5, 7}});
    const Repaired merged = repaired(consistent);
    EXPECT_EQ(merged.repairs.triangles_double, 4u);
    EXPECT_TRUE(merged.closed);
    EXPECT_EQ(merged.repairs.non_manifold_edges, 0u);
    EXPECT_EQ(merged.triangles.size(), 20u);
    EXPECT_DOUBLE_EQ(volume(merged), 2);
}

TEST(Repair, FinsOfTwoSidesStayOnce) {
    // At an edge of the box_between, which is closed without it.
    SolidMesh fin = box_between({0, 0, 0}, {1, 1, 1});
    add(fin, {{{1, 1, 0}, {2, 2, 0}, {2, 2, 1}, {1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}}});
    const Repaired result = repaired(fin);
    EXPECT_EQ(result.repairs.triangles_double, 2u);
    EXPECT_EQ(result.triangles.size(), 14u);
    EXPECT_EQ(result.repairs.open_edges, 3u);
    EXPECT_EQ(result.repairs.non_manifold_edges, 1u);
}

TEST(Repair, HolesGetNoEdgeThatIsThere) {
    for (const bool other_diagonal : {false, true}) {
        SolidMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
        if (other_diagonal) sheet.triangles = {{0, 1, 3}, {1, 2, 3}};
        const Repaired result = repaired(sheet, {.hole_area = 1});
        EXPECT_TRUE(result.closed);
        EXPECT_EQ(result.repairs.non_manifold_edges, 0u) << described(result.repairs);
        EXPECT_EQ(result.triangles.size(), 4u);
    }
}

TEST(Repair, OfATwoSidedSolidOneSideStays) {
    SolidMesh both = box_between({0, 0, 0}, {1, 2, 3});
    add(both, inside_out(both));
    const Repaired result = repaired(both);
    EXPECT_EQ(result.triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(volume(result), 6);
}

TEST(Repair, TellsWhatCantAgree) {
    // A strip of eight squares with half a turn.
    SolidMesh strip;
    constexpr std::uint32_t count = 8;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> around = scenes::on_circle(4.0 * i / count), half = scenes::on_circle(2.0 * i / count);
        const DVec<3> out(around.x, around.y, 0), across = out * half.x + axis<3>(2) * half.y;
        strip.points.push_back(to_float(out * 3.0 + across));
        strip.points.push_back(to_float(out * 3.0 - across));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool last = i + 1 == count;
        const std::uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 0 : a + 3, d = last ? 1 : a + 2;
        strip.triangles.insert(strip.triangles.end(), {{a, b, c}, {a, c, d}});
    }
    const Repaired result = repaired(strip);
    EXPECT_EQ(result.triangles.size(), 16u);
    EXPECT_EQ(result.repairs.disagreeing_edges, 1u) << described(result.repairs);
    EXPECT_FALSE(result.closed);
}

TEST(Repair, NamesWhatCantBeUsed) {
    const SolidMesh good = box_between({0, 0, 0}, {1, 1, 1});
    const auto code = [](const SolidMesh& mesh, const RepairOptions& options = {}) {
        const Result<Repaired> result = repair(mesh.points, mesh.triangles, options);
        EXPECT_FALSE(result);
        return result ? Problem{} : result.problem();
    };
    SolidMesh bad = good;
    bad.triangles[3].y = 8;
    EXPECT_EQ(code(bad).code, ProblemCode::index_out_of_range);
    EXPECT_EQ(code(bad).index, 3u);
    EXPECT_EQ(code(bad).message, "triangle 3 names point 8 of 8");
    bad = good;
    bad.points[5].z = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(code(bad).code, ProblemCode::not_finite);
    EXPECT_EQ(code(bad).index, 5u);
    EXPECT_EQ(code({good.points, {}}).code, ProblemCode::empty_input);
    EXPECT_EQ(code({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}}).code, ProblemCode::degenerate);
    EXPECT_EQ(code(good, {.weld_distance = 100}).code, ProblemCode::degenerate);
    EXPECT_EQ(code(good, {.weld_distance = -1}).code, ProblemCode::bad_argument);
    EXPECT_EQ(code(good, {.weld_distance = std::numeric_limits<double>::infinity()}).code, ProblemCode::bad_argument);
    EXPECT_EQ(code(good, {.hole_edges = 1001}).code, ProblemCode::bad_argument);
    EXPECT_EQ(code(good, {.hole_area = 1.5}).code, ProblemCode::bad_argument);
}

TEST(Repair, OfAnyHeapIsGoodToUseAndSolidsAreRepairedOnce) {
    std::size_t closed = 0, filled = 0, again_changed = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        SolidMesh heap;
        const std::uint32_t points = 3 + random.below(9);
        for (std::uint32_t i = 0; i < points; ++i)
            heap.points.push_back({static_cast<float>(random.below(3)), static_cast<float>(random.below(3)),
                                   static_cast<float>(random.below(3))});
        for (std::uint32_t i = 1 + random.below(24); i > 0; --i)
            heap.triangles.emplace_back(random.below(points), random.below(points), random.below(points));
        const RepairOptions options{.weld_distance = random.chance(0.2) ? 1.0 : 0.0, .hole_area = random.unit()};
        const Result<Repaired> result = repair(heap.points, heap.triangles, options);
        if (!result) {
            EXPECT_EQ(result.problem().code, ProblemCode::degenerate);
            continue;
        }
        for (const glm::uvec3& t : result->triangles)
            for (int k = 0; k < 3; ++k) ASSERT_LT(t[k], result->points.size());
        const EdgeFaults faults = edge_faults(result->triangles);
        EXPECT_EQ(faults.closed, result->closed);
        EXPECT_EQ(faults.boundary, result->repairs.open_edges);
        if (result->closed) {
            EXPECT_EQ(faults.boundary, 0u);
        }
        const Result<Repaired> again = repair(result->points, result->triangles, options);
        ASSERT_TRUE(again);
        again_changed += result->closed && faults.non_manifold == 0 && changed(again->repairs);
        closed += result->closed;
        filled += result->repairs.holes_filled > 0;
    }
    EXPECT_GT(closed, 100u);
    EXPECT_GT(filled, 100u);
    EXPECT_EQ(again_changed, 0u);
}

}  // namespace
}  // namespace abut
