#include "../oracle/random.hpp"
#include "../oracle/sample.hpp"
#include <abut/query/polytope.hpp>
#include <abut/shape/cylinder.hpp>

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

template <int D>
std::vector<Vec<D>> corners_of_polytope(const PolytopeOf<D>& polytope) {
    return {polytope.points().begin(), polytope.points().end()};
}

TEST(Polytope, OfWhatHasCornersIsExact) {
    EXPECT_EQ(corners_of_polytope<2>(polytope(Aabb2{{0, 0.1f}, {0.3f, 0.7f}})),
              (std::vector<Vec2>{{0, 0.1f}, {0.3f, 0.1f}, {0.3f, 0.7f}, {0, 0.7f}}));
    EXPECT_EQ(corners_of_polytope<2>(polytope(Box2{{1, 2}, {3, 1}})),
              (std::vector<Vec2>{{-2, 1}, {4, 1}, {4, 3}, {-2, 3}}));
    EXPECT_EQ(corners_of_polytope<2>(polytope(Triangle2{{0, 3}, {6, 0}, {0, 0}})),
              (std::vector<Vec2>{{0, 0}, {6, 0}, {0, 3}}));
    EXPECT_EQ(corners_of_polytope<3>(polytope(Segment3{{4, 5, 6}, {1, 2, 3}})),
              (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(polytope(Aabb3{{0, 0, 0}, {1, 2, 3}}).volume(), 6);
    EXPECT_EQ(polytope(Triangle3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).rank(), 2);
}

TEST(Polytope, OfPlacedAndStretchedOnes) {
    const Polygon polygon = *Polygon::build({{0, 0}, {2, 0}, {0, 1}});
    EXPECT_EQ(corners_of_polytope<2>(polytope(at(polygon, Pose2{{5, 5}, Turn{0, 1}}))),
              (std::vector<Vec2>{{4, 5}, {5, 5}, {5, 7}}));
    EXPECT_EQ(corners_of_polytope<2>(polytope(stretched(polygon, Vec2(-1, 0)))), (std::vector<Vec2>{{-2, 0}, {0, 0}}));
    EXPECT_EQ(polytope(stretched(Box3{{0, 0, 0}, {1, 1, 1}}, Vec3(1, 2, 3))).volume(), 48);
    EXPECT_EQ(corners_of_polytope<2>(polytope(polygon)), corners_of_polytope<2>(polygon));
    EXPECT_EQ(corners_of_polytope<2>(polytope(polygon, 0.5f)), corners_of_polytope<2>(polygon));
}

TEST(Polytope, WithoutToleranceIsForTypesThatAreOne) {
    static_assert(PolytopeShape<Box3> && PolytopeShape<At<Stretched<Triangle2>>> && PolytopeShape<At<const Polygon&>>);
    static_assert(!PolytopeShape<Ball<2>> && !PolytopeShape<Capsule3> && !PolytopeShape<Cylinder>);
    static_assert(!PolytopeShape<Cone> && !PolytopeShape<Rounded<Box3>> && !PolytopeShape<At<Rounded<Box2>>>);
    static_assert(!PolytopeShape<oracle::PointCloud<3>> && !PolytopeShape<HalfSpace<3>>);
}

/// The minimal and maximal excess of a shape's support over a polytope's, over many directions.
template <int D>
std::array<double, 2> gaps(const Convex<D>& shape, const PolytopeOf<D>& polytope, Random random) {
    std::array<double, 2> result{0, 0};
    const auto test_direction = [&](const DVec<D>& n) {
        const double gap = dot(n, support(shape, n)) - dot(n, support(convex(polytope), n));
        result = {std::min(result[0], gap), std::max(result[1], gap)};
    };
    for (int i = 0; i < D; ++i)
        for (const double sign : {1.0, -1.0}) test_direction(axis<D>(i, sign));
    for (int i = 0; i < 300; ++i) test_direction(random.direction<D>());
    if constexpr (D == 3) {
        const auto normal = [&](std::uint32_t face) { return DVec<3>(polytope.facets().normals[face]); };
        for (std::uint32_t face = 0; face < polytope.facets().normals.size(); face += 7)
            test_direction(normalized(normal(face)));
        for (std::size_t i = 0; i < polytope.facets().edges.size(); i += 7) {
            const FacetEdge& edge = polytope.facets().edges[i];
            test_direction(normalized(normal(edge.left) + normal(edge.right)));
        }
    }
    return result;
}

/// The rounding of the corners, and the hull's tolerance relative to the extent.
template <int D>
double rounding_of_hull(const Convex<D>& shape) {
    const Aabb<D> box = bounds(shape);
    return 1e-6 * size(shape) + 1e-7 * std::max(largest(DVec<D>(box.min)), largest(DVec<D>(box.max)));
}

template <int D>
void expect_within(const Convex<D>& shape, double part_of_size) {
    const auto tolerance = static_cast<float>(part_of_size * size(shape));
    const auto [min_reach, max_reach] = gaps<D>(shape, polytope(shape, tolerance), Random(1));
    EXPECT_GE(min_reach, -rounding_of_hull(shape));
    EXPECT_LE(max_reach, static_cast<double>(tolerance) + rounding_of_hull(shape));
}

template <int D>
Pose<D> random_pose(Random& random, double away) {
    return {to_float(random.direction<D>() * away), random.rotation<D>()};
}

template <int D>
Vec<D> random_scale(Random& random) {
    Vec<D> result;
    for (int i = 0; i < D; ++i) result[i] = static_cast<float>(random.power_of_two(-12, 1));
    return result;
}

template <int D>
void expect_round_shapes_within(Random& random, double part_of_size) {
    const auto size = static_cast<float>(random.power_of_two(-10, 13));
    const double away = random.chance(0.5) ? 0 : random.power_of_two(0, 7) * static_cast<double>(size);
    const Pose<D> pose = random_pose<D>(random, away);
    const Vec<D> end = to_float(random.in_cube<D>()) * size;
    const Ball<D> ball{Vec<D>(0), size};
    const Capsule<D> capsule{Vec<D>(0), end, size * random.uniform_float(0.01, 1)};
    expect_within(view(at(ball, pose)), part_of_size);
    expect_within(view(at(capsule, pose)), part_of_size);
    const Vec<D> scale = random_scale<D>(random), thin = random_scale<D>(random);
    const auto ellipsoid = stretched(ball, scale);
    const auto shaved = stretched(capsule, thin);
    expect_within(view(at(ellipsoid, pose)), part_of_size);
    expect_within(view(at(shaved, pose)), part_of_size);
    const auto round = rounded(ellipsoid, size * 0.1f);
    expect_within(view(at(round, pose)), part_of_size);
    const auto box = rounded(Box<D>{Vec<D>(0), scale * size}, size * 0.2f);
    expect_within(view(at(box, pose)), part_of_size);
}

TEST(Polytope, IsWithinTheToleranceOfRoundShapes) {
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(i);
        expect_round_shapes_within<2>(random, random.power_of_two(-16, 1));
        expect_round_shapes_within<3>(random, random.power_of_two(-8, 1));
    }
}

TEST(Polytope, IsWithinTheToleranceOfCylindersAndCones) {
    Random random(4);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(i);
        const double part = random.power_of_two(-10, 1);
        const Pose3 pose = random_pose<3>(random, random.power_of_two(0, 10));
        const Vec3 a = to_float(random.in_cube<3>()), b = to_float(random.in_cube<3>());
        const auto radius = static_cast<float>(random.power_of_two(-10, 1));
        expect_within(view(at(Cylinder{a, b, radius}, pose)), part);
        expect_within(view(at(Cone{a, b, radius}, pose)), part);
        expect_within(view(Cylinder{a, a, radius}), part);
        expect_within(view(Cone{b, a, 1e3f}), part);
        const auto flat = stretched(Cone{a, b, radius}, Vec3(1, 0, 1));
        const auto line = stretched(Cone{a, b, radius}, Vec3(0, 0, 1));
        expect_within(view(at(flat, pose)), part);
        expect_within(view(at(line, pose)), part);
    }
}

