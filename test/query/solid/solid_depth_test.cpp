// The depth of solids: a move that parts them, seldom longer than the least one.

#include "../../../scenes/bumpy_ball.hpp"
#include "../../oracle/is_long.hpp"
#include "../../shape/meshes.hpp"
#include "solid_pairs.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using detail::DVec;
using detail::length;

/// Whether the interiors are parted after B has moved, exactly.
template <class A, class B>
bool is_parted(const A& a, const B& b, const DVec<3>& move) {
    const detail::PlacedSolid solid_a{View<3>(view(a))}, solid_b{View<3>(view(b))};
    return !detail::interiors_overlap(solid_a, solid_b.moved(move));
}

template <class A, class B>
bool is_parted(const A& a, const B& b, const Closest<3>& nearest) {
    return is_parted(a, b, DVec<3>(nearest.normal) * -static_cast<double>(nearest.distance));
}

/// The shortest move along an axis, or along the normal of a face.
double least_along_normals(const oracle::OverlappingMoves& moves, const scenes::KitPiece& a,
                           const scenes::KitPiece& b) {
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const DVec<3>& direction) {
        for (const double sign : {1.0, -1.0}) least = std::min(least, moves.separation_along(direction * sign));
    };
    for (int i = 0; i < 3; ++i) offer(detail::axis<3>(i));
    for (const scenes::KitPiece* piece : {&a, &b})
        for (const glm::uvec3& t : piece->triangles) {
            const DVec<3> corner(piece->points[t.x]);
            const DVec<3> normal =
                detail::cross(DVec<3>(piece->points[t.y]) - corner, DVec<3>(piece->points[t.z]) - corner);
            offer(normal / length(normal));
        }
    return least;
}

TEST(SolidDepth, OfAKitPartsAndIsMostlyTheLeast) {
    constexpr std::uint64_t seed = 20263;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    const int pairs = oracle::is_long() ? 20'000 : 2'000;
    int known = 0, near = 0;
    for (int i = 0; i < pairs; ++i) {
        const KitPair pair(kit, random);
        const scenes::KitPiece &piece_a = kit.pieces[pair.a.piece], &piece_b = kit.pieces[pair.b.piece];
        if (!oracle::interiors_overlap(piece_a, pair.a.position, piece_b, pair.b.position)) continue;
        SCOPED_TRACE(pair.text(kit));
        const auto a = placed(kit, pair.a), b = placed(kit, pair.b);
        const Closest<3> nearest = closest(a, b);
        const double depth = -static_cast<double>(nearest.distance);
        const oracle::OverlappingMoves moves(piece_a, pair.a.position, piece_b, pair.b.position);
        ASSERT_TRUE(is_parted(a, b, nearest));
        ASSERT_NEAR(length(DVec<3>(nearest.normal)), 1, 1e-6);
        ASSERT_LE(depth, least_along_normals(moves, piece_a, piece_b) * (1 + 1e-6) + 1e-6);
        const std::optional<double> least = moves.least_separation();
        if (!least) continue;
        ++known;
        ASSERT_GE(depth, *least * (1 - 1e-5) - 1e-6);
        if (depth <= 1.001 * *least + 1e-6) ++near;
    }
    EXPECT_GT(known, pairs / 20);
    EXPECT_GE(near, 0.99 * known) << near << " of " << known;
}

/// Turned together, two solids are as deep as before, where they part along no axis of the world.
TEST(SolidDepth, OfAKitTurnedAsAWholeIsMostlyTheLeast) {
    constexpr std::uint64_t seed = 20281;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int known = 0, near = 0;
    for (int i = 0; i < 2'000; ++i) {
        const KitPair pair(kit, random);
        const oracle::OverlappingMoves moves(kit.pieces[pair.a.piece], pair.a.position, kit.pieces[pair.b.piece],
                                             pair.b.position);
        const std::optional<double> least = moves.least_separation();
        if (!least || *least == 0) continue;
        SCOPED_TRACE(pair.text(kit));
        const glm::quat turn = random.rotation<3>();
        const auto a = at(solid(kit.meshes[pair.a.piece]), Pose3{turn * pair.a.position, turn});
        const auto b = at(solid(kit.meshes[pair.b.piece]), Pose3{turn * pair.b.position, turn});
        const double depth = -static_cast<double>(closest(a, b).distance);
        ++known;
        ASSERT_GE(depth, *least * (1 - 1e-5) - 1e-5);
        if (depth <= 1.001 * *least + 1e-5) ++near;
    }
    EXPECT_GT(known, 50);
    EXPECT_GE(near, 0.98 * known) << near << " of " << known;
}

