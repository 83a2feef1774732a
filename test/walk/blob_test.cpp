// Saving and loading of walk meshes.

#include "../oracle/random.hpp"
#include "../oracle/seal.hpp"
#include "../shape/meshes.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/data.hpp>
#include <abut/walk/file.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using test::built;
using test::Surface;

using Bytes = std::vector<std::byte>;

/// A mesh with all special cases: a repeated and a flat triangle, a reversed one, a component of one, non-manifold
/// edges, an unused point, and -0.
Surface odd() {
    Surface result;
    result.points = {{0, 0, -0.0f}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}, {4, 0, 1}, {4, 2, 1},
                     {2, 0, 3},     {9, 9, 9}, {9, 8, 9}, {8, 8, 9}, {5, 5, 5}, {2, 0, 0}, {2, 2, -0.0f}};
    result.triangles = {{0, 1, 2},  {2, 3, 4},   {4, 3, 0}, {0, 2, 4},  {2, 1, 0},
                        {12, 5, 6}, {6, 12, 13}, {1, 2, 7}, {8, 9, 10}, {7, 7, 3}};
    return result;
}

std::vector<std::uint8_t> areas_of(std::size_t count) {
    std::vector<std::uint8_t> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<std::uint8_t>(7 * i));
    return result;
}

std::vector<Vec3> normals_of(const Surface& surface) {
    std::vector<Vec3> result;
    for (const Vec3& p : surface.points) result.push_back(Vec3(p.y, 0.3f * p.x, 2 * p.z));
    return result;
}

