// The intersection of two polytopes: examples with known answers, exact areas and volumes, and invariants of all pairs.

#include "../oracle/bake/volume.hpp"
#include "../oracle/check.hpp"
#include "../oracle/degenerate.hpp"
#include "../oracle/expect.hpp"
#include "../oracle/pair.hpp"
#include <abut/query/intersection.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

double measure(const Polygon& polygon) {
    return polygon.area();
}
double measure(const Polyhedron& polyhedron) {
    return polyhedron.volume();
}

Polygon overlap(const auto& a, const auto& b) requires(dimension<std::remove_cvref_t<decltype(a)>> == 2) {
    const auto found = intersection(a, b);
    EXPECT_TRUE(found);
    return found.value_or(Polygon());
}
Polyhedron overlap(const auto& a, const auto& b) requires(dimension<std::remove_cvref_t<decltype(a)>> == 3) {
    const auto found = intersection(a, b);
    EXPECT_TRUE(found);
    return found.value_or(Polyhedron());
}

std::vector<Vec2> corners(const Polygon& polygon) {
    return {polygon.points().begin(), polygon.points().end()};
}
std::vector<Vec3> corners(const Polyhedron& polyhedron) {
    return {polyhedron.points().begin(), polyhedron.points().end()};
}

TEST(Intersection, OfTwoShiftedSquares) {
    const Box2 a{{0, 0}, {1, 1}}, b{{1.5f, 1}, {1, 1}};
    const Polygon found = overlap(a, b);
    EXPECT_EQ(corners(found), (std::vector<Vec2>{{0.5f, 0}, {1, 0}, {1, 1}, {0.5f, 1}}));
    EXPECT_EQ(found.area(), 0.5);
    EXPECT_EQ(found.centroid(), Vec2(0.75f, 0.5f));
    EXPECT_EQ(std::abs(found.normal().x), 1);
}

TEST(Intersection, OfASquareAndItselfTurnedIsARegularOctagon) {
    const Polygon found =
        overlap(Box2{{3, 2}, Vec2(0.5f)}, Box2{{3, 2}, Vec2(0.5f), Turn{std::sqrt(0.5f), std::sqrt(0.5f)}});
    EXPECT_EQ(found.points().size(), 8u);
    EXPECT_NEAR(found.area(), 2 * (std::sqrt(2.0) - 1), 1e-6);
    EXPECT_TRUE(near(found.centroid(), Vec2(3, 2)));
}