/// Expects that no move of B along the normal of a face that is a little shorter than the depth parts the solids.
template <class A, class B>
void expect_no_shorter_along_normals(const A& a, const B& b) {
    const Closest<3> nearest = closest(a, b);
    if (!(nearest.distance < 0)) return;
    ASSERT_TRUE(is_parted(a, b, nearest));
    const double shorter = -static_cast<double>(nearest.distance) * (1 - 1e-5);
    const detail::PlacedSolid solid_a{View<3>(view(a))}, solid_b{View<3>(view(b))};
    for (const auto& [solid, sign] : {std::pair(&solid_a, 1.0), std::pair(&solid_b, -1.0)})
        for (std::uint32_t i = 0; i < solid->triangle_count(); ++i) {
            const detail::Corners t = solid->corners(i);
            const DVec<3> across = detail::cross(t[1] - t[0], t[2] - t[0]);
            EXPECT_TRUE(detail::interiors_overlap(solid_a, solid_b.moved(across * (sign * shorter / length(across)))))
                << i << ' ' << sign;
        }
}

TEST(SolidDepth, IsNoLongerThanAlongTheNormalOfAFace) {
    constexpr std::uint64_t seed = 20287;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    const auto expect_at = [&](std::size_t a, const Pose3& pose_a, std::size_t b, const Pose3& pose_b) {
        expect_no_shorter_along_normals(at(solid(kit.meshes[a]), pose_a), at(solid(kit.meshes[b]), pose_b));
    };
    for (int i = 0; i < 400; ++i) {
        const KitPair pair(kit, random);
        SCOPED_TRACE(pair.text(kit));
        expect_at(pair.a.piece, {pair.a.position, random.rotation<3>()}, pair.b.piece,
                  {pair.b.position, random.rotation<3>()});
    }
    // Without the moves along the normals the depth was 0.5, 2.8 and 6.3 % longer.
    expect_at(8, {{-0.75f, 0, -2}, {0.350331664f, -0.667902589f, -0.317557901f, -0.574744165f}}, 15,
              {{0.150000006f, 2, 0}, {0.0421358831f, -0.306652755f, 0.867592573f, 0.389193743f}});
    expect_at(15, {{0, 0, 0}, {0.116825603f, -0.715420127f, -0.413581043f, 0.550887048f}}, 0,
              {{1, 2, -1}, {-0.0601065122f, -0.487839907f, 0.496480197f, 0.715476632f}});
    expect_at(6, {{2, 0, 2}, {-0.466191471f, -0.88026762f, 0.0469841473f, -0.074745506f}}, 15,
              {{2.99987793f, -0.99987793f, 3.25f}, {-0.312451661f, -0.429544121f, 0.751426995f, -0.391437471f}});
}

/// Two to five boxes, which may overlap; corners are multiples of 1/64.
scenes::KitPiece union_of_boxes(oracle::Random& random) {
    const auto coordinates = [&](std::uint32_t low, std::uint32_t count) {
        Vec3 result;
        for (int i = 0; i < 3; ++i) result[i] = static_cast<float>(low + random.below(count)) / 64;
        return result;
    };
    scenes::KitPiece result;
    const std::uint32_t count = 2 + random.below(4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 low = coordinates(0, 192);
        const scenes::KitPiece box = scenes::kit_box("", low, low + coordinates(16, 128));
        result = i == 0 ? box : joined(result, box);
    }
    return result;
}

TEST(SolidDepth, OfUnionsOfBoxesIsMostlyTheLeast) {
    constexpr std::uint64_t seed = 20270;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    int known = 0, near = 0;
    for (int i = 0; i < 250; ++i) {
        const scenes::KitPiece piece_a = union_of_boxes(random), piece_b = union_of_boxes(random);
        Vec3 place;
        for (int k = 0; k < 3; ++k) place[k] = static_cast<float>(random.below(256)) / 64 - 2;
        const Mesh mesh_a = mesh_of(piece_a), mesh_b = mesh_of(piece_b);
        const auto b = at(solid(mesh_b), Pose3{place});
        const Closest<3> nearest = closest(solid(mesh_a), b);
        ASSERT_EQ(nearest.distance < 0, oracle::interiors_overlap(piece_a, Vec3(0), piece_b, place)) << i;
        if (nearest.distance >= 0) continue;
        ASSERT_TRUE(is_parted(solid(mesh_a), b, nearest)) << i;
        const std::optional<double> least =
            oracle::OverlappingMoves(piece_a, Vec3(0), piece_b, place).least_separation();
        if (!least) continue;
        ++known;
        ASSERT_GE(-nearest.distance, *least * (1 - 1e-5) - 1e-6) << i;
        if (-nearest.distance <= 1.05 * *least) ++near;
    }
    EXPECT_GT(known, 100);
    EXPECT_GE(near, 0.97 * known) << near << " of " << known;
}

