// Queries of meshes against a reference over all triangles: the least answer, bit for bit, and the reported part
// attains it.

#include "../world/support/random_shapes.hpp"
#include "meshes.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>

#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// Counts of the kinds of answers.
struct AnswerCounts {
    int gaps = 0, depths = 0, filtered = 0, hits = 0, misses = 0;
};

/// All triangles of a mesh with its pose.
struct Parts {
    std::vector<View<3>> views;

    template <class Place>
    Parts(const std::vector<Triangle3>& triangles, Place place) {
        for (const Triangle3& triangle : triangles) views.push_back(view(place(triangle)));
    }
};

std::vector<Triangle3> triangles_of(const Mesh& mesh) {
    std::vector<Triangle3> result;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) result.push_back(mesh.triangle(i));
    return result;
}

/// A lower bound of the distance of two boxes.
double gap(const Aabb3& a, const Aabb3& b) {
    double widest = 0;
    for (int i = 0; i < 3; ++i)
        widest = std::max({widest, static_cast<double>(a.min[i]) - static_cast<double>(b.max[i]),
                           static_cast<double>(b.min[i]) - static_cast<double>(a.max[i])});
    return widest;
}

/// The least distance over all parts; a part whose box is farther away is skipped.
float min_distance(const Parts& parts, const View<3>& other) {
    const Aabb3 box = bounds(other);
    float least = std::numeric_limits<float>::infinity();
    for (const View<3>& part : parts.views)
        if (gap(bounds(part), box) * (1 - 1e-6) <= static_cast<double>(std::max(least, 0.0f)))
            least = std::min(least, closest(part, other).distance);
    return least;
}

void check_closest(const View<3>& mesh, const Parts& parts, const View<3>& other, AnswerCounts& seen) {
    const float expected = min_distance(parts, other);
    const Closest<3> found = closest(mesh, other), swapped = closest(other, mesh);
    ASSERT_EQ(found.distance, expected);
    const Closest<3> part = closest(parts.views.at(found.feature_a.part), other);
    EXPECT_EQ(part.distance, expected) << "part " << found.feature_a.part;
    EXPECT_EQ(part.normal, found.normal);
    EXPECT_EQ(part.on_a, found.on_a);
    EXPECT_EQ(part.on_b, found.on_b);
    EXPECT_EQ(part.feature_a.kind, found.feature_a.kind);
    EXPECT_EQ(closest(other, parts.views.at(swapped.feature_b.part)).distance, swapped.distance);
    ++(expected > 0 ? seen.gaps : seen.depths);

    const bool touches = expected <= 0;
    EXPECT_EQ(overlaps(mesh, other), touches) << expected;
    EXPECT_EQ(overlaps(other, mesh), touches) << expected;
    const Contact<3> touch = contact(mesh, other);
    ASSERT_EQ(static_cast<bool>(touch), touches) << expected;
    if (!touches) return;
    if (touch.depth != -expected) {
        // The internal-edge filter removed the deepest triangle's normal: then the answer is the deepest of the others.
        float deepest = -std::numeric_limits<float>::infinity();
        each_contact(mesh, other, [&](const Contact<3>& one) { deepest = std::max(deepest, one.depth); });
        EXPECT_EQ(touch.depth, deepest);
        ++seen.filtered;
        return;
    }
    // A triangle alone may have another separating plane than one among the parts of a composite shape.
    if (std::holds_alternative<Composite<3>>(other)) return;
    const Contact<3> part_contact = contact(parts.views.at(touch.feature_a.part), other);
    EXPECT_EQ(part_contact.depth, touch.depth) << "part " << touch.feature_a.part;
    EXPECT_EQ(part_contact.normal, touch.normal);
    // The points are those of all triangles on this plane.
    const auto deepest_of = [](const Contact<3>& one) {
        float result = -std::numeric_limits<float>::infinity();
        for (const ContactPoint<3>& point : one.points) result = std::max(result, point.depth);
        return result;
    };
    EXPECT_EQ(deepest_of(touch), deepest_of(part_contact));
}

