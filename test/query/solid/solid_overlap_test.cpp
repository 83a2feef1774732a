// The interiors of solids: exact answers for a kit of modular pieces, flush and not.

#include "../../oracle/is_long.hpp"
#include "../../shape/meshes.hpp"
#include "solid_pairs.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polyhedron.hpp>

#include <array>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// A box with a box-shaped hole through it along z, of cells.
Surface frame(int size, int hole) {
    const int from = (size - hole) / 2, to = from + hole;
    return cell_surface(size, [=](int x, int y, int) { return x < from || x >= to || y < from || y >= to; });
}

template <class A, class B>
void expect_overlap(const A& a, const B& b, bool interiors) {
    for (const bool swapped : {false, true}) {
        const float distance = swapped ? closest(b, a).distance : closest(a, b).distance;
        if (interiors)
            EXPECT_LT(distance, 0);
        else
            EXPECT_GE(distance, 0);
    }
}

TEST(SolidOverlap, OfAKitIsExact) {
    constexpr std::uint64_t seed = 20261;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    const int pairs = oracle::is_long() ? 100'000 : 4'000;
    int overlapping = 0, touching = 0;
    for (int i = 0; i < pairs; ++i) {
        const KitPair pair(kit, random);
        const bool expected = oracle::interiors_overlap(kit.pieces[pair.a.piece], pair.a.position,
                                                        kit.pieces[pair.b.piece], pair.b.position);
        const auto a = placed(kit, pair.a), b = placed(kit, pair.b);
        ASSERT_EQ(closest(a, b).distance < 0, expected) << pair.text(kit);
        ASSERT_EQ(contact(b, a).depth > 0, expected) << pair.text(kit);
        if (expected)
            ++overlapping;
        else if (overlaps(a, b))
            ++touching;
        ASSERT_TRUE(!expected || overlaps(a, b)) << pair.text(kit);
    }
    EXPECT_GT(overlapping, pairs / 20);
    EXPECT_GT(touching, pairs / 20);
}

/// The deepest overlap, or else the least gap, of two parts of two pieces, as polyhedra.
float distance_of_pieces(const Kit& kit, const scenes::KitPlacement& a, const Pose3& pose_a,
                         const scenes::KitPlacement& b, const Pose3& pose_b) {
    float least = std::numeric_limits<float>::infinity();
    for (const scenes::KitPart& part : kit.pieces[b.piece].parts)
        least = std::min(least,
                         distance_of_parts(kit.pieces[a.piece], pose_a, at(*Polyhedron::build(part.points), pose_b)));
    return least;
}

TEST(SolidOverlap, OfTurnedPiecesIsThatOfTheirParts) {
    constexpr std::uint64_t seed = 20268;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int overlapping = 0, apart = 0;
    for (int i = 0; i < 400; ++i) {
        const KitPair pair(kit, random);
        const Vec3 far = random.chance(0.2) ? Vec3(1000, -500, 200) : Vec3(0);
        const Pose3 pose_a{pair.a.position + far, random.rotation<3>()},
            pose_b{pair.b.position + far, random.rotation<3>()};
        const auto a = at(solid(kit.meshes[pair.a.piece]), pose_a), b = at(solid(kit.meshes[pair.b.piece]), pose_b);
        const float expected = distance_of_pieces(kit, pair.a, pose_a, pair.b, pose_b);
        const float distance = closest(a, b).distance;
        if (expected > 0) {
            ++apart;
            ASSERT_NEAR(distance, expected, 1e-3) << pair.text(kit);
        } else if (expected < -1e-4f) {
            ++overlapping;
            ASSERT_LT(distance, expected * 0.999f) << pair.text(kit);
        }
    }
    EXPECT_GT(apart, 100);
    EXPECT_GT(overlapping, 50);
}

TEST(SolidOverlap, OfTPrismsSideBySide) {
    // `contact` of the meshes said 0.316, 1 and 0 deep at the first three places, and `closest` 0 at all of them.
    const Mesh t = mesh_of(scenes::kit()[0]);
    for (const float x : {3.0f, 2.99f, 2.9f, 2.8f, 2.5f, 2.1f}) {
        SCOPED_TRACE(x);
        const auto other = at(solid(t), Pose3{{x, 0, 0}});
        const Closest<3> nearest = closest(solid(t), other);
        EXPECT_EQ(nearest.distance, x - 3);
        EXPECT_EQ(nearest.normal, Vec3(1, 0, 0));
        const Contact<3> touch = contact(solid(t), other);
        EXPECT_EQ(touch.depth, 3 - x);
        EXPECT_EQ(touch.normal, Vec3(1, 0, 0));
        ASSERT_EQ(touch.points.size(), 4u);
        for (const auto& point : touch.points) EXPECT_FLOAT_EQ(point.position.x, 0.5f * (3 + x));
    }
    EXPECT_EQ(closest(solid(t), at(solid(t), Pose3{{3.5f, 0, 0}})).distance, 0.5f);
}

