// Solids and convex shapes of every kind, and composite shapes: the same answers as for the convex parts of the solid.

#include "../../oracle/is_long.hpp"
#include "../../shape/meshes.hpp"
#include "solid_pairs.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr std::array<const char*, 11> kinds{
    "ball",         "point",     "capsule",      "cylinder",          "cone", "rounded box",
    "rounded hull", "ellipsoid", "rounded cone", "stretched capsule", "box"};

Polyhedron random_hull(oracle::Random& random, double size) {
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i)
        points.push_back(detail::to_float(random.direction<3>() * random.uniform(0.5 * size, size)));
    return *Polyhedron::build(points);
}

AnyShape<3> random_convex(std::size_t kind, oracle::Random& random, float size) {
    const auto direction = [&] { return detail::to_float(random.direction<3>()) * size; };
    const auto some = [&] { return random.uniform_float(0.3f, 1) * size; };
    const Vec3 a = direction() * 0.5f, half(some(), some(), some());
    switch (kind) {
        case 0:
            return Sphere{a, some()};
        case 1:
            return Sphere{a, 0};
        case 2:
            return Capsule3{a, a + direction(), some()};
        case 3:
            return Cylinder{a, a + direction(), some()};
        case 4:
            return Cone{a, a + direction(), some()};
        case 5:
            return rounded(Box3{a, half, random.rotation<3>()}, 0.3f * size);
        case 6:
            return rounded(random_hull(random, static_cast<double>(size)), 0.2f * size);
        case 7:
            return at(stretched(Sphere{{0, 0, 0}, 1}, half), Pose3{a, random.rotation<3>()});
        case 8:
            return rounded(Cone{a, a + direction(), some()}, 0.2f * size);
        case 9:
            return stretched(Capsule3{a, a + direction(), some()}, {1, 0.5f, 1.5f});
        default:
            return Box3{a, half, random.rotation<3>()};
    }
}

TEST(SolidConvex, IsAsDeepAsInTheParts) {
    constexpr std::uint64_t seed = 20281;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    const int count = oracle::is_long() ? 10'000 : 600;
    int overlapping = 0, convex = 0, near = 0, inside = 0;
    for (int i = 0; i < count; ++i) {
        const std::size_t kind = random.below(kinds.size()), number = kit.random_piece(random);
        const scenes::KitPiece& piece = kit.pieces[number];
        const Mesh& mesh = kit.meshes[number];
        const Pose3 pose{random.chance(0.2) ? Vec3(300, -500, 200) : Vec3(0), random.rotation<3>()};
        const float size = random.chance(0.5) ? 0.15f : 0.8f;
        const Aabb3 box = bounds(mesh);
        Vec3 place;
        for (int k = 0; k < 3; ++k) place[k] = random.uniform_float(box.min[k] - 0.5f, box.max[k] + 0.5f);
        const AnyShape<3> shape = at(random_convex(kind, random, size), Pose3{pose * place});
        const auto in = at(solid(mesh), pose);
        SCOPED_TRACE(std::to_string(i) + ": " + kinds[kind] + " and " + piece.name);
        const float expected = distance_of_parts(piece, pose, shape), tolerance = 2e-4f;
        const Closest<3> nearest = closest(in, shape), swapped = closest(shape, in);
        ASSERT_NEAR(glm::length(nearest.normal), 1, 1e-5);
        if (expected > tolerance) {
            ASSERT_NEAR(nearest.distance, expected, tolerance);
            ASSERT_FALSE(overlaps(in, shape));
            ASSERT_FALSE(contact(in, shape));
            continue;
        }
        if (expected > -tolerance) continue;
        ++overlapping;
        ASSERT_TRUE(overlaps(in, shape));
        ASSERT_TRUE(overlaps(shape, in));
        if (!overlaps(at(mesh, pose), shape)) ++inside;
        // The move must lead out of the deepest part at least, and out of all of them.
        ASSERT_LE(nearest.distance, expected + tolerance);
        ASSERT_NEAR(swapped.distance, nearest.distance, 0.2f * std::abs(nearest.distance) + tolerance);
        ASSERT_GE(distance_of_parts(piece, pose, at(shape, Pose3{nearest.normal * -nearest.distance})), -tolerance);
        ASSERT_GE(distance_of_parts(piece, pose, at(shape, Pose3{swapped.normal * swapped.distance})), -tolerance);
        if (piece.parts.size() == 1) {
            ++convex;
            if (nearest.distance >= 1.05f * expected - tolerance) ++near;
        }
        const Contact<3> touch = contact(in, shape);
        ASSERT_TRUE(touch);
        ASSERT_EQ(touch.depth, -nearest.distance);
        ASSERT_EQ(touch.normal, nearest.normal);
        int visits = 0;
        each_contact(in, shape, [&](const Contact<3>& found) {
            ++visits;
            ASSERT_NEAR(glm::length(found.normal), 1, 1e-5);
            ASSERT_LE(found.depth, -nearest.distance + tolerance);
            ASSERT_FALSE(found.points.empty());
        });
        ASSERT_GT(visits, 0);
    }
    EXPECT_GT(overlapping, count / 4);
    EXPECT_GT(convex, count / 20);
    EXPECT_GE(near, 0.98 * convex) << near << " of " << convex;
    EXPECT_GT(inside, count / 50);
}

