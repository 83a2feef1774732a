// Every builder gives the same shape for the vectors of glm and for the same points in a vertex buffer.
#include "../oracle/random.hpp"
#include <abut/bake.hpp>
#include <abut/field/file.hpp>
#include <abut/math/point_span.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/weld.hpp>
#include <abut/walk/file.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace game {
namespace {

struct Vec2 {
    float x, y;
};
struct Vec3 {
    float x, y, z;
};
struct Vertex {
    std::uint32_t color;
    Vec3 position;
    Vec3 normal;
    std::uint32_t more;
};
static_assert(sizeof(Vertex) == 32);
struct Padded {
    float x, y, z, w;
};
struct Double {
    double x, y, z;
};
struct Reordered {
    float z, y, x;
};

}  // namespace
}  // namespace game

namespace abut::test {
namespace {

static_assert(std::convertible_to<std::vector<game::Vec3>, PointSpan<3>>);
static_assert(std::convertible_to<std::vector<game::Padded>, PointSpan<3>>);
static_assert(std::convertible_to<std::array<game::Vec2, 3>, PointSpan<2>>);
static_assert(!std::convertible_to<std::vector<game::Vec3>, PointSpan<2>>);
static_assert(!std::convertible_to<std::vector<game::Vec2>, PointSpan<3>>);
static_assert(!std::convertible_to<std::vector<game::Double>, PointSpan<3>>);
static_assert(!std::convertible_to<std::vector<game::Reordered>, PointSpan<3>>);
static_assert(!std::convertible_to<std::vector<Vec2>, PointSpan<3>>);
static_assert(!std::convertible_to<std::vector<float>, PointSpan<3>>);

// A tetrahedron, closed and oriented outwards.
const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const std::vector<glm::uvec3> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
const std::vector<Vec2> outline{{0, 0}, {4, 0}, {4, 3}, {1, 1}, {0, 3}};

std::vector<game::Vertex> interleaved() {
    std::vector<game::Vertex> result;
    for (const Vec3& point : points) result.push_back({0xffffffff, {point.x, point.y, point.z}, {0, 1, 0}, 0xffffffff});
    return result;
}
std::vector<Vec3> all_of(const PointSpan<3>& span) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < span.size(); ++i) result.push_back(span[i]);
    return result;
}

TEST(PointSpan, Views) {
    const std::vector<game::Vertex> buffer = interleaved();
    EXPECT_EQ(all_of({&buffer[0].position.x, buffer.size(), sizeof(game::Vertex)}), points);
    EXPECT_EQ(all_of({&points[0].x, points.size()}), points);
    EXPECT_EQ(all_of(points), points);
    EXPECT_EQ(all_of({points.data(), 2}), std::vector<Vec3>(points.begin(), points.begin() + 2));
    EXPECT_EQ(all_of({points.begin() + 1, points.end()}), std::vector<Vec3>(points.begin() + 1, points.end()));
    const game::Vec3 own[]{{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(all_of(own), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(all_of(std::array{game::Padded{1, 2, 3, 9}, game::Padded{4, 5, 6, 9}}),
              (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_TRUE(PointSpan<3>().empty());
    EXPECT_TRUE(PointSpan<3>(std::vector<game::Vec3>()).empty());
    EXPECT_TRUE(PointSpan<3>(nullptr, 0, 12).empty());
}

// Points at any address, as in a file that was read as it is.
TEST(PointSpan, NeedsNoAlignment) {
    std::vector<std::byte> bytes(1 + points.size() * 13);
    for (std::size_t i = 0; i < points.size(); ++i) std::memcpy(bytes.data() + 1 + i * 13, &points[i], 12);
    const auto* first = reinterpret_cast<const float*>(bytes.data() + 1);
    EXPECT_EQ(all_of({first, points.size(), 13}), points);
}

TEST(PointSpan, BuildsTheSameShapes) {
    const std::vector<game::Vertex> buffer = interleaved();
    const PointSpan<3> strided(&buffer[0].position.x, buffer.size(), sizeof(game::Vertex));
    std::vector<game::Vec2> own_outline;
    for (const Vec2& point : outline) own_outline.push_back({point.x, point.y});

    EXPECT_EQ(save(*Mesh::build(strided, triangles)), save(*Mesh::build(points, triangles)));
    EXPECT_EQ(save(*Polyhedron::build(strided)), save(*Polyhedron::build(points)));
    EXPECT_EQ(save(*Polyhedron::build(strided, {.max_vertices = 4})),
              save(*Polyhedron::build(points, {.max_vertices = 4})));
    EXPECT_EQ(save(*Polygon::build(own_outline)), save(*Polygon::build(outline)));
    EXPECT_EQ(save(*Chain::build(own_outline, true)), save(*Chain::build(outline, true)));
    EXPECT_EQ(save(*SolidBsp<3>::build(strided, triangles)), save(*SolidBsp<3>::build(points, triangles)));
    EXPECT_EQ(weld(strided, triangles).points, weld(points, triangles).points);

    const Result<WalkMesh> walk = WalkMesh::build(strided, triangles, {&buffer[0].normal.x, buffer.size(), 32});
    const std::vector<Vec3> up(4, Vec3(0, 1, 0));
    EXPECT_EQ(save(*walk), save(*WalkMesh::build(points, triangles, up)));
}

TEST(PointSpan, BakesTheSame) {
    const std::vector<game::Vertex> buffer = interleaved();
    const PointSpan<3> strided(&buffer[0].position.x, buffer.size(), sizeof(game::Vertex));
    std::vector<game::Vec2> own_outline;
    for (const Vec2& point : outline) own_outline.push_back({point.x, point.y});

    EXPECT_EQ(save(*bake_field(strided, triangles, {.cell = 0.5f})),
              save(*bake_field(points, triangles, {.cell = 0.5f})));
    EXPECT_EQ(save(*bake_field(own_outline, {}, {.cell = 0.5f})), save(*bake_field(outline, {}, {.cell = 0.5f})));
    EXPECT_EQ(repair(strided, triangles)->points, repair(points, triangles)->points);
    const auto parts = decompose(strided, triangles);
    ASSERT_EQ(parts->size(), 1u);
    EXPECT_EQ(save(parts->front()), save(decompose(points, triangles)->front()));
    const auto pieces = decompose(own_outline), same = decompose(outline);
    ASSERT_EQ(pieces->size(), same->size());
    for (std::size_t i = 0; i < pieces->size(); ++i) EXPECT_EQ(save((*pieces)[i]), save((*same)[i]));
}

TEST(PointSpan, ProblemsNameThePoint) {
    std::vector<game::Vertex> buffer = interleaved();
    buffer[2].position.y = std::numeric_limits<float>::quiet_NaN();
    const auto mesh = Mesh::build({&buffer[0].position.x, buffer.size(), sizeof(game::Vertex)}, triangles);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.problem().code, ProblemCode::not_finite);
    EXPECT_EQ(mesh.problem().index, 2u);
}

TEST(PointSpan, FlatIndices) {
    const std::vector<std::uint32_t> flat{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const auto view = as_triangles(flat);
    EXPECT_TRUE(std::equal(view.begin(), view.end(), triangles.begin(), triangles.end()));
    EXPECT_TRUE(as_triangles({}).empty());
}

}  // namespace
}  // namespace abut::test