TEST(SolidOverlap, OfAPegInAHoleThatFits) {
    const Mesh hole = frame(4, 2).mesh(), peg = box_surface({1, 1, -1}, {3, 3, 5}).mesh(),
               thick = box_surface({1, 1, -1}, {3.0625f, 3, 5}).mesh();
    expect_overlap(solid(hole), solid(peg), false);
    EXPECT_TRUE(overlaps(solid(hole), solid(peg)));
    expect_overlap(solid(hole), solid(thick), true);
    EXPECT_FLOAT_EQ(closest(solid(hole), at(solid(peg), Pose3{{0.25f, 0, 0}})).distance, -0.25f);
}

TEST(SolidOverlap, OfOneInsideAnother) {
    const Mesh outer = box_surface({0, 0, 0}, {4, 4, 4}).mesh(), inner = box_surface({1, 1, 1}, {2, 2, 2}).mesh();
    expect_overlap(solid(outer), solid(inner), true);
    EXPECT_FLOAT_EQ(closest(solid(outer), solid(inner)).distance, -2);
    EXPECT_TRUE(overlaps(solid(inner), solid(outer)));
    EXPECT_FALSE(overlaps(inner, outer)) << "the surfaces alone";
    const Mesh hollow = joined(box_surface({0, 0, 0}, {4, 4, 4}), reversed(box_surface({1, 1, 1}, {3, 3, 3}))).mesh();
    expect_overlap(solid(hollow), solid(inner), false);
    EXPECT_TRUE(overlaps(solid(hollow), solid(inner))) << "it touches the cavity's walls";
    const auto free = at(solid(inner), Pose3{{0.5f, 0.5f, 0.5f}});
    EXPECT_FALSE(overlaps(solid(hollow), free));
    EXPECT_FLOAT_EQ(closest(solid(hollow), free).distance, 0.5f);
    expect_overlap(solid(hollow), at(solid(inner), Pose3{{-0.125f, 0, 0}}), true);
}

TEST(SolidOverlap, OfOneInsideOfAUnionOfBoxes) {
    // The inner box is inside the first one, and flush with a face of the second one that is inside the first one too.
    const Mesh boxes = joined(box_surface({0, 0, 0}, {4, 4, 4}), box_surface({-1, 1, 2}, {3, 3, 3})).mesh();
    for (const Vec3 low : {Vec3(1, 1, 1), Vec3(1, 1, 3), Vec3(1, 0, 2), Vec3(1, 0.5f, 1), Vec3(3, 1, 2)})
        expect_overlap(solid(boxes), solid(box_surface(low, low + Vec3(0.5f, 1, 1)).mesh()), true);
    expect_overlap(solid(boxes), solid(box_surface({-1, 1, 3}, {0, 2, 4}).mesh()), false);
}