TEST(SolidConvex, FlatShapesInsideAreDeep) {
    const Mesh box = box_surface({0, 0, 0}, {4, 4, 4}).mesh();
    const Segment3 segment{{1, 2, 2}, {3, 2, 2}}, through{{-1, 2, 2}, {5, 2, 2}};
    const Triangle3 triangle{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
    EXPECT_NEAR(closest(solid(box), segment).distance, -2, 1e-4);
    EXPECT_NEAR(closest(through, solid(box)).distance, -2, 1e-4);
    EXPECT_NEAR(closest(solid(box), triangle).distance, -1, 1e-4);
    EXPECT_TRUE(overlaps(solid(box), triangle));
    EXPECT_TRUE(contact(segment, solid(box)));
    EXPECT_NEAR(closest(solid(box), at(segment, Pose3{{0, 0, 3}})).distance, 1, 1e-5);
    EXPECT_NEAR(closest(solid(box), at(segment, Pose3{{0, 0, 2}})).distance, 0, 1e-5) << "on a face";
}

TEST(SolidConvex, OfCompositeShapesIsThatOfTheDeepestPart) {
    constexpr std::uint64_t seed = 20282;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int overlapping = 0;
    for (int i = 0; i < 100; ++i) {
        const std::size_t number = kit.random_piece(random);
        const auto place = [&] { return Pose3{detail::to_float(random.in_cube<3>() * 2.0), random.rotation<3>()}; };
        const Sphere ball{place().position, 0.4f};
        const auto capsule = Capsule3{place().position, place().position, 0.2f};
        const Box3 box{place().position, {0.3f, 0.2f, 0.4f}};
        const Compound3 compound = *Compound3::build({ball, capsule, box});
        const auto in = at(solid(kit.meshes[number]), Pose3{{-1, -1, 0}});
        const float expected =
            std::min({closest(in, ball).distance, closest(in, capsule).distance, closest(in, box).distance});
        ASSERT_NEAR(closest(in, compound).distance, expected, 1e-4) << i;
        ASSERT_NEAR(closest(compound, in).distance, expected, 1e-4) << i;
        ASSERT_EQ(overlaps(compound, in), overlaps(in, ball) || overlaps(in, capsule) || overlaps(in, box)) << i;
        if (expected > -1e-4f) continue;
        ++overlapping;
        ASSERT_NEAR(contact(in, compound).depth, -expected, 1e-4) << i;
    }
    EXPECT_GT(overlapping, 20);
}

TEST(SolidConvex, OfAHalfSpaceIsThatOfTheCorners) {
    const Kit kit;
    for (const Mesh& mesh : kit.meshes) {
        const Aabb3 box = bounds(mesh);
        for (const float offset : {-20.0f, box.min.y, box.min.y + 0.5f, box.max.y + 3}) {
            const HalfSpace3 ground{{0, 1, 0}, offset};
            EXPECT_FLOAT_EQ(closest(ground, solid(mesh)).distance, box.min.y - offset);
            EXPECT_EQ(overlaps(ground, solid(mesh)), box.min.y <= offset);
        }
    }
}

TEST(SolidConvex, InACornerTouchesBothWalls) {
    // A ball and a capsule between the arms of an L, sunk into one of them, and touching the other one.
    const Mesh corner = mesh_of(scenes::kit()[1]);
    const auto normals_of = [&](const auto& shape) {
        std::vector<Vec3> normals;
        each_contact(solid(corner), shape, [&](const Contact<3>& found) {
            normals.push_back(found.normal);
            const float depth = found.normal.x > 0.5f ? 0.0f : 0.125f;
            EXPECT_NEAR(found.depth, depth, 1e-4) << found.normal.x << " " << found.normal.y << " " << found.normal.z;
        });
        return normals;
    };
    EXPECT_EQ(normals_of(Sphere{{1.5f, 1.375f, 0.5f}, 0.5f}).size(), 2u);
    EXPECT_EQ(normals_of(Capsule3{{1.5f, 1.375f, 0.375f}, {1.5f, 1.375f, 0.625f}, 0.5f}).size(), 2u);
}

}  // namespace
}  // namespace abut::test
