#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

TEST(HeightField, TellsWhatIsWrongAndWhere) {
    const auto problem = [](const std::vector<float>& heights, std::uint32_t columns, Vec2 cell,
                            const std::vector<std::uint32_t>& holes = {}) {
        const Result<HeightField> built = HeightField::build(heights, columns, cell, {.holes = holes});
        EXPECT_FALSE(built);
        return built ? Problem{} : built.problem();
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> six(6, 0);
    EXPECT_EQ(problem({}, 2, Vec2(1)).code, ProblemCode::empty_input);
    EXPECT_EQ(problem(six, 0, Vec2(1)).code, ProblemCode::bad_argument);
    EXPECT_EQ(problem(six, 1, Vec2(1)).code, ProblemCode::bad_argument);
    EXPECT_EQ(problem(six, 4, Vec2(1)).code, ProblemCode::bad_argument);
    EXPECT_EQ(problem(six, 6, Vec2(1)).code, ProblemCode::bad_argument);
    for (const Vec2 cell : {Vec2(0, 1), Vec2(1, -1), Vec2(1, infinity), Vec2(3e38f, 1)})
        EXPECT_EQ(problem(six, 3, cell).code, ProblemCode::bad_argument);
    std::vector<float> wrong = six;
    wrong[3] = -infinity;
    EXPECT_EQ(problem(wrong, 3, Vec2(1)).code, ProblemCode::not_finite);
    EXPECT_EQ(problem(wrong, 3, Vec2(1)).index, 3u);
    EXPECT_EQ(problem(six, 3, Vec2(1), {1, 2}).code, ProblemCode::index_out_of_range);
    EXPECT_EQ(problem(six, 3, Vec2(1), {1, 2}).index, 1u);
}

TEST(HeightField, LooksUp) {
    const HeightField field = *HeightField::build(std::vector<float>{0, 1, 2, 3, 4, 5}, 3, Vec2(2, 3));
    EXPECT_EQ(field.rows(), 2u);
    EXPECT_EQ(field.size(), 4u);
    EXPECT_EQ(bounds(field), (Aabb3{{0, 0, 0}, {4, 3, 5}}));
    const Triangle3 first = field.triangle(0), last = field.triangle(3);
    EXPECT_TRUE(near(first.b, Vec3(2, 0, 1)));
    EXPECT_TRUE(near(last.c, Vec3(2, 3, 4)));
    for (std::uint32_t i = 0; i < field.size(); ++i) {
        const Triangle3 t = field.triangle(i);
        EXPECT_GT(cross(DVec<3>(t.b) - DVec<3>(t.a), DVec<3>(t.c) - DVec<3>(t.a)).z, 0);
    }
}

TEST(HeightField, WithoutGroundInAHole) {
    const std::vector<std::uint32_t> holes{1};
    const HeightField field = *HeightField::build(std::vector<float>(9, 1.0f), 3, 1.0f, {.holes = holes});
    EXPECT_TRUE(raycast(Ray3::between({0.5f, 0.5f, 5}, {0.5f, 0.5f, 0}), field));
    EXPECT_FALSE(raycast(Ray3::between({1.5f, 0.5f, 5}, {1.5f, 0.5f, 0}), field));
    EXPECT_FALSE(overlaps(field, Sphere{{1.5f, 0.5f, 1}, 0.25f}));
    EXPECT_FLOAT_EQ(closest(field, Vec3(1.5f, 0.5f, 1)).distance, 0.5f);
    const std::vector<std::uint32_t> all{0, 1, 2, 3};
    const HeightField nothing = *HeightField::build(std::vector<float>(9, 1.0f), 3, 1.0f, {.holes = all});
    EXPECT_FALSE(overlaps(nothing, Sphere{{1, 1, 1}, 5}));
    EXPECT_EQ(closest(nothing, Vec3(1, 1, 1)).distance, std::numeric_limits<float>::infinity());
}

/// The neighbour across each edge has that edge reversed.
TEST(HeightField, KnowsNeighbours) {
    oracle::Random random(1);
    std::vector<float> heights;
    for (int i = 0; i < 7 * 5; ++i) heights.push_back(random.uniform_float(0, 1));
    const std::vector<std::uint32_t> holes{3, 8, 9};
    const HeightField field = *HeightField::build(heights, 7, 1.0f, {.holes = holes});
    int borders = 0, seams = 0;
    for (std::uint32_t i = 0; i < field.size(); ++i) {
        if (field.is_hole(i / 2)) continue;
        const Triangle3 t = field.triangle(i);
        const std::array<Vec3, 4> corner{t.a, t.b, t.c, t.a};
        for (std::uint32_t edge = 0; edge < 3; ++edge) {
            const std::uint32_t other = field.neighbour(i, edge);
            if (other == no_neighbour) {
                ++borders;
                continue;
            }
            ++seams;
            ASSERT_LT(other, field.size());
            EXPECT_FALSE(field.is_hole(other / 2));
            const Triangle3 o = field.triangle(other);
            const std::array<Vec3, 4> of{o.a, o.b, o.c, o.a};
            int shared = 0;
            for (std::size_t k = 0; k < 3; ++k)
                shared += of[k] == corner[edge + 1] && of[k + 1] == corner[edge] &&
                                  field.neighbour(other, static_cast<std::uint32_t>(k)) == i
                              ? 1
                              : 0;
            EXPECT_EQ(shared, 1) << i << " " << edge;
        }
    }
    // Each internal edge is reported from both sides. There are 20 border edges around, and more around the holes.
    EXPECT_EQ(seams % 2, 0);
    EXPECT_EQ(seams + borders, 3 * 42);
    EXPECT_GT(borders, 20);
}

/// Large enough for several levels of blocks, with an equal mesh whose triangles have the same order.
TEST(HeightField, AnswersAsTheMeshOfItsTriangles) {
    oracle::Random random(2);
    constexpr std::uint32_t columns = 90, rows = 70;
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < columns * rows; ++i) heights.push_back(random.uniform_float(-2, 2));
    std::vector<std::uint32_t> holes;
    for (std::uint32_t i = 0; i < (columns - 1) * (rows - 1); ++i)
        if (random.chance(0.1)) holes.push_back(i);
    const HeightField field = *HeightField::build(heights, columns, Vec2(0.5f, 0.25f), {.holes = holes});
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < field.size(); ++i) {
        if (field.is_hole(i / 2)) continue;
        const Triangle3 t = field.triangle(i);
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), {t.a, t.b, t.c});
        triangles.emplace_back(first, first + 1, first + 2);
        numbers.push_back(i);
    }
    const Mesh mesh = *Mesh::build(points, triangles);
    int hits = 0, apart = 0;
    for (int i = 0; i < 600; ++i) {
        SCOPED_TRACE(i);
        const Vec3 from(random.uniform_float(-5, 50), random.uniform_float(-5, 23), random.uniform_float(-6, 6));
        const Vec3 to(random.uniform_float(-5, 50), random.uniform_float(-5, 23), random.uniform_float(-6, 6));
        const auto hit = raycast(Ray3::between(from, to), field), same = raycast(Ray3::between(from, to), mesh);
        ASSERT_EQ(hit.has_value(), same.has_value());
        if (hit) {
            ++hits;
            EXPECT_NEAR(hit->distance, same->distance, 2e-5);
            EXPECT_EQ(hit->feature.part, numbers[same->feature.part]);
        }
        const Box3 box{from, {0.3f, random.uniform_float(0, 20), random.uniform_float(0, 4)}, random.rotation<3>()};
        const Closest<3> near_field = closest(field, box), near_mesh = closest(mesh, box);
        EXPECT_NEAR(near_field.distance, near_mesh.distance, 1e-6);
        EXPECT_EQ(overlaps(field, box), overlaps(mesh, box));
        apart += near_mesh.distance > 0 ? 1 : 0;
    }
    EXPECT_TRUE(hits > 200 && apart > 100 && apart < 500) << hits << " " << apart;
}

/// A tall thin box, and a wide flat one high above, visit few of the blocks, and no cells where none is near.
TEST(HeightField, RefusesByBlocks) {
    const HeightField field = *HeightField::build(std::vector<float>(1000 * 1000, 0.0f), 1000, 1.0f);
    int seen = 0;
    const auto count = [&seen](const Triangle3&, std::uint32_t) {
        ++seen;
        return true;
    };
    each_part(field, Aabb3{{0, 0, 1}, {999, 999, 2}}, count);
    EXPECT_EQ(seen, 0);
    each_part(field, Aabb3{{500.25f, 500.25f, -100}, {500.75f, 500.75f, 100}}, count);
    EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace abut