void check_raycast(const View<3>& mesh, const Parts& parts, const Ray3& ray, AnswerCounts& seen) {
    const Hit<3>* first = nullptr;
    std::vector<Hit<3>> hits;
    hits.reserve(parts.views.size());
    for (const View<3>& part : parts.views)
        if (const auto hit = raycast(ray, part)) {
            hits.push_back(*hit);
            if (first == nullptr || hit->distance < first->distance) first = &hits.back();
        }
    const auto found = raycast(ray, mesh);
    ASSERT_EQ(found.has_value(), first != nullptr);
    ++(found ? seen.hits : seen.misses);
    if (!found) return;
    ASSERT_EQ(found->distance, first->distance);
    const auto part = raycast(ray, parts.views.at(found->feature.part));
    ASSERT_TRUE(part) << "part " << found->feature.part;
    EXPECT_EQ(part->distance, found->distance);
    EXPECT_EQ(part->point, found->point);
    EXPECT_EQ(part->normal, found->normal);
    EXPECT_EQ(part->started_inside, found->started_inside);
}

/// Random shapes and rays near a mesh of size about 1, placed by `place`.
template <class Place>
void check_placed(oracle::Random& random, const Mesh& mesh, Place place, AnswerCounts& seen) {
    const std::vector<Triangle3> triangles = triangles_of(mesh);
    const Parts parts(triangles, place);
    const auto placed = place(mesh);
    const View<3> as_view = view(placed);
    const Aabb3 box = bounds(as_view);
    const Vec3 middle = center(box);
    const double reach =
        0.45 * static_cast<double>(std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z}));
    for (int i = 0; i < 6; ++i) {
        const Pose3 pose{middle + to_float(random.in_cube<3>() * reach), random.rotation<3>()};
        with_random_shape<3>(random, random_kind<3>(random), [&](const auto& shape) {
            const auto other = at(shape, pose);
            check_closest(as_view, parts, view(other), seen);
        });
        const Vec3 from = middle + to_float(random.in_cube<3>() * (2 * reach)),
                   to = middle + to_float(random.in_cube<3>() * (0.5 * reach));
        check_raycast(as_view, parts, Ray3::between(from, to), seen);
    }
}

/// Ways to place a mesh: its triangles have the same pose.
void check_mesh(oracle::Random& random, const Mesh& mesh, AnswerCounts& seen) {
    const Pose3 pose = random_pose<3>(random, 5), inner = random_pose<3>(random, 2);
    const Vec3 scale = random_scale(random);
    check_placed(
        random, mesh, [](const auto& s) { return at(s, {}); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return at(s, pose); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return stretched(s, scale); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return at(stretched(at(s, inner), scale), pose); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return at(rounded(s, 0.3f), pose); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return rounded(at(stretched(s, scale), pose), 0.2f); }, seen);
    check_placed(
        random, mesh, [&](const auto& s) { return stretched(rounded(s, 0.2f), scale); }, seen);
}

void expect_both_kinds(const AnswerCounts& seen) {
    std::cout << "gaps " << seen.gaps << ", depths " << seen.depths << ", filtered " << seen.filtered << ", hits "
              << seen.hits << ", misses " << seen.misses << "\n";
    const int pairs = seen.gaps + seen.depths, rays = seen.hits + seen.misses;
    EXPECT_GT(seen.gaps, pairs / 5);
    EXPECT_GT(seen.depths, pairs / 5);
    EXPECT_LT(seen.filtered, seen.depths / 2);
    EXPECT_GT(seen.hits, rays / 5);
    EXPECT_GT(seen.misses, rays / 10);
}

TEST(MeshQuery, SoupAgreesWithItsTriangles) {
    oracle::Random random(1);
    AnswerCounts seen;
    for (int i = 0; i < 20; ++i) check_mesh(random, random_soup(random, 30, 1, 1).mesh(), seen);
    expect_both_kinds(seen);
}

TEST(MeshQuery, ClosedMeshAgreesWithItsTriangles) {
    oracle::Random random(2);
    AnswerCounts seen;
    for (int i = 0; i < 10; ++i) check_mesh(random, house(random.uniform_float(0.5, 2)), seen);
    expect_both_kinds(seen);
}