template <class T>
bool same_bits(const T& a, const T& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

void expect_same(const MeshTree& a, const MeshTree& b) {
    EXPECT_TRUE(same_bits(a.nodes, b.nodes));
    EXPECT_TRUE(same_bits(a.order, b.order));
    ASSERT_EQ(a.leaves.size(), b.leaves.size());
    for (std::size_t i = 0; i < a.leaves.size(); ++i)
        ASSERT_EQ(std::memcmp(&a.leaves[i], &b.leaves[i], offsetof(MeshLeaf, extent) + sizeof(float)), 0) << i;
    EXPECT_EQ(a.roots[0].ref, b.roots[0].ref);
    EXPECT_EQ(a.roots[0].box, b.roots[0].box);
    EXPECT_EQ(a.middle, b.middle);
    EXPECT_EQ(a.off_center, b.off_center);
    EXPECT_EQ(a.spread, b.spread);
}

void expect_same(const WalkMesh& mesh) {
    const Bytes bytes = save(mesh);
    const Result<WalkMesh> again = load_walk_mesh(bytes);
    ASSERT_TRUE(again) << again.problem().message;
    EXPECT_EQ(save(*again), bytes);
    const WalkMeshData &a = mesh.data(), &b = again->data();
    EXPECT_EQ(b.report, a.report) << described(b.report);
    EXPECT_TRUE(same_bits(a.points, b.points));
    EXPECT_TRUE(same_bits(a.triangles, b.triangles));
    EXPECT_TRUE(same_bits(a.walk, b.walk));
    EXPECT_TRUE(same_bits(a.components, b.components));
    EXPECT_TRUE(same_bits(a.normals, b.normals));
    EXPECT_TRUE(same_bits(a.corner_normals, b.corner_normals));
    EXPECT_EQ(a.given_normals, b.given_normals);
    EXPECT_EQ(a.given_areas, b.given_areas);
    EXPECT_EQ(a.bounds, b.bounds);
    expect_same(a.tree, b.tree);
    EXPECT_EQ(a.leaf_of, b.leaf_of);
}

ProblemCode code_of(const Bytes& bytes) {
    const Result<WalkMesh> result = load_walk_mesh(bytes);
    EXPECT_FALSE(result);
    if (result) return ProblemCode::cancelled;
    EXPECT_FALSE(result.problem().message.empty());
    EXPECT_EQ(result.problem().message.find('\n'), std::string::npos);
    return result.problem().code;
}

TEST(WalkBlob, IsTheSameMeshAgain) {
    const Surface mixed = odd();
    const WalkMesh mesh = built(mixed);
    const WalkMeshReport& report = mesh.report();
    EXPECT_GT(report.duplicates, 0u);
    EXPECT_GT(report.flat, 0u);
    EXPECT_GT(report.left_out, 0u);
    EXPECT_GT(report.turned, 0u);
    EXPECT_GT(report.non_manifold_edges, 0u);
    EXPECT_GT(report.components, 1u);
    expect_same(mesh);
    expect_same(built(mixed, normals_of(mixed)));
    expect_same(built(mixed, {}, areas_of(mixed.triangles.size())));
    expect_same(built(mixed, normals_of(mixed), areas_of(mixed.triangles.size())));
    const WalkMesh strip = built(test::twisted_strip(12, 1, 1));
    EXPECT_GT(strip.report().mirrored, 0u);
    expect_same(strip);
    expect_same(built(test::reversed(test::box_surface({-1, -2, -3}, {1, 2, 3}))));
}

TEST(WalkBlob, IsTheSameMeshAgainForAnyTriangles) {
    std::size_t turned = 0, non_manifold_vertices = 0, non_manifold_edges = 0, mirrored = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        // Few distinct coordinates, so that points, edges and triangles repeat.
        Surface soup;
        const std::uint32_t points = 5 + random.below(12);
        for (std::uint32_t i = 0; i < points; ++i) {
            Vec3 p;
            for (int a = 0; a < 3; ++a) p[a] = static_cast<float>(random.below(3)) - 1;
            soup.points.push_back(p * random.uniform_float(0.999, 1.0001));
            if (random.chance(0.5)) soup.points.back() = p;
        }
        const std::uint32_t triangles = 1 + random.below(40);
        for (std::uint32_t i = 0; i < triangles; ++i) {
            glm::uvec3 t;
            for (int k = 0; k < 3; ++k) t[k] = random.below(points);
            soup.triangles.push_back(t);
        }
        const bool with_normals = random.chance(0.3), with_areas = random.chance(0.3);
        const std::vector<Vec3> normals = with_normals ? normals_of(soup) : std::vector<Vec3>{};
        const std::vector<std::uint8_t> areas = with_areas ? areas_of(triangles) : std::vector<std::uint8_t>{};
        const Result<WalkMesh> mesh = WalkMesh::build(soup.points, soup.triangles, normals, areas);
        if (!mesh) continue;
        turned += mesh->report().turned;
        non_manifold_vertices += mesh->report().non_manifold_vertices;
        non_manifold_edges += mesh->report().non_manifold_edges;
        mirrored += mesh->report().mirrored;
        expect_same(*mesh);
    }
    EXPECT_GT(turned, 100u);
    EXPECT_GT(non_manifold_vertices, 100u);
    EXPECT_GT(non_manifold_edges, 100u);
    EXPECT_GT(mirrored, 20u);
}

TEST(WalkBlob, IsTheSameMeshAgainWhereThereIsMuch) {
    Random random(3);
    const test::Terrain terrain = test::random_terrain(random, 60, 0.7);
    expect_same(built(terrain.surface()));
    expect_same(built(terrain.solid(-2)));
}

TEST(WalkBlob, HasTheSameBytesOnEveryMachine) {
    // A few numbers that are exact, so that the test pins only the layout.
    Surface surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}};
    surface.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}};
    const std::vector<Vec3> normals(4, Vec3(0, 0, 2));
    const std::vector<std::uint8_t> areas{1, 2, 3};
    const Bytes bytes = save(built(surface, normals, areas));
    EXPECT_EQ(bytes.size(), 8u + 4 + 2 + 5 * 8 + 5 * 8 + 4 * 12 + 3 * 12 + 3 * 12 + 4 * 12 + 3 + 2 * (4 + 2) + 1 + 8);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    EXPECT_EQ(hash, 3041858745794405868u);
}