/// A tetrahedron with its first corner at the origin, and the others at these places.
Mesh tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::vector<Vec3> points{{0, 0, 0}, a, b, c};
    return *Mesh::build(points, std::vector<glm::uvec3>{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

TEST(SolidOverlap, OfOneInsideThatTouchesInACorner) {
    const Mesh box = box_surface({0, 0, 0}, {8, 8, 8}).mesh();
    // A corner in a face, in an edge, and in a corner of the box; from inside and from outside.
    const Mesh in_face = tetrahedron({1, 0.5f, 0.25f}, {0.5f, 2, 0.5f}, {0.25f, 0.5f, 1});
    for (const Vec3 place : {Vec3(0, 3, 3), Vec3(0, 0, 3), Vec3(0, 0, 0), Vec3(0, 4, 4)}) {
        expect_overlap(solid(box), at(solid(in_face), Pose3{place}), true);
        expect_overlap(solid(box), at(stretched(solid(in_face), Vec3(-1)), Pose3{place}), false);
        EXPECT_TRUE(overlaps(solid(box), at(stretched(solid(in_face), Vec3(-1)), Pose3{place})));
    }
    // A corner of a cavity in an edge, a face and a corner of the solid: from within the material.
    const Mesh corner = mesh_of(scenes::kit()[1]);
    const Mesh below = tetrahedron({-0.25f, -0.5f, -0.25f}, {-0.5f, -0.25f, -0.25f}, {-0.5f, -0.5f, 0.125f});
    for (const Vec3 place : {Vec3(1, 1, 0.5f), Vec3(1, 2, 0.5f), Vec3(2, 1, 0.5f), Vec3(1, 1, 1)})
        expect_overlap(solid(corner), at(solid(below), Pose3{place}), true);
}

TEST(SolidOverlap, OfSolidsThatTouchInAnEdgeOrACorner) {
    const Mesh box = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    for (const Vec3 at_b : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(1, 0.5f, 0), Vec3(1, 1, 0.25f),
                            Vec3(-1, 0.5f, -0.5f), Vec3(0, -1, 1)}) {
        expect_overlap(solid(box), at(solid(box), Pose3{at_b}), false);
        EXPECT_TRUE(overlaps(solid(box), at(solid(box), Pose3{at_b})));
    }
    // A flush box inside, and the same box.
    for (const Vec3 at_b : {Vec3(0, 0, 0), Vec3(0.5f, 0, 0), Vec3(0, 0.5f, 0.5f), Vec3(0.99f, 0, 0)})
        expect_overlap(solid(box), at(solid(box), Pose3{at_b}), true);
    // Two roofs whose ridges cross: one on the other, and one sunk into the other.
    const scenes::KitPiece along_x = scenes::kit_prism("", {{0, 0}, {2, 0}, {1, 1}}, {{0, 1, 2}}, 2, 1),
                           along_z = scenes::kit_prism("", {{0, 0}, {1, -1}, {2, 0}}, {{0, 1, 2}}, 2, 0);
    const Mesh lower = mesh_of(along_x), upper = mesh_of(along_z);
    const Aabb3 low = bounds(lower), high = bounds(upper);
    const Vec3 onto = Vec3(0.5f * (low.min + low.max) - 0.5f * (high.min + high.max));
    for (const float sunk : {0.0f, 0.0078125f}) {
        Vec3 place = onto;
        place.y = low.max.y - high.min.y - sunk;
        expect_overlap(solid(lower), at(solid(upper), Pose3{place}), sunk > 0);
    }
}

/// Prisms around the z axis, each from one angle to another, in steps of a 48th of a turn. All share the axis as an
/// edge.
scenes::KitPiece star(const std::vector<std::array<std::uint32_t, 2>>& sectors, float radius) {
    const std::vector<Vec2> circle = scenes::kit_circle(48, radius);
    scenes::KitPiece result;
    for (const auto& [from, to] : sectors) {
        const scenes::KitPiece wedge =
            scenes::kit_prism("", {{0, 0}, circle[from % 48], circle[to % 48]}, {{0, 1, 2}}, 1);
        result = result.points.empty() ? wedge : joined(result, wedge);
    }
    return result;
}

TEST(SolidOverlap, AtAnEdgeOfManyTriangles) {
    // At most 16 triangles at an edge were looked at: a prism between two others seemed to be inside.
    std::vector<std::array<std::uint32_t, 2>> sectors;
    for (std::uint32_t from = 0; from < 48; from += 4) sectors.push_back({from, from + 2});
    const Mesh many = mesh_of(star(sectors, 2));
    ASSERT_TRUE(many.closed());
    for (std::uint32_t from = 0; from < 48; ++from)
        for (const std::uint32_t size : {1u, 2u, 3u}) {
            SCOPED_TRACE(std::to_string(from) + " " + std::to_string(size));
            const bool is_between = from % 4 >= 2 && from % 4 + size <= 4;
            for (const float radius : {1.0f, 2.0f, 3.0f})
                expect_overlap(solid(many), solid(mesh_of(star({{from, from + size}}, radius))), !is_between);
        }
}

TEST(SolidOverlap, OfPrismsAroundOneAxis) {
    constexpr std::uint64_t seed = 20272;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const auto random_star = [&](std::uint32_t max_count, float radius) {
        std::vector<std::array<std::uint32_t, 2>> sectors;
        for (std::uint32_t count = 1 + random.below(max_count); count > 0; --count) {
            const std::uint32_t from = random.below(48);
            sectors.push_back({from, from + 1 + random.below(6)});
        }
        return star(sectors, radius);
    };
    int overlapping = 0;
    const int pairs = oracle::is_long() ? 2000 : 200;
    for (int i = 0; i < pairs; ++i) {
        // Prisms of one piece may overlap, lie on one another or touch.
        const scenes::KitPiece a = random_star(12, 2), b = random_star(3, 1);
        const Vec3 place(0, 0, static_cast<float>(random.below(3)) * 0.5f);
        const bool expected = oracle::interiors_overlap(a, Vec3(0), b, place);
        const Mesh mesh_a = mesh_of(a), mesh_b = mesh_of(b);
        ASSERT_EQ(closest(solid(mesh_a), at(solid(mesh_b), Pose3{place})).distance < 0, expected) << i;
        ASSERT_EQ(closest(at(solid(mesh_b), Pose3{place}), solid(mesh_a)).distance < 0, expected) << i;
        if (expected) ++overlapping;
    }
    EXPECT_GT(overlapping, pairs / 5);
    EXPECT_LT(overlapping, pairs * 4 / 5);
}

TEST(SolidOverlap, OfAMeshThatIsInsideOut) {
    const Surface box = box_surface({0, 0, 0}, {1, 1, 1});
    const Mesh outwards = box.mesh(), inwards = reversed(box).mesh();
    for (const float x : {0.5f, 1.0f, 1.5f}) {
        expect_overlap(solid(inwards), at(solid(outwards), Pose3{{x, 0, 0}}), x < 1);
        expect_overlap(solid(outwards), at(stretched(solid(outwards), Vec3(-1, 1, 1)), Pose3{{x + 1, 0, 0}}), x < 1);
    }
}

TEST(SolidOverlap, OfBoxesAndPolyhedra) {
    constexpr std::uint64_t seed = 20262;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int overlapping = 0;
    for (int i = 0; i < 300; ++i) {
        const KitPair pair(kit, random);
        const auto piece = placed(kit, pair.a);
        const Vec3 half(0.5f, 0.25f, 1);
        const Mesh as_mesh = box_surface(-half, half).mesh();
        const Polyhedron hull = *Polyhedron::build(as_mesh.points());
        const Vec3 place = pair.b.position;
        const Closest<3> expected = closest(piece, at(solid(as_mesh), Pose3{place}));
        EXPECT_FLOAT_EQ(closest(piece, Box3{place, half}).distance, expected.distance) << pair.text(kit);
        EXPECT_FLOAT_EQ(closest(at(hull, Pose3{place}), piece).distance, expected.distance) << pair.text(kit);
        if (expected.distance < 0) ++overlapping;
    }
    EXPECT_GT(overlapping, 10);
}

TEST(SolidOverlap, OfBallsAndPoints) {
    constexpr std::uint64_t seed = 20267;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Mesh box = box_surface({0, 0, 0}, {4, 2, 3}).mesh();
    const Polyhedron hull = *Polyhedron::build(box.points());
    for (int i = 0; i < 300; ++i) {
        const Vec3 center(random.uniform_float(-1, 5), random.uniform_float(-1, 3), random.uniform_float(-1, 4));
        const Sphere ball{center, random.chance(0.3) ? 0 : random.uniform_float(0, 2)};
        const Closest<3> expected = closest(hull, ball), nearest = closest(solid(box), ball);
        ASSERT_NEAR(nearest.distance, expected.distance, 1e-4);
        ASSERT_EQ(overlaps(solid(box), ball), expected.distance <= 0);
        if (std::abs(expected.distance) < 1e-3f) continue;
        ASSERT_GT(glm::dot(nearest.normal, nearest.on_b - nearest.on_a) * nearest.distance, 0);
        ASSERT_NEAR(closest(ball, solid(box)).distance, expected.distance, 1e-4);
        ASSERT_EQ(static_cast<bool>(contact(ball, solid(box))), expected.distance <= 0);
    }
    // In the corner of an L the ball leaves both arms.
    const Mesh corner = mesh_of(scenes::kit()[1]);
    const Closest<3> deep = closest(solid(corner), Sphere{{0.875f, 0.875f, 0.5f}, 0.5f});
    EXPECT_LT(deep.distance, -0.625f);
    const Vec3 out = Vec3(0.875f, 0.875f, 0.5f) - deep.normal * deep.distance;
    EXPECT_GE(closest(solid(corner), Sphere{out, 0.5f}).distance, -1e-5f);
}

TEST(SolidOverlap, OfAMeshThatIsNotClosedIsThatOfItsTriangles) {
    Surface open = box_surface({0, 0, 0}, {4, 4, 4});
    open.triangles.pop_back();
    const Mesh box = open.mesh(), inner = box_surface({1, 1, 1}, {2, 2, 2}).mesh();
    EXPECT_FALSE(overlaps(solid(box), solid(inner)));
    EXPECT_FLOAT_EQ(closest(solid(box), solid(inner)).distance, closest(box, inner).distance);
}

}  // namespace
}  // namespace abut::test