TEST(SolidDepth, OfConvexSolidsIsTheLeast) {
    constexpr std::uint64_t seed = 20271;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const auto hull = [&] {
        std::vector<Vec3> points;
        for (int i = 0; i < 30; ++i) points.push_back(detail::to_float(random.direction<3>() * random.uniform(0.5, 1)));
        return *Polyhedron::build(points);
    };
    const auto mesh = [](const Polyhedron& polyhedron) {
        std::vector<glm::uvec3> triangles;
        const detail::Facets& facets = polyhedron.facets();
        for (std::size_t face = 0; face < facets.loop_ends.size(); ++face) {
            const auto loop = facets.loop(face);
            for (std::size_t i = 1; i + 1 < loop.size(); ++i) triangles.emplace_back(loop[0], loop[i], loop[i + 1]);
        }
        return *Mesh::build(polyhedron.points(), triangles);
    };
    int overlapping = 0;
    for (int i = 0; i < 60; ++i) {
        const Polyhedron a = hull(), b = hull();
        const Pose3 pose{detail::to_float(random.direction<3>() * random.uniform(0.2, 2)), random.rotation<3>()};
        const Closest<3> expected = closest(a, at(b, pose));
        const Mesh mesh_b = mesh(b);
        const Closest<3> nearest = closest(solid(mesh(a)), at(solid(mesh_b), pose));
        ASSERT_NEAR(nearest.distance, expected.distance, 0.05 * std::abs(expected.distance) + 1e-5) << i;
        if (expected.distance < 0) ++overlapping;
    }
    EXPECT_GT(overlapping, 20);
}

TEST(SolidDepth, OfANotchIsDiagonal) {
    // A box that is 0.25 and 0.125 deep in the two arms of an L leaves both at once.
    const Mesh corner = mesh_of(scenes::kit()[1]), box = box_surface({0.75f, 0.875f, 0}, {2, 2, 1}).mesh();
    const Closest<3> nearest = closest(solid(corner), solid(box));
    EXPECT_NEAR(nearest.distance, -std::sqrt(0.25 * 0.25 + 0.125 * 0.125), 1e-6);
    EXPECT_TRUE(is_parted(solid(corner), solid(box), nearest));
}

/// A block of 1 x 1 x 1 in a cup of four walls and a floor, with a play of 0.1, deep in a corner. Exits along spread
/// directions alone missed the place where it fits in 17 of 200 turns.
TEST(SolidDepth, OfABlockInACupIsDiagonal) {
    constexpr std::uint64_t seed = 20282;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    scenes::KitPiece cup = scenes::kit_box("", {0, 0, 0}, {3.1f, 3.1f, 1});
    for (const Aabb3& wall : {Aabb3{{0, 0, 0}, {1, 3.1f, 4}}, Aabb3{{2.1f, 0, 0}, {3.1f, 3.1f, 4}},
                              Aabb3{{0, 0, 0}, {3.1f, 1, 4}}, Aabb3{{0, 2.1f, 0}, {3.1f, 3.1f, 4}}})
        cup = joined(cup, scenes::kit_box("", wall.min, wall.max));
    const Mesh cup_mesh = mesh_of(cup), block_mesh = mesh_of(scenes::kit_box("", {0, 0, 0}, {1, 1, 1}));
    for (int i = 0; i < 200; ++i) {
        const Vec3 deep(random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), random.uniform(0.1, 0.3));
        const glm::quat turn = random.rotation<3>();
        const auto a = at(solid(cup_mesh), Pose3{Vec3(0), turn});
        const auto b = at(solid(block_mesh), Pose3{turn * (Vec3(1) - deep), turn});
        EXPECT_NEAR(closest(a, b).distance, -glm::length(deep), 1e-5) << i;
        EXPECT_NEAR(closest(b, a).distance, -glm::length(deep), 1e-5) << i;
    }
}