TEST(WalkBlob, CutShortOrDamagedIsRefused) {
    const Surface mixed = odd();
    const Bytes bytes = save(built(mixed, normals_of(mixed), areas_of(mixed.triangles.size())));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        ASSERT_EQ(code_of(cut), ProblemCode::bad_format) << size;
        ASSERT_EQ(is_walk_mesh(cut), size >= 8) << size;
    }
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes damaged = bytes;
        damaged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        ASSERT_EQ(code_of(damaged), ProblemCode::bad_format) << bit;
        ASSERT_EQ(is_walk_mesh(damaged), bit >= 64) << bit;
    }
    Bytes longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_EQ(code_of(longer), ProblemCode::bad_format);
}

/// Two triangles in a square, and a third that repeats one of them.
class ForgedWalkBlob : public testing::Test {
protected:
    ForgedWalkBlob() {
        Surface surface;
        surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        surface.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}};
        const std::vector<Vec3> up(4, Vec3(0, 0, 1));
        bytes = save(built(surface, up, areas_of(3)));
    }
    template <class T>
    std::string refused(std::size_t at, T value) const {
        Bytes result = bytes;
        std::memcpy(result.data() + at, &value, sizeof(value));
        EXPECT_NE(result, bytes) << "it is changed to what it was";
        oracle::seal(result);
        const Result<WalkMesh> mesh = load_walk_mesh(result);
        EXPECT_FALSE(mesh) << "at " << at;
        return mesh ? "" : mesh.problem().message;
    }

    static constexpr std::size_t version = 8, flags = 12, counts = 14, sizes = 54, points = 94, triangles = 142,
                                 links = 178, normals = 214, order = 265, corners = 273, leaf = 277;
    static constexpr std::uint32_t border = WalkLink::none, left_out = WalkLink::none - 1;
    Bytes bytes;
};

TEST_F(ForgedWalkBlob, SaysOfItselfWhatIsTrue) {
    if constexpr (std::endian::native != std::endian::little) GTEST_SKIP() << "numbers are put in as they are here";
    Bytes same = bytes;
    oracle::seal(same);
    EXPECT_EQ(same, bytes);
    EXPECT_EQ(refused(version, 2u), "the walk mesh has an unknown version");
    EXPECT_EQ(refused(flags, std::uint8_t{2}), "the walk mesh is of an unknown kind");
    EXPECT_EQ(refused(flags, std::uint8_t{0}), "the walk mesh has extra bytes at its end");
    for (std::size_t i = 0; i < 5; ++i)
        for (const std::uint64_t count : {std::uint64_t{4}, std::uint64_t{1} << 40, UINT64_MAX})
            EXPECT_EQ(refused(counts + 8 * i, count), "the counts of the walk mesh contradict its triangles") << i;
    EXPECT_EQ(refused(counts, std::uint64_t{0}), "the counts of the walk mesh contradict its triangles");
    for (std::size_t i = 0; i < 5; ++i)
        for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{1} << 40, UINT64_MAX})
            EXPECT_EQ(refused(sizes + 8 * i, count), "the walk mesh is truncated") << i;
}

TEST_F(ForgedWalkBlob, HasTrianglesThatThereCanBe) {
    if constexpr (std::endian::native != std::endian::little) GTEST_SKIP() << "numbers are put in as they are here";
    EXPECT_EQ(refused(points + 4, std::numeric_limits<float>::quiet_NaN()),
              "point 0 has a coordinate that is not finite");
    EXPECT_EQ(refused(points + 4, 2e15f), "point 0 has a coordinate above 1e15");
    EXPECT_EQ(refused(triangles + 4, 4u), "triangle 0 names point 4 of 4");
    EXPECT_EQ(refused(triangles + 4, 0u), "triangle 0 of the walk mesh has no area");
    EXPECT_EQ(refused(normals + 8, 0.5f), "normal 0 of the walk mesh is not of unit length");
    EXPECT_EQ(refused(normals + 8, std::numeric_limits<float>::infinity()), "normal 0 is not finite");
}