TEST(Intersection, OfTwoCubesAndOfACubeWithATetrahedron) {
    const Polyhedron cubes = overlap(Box3{Vec3(0), Vec3(1)}, Box3{{1.5f, 1, 1}, Vec3(1)});
    EXPECT_DOUBLE_EQ(cubes.volume(), 0.5);
    EXPECT_EQ(cubes.points().size(), 8u);
    EXPECT_EQ(cubes.centroid(), Vec3(0.75f, 0.5f, 0.5f));
    EXPECT_EQ(std::abs(cubes.normal().x), 1);

    // Three corners of the tetrahedron, of volume 1/6 each, are outside the cube.
    const Polyhedron tetrahedron = *Polyhedron::build({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
    const Polyhedron found = overlap(Aabb3{Vec3(0), Vec3(2)}, tetrahedron);
    EXPECT_EQ(found.points().size(), 10u);
    EXPECT_DOUBLE_EQ(found.volume(), 4);
    const float along = static_cast<float>((4.5 * 0.75 - (2.25 + 0.25 + 0.25) / 6) / 4);
    EXPECT_TRUE(near(found.centroid(), Vec3(along)));
    // The cube [0, 1] fits inside, with its far corner on the slanted face.
    EXPECT_DOUBLE_EQ(overlap(Aabb3{Vec3(0), Vec3(1)}, tetrahedron).volume(), 1);
}

TEST(Intersection, OfCubesThatTouchIsTheFaceEdgeOrCorner) {
    const Aabb3 cube{Vec3(0.1f), Vec3(0.7f)};
    const Polyhedron face = overlap(cube, Aabb3{{0.7f, 0.3f, 0.2f}, Vec3(5)});
    EXPECT_EQ(face.rank(), 2);
    EXPECT_EQ(corners(face),
              (std::vector<Vec3>{{0.7f, 0.3f, 0.2f}, {0.7f, 0.3f, 0.7f}, {0.7f, 0.7f, 0.2f}, {0.7f, 0.7f, 0.7f}}));
    EXPECT_EQ(face.volume(), 0);
    EXPECT_NEAR(face.area(), 2 * 0.4 * 0.5, 1e-6);
    EXPECT_EQ(std::abs(face.normal().x), 1);
    const Polyhedron edge = overlap(cube, Aabb3{{0.7f, 0.7f, 0.2f}, Vec3(5)});
    EXPECT_EQ(corners(edge), (std::vector<Vec3>{{0.7f, 0.7f, 0.2f}, {0.7f, 0.7f, 0.7f}}));
    EXPECT_EQ(edge.normal().z, 0);
    EXPECT_TRUE(oracle::is_unit(edge.normal()));
    const Polyhedron corner = overlap(cube, Aabb3{{0.7f, 0.7f, 0.7f}, Vec3(5)});
    EXPECT_EQ(corners(corner), std::vector<Vec3>{Vec3(0.7f)});
    EXPECT_TRUE(oracle::is_unit(corner.normal()));
    EXPECT_FALSE(intersection(cube, Aabb3{{0.7001f, 0, 0}, Vec3(5)}));
}

TEST(Intersection, OfPolygonsThatTouchIsTheEdgeOrCorner) {
    const Aabb2 square{Vec2(0), Vec2(1)};
    const Polygon edge = overlap(square, Triangle<2>{{1, 0.25f}, {3, 0}, {1, 5}});
    EXPECT_EQ(corners(edge), (std::vector<Vec2>{{1, 0.25f}, {1, 1}}));
    EXPECT_EQ(std::abs(edge.normal().x), 1);
    EXPECT_EQ(corners(overlap(square, Box2{{2, 2}, {1, 1}})), std::vector<Vec2>{Vec2(1)});
}

TEST(Intersection, OfWhatHasNoThickness) {
    EXPECT_EQ(corners(overlap(Segment<2>{{0, 0}, {4, 4}}, Segment<2>{{0, 2}, {2, 0}})), std::vector<Vec2>{Vec2(1)});
    EXPECT_EQ(corners(overlap(Segment<2>{{0, 0}, {4, 0}}, Segment<2>{{3, 0}, {7, 0}})),
              (std::vector<Vec2>{{3, 0}, {4, 0}}));
    EXPECT_EQ(corners(overlap(Segment<3>{{0, 0, 1}, {4, 4, 1}}, Segment<3>{{0, 2, 1}, {2, 0, 1}})),
              std::vector<Vec3>{Vec3(1)});
    const Triangle<3> triangle{{-4, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    const Polyhedron slice = overlap(triangle, Box3{Vec3(0, 1, 0), Vec3(1)});
    EXPECT_EQ(slice.rank(), 2);
    EXPECT_DOUBLE_EQ(slice.area(), 8);  // both faces
    EXPECT_EQ(std::abs(slice.normal().z), 1);
    EXPECT_EQ(corners(overlap(triangle, Triangle<3>{{1, 1, -2}, {1, 1, 2}, {1, 9, 0}})),
              (std::vector<Vec3>{{1, 1, 0}, {1, 6, 0}}));
    EXPECT_EQ(corners(overlap(triangle, Segment<3>{{1, 1, -3}, {1, 1, 1}})), std::vector<Vec3>{Vec3(1, 1, 0)});
    EXPECT_EQ(corners(overlap(triangle, Box3{Vec3(0, 1, 0), Vec3(0)})), std::vector<Vec3>{Vec3(0, 1, 0)});
}

TEST(Intersection, OfCrossedNeedlesAndOfAFlakeWithANeedle) {
    const float thin = 1e-6f;
    const Polygon square = overlap(Box2{{0, 0}, {1, thin}}, Box2{{0.5f, 0}, {1, thin}, Turn{0, 1}});
    EXPECT_NEAR(square.area() / 4e-12, 1, 0.1);  // floats about 0.5 are 6e-8 apart
    const Polygon diamond = overlap(Box2{{0, 0}, {1, thin}}, Box2{{0, 0}, {1, thin}, Turn{0.6f, 0.8f}});
    EXPECT_NEAR(diamond.area() / (4e-12 / 0.8), 1, 1e-5);
    const Polyhedron piece = overlap(Box3{Vec3(0), Vec3(1, 1, thin)}, Box3{Vec3(0), Vec3(thin, thin, 1)});
    EXPECT_NEAR(piece.volume() / 8e-18, 1, 1e-5);
    // At a million from the origin, the spacing of floats is 1/16.
    const Vec3 away(1e6f, -1e6f, 1e6f);
    EXPECT_EQ(overlap(Box3{away, Vec3(8)}, Box3{away + 8.0f, Vec3(1, 8, 8)}).volume(), 64);
    EXPECT_EQ(overlap(Box3{away, Vec3(1e4f, 1e-2f, 1e-2f)}, Box3{away, Vec3(1e-2f, 1e4f, 1e-2f)}).rank(), 0);
}

// Two needles of thickness 3e-6 cross 1.2e-7 deep: clipping, with a tolerance of 1e-6, finds nothing.
TEST(Intersection, OfWhatTouchesByARoundingIsAPoint) {
    const Polyhedron a = *Polyhedron::build({{-0.154512942f, 0.687873065f, 0.0514348149f},
                                             {0.0159486663f, -0.0709984526f, -0.00530935219f},
                                             {0.0390664376f, -0.173911393f, -0.01300258f},
                                             {0.128966942f, -0.574160397f, -0.0429314747f}});
    const Polyhedron b = *Polyhedron::build({{-0.246010408f, -0.270496935f, 0.0788599476f},
                                             {-0.000824598421f, -0.000900461164f, 0.000263344584f},
                                             {0.294113427f, 0.323390126f, -0.0942799672f},
                                             {0.597186029f, 0.656623483f, -0.191432357f}});
    ASSERT_TRUE(overlaps(a, b));
    const Polyhedron found = overlap(a, b);
    EXPECT_EQ(found.rank(), 0);
    EXPECT_LE(closest(a, found).distance, 1e-6);
    EXPECT_LE(closest(b, found).distance, 1e-6);
}

TEST(Intersection, OfTheSameShapeTwiceAndOfNestedOnesIsTheInner) {
    const Polyhedron rock = *Polyhedron::build({{-1, 0.1f, 0}, {0.9f, 0, 0.2f}, {0, 1, 0}, {0.3f, 0, 1}, {0, 0, -1}});
    EXPECT_EQ(corners(overlap(rock, rock)), corners(rock));
    const Pose3 pose{{3, 1, -2}, turn_about(Vec3(0.6f, 0, 0.8f), 1)};
    EXPECT_EQ(corners(overlap(at(rock, pose), at(rock, pose))), corners(polytope(at(rock, pose))));
    const Box3 room{Vec3(0), Vec3(7), turn_about(Vec3(0, 1, 0), 0.4f)};
    EXPECT_EQ(corners(overlap(rock, room)), corners(rock));
    EXPECT_EQ(corners(overlap(room, rock)), corners(rock));
    EXPECT_EQ(corners(overlap(Polygon(), Box2{{0, 0}, {1, 1}})), std::vector<Vec2>{Vec2(0)});
}

TEST(Intersection, OfViews) {
    const Box2 box{{1, 0}, {1, 1}};
    const Polygon mirrored = overlap(stretched(box, Vec2(-1, 2)), Aabb2{Vec2(-1), Vec2(3)});
    EXPECT_EQ(mirrored.area(), 3);
    const Polyhedron wedge = *Polyhedron::build({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}});
    const Polyhedron shadow = overlap(stretched(wedge, Vec3(1, 1, 0)), Box3{Vec3(0), Vec3(1)});
    EXPECT_EQ(shadow.rank(), 2);
    EXPECT_NEAR(shadow.area(), 2, 1e-6);
    EXPECT_NEAR(overlap(stretched(wedge, Vec3(-1, 1, 1)), Aabb3{Vec3(-1), Vec3(1)}).volume(), 1, 1e-6);
    // The intersection is the mirror image of the cutting shape.
    EXPECT_NEAR(overlap(stretched(wedge, Vec3(-4, 4, 4)), Aabb3{Vec3(-1), Vec3(1)}).volume(), 1, 1e-6);
    EXPECT_EQ(overlap(stretched(box, Vec2(-9, 9)), Aabb2{Vec2(-1), Vec2(3)}).area(), 4);
    EXPECT_NEAR(overlap(at(wedge, {Vec3(5)}), Aabb3{Vec3(5), Vec3(6)}).volume(), 1, 1e-6);
    const Convex<3> seen = convex(wedge);
    EXPECT_EQ(corners(overlap(seen, wedge)), corners(wedge));
}

TEST(Intersection, LeavesTheResultAloneWhereThereIsNone) {
    Polygon out = *Polygon::build({{1, 2}});
    EXPECT_FALSE(intersection(Box2{{0, 0}, {1, 1}}, Box2{{9, 0}, {1, 1}}, out));
    EXPECT_EQ(corners(out), std::vector<Vec2>{Vec2(1, 2)});
    Polygon both = *Polygon::build({{0, 0}, {2, 0}, {0, 2}});
    EXPECT_TRUE(intersection(both, Box2{{0, 0}, {1, 1}}, both));  // the output may be an input
    EXPECT_EQ(both.area(), 1);
}

TEST(Intersection, WritesItsTrace) {
    Trace<2> trace;
    EXPECT_TRUE(intersection(Box2{{0, 0}, {1, 1}}, Box2{{1, 0}, {1, 1}}, {.trace = &trace}));
    ASSERT_EQ(trace.steps.size(), 4u);
    for (const auto& step : trace.steps) EXPECT_TRUE(std::holds_alternative<ClipStep<2>>(step));
}

template <class A, class B>
concept Intersect = requires(const A& a, const B& b) {
    intersection(a, b);
};
static_assert(Intersect<Box2, Polygon> && Intersect<At<Stretched<Triangle<3>>>, Aabb3>);
static_assert(!Intersect<Box2, Box3> && !Intersect<Box2, Ball<2>> && !Intersect<Capsule<3>, Box3> &&
              !Intersect<Rounded<Box2>, Box2>);

constexpr oracle::Kind polytopes[] = {oracle::Kind::segment, oracle::Kind::triangle,      oracle::Kind::box,
                                      oracle::Kind::aabb,    oracle::Kind::stretched_box, oracle::Kind::polytope};

/// The tolerance of the intersection's surface, including rounding to floats.
template <int D>
double allowed_error(const oracle::Sample<D>& a, const oracle::Sample<D>& b, const PolytopeOf<D>& found) {
    double rounding = 0;
    for (const Vec<D>& point : found.points()) rounding = std::max(rounding, oracle::rounding_of(point));
    return oracle::tolerance_for(a.solid, b.solid) + 2 * rounding;
}

template <class T>
class IntersectionOracle : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(IntersectionOracle, Dimensions);

TYPED_TEST(IntersectionOracle, HasTheVolumeThatRationalNumbersSay) {
    constexpr int D = TypeParam::value;
    const int pairs = oracle::case_count(D == 2 ? 300 : 60);
    int overlapping = 0;
    for (int i = 0; i < pairs; ++i) {
        const std::uint64_t seed = 31000 + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto points = [&](int shift) {
            std::vector<Vec<D>> result(D + 1 + random.below(4));
            for (Vec<D>& point : result)
                for (int axis = 0; axis < D; ++axis)
                    point[axis] = static_cast<float>(static_cast<int>(random.below(33)) + (axis == 0 ? shift : 0));
            return result;
        };
        const std::vector<Vec<D>> points_a = points(0), points_b = points(static_cast<int>(random.below(30)));
        const auto found = intersection(*PolytopeOf<D>::build(points_a), *PolytopeOf<D>::build(points_b));
        const double expected = oracle::volume_of_overlap(oracle::hull_of<D>(points_a), oracle::hull_of<D>(points_b));
        // The rounding of vertices below 64 to floats moves them by at most 2^-19.
        const double surface = 2 * D * std::pow(33.0, D - 1);
        EXPECT_NEAR(found ? measure(*found) : 0, expected, surface * 0x1p-18);
        overlapping += found ? 1 : 0;
        EXPECT_TRUE(found || expected == 0);
    }
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

/// Checks the invariants of an intersection. If the depth is within the tolerance, contact along an edge and contact at
/// its end differ by less than the tolerance; only exact coordinates distinguish them.
template <int D>
void check_overlap(const oracle::Sample<D>& a, const oracle::Sample<D>& b, oracle::Random& random, bool exact,
                   int& overlapping) {
    const oracle::Truth<D> truth = oracle::truth(a.solid, b.solid);
    PolytopeOf<D> found, swapped;
    const bool yes = intersection(convex_of(a), convex_of(b), found);
    EXPECT_EQ(yes, overlaps(a.view, b.view));
    if (std::abs(truth.distance) > oracle::tolerance_for(a.solid, b.solid)) {
        EXPECT_EQ(yes, truth.overlap);
        EXPECT_EQ(intersection(convex_of(b), convex_of(a), swapped), yes);
    }
    if (!yes) return;
    ++overlapping;
    const double allowed = allowed_error(a, b, found);
    const auto off = [&](const oracle::Polytope<D>& shape, const Vec<D>& point) {
        return oracle::truth(shape, oracle::hull_of<D>({point}), oracle::Arithmetic::floating_point).distance;
    };

    // The intersection lies in both shapes, and contains its centroid.
    for (const Vec<D>& point : found.points()) {
        EXPECT_LE(off(a.solid, point), allowed);
        EXPECT_LE(off(b.solid, point), allowed);
    }
    const auto solid = oracle::hull_of<D>({found.points().begin(), found.points().end()});
    EXPECT_LE(off(solid, found.centroid()), allowed);
    EXPECT_TRUE(oracle::is_unit(found.normal()));

    // Every point of both shapes lies in the intersection.
    const bool clear = exact || truth.distance < -oracle::tolerance_for(a.solid, b.solid);
    for (int i = 0; clear && i < 8; ++i) {
        const auto corners_a = oracle::corners_relative_to(a.solid, DVec<D>(0.0));
        DVec<D> sum(0.0);
        double weights = 0;
        for (const DVec<D>& corner : corners_a) {
            const double weight = i == 0 ? 1 : random.power_of_two(-12, 0);
            sum += corner * weight;
            weights += weight;
        }
        const Vec<D> point = to_float(
            i < static_cast<int>(corners_a.size()) && i > 3 ? corners_a[static_cast<std::size_t>(i)] : sum / weights);
        if (off(a.solid, point) > 0 || off(b.solid, point) > 0) continue;
        EXPECT_LE(off(solid, point), allowed + oracle::rounding_of(point));
    }

    // It is not larger than either shape, and does not depend on their order.
    const double surface = 2 * D * std::pow(2 * std::min(oracle::size(a.solid), oracle::size(b.solid)), D - 1);
    for (const auto* one : {&a, &b}) EXPECT_LE(measure(found), measure(polytope(convex_of(*one))) + surface * allowed);
    if (intersection(convex_of(b), convex_of(a), swapped)) {
        EXPECT_NEAR(measure(swapped), measure(found), surface * allowed);
    }
}

template <class T>
class IntersectionLaws : public testing::Test {};
TYPED_TEST_SUITE(IntersectionLaws, Dimensions);

TYPED_TEST(IntersectionLaws, HoldForEveryKindOfPair) {
    constexpr int D = TypeParam::value;
    int pairs = 0, overlapping = 0;
    for (const oracle::Kind kind_a : polytopes)
        for (const oracle::Kind kind_b : polytopes)
            for (int i = 0; i < oracle::case_count(30); ++i) {
                const std::uint64_t seed = 52000 + static_cast<std::uint64_t>(pairs++);
                SCOPED_TRACE(seed);
                oracle::Random random(seed);
                const auto [a, b] = oracle::random_pair<D>(random, kind_a, kind_b);
                check_overlap(a, b, random, false, overlapping);
            }
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

TYPED_TEST(IntersectionLaws, HoldForDegeneratePairs) {
    constexpr int D = TypeParam::value;
    int pairs = 0, overlapping = 0, flat = 0;
    for (int disturbance = 0; disturbance < oracle::perturbation_count; ++disturbance)
        for (int i = 0; i < oracle::case_count(800); ++i) {
            const std::uint64_t seed = 93000 + static_cast<std::uint64_t>(disturbance * 800 + i);
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", disturbance " << disturbance);
            oracle::Random random(seed);
            oracle::LatticeGenerator<D> maker(random, static_cast<oracle::Perturbation>(disturbance));
            const oracle::Sample<D> a = maker.make(), b = maker.make();
            if (!detail::has_corners_only(convex_of(a)) || !detail::has_corners_only(convex_of(b))) continue;
            ++pairs;
            check_overlap(a, b, random, disturbance == 0, overlapping);
            PolytopeOf<D> found;
            if (intersection(convex_of(a), convex_of(b), found)) flat += found.rank() < D ? 1 : 0;
        }
    EXPECT_GT(overlapping, pairs / 4);
    EXPECT_LT(overlapping, pairs * 7 / 10);
    EXPECT_GT(flat, pairs / 10);
}

TYPED_TEST(IntersectionLaws, MovingBothMovesIt) {
    constexpr int D = TypeParam::value;
    const int pairs = oracle::case_count(200);
    int overlapping = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(pairs); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto [a, b] = oracle::random_pair<D>(random, oracle::Kind::polytope, oracle::Kind::box);
        PolytopeOf<D> found, moved;
        if (closest(a.view, b.view).distance > -oracle::tolerance_for(a.solid, b.solid)) continue;
        ++overlapping;
        ASSERT_TRUE(intersection(convex_of(a), convex_of(b), found));
        const Pose<D> pose{to_float(random.direction<D>() * oracle::size(a.solid)), random.rotation<D>()};
        ASSERT_TRUE(intersection(at(convex_of(a), pose), at(convex_of(b), pose), moved));
        const double allowed = allowed_error(a, b, found) + allowed_error(a, b, moved);
        const double surface = 2 * D * std::pow(2 * std::min(oracle::size(a.solid), oracle::size(b.solid)), D - 1);
        EXPECT_NEAR(measure(moved), measure(found), surface * allowed);
    }
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

}  // namespace
}  // namespace abut