TEST(SolidDepth, OfTurnedSolidsParts) {
    constexpr std::uint64_t seed = 20264;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int overlapping = 0, differ = 0;
    for (int i = 0; i < 300; ++i) {
        const KitPair pair(kit, random);
        const Vec3 far = random.chance(0.2) ? Vec3(1000, -500, 200) : Vec3(0);
        const auto a = at(solid(kit.meshes[pair.a.piece]), Pose3{pair.a.position + far, random.rotation<3>()});
        const auto b = at(solid(kit.meshes[pair.b.piece]), Pose3{pair.b.position + far, random.rotation<3>()});
        const Closest<3> nearest = closest(a, b);
        const Contact<3> touch = contact(a, b);
        if (nearest.distance > 0) {
            EXPECT_FALSE(touch);
            continue;
        }
        ++overlapping;
        EXPECT_TRUE(is_parted(a, b, nearest));
        EXPECT_EQ(touch.depth, -nearest.distance);
        EXPECT_EQ(touch.normal, nearest.normal);
        EXPECT_GE(touch.points.size(), 1u);
        if (std::abs(closest(b, a).distance - nearest.distance) > 0.05f * std::abs(nearest.distance) + 1e-4f) ++differ;
    }
    EXPECT_GT(overlapping, 50);
    EXPECT_LE(differ, 0.03 * overlapping) << "swapped, where the search isn't the least";
}

TEST(SolidCertificate, HoldsForEveryAnswer) {
    constexpr std::uint64_t seed = 20266;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int overlapping = 0, touching = 0;
    for (int i = 0; i < 300; ++i) {
        const KitPair pair(kit, random);
        SCOPED_TRACE(pair.text(kit));
        const auto a = placed(kit, pair.a);
        const Pose3 pose{pair.b.position, random.chance(0.3) ? random.rotation<3>() : glm::quat(1, 0, 0, 0)};
        const auto check = [&](const auto& b) {
            const Closest<3> nearest = closest(a, b);
            const Certificate<3> found = certify(a, b, nearest);
            ASSERT_TRUE(found) << "distance " << nearest.distance << " margin " << found.margin << " plane "
                               << found.plane << " off " << found.off_a << " and " << found.off_b << " across "
                               << found.across << " common " << found.off_common;
            Closest<3> wrong = nearest;
            wrong.distance += nearest.distance > 0 ? 0.01f : -0.01f;
            EXPECT_FALSE(certify(a, b, wrong));
            wrong = nearest;
            wrong.on_a += nearest.normal * 0.01f;
            EXPECT_FALSE(certify(a, b, wrong));
            if (nearest.distance < 0) {
                ++overlapping;
                wrong = nearest;
                wrong.distance = 0.5f;
                EXPECT_FALSE(certify(a, b, wrong)) << "said to be apart";
            }
            if (nearest.distance == 0) ++touching;
        };
        check(at(solid(kit.meshes[pair.b.piece]), pose));
        check(Box3{pose.position, {0.25f, 0.5f, 0.75f}, pose.rotation});
        check(Capsule3{pose.position, pose.position + Vec3(0, 1, 0), 0.25f});
    }
    EXPECT_GT(overlapping, 100);
    EXPECT_GT(touching, 30);
}