TEST_F(ForgedWalkBlob, GoesOnInWhatIsBesideIt) {
    if constexpr (std::endian::native != std::endian::little) GTEST_SKIP() << "numbers are put in as they are here";
    const auto wrong = [](int triangle) {
        return "triangle " + std::to_string(triangle) + " of the walk mesh is linked to a side that isn't adjacent";
    };
    // Side 2 of triangle 0 is side 0 of triangle 1.
    std::uint32_t code = 0;
    std::memcpy(&code, bytes.data() + links + 8, 4);
    ASSERT_EQ(code, WalkLink::to(1, 0, false).code);
    EXPECT_EQ(refused(links + 8, border), wrong(1)) << "not in reverse";
    EXPECT_EQ(refused(links + 8, WalkLink::to(1, 1, false).code), wrong(0)) << "another side";
    EXPECT_EQ(refused(links + 8, WalkLink::to(1, 3, false).code), wrong(0)) << "no side";
    EXPECT_EQ(refused(links + 8, WalkLink::to(1, 0, true).code), wrong(0)) << "in reverse";
    EXPECT_EQ(refused(links + 8, WalkLink::to(2, 0, false).code), wrong(0)) << "one that is left out";
    EXPECT_EQ(refused(links + 8, WalkLink::to(3, 0, false).code), wrong(0)) << "one that there isn't";
    EXPECT_EQ(refused(links + 8, left_out), wrong(0)) << "half of the code of a left-out triangle";
    EXPECT_EQ(refused(links + 0, WalkLink::to(0, 0, true).code), wrong(0)) << "itself";
    EXPECT_EQ(refused(links + 0, WalkLink::to(1, 1, false).code), wrong(0));
    EXPECT_EQ(refused(links + 0, 0x7fffffffu), wrong(0));

    // The two sides link to each other, but aren't at one place.
    Bytes twisted = bytes;
    const std::uint32_t to_one = WalkLink::to(1, 1, false).code, to_zero = WalkLink::to(0, 0, false).code;
    std::memcpy(twisted.data() + links, &to_one, 4);
    std::memcpy(twisted.data() + links + 12 + 4, &to_zero, 4);
    oracle::seal(twisted);
    const Result<WalkMesh> mesh = load_walk_mesh(twisted);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.problem().message, wrong(0));

    // A linked side may become a border: another valid mesh.
    Bytes parted = bytes;
    std::memcpy(parted.data() + links + 8, &border, 4);
    std::memcpy(parted.data() + links + 12, &border, 4);
    oracle::seal(parted);
    const Result<WalkMesh> two = load_walk_mesh(parted);
    ASSERT_TRUE(two) << two.problem().message;
    EXPECT_EQ(two->report().components, 2u);
    EXPECT_EQ(two->report().border, 6u);
    EXPECT_EQ(save(*two), parted);
}

TEST_F(ForgedWalkBlob, HasATreeOfItsTriangles) {
    if constexpr (std::endian::native != std::endian::little) GTEST_SKIP() << "numbers are put in as they are here";
    const std::string wrong = "the tree of the walk mesh doesn't match its triangles";
    EXPECT_EQ(refused(order, 1u), wrong) << "twice the same";
    EXPECT_EQ(refused(order, 2u), wrong) << "one that is left out";
    EXPECT_EQ(refused(order, 3u), wrong) << "one that there isn't";
    EXPECT_EQ(refused(corners, std::uint16_t{0}), wrong) << "one number for three corners";
    EXPECT_EQ(refused(leaf, std::uint8_t{1}), wrong) << "one is in no leaf";
    EXPECT_EQ(refused(leaf, std::uint8_t{3}), wrong);
}

TEST_F(ForgedWalkBlob, IsWalkedOnSomewhere) {
    Bytes none = bytes;
    for (std::size_t i = 0; i < 9; ++i) std::memcpy(none.data() + links + 4 * i, &left_out, 4);
    oracle::seal(none);
    const Result<WalkMesh> mesh = load_walk_mesh(none);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.problem().message, "no triangle of the walk mesh is walkable");
}

}  // namespace
}  // namespace abut