TEST(Polytope, OfAUsersShapeHasItsCorners) {
    const oracle::PointCloud<3> cloud{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}, {3, 3, 3}}};
    EXPECT_EQ(corners_of_polytope<3>(polytope(cloud, 1e-3f)),
              (std::vector<Vec3>{{0, 0, 0}, {0, 0, 4}, {0, 4, 0}, {3, 3, 3}, {4, 0, 0}}));
    const oracle::PointCloud<2> flat{{{0, 0}, {4, 0}, {0, 4}, {1, 1}, {3, 3}}};
    EXPECT_EQ(corners_of_polytope<2>(polytope(flat, 1e-3f)), (std::vector<Vec2>{{0, 0}, {4, 0}, {3, 3}, {0, 4}}));
}

TEST(Polytope, LooksAcrossWhatSeemsToBeASegment) {
    // The extreme points along all axes are the two ends of a diagonal.
    const oracle::PointCloud<3> bulging{{{-1, -1, -1}, {1, 1, 1}, {0.9f, -0.9f, 0}, {0.4f, 0.4f, -0.9f}}};
    EXPECT_EQ(polytope(bulging, 1e-3f).points().size(), 4u);
}

TEST(Polytope, HasAsManyCornersAsTheToleranceNeeds) {
    EXPECT_EQ(polytope(Circle{{0, 0}, 0}, 1).points().size(), 1u);
    EXPECT_EQ(polytope(Circle{{0, 0}, 1}, 10).points().size(), 4u);
    const std::size_t of_circle = polytope(Circle{{0, 0}, 1}, 1e-4f).points().size();
    EXPECT_GE(of_circle, 220u);
    EXPECT_LE(of_circle, 440u);
    EXPECT_EQ(polytope(Sphere{{0, 0, 0}, 1}, 10).points().size(), 6u);
    const std::size_t of_sphere = polytope(Sphere{{0, 0, 0}, 1}, 1e-2f).points().size();
    EXPECT_GE(of_sphere, 300u);
    EXPECT_LE(of_sphere, 800u);
}