TEST(SolidContact, IsOneManifold) {
    const Mesh floor = box_surface({0, 0, 0}, {8, 8, 1}).mesh(), crate = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    for (const float sunk : {0.0f, 0.125f}) {
        const auto on_it = at(solid(crate), Pose3{{3, 2, 1 - sunk}});
        const Contact<3> touch = contact(solid(floor), on_it);
        EXPECT_EQ(touch.depth, sunk);
        EXPECT_EQ(touch.normal, Vec3(0, 0, 1));
        ASSERT_EQ(touch.points.size(), 4u);
        for (const auto& point : touch.points) {
            EXPECT_FLOAT_EQ(point.position.z, 1 - 0.5f * sunk);
            EXPECT_NEAR(std::abs(point.position.x - 3.5f), 0.5, 1e-5);
            EXPECT_NEAR(std::abs(point.position.y - 2.5f), 0.5, 1e-5);
            EXPECT_EQ(point.depth, sunk);
        }
        int visits = 0;
        each_contact(solid(floor), on_it, [&](const Contact<3>&) { ++visits; });
        EXPECT_EQ(visits, 1);
        // The corners keep their names while the crate slides.
        const Contact<3> later = contact(solid(floor), at(solid(crate), Pose3{{3.01f, 2.01f, 1 - sunk}}));
        ASSERT_EQ(later.points.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(later.points[i].feature, touch.points[i].feature);
    }
    const auto above = at(solid(crate), Pose3{{3, 2, 1.0625f}});
    EXPECT_FALSE(contact(solid(floor), above));
    const Contact<3> near = contact(solid(floor), above, {.margin = 0.125f});
    EXPECT_EQ(near.depth, -0.0625f);
    EXPECT_EQ(near.points.size(), 4u);
}

TEST(SolidContact, OfACornerIsOneForEachPlane) {
    // An L has a floor with the normal y, and a wall with the normal x.
    const Mesh corner = mesh_of(scenes::kit()[1]), box = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    struct Found {
        Vec3 normal;
        float depth;
        std::size_t points;
    };
    for (const bool as_mesh : {true, false})
        for (const float sunk_x : {0.0f, 0.125f})
            for (const float sunk_y : {0.0f, 0.25f}) {
                SCOPED_TRACE(std::to_string(sunk_x) + " " + std::to_string(sunk_y));
                const Pose3 pose{{1 - sunk_x, 1 - sunk_y, 0.25f}};
                std::vector<Found> found;
                const auto visit = [&](const Contact<3>& contact) {
                    found.push_back({contact.normal, contact.depth, contact.points.size()});
                };
                if (as_mesh)
                    each_contact(solid(corner), at(solid(box), pose), visit);
                else
                    each_contact(solid(corner), Box3{pose.position + Vec3(0.5f), Vec3(0.5f)}, visit);
                ASSERT_EQ(found.size(), 2u);
                if (found[0].normal.x < 0.5f) std::swap(found[0], found[1]);
                EXPECT_EQ(found[0].normal, Vec3(1, 0, 0));
                EXPECT_EQ(found[1].normal, Vec3(0, 1, 0));
                EXPECT_FLOAT_EQ(found[0].depth, sunk_x);
                EXPECT_FLOAT_EQ(found[1].depth, sunk_y);
                EXPECT_EQ(found[0].points, 4u);
                EXPECT_EQ(found[1].points, 4u);
            }
    // Sides that are flush, and face the same direction, are no contact.
    const Mesh floor = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    int visits = 0;
    each_contact(solid(floor), at(solid(box), Pose3{{0, 0.875f, 0}}), [&](const Contact<3>& contact) {
        ++visits;
        EXPECT_EQ(contact.normal, Vec3(0, 1, 0));
    });
    EXPECT_EQ(visits, 1);
}

TEST(SolidContact, OfViewsAndOwners) {
    const Mesh t = mesh_of(scenes::kit()[0]);
    const Pose3 beside{{2.75f, 0, 0}};
    const auto owner = at(solid(mesh_of(scenes::kit()[0])), beside);
    EXPECT_EQ(closest(solid(t), owner).distance, -0.25f);
    EXPECT_EQ(closest(AnyShape<3>(solid(t)), AnyShape<3>(owner)).distance, -0.25f);
    EXPECT_EQ(closest(solid(t), stretched(owner, Vec3(1, 0.5f, 1))).distance, -0.25f);
    // The ball is added to the triangles, so that the sum has no inside; the other one still has.
    EXPECT_NEAR(closest(rounded(solid(t), 0.125f), owner).distance, -0.375f, 1e-5);
    EXPECT_EQ(closest(rounded(solid(t), 0.125f), at(t, beside)).distance,
              closest(rounded(t, 0.125f), at(t, beside)).distance);
    World3 world;
    world.add(solid(t), {.fixed = true});
    world.add(solid(t), {.pose = beside});
    world.update();
    ASSERT_EQ(world.contacts().size(), 1u);
    const Contact<3>& touch = world.contacts()[0].contact;
    EXPECT_EQ(touch.depth, 0.25f);
    EXPECT_EQ(touch.points.size(), 4u);
}

TEST(MeshContact, OfOpenMeshesAgreesWithClosest) {
    // The depth was that of another pair of triangles, whose normal is one of the whole surface.
    constexpr std::uint64_t seed = 20265;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const Kit kit;
    int touching = 0;
    for (int i = 0; i < 400; ++i) {
        const KitPair pair(kit, random);
        const Pose3 turned{pair.b.position, random.chance(0.5) ? random.rotation<3>() : glm::quat(1, 0, 0, 0)};
        const auto a = at(kit.meshes[pair.a.piece], Pose3{pair.a.position});
        const auto b = at(kit.meshes[pair.b.piece], turned);
        const Contact<3> touch = contact(a, b);
        if (!touch) continue;
        ++touching;
        SCOPED_TRACE(pair.text(kit));
        const Closest<3> nearest = closest(a, b);
        ASSERT_NEAR(touch.depth, -nearest.distance, 2e-5);
        if (nearest.distance < -1e-4f) {
            ASSERT_GT(glm::dot(touch.normal, nearest.normal), 0.999f);
            const auto part = [](const auto& shape, const Feature& feature) {
                return at(shape.shape.triangle(feature.part), shape.pose);
            };
            Pose3 away = turned;
            away.position += touch.normal * touch.depth;
            const auto moved = at(kit.meshes[pair.b.piece], away);
            EXPECT_GE(closest(part(a, touch.feature_a), part(moved, touch.feature_b)).distance, -1e-4f);
        }
    }
    EXPECT_GT(touching, 100);
}

/// A surface that isn't closed: a bumpy ball with holes, a sheet of waves, or triangles anywhere.
Mesh open_mesh(oracle::Random& random) {
    Surface surface;
    const std::uint32_t kind = random.below(3);
    if (kind == 0) {
        const scenes::BumpyBall ball = scenes::bumpy_ball(6, 0.3, 0.05, random);
        surface.points = ball.points;
        for (const glm::uvec3& t : ball.triangles)
            if (random.chance(0.8)) surface.triangles.push_back(t);
    } else if (kind == 1) {
        for (std::uint32_t i = 0; i < 36; ++i)
            surface.points.emplace_back(0.4f * static_cast<float>(i % 6) - 1, random.uniform_float(-0.2f, 0.2f),
                                        0.4f * static_cast<float>(i / 6) - 1);
        for (std::uint32_t i = 0; i < 35; ++i) {
            if (i % 6 == 5 || i >= 30) continue;
            surface.triangles.emplace_back(i, i + 1, i + 7);
            surface.triangles.emplace_back(i, i + 7, i + 6);
        }
    } else {
        for (std::uint32_t i = 0; i < 30; ++i) {
            surface.points.push_back(to_float(random.in_cube<3>()));
            if (i % 3 == 2) surface.triangles.emplace_back(i - 2, i - 1, i);
        }
    }
    return surface.mesh();
}

TEST(MeshContact, OfRandomOpenMeshesPartsTheDeepestPair) {
    constexpr std::uint64_t seed = 20273;
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const int pairs = oracle::is_long() ? 10'000 : 500;
    int touching = 0, ties = 0;
    for (int i = 0; i < pairs; ++i) {
        SCOPED_TRACE(i);
        const Mesh mesh_a = open_mesh(random), mesh_b = open_mesh(random);
        const Pose3 pose{to_float(random.in_cube<3>() * 1.5), random.rotation<3>()};
        const auto b = at(mesh_b, pose);
        const Closest<3> nearest = closest(mesh_a, b);
        const Contact<3> touch = contact(mesh_a, b);
        ASSERT_EQ(static_cast<bool>(touch), nearest.distance <= 0);
        if (!touch) continue;
        ++touching;
        ASSERT_NEAR(touch.depth, -nearest.distance, 2e-5);
        if (glm::dot(touch.normal, nearest.normal) < 0.999f) ++ties;
        // Both name a pair of triangles, and the move parts that pair. No other pair is deeper.
        const auto depth_of = [&](const Feature& of_a, const Feature& of_b, const Vec3& move) {
            return -closest(mesh_a.triangle(of_a.part),
                            at(mesh_b.triangle(of_b.part), Pose3{pose.position + move, pose.rotation}))
                        .distance;
        };
        EXPECT_NEAR(depth_of(touch.feature_a, touch.feature_b, Vec3(0)), touch.depth, 2e-5);
        EXPECT_LE(depth_of(touch.feature_a, touch.feature_b, touch.normal * touch.depth), 2e-5);
        EXPECT_LE(depth_of(nearest.feature_a, nearest.feature_b, nearest.normal * -nearest.distance), 2e-5);
        float deepest = 0;
        for (std::uint32_t x = 0; x < mesh_a.triangles().size(); ++x)
            for (std::uint32_t y = 0; y < mesh_b.triangles().size(); ++y)
                deepest = std::max(deepest, depth_of({x, 0, FeatureKind::face}, {y, 0, FeatureKind::face}, Vec3(0)));
        EXPECT_NEAR(deepest, touch.depth, 2e-5);
    }
    EXPECT_GT(touching, pairs / 4);
    EXPECT_LE(ties, touching / 100);
}

}  // namespace
}  // namespace abut::test