/// The triangles as a user's own composite shape, unsorted.
struct Heap {
    Mesh mesh;
};
Aabb3 bounds(const Heap& heap) {
    return bounds(heap.mesh);
}
template <class Visit>
void each_part(const Heap& heap, const Aabb3& box, Visit&& visit) {
    for (std::uint32_t i = 0; i < heap.mesh.triangles().size(); ++i)
        if (overlaps(bounds(convex(heap.mesh.triangle(i))), box) && !visit(heap.mesh.triangle(i), i)) return;
}

TEST(MeshQuery, IsLikeTheSameTrianglesInNoOrder) {
    oracle::Random random(6);
    int hits = 0, gaps = 0;
    for (int i = 0; i < 200; ++i) {
        const Heap heap{random_soup(random, 30, 1, 0.6).mesh()};
        static_assert(Shape<Heap>);
        ASSERT_EQ(view(heap).each_part_near, nullptr);
        ASSERT_NE(view(heap.mesh).each_part_near, nullptr);
        const Pose3 pose = random_pose<3>(random, 1.5);
        const Vec3 scale = random_scale(random);
        const Box3 box{to_float(random.in_cube<3>() * 2.5), {0.2f, 0.3f, 0.1f}, random.rotation<3>()};
        const auto ordered = at(stretched(heap.mesh, scale), pose);
        const auto unordered = at(stretched(heap, scale), pose);
        const Closest<3> found = closest(ordered, box), expected = closest(unordered, box);
        EXPECT_EQ(found.distance, expected.distance);
        EXPECT_EQ(closest(box, unordered).distance, expected.distance);
        EXPECT_EQ(closest(unordered, ordered).distance, closest(ordered, ordered).distance);
        gaps += found.distance > 0 ? 1 : 0;
        const Vec3 from = to_float(random.in_cube<3>() * 4.0), to = to_float(random.in_cube<3>());
        const auto hit = raycast(Ray3::between(from, to), ordered), same = raycast(Ray3::between(from, to), unordered);
        ASSERT_EQ(hit.has_value(), same.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_EQ(hit->distance, same->distance);
        EXPECT_EQ(hit->feature, same->feature);
        EXPECT_EQ(hit->normal, same->normal);
    }
    EXPECT_GT(hits, 40);
    EXPECT_GT(gaps, 40);
}

TEST(MeshQuery, MeshAgainstMeshAgreesWithAllPairsOfTriangles) {
    oracle::Random random(3);
    AnswerCounts seen;
    for (int i = 0; i < 60; ++i) {
        const Mesh a = random_soup(random, 20, 1, 0.6).mesh(), b = random_soup(random, 20, 1, 0.6).mesh();
        const Pose3 pose_a = random_pose<3>(random, 1.5), pose_b = random_pose<3>(random, 1.5);
        const Vec3 scale = random_scale(random);
        const auto place_a = [&](const auto& s) { return at(stretched(s, scale), pose_a); };
        const auto place_b = [&](const auto& s) { return at(s, pose_b); };
        const std::vector<Triangle3> triangles_a = triangles_of(a), triangles_b = triangles_of(b);
        const Parts parts_a(triangles_a, place_a), parts_b(triangles_b, place_b);
        const auto mesh_a = place_a(a);
        const auto mesh_b = place_b(b);
        check_closest(view(mesh_a), parts_a, view(mesh_b), seen);
        // Down to single triangles on both sides.
        const Closest<3> found = closest(mesh_a, mesh_b);
        float least = std::numeric_limits<float>::infinity();
        for (const View<3>& part : parts_b.views) least = std::min(least, min_distance(parts_a, part));
        EXPECT_EQ(found.distance, least);
        EXPECT_EQ(closest(parts_a.views[found.feature_a.part], parts_b.views[found.feature_b.part]).distance, least);
    }
    EXPECT_GT(seen.gaps, 10);
    EXPECT_GT(seen.depths, 10);
}

TEST(MeshQuery, TerrainOfTwentyThousandTriangles) {
    oracle::Random random(4);
    const Mesh mesh = random_terrain(random, 100, 2).surface().mesh();
    ASSERT_EQ(mesh.triangles().size(), 20000u);
    const std::vector<Triangle3> triangles = triangles_of(mesh);
    const Pose3 pose{{-50, -50, 0}};
    const auto place = [&](const auto& s) { return at(s, pose); };
    const Parts parts(triangles, place);
    const auto placed = place(mesh);
    AnswerCounts seen;
    for (int i = 0; i < 20; ++i) {
        const Pose3 there{{random.uniform_float(-55, 55), random.uniform_float(-55, 55), random.uniform_float(-1, 4)},
                          random.rotation<3>()};
        with_random_shape<3>(random, random_kind<3>(random), [&](const auto& shape) {
            const auto other = at(shape, there);
            check_closest(view(placed), parts, view(other), seen);
        });
    }
    for (int i = 0; i < 10; ++i) {
        const Vec3 from{random.uniform_float(-60, 60), random.uniform_float(-60, 60), random.uniform_float(3, 10)};
        check_raycast(view(placed), parts, {from, to_float(random.direction<3>()), 100}, seen);
    }
    std::cout << "gaps " << seen.gaps << ", depths " << seen.depths << ", filtered " << seen.filtered << ", hits "
              << seen.hits << ", misses " << seen.misses << "\n";
    EXPECT_GT(seen.gaps, 3);
    EXPECT_GT(seen.depths, 3);
    EXPECT_GT(seen.hits, 1);
}

// Where a vertical ray hits the surface, the height is known in closed form.
TEST(MeshQuery, RaysFindTheHeightOfTerrain) {
    oracle::Random random(5);
    const Terrain terrain = random_terrain(random, 100, 2);
    const Mesh mesh = terrain.surface().mesh();
    for (int i = 0; i < 500; ++i) {
        Vec3 from{random.uniform_float(0, 100), random.uniform_float(0, 100), 10};
        if (i % 5 == 0) from.x = std::floor(from.x);   // on an edge
        if (i % 10 == 0) from.y = std::floor(from.y);  // on a corner
        const double height = terrain.height_at(static_cast<double>(from.x), static_cast<double>(from.y));
        const auto down = raycast({from, {0, 0, -1}}, mesh);
        ASSERT_TRUE(down) << from.x << " " << from.y;
        EXPECT_NEAR(static_cast<double>(down->point.z), height, 1e-5);
        EXPECT_GT(down->normal.z, 0);
        const auto up = raycast({{from.x, from.y, -10}, {0, 0, 1}}, mesh);
        ASSERT_TRUE(up);
        EXPECT_NEAR(static_cast<double>(up->point.z), height, 1e-5);
        EXPECT_LT(up->normal.z, 0) << "the same from both sides";
        EXPECT_FALSE(raycast({from, {0, 0, 1}}, mesh));
    }
}

TEST(MeshQuery, AnswersByHand) {
    const Mesh cube = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    const Sphere ball{{0.5f, 0.5f, 0.5f}, 0.125f};
    EXPECT_FALSE(overlaps(cube, ball)) << "in the open middle: a surface, not a solid";
    EXPECT_EQ(closest(cube, ball).distance, 0.375f);
    EXPECT_EQ(closest(cube, Vec3(0.5f, 0.5f, 2)).distance, 1);
    EXPECT_EQ(closest(cube, Vec3(0.5f, 0.5f, 2)).normal, Vec3(0, 0, 1));
    EXPECT_EQ(closest(cube, Vec3(2, 2, 0.5f)).on_a, Vec3(1, 1, 0.5f));
    const Contact<3> touch = contact(cube, Sphere{{0.75f, 0.25f, 1.5f}, 0.625f});
    ASSERT_TRUE(touch);
    EXPECT_EQ(touch.depth, 0.125f);
    EXPECT_EQ(touch.normal, Vec3(0, 0, 1));
    EXPECT_EQ(cube.triangle(touch.feature_a.part).a.z, 1);
    const auto from_inside = raycast({{0.5f, 0.25f, 0.5f}, {1, 0, 0}}, cube);
    ASSERT_TRUE(from_inside);
    EXPECT_EQ(from_inside->distance, 0.5f);
    EXPECT_EQ(from_inside->normal, Vec3(-1, 0, 0));
    const auto mirrored = stretched(cube, {-2, 1, 1});
    EXPECT_EQ(closest(mirrored, Vec3(-3, 0.5f, 0.5f)).distance, 1);
    EXPECT_EQ(bounds(mirrored).min.x, std::nextafter(-2.0f, -3.0f));
}

}  // namespace
}  // namespace abut::test