TEST(Polytope, StopsAtItsMostCorners) {
    const Convex<3> sphere = view(Sphere{{0, 0, 0}, 1});
    const Polyhedron near = polytope(sphere, 1e-6f);
    EXPECT_LE(near.points().size(), max_polyhedron_vertices);
    EXPECT_GT(near.points().size(), max_polyhedron_vertices - 100);
    EXPECT_LT(gaps<3>(sphere, near, Random(1))[1], 1e-3);
}

/// A set with an inconsistent support function: each support point is farther out than the last.
struct Endless {
    mutable std::uint64_t calls = 0;
    [[maybe_unused]] friend Aabb2 bounds(const Endless&) { return {{-1, -1}, {1, 1}}; }
    friend Vec2 support(const Endless& shape, const Vec2& direction) {
        return direction * (1 + 1e-2f * static_cast<float>(++shape.calls));
    }
};

TEST(Polytope, StopsWhereASupportFunctionContradictsItself) {
    EXPECT_LE(polytope(Endless{}, 1e-3f).points().size(), max_polygon_vertices);
}

#ifdef NDEBUG
// These calls trip assertions if they are enabled.
TEST(Polytope, OfBadInputIsHarmless) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(corners_of_polytope<2>(polytope(Circle{{nan, 0}, 1}, 0.1f)), std::vector<Vec2>{Vec2(0)});
    EXPECT_EQ(corners_of_polytope<3>(polytope(Segment3{{nan, 0, 0}, {1, 1, 1}})), std::vector<Vec3>{Vec3(0)});
    EXPECT_EQ(corners_of_polytope<2>(polytope(view(Circle{{1, 0}, 1}))), std::vector<Vec2>{Vec2(0)});
    for (const float tolerance : {0.0f, -1.0f, nan}) {
        const Convex<2> circle = view(Circle{{0, 0}, 1});
        EXPECT_LT(gaps<2>(circle, polytope(circle, tolerance), Random(1))[1], 1e-5);
    }
}
#endif

}  // namespace
}  // namespace abut
