// Closest features: known answers for each Voronoi region, and against the oracle.

#include "../oracle/degenerate.hpp"
#include "../oracle/pair.hpp"
#include <abut/convex/features.hpp>
#include <abut/convex/hull/hull.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

template <int D>
void expect_feature(const ClosestFeature<D>& found, FeatureKind kind, std::uint32_t index, const DVec<D>& point,
                    double distance, const DVec<D>& normal) {
    EXPECT_EQ(found.kind, kind);
    EXPECT_EQ(found.index, index);
    EXPECT_LT(length(found.point - point), 1e-14) << found.point.x << ' ' << found.point.y;
    EXPECT_NEAR(found.distance, distance, 1e-14);
    EXPECT_LT(length(found.normal - normal), 1e-14) << found.normal.x << ' ' << found.normal.y;
}

constexpr FeatureKind on_vertex = FeatureKind::vertex, on_edge = FeatureKind::edge, on_face = FeatureKind::face;

// --- known answers ---

TEST(Features, EdgesAreNamedByBothPoints) {
    EXPECT_EQ(edge_index(3, 7), 3u | 7u << 16);
    EXPECT_EQ(edge_index(7, 3), 3u | 7u << 16);
    EXPECT_EQ(edge_index(65536, 65537), 0u | 1u << 16) << "their low 16 bits";
}

TEST(Features, OfASegment) {
    const DVec<3> a(1, 0, 0), b(3, 0, 0);
    expect_feature<3>(closest_on_segment<3>(a, b, {0, 0, 0}), on_vertex, 0, a, 1, {-1, 0, 0});
    expect_feature<3>(closest_on_segment<3>(a, b, {6, 4, 0}), on_vertex, 1, b, 5, {0.6, 0.8, 0});
    expect_feature<3>(closest_on_segment<3>(a, b, {2, 0, -2}), on_edge, edge_index(0, 1), {2, 0, 0}, 2, {0, 0, -1});
    expect_feature<3>(closest_on_segment<3>(a, b, {3, 1, 0}), on_vertex, 1, b, 1, {0, 1, 0});
}

TEST(Features, OnTheSegmentItselfTheNormalIsStillOne) {
    const DVec<3> a(1, 2, 3), b(3, 2, 3);
    const auto inside = closest_on_segment<3>(a, b, {2, 2, 3});
    EXPECT_EQ(inside.kind, on_edge);
    EXPECT_EQ(inside.distance, 0);
    EXPECT_NEAR(length(inside.normal), 1, 1e-15);
    EXPECT_EQ(inside.normal.x, 0);
    expect_feature<3>(closest_on_segment(a, b, a), on_vertex, 0, a, 0, {-1, 0, 0});
    expect_feature<3>(closest_on_segment(a, b, b), on_vertex, 1, b, 0, {1, 0, 0});
    expect_feature<3>(closest_on_segment(a, a, a), on_vertex, 0, a, 0, {1, 0, 0});
    expect_feature<3>(closest_on_segment<3>(a, b, {2, 2, 3}, {0, 1, 0}), on_edge, edge_index(0, 1), {2, 2, 3}, 0,
                      {0, 1, 0});
}

TEST(Features, OfATriangleInThePlane) {
    const double r = std::sqrt(0.5);
    for (const bool mirrored : {false, true}) {
        SCOPED_TRACE(mirrored);
        const DVec<2> a(0, 0), x(4, 0), y(0, 4);
        const DVec<2>&b = mirrored ? y : x, &c = mirrored ? x : y;
        const std::uint32_t at_x = mirrored ? 2 : 1, at_y = mirrored ? 1 : 2;
        const auto query = [&](double px, double py) { return closest_on_triangle(a, b, c, DVec<2>(px, py)); };
        expect_feature<2>(query(-3, -4), on_vertex, 0, a, 5, {-0.6, -0.8});
        expect_feature<2>(query(7, 0), on_vertex, at_x, x, 3, {1, 0});
        expect_feature<2>(query(-1, 4), on_vertex, at_y, y, 1, {-1, 0});
        expect_feature<2>(query(1, -2), on_edge, edge_index(0, at_x), {1, 0}, 2, {0, -1});
        expect_feature<2>(query(-2, 3), on_edge, edge_index(0, at_y), {0, 3}, 2, {-1, 0});
        expect_feature<2>(query(4, 4), on_edge, edge_index(1, 2), {2, 2}, std::sqrt(8), {r, r});
        expect_feature<2>(query(1, 0.5), on_edge, edge_index(0, at_x), {1, 0}, -0.5, {0, -1});
        expect_feature<2>(query(2, 0), on_edge, edge_index(0, at_x), {2, 0}, 0, {0, -1});
        expect_feature<2>(query(1.75, 1.75), on_edge, edge_index(1, 2), {2, 2}, -0.25 / r, {r, r});
    }
}

TEST(Features, OfATriangleInSpace) {
    const DVec<3> a(0, 0, 1), b(4, 0, 1), c(0, 4, 1);
    const double r = std::sqrt(0.5);
    const auto query = [&](const DVec<3>& p) { return closest_on_triangle(a, b, c, p); };
    expect_feature<3>(query({1, 1, 3}), on_face, 0, {1, 1, 1}, 2, {0, 0, 1});
    expect_feature<3>(query({1, 1, -2}), on_face, 1, {1, 1, 1}, 3, {0, 0, -1});
    expect_feature<3>(query({1, 1, 1}), on_face, 0, {1, 1, 1}, 0, {0, 0, 1});
    expect_feature<3>(query({-3, -4, 1}), on_vertex, 0, a, 5, {-0.6, -0.8, 0});
    expect_feature<3>(query({7, 0, 5}), on_vertex, 1, b, 5, {0.6, 0, 0.8});
    expect_feature<3>(query({-1, 5, 1}), on_vertex, 2, c, 1 / r, {-r, r, 0});
    expect_feature<3>(query({1, -3, 5}), on_edge, edge_index(0, 1), {1, 0, 1}, 5, {0, -0.6, 0.8});
    expect_feature<3>(query({-3, 1, -3}), on_edge, edge_index(0, 2), {0, 1, 1}, 5, {-0.6, 0, -0.8});
    expect_feature<3>(query({4, 4, 1}), on_edge, edge_index(1, 2), {2, 2, 1}, 2 / r, {r, r, 0});
}

TEST(Features, OfATriangleThatIsALineOrAPoint) {
    const DVec<3> a(0, 0, 0), b(4, 0, 0), c(1, 0, 0);
    expect_feature<3>(closest_on_triangle(a, b, c, {3, 0, 2}), on_edge, edge_index(0, 1), {3, 0, 0}, 2, {0, 0, 1});
    expect_feature<3>(closest_on_triangle(a, b, c, {5, 0, 0}), on_vertex, 1, b, 1, {1, 0, 0});
    expect_feature<3>(closest_on_triangle(a, a, a, {0, 3, 4}), on_vertex, 0, a, 5, {0, 0.6, 0.8});
    const DVec<2> d(0, 0), e(4, 0), f(1, 0);
    EXPECT_EQ(closest_on_triangle(d, e, f, {3, 2}).distance, 2);
    EXPECT_EQ(closest_on_triangle(d, e, f, {3, -2}).distance, 2);
    EXPECT_EQ(closest_on_triangle(d, e, f, {3, 0}).distance, 0);
    expect_feature<2>(closest_on_triangle(d, e, f, {5, 0}), on_vertex, 1, e, 1, {1, 0});
    expect_feature<2>(closest_on_triangle(d, d, d, {3, 4}), on_vertex, 0, d, 5, {0.6, 0.8});
    EXPECT_NEAR(length(closest_on_triangle(d, d, d, d).normal), 1, 1e-15);
}

/// All 3^D regions of a box, by their sides: -1, 0 (between), 1.
TEST(Features, OfABoxInSpace) {
    const DVec<3> half(1, 2, 3);
    for (int region = 0; region < 27; ++region) {
        const int side[3] = {region % 3 - 1, region / 3 % 3 - 1, region / 9 - 1};
        DVec<3> point, expected;
        std::uint32_t low = 0, free = 0;
        int outside = 0;
        for (int i = 0; i < 3; ++i) {
            expected[i] = side[i] == 0 ? 0.25 : side[i] * half[i];
            point[i] = expected[i] + side[i] * 2.0;
            outside += side[i] != 0 ? 1 : 0;
            low |= side[i] < 0 ? 1u << i : 0u;
            free |= side[i] == 0 ? 1u << i : 0u;
        }
        SCOPED_TRACE(testing::Message() << "region " << region);
        if (outside == 0) {
            expect_feature<3>(closest_on_box(half, point), on_face, 0, {1, 0.25, 0.25}, -0.75, {1, 0, 0});
            continue;
        }
        const DVec<3> normal = (point - expected) / length(point - expected);
        const std::uint32_t axis = side[0] != 0 ? 0 : side[1] != 0 ? 1 : 2;
        const FeatureKind kind = outside == 3 ? on_vertex : outside == 2 ? on_edge : on_face;
        const std::uint32_t index = kind == on_vertex ? low
                                    : kind == on_edge ? edge_index(low, low | free)
                                                      : 2 * axis + (low != 0 ? 1u : 0u);
        expect_feature<3>(closest_on_box(half, point), kind, index, expected, length(point - expected), normal);
    }
}

TEST(Features, OfABoxInThePlane) {
    const DVec<2> half(1, 2);
    expect_feature<2>(closest_on_box<2>(half, {4, 6}), on_vertex, 0, {1, 2}, 5, {0.6, 0.8});
    expect_feature<2>(closest_on_box<2>(half, {-4, 6}), on_vertex, 1, {-1, 2}, 5, {-0.6, 0.8});
    expect_feature<2>(closest_on_box<2>(half, {4, -6}), on_vertex, 2, {1, -2}, 5, {0.6, -0.8});
    expect_feature<2>(closest_on_box<2>(half, {-4, -6}), on_vertex, 3, {-1, -2}, 5, {-0.6, -0.8});
    expect_feature<2>(closest_on_box<2>(half, {4, 1}), on_edge, edge_index(0, 2), {1, 1}, 3, {1, 0});
    expect_feature<2>(closest_on_box<2>(half, {0.5, -3}), on_edge, edge_index(2, 3), {0.5, -2}, 1, {0, -1});
    expect_feature<2>(closest_on_box<2>(half, {-0.5, 1}), on_edge, edge_index(1, 3), {-1, 1}, -0.5, {-1, 0});
    expect_feature<2>(closest_on_box<2>(half, {0, -1.75}), on_edge, edge_index(2, 3), {0, -2}, -0.25, {0, -1});
}

TEST(Features, OfABoxOfNoThickness) {
    expect_feature<3>(closest_on_box<3>({1, 1, 0}, {0.5, 0, 2}), on_face, 4, {0.5, 0, 0}, 2, {0, 0, 1});
    expect_feature<3>(closest_on_box<3>({1, 1, 0}, {0.5, 0, -2}), on_face, 5, {0.5, 0, 0}, 2, {0, 0, -1});
    expect_feature<3>(closest_on_box<3>({1, 1, 0}, {0.5, 0, 0}), on_face, 4, {0.5, 0, 0}, 0, {0, 0, 1});
    EXPECT_EQ(closest_on_box<3>({0, 0, 0}, {0, 3, -4}).distance, 5);
    EXPECT_EQ(closest_on_box<3>({0, 0, 0}, {0, 0, 0}).distance, 0);
    EXPECT_EQ(length(closest_on_box<3>({0, 0, 0}, {0, 0, 0}).normal), 1);
}

TEST(Features, OfAPolygon) {
    const std::vector<Vec2> house{{0, 0}, {4, 0}, {4, 3}, {2, 5}, {0, 3}};
    const double r = std::sqrt(0.5);
    expect_feature<2>(closest_on_polygon(house, {2, 7}), on_vertex, 3, {2, 5}, 2, {0, 1});
    expect_feature<2>(closest_on_polygon(house, {4, 5}), on_edge, edge_index(2, 3), {3, 4}, 1 / r, {r, r});
    expect_feature<2>(closest_on_polygon(house, {-1, 1}), on_edge, edge_index(4, 0), {0, 1}, 1, {-1, 0});
    expect_feature<2>(closest_on_polygon(house, {3.5, 1}), on_edge, edge_index(1, 2), {4, 1}, -0.5, {1, 0});
    expect_feature<2>(closest_on_polygon(house, {-3, -4}), on_vertex, 0, {0, 0}, 5, {-0.6, -0.8});
}

TEST(Features, OfAPolyhedronAsOfABox) {
    const Box3 box{{0, 0, 0}, {1, 2, 3}};
    const Convex<3> as_box = convex(box);
    std::vector<Vec3> corners;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-2.0f, 2.0f})
            for (const float z : {-3.0f, 3.0f}) corners.emplace_back(x, y, z);
    const Polyhedron hull = *Polyhedron::build(corners);
    const Convex<3> as_hull = convex(hull);
    Random random(11);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const DVec<3> point = random.in_cube<3>() * 4.0;
        const auto a = closest_feature(as_box, point), b = closest_feature(as_hull, point);
        expect_feature<3>(b, a.kind, b.index, a.point, a.distance, a.normal);
        inside += a.distance < 0 ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
}

/// A flat polygon that isn't quite planar. Its shortest edge is perpendicular to it, so that the outer side of the edge
/// is undefined: this point in the middle was reported 54.7 away, at the edge's end.
TEST(Features, OfAPolygonWithAnUprightEdge) {
    const Polyhedron hull = *Polyhedron::build({{-32.0000038f, -63.9999962f, -32},
                                                {-31.9999981f, -64, -31.9999981f},
                                                {0, 64, 1.40129846e-45f},
                                                {32.0000038f, 63.9999924f, -64}});
    ASSERT_EQ(hull.rank(), 2);
    const DVec<3> point(-8.1268472671508789, -16.253700256347656, -43.936573028564453);
    EXPECT_NEAR(closest_feature(convex(hull), point).distance, 0, 1e-5);
}

/// A flake whose large face isn't quite planar either. Just below the edge to its neighbour, the normal pointed along
/// the flake, through it.
TEST(Features, BelowAnEdgeOfAFlakeTheNormalPointsOut) {
    const Polyhedron hull = *Polyhedron::build({{-64, 0.000192507548f, -32},
                                                {0, -0.000192507548f, 32},
                                                {32, -0.000192507548f, -64},
                                                {32, 0, 0},
                                                {64, -0.000192507548f, 64}});
    const DVec<3> point(1.1886162757873535, 6.1785664001945406e-05, -10.270461082458496);
    const auto found = closest_feature(convex(hull), point);
    EXPECT_NEAR(found.distance, 0, 1e-4);
    EXPECT_LT(dot(found.normal, support(convex(hull), found.normal) - found.point), 1e-3);
}

TEST(Features, OfWhatIsRoundNone) {
    EXPECT_TRUE(has_features(convex(Capsule3{{0, 0, 0}, {1, 0, 0}, 1}))) << "its core is a segment";
    EXPECT_TRUE(has_features(view(stretched(Box3{{0, 0, 0}, {1, 1, 1}}, {1, 2, 3}))));
    EXPECT_FALSE(has_features(view(stretched(Capsule3{{0, 0, 0}, {1, 0, 0}, 1}, {1, 2, 3}))));
    const oracle::PointCloud<3> cloud{{Vec3(0), Vec3(1)}};
    EXPECT_FALSE(has_features(view(cloud)));
}

// --- against the oracle ---

/// The vertices of the reported feature of the placed core: one, two, or the loop of a face.
template <int D>
std::vector<DVec<D>> corners_of(const Convex<D>& core, FeatureKind kind, std::uint32_t index) {
    std::vector<std::uint32_t> numbers;
    if (kind == on_vertex)
        numbers = {index};
    else if (kind == on_edge)
        numbers = {index & 0xffffu, index >> 16};
    else if (core.core == Core::box) {
        const std::uint32_t axis = index / 2, low = index % 2;
        for (std::uint32_t i = 0; i < 8; ++i)
            if ((i >> axis & 1u) == low) numbers.push_back(i);
        std::swap(numbers[2], numbers[3]);
    } else if (core.facets != nullptr) {
        const auto loop = core.facets->loop(index);
        numbers.assign(loop.begin(), loop.end());
    } else {
        EXPECT_LT(index, 2u);
        numbers = {0, 1, 2};
    }
    std::vector<DVec<D>> result;
    for (const std::uint32_t number : numbers) {
        DVec<D> corner;
        if (core.core == Core::box) {
            EXPECT_LT(number, 1u << D);
            corner = DVec<D>(core.own[0]);
            for (int i = 0; i < D; ++i)
                if ((number >> i & 1u) != 0) corner[i] = -corner[i];
        } else {
            EXPECT_LT(number, core.count);
            corner = DVec<D>(core.vertices()[number]);
        }
        result.push_back(core.place.point(corner));
    }
    return result;
}

/// The distance of a point from a vertex, an edge, or a face.
template <int D>
double distance_to(const std::vector<DVec<D>>& corners, const DVec<D>& point) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const DVec<D> on = oracle::nearest_on_segment(point, corners[i], corners[(i + 1) % corners.size()]);
        least = std::min(least, length(point - on));
        if constexpr (D == 3) {
            DVec<3> nearest;
            if (i > 1 && oracle::project_onto_triangle(point, corners[0], corners[i - 1], corners[i], nearest))
                least = std::min(least, length(point - nearest));
        }
    }
    return least;
}

template <int D>
oracle::Polytope<D> as_polytope(const DVec<D>& point) {
    oracle::Polytope<D> result;
    result.points = {Vec<D>(0)};
    result.place.offset = point;
    return result;
}

/// A point near or far, or on a vertex, an edge or inside of the shape, to the rounding of a float.
template <int D>
DVec<D> point_near(const oracle::Polytope<D>& solid, Random& random) {
    const double size = oracle::size(solid);
    const DVec<D> middle = oracle::middle(solid);
    if (random.chance(0.4)) return DVec<D>(to_float(middle + random.in_cube<D>() * (size * random.uniform(0, 3))));
    DVec<D> result(0.0);
    double whole = 0;
    for (std::uint32_t i = 1 + random.below(4); i > 0; --i) {
        const auto corner = random.below(static_cast<std::uint32_t>(solid.points.size()));
        const double weight = random.chance(0.5) ? 1 : random.unit();
        result += solid.place.point(DVec<D>(solid.points[corner])) * weight;
        whole += weight;
    }
    result = whole > 0 ? result / whole : middle;
    if (random.chance(0.5)) result += random.direction<D>() * (size * random.power_of_two(-40, 1));
    return DVec<D>(to_float(result));
}

struct Tally {
    int inside = 0, queries = 0;
};

/// Queries one shape with some points.
template <int D>
void check(const oracle::Sample<D>& sample, Random& random, Tally& tally) {
    const auto* convex = std::get_if<Convex<D>>(&sample.view);
    if (convex == nullptr || !has_features(*convex)) return;
    Convex<D> core = *convex;
    core.radius = 0;
    oracle::Polytope<D> solid = sample.solid;
    solid.radius = 0;
    for (int i = 0; i < 4; ++i) {
        const DVec<D> point = point_near(solid, random);
        const auto found = closest_feature(core, point);
        const double truth = oracle::truth(solid, as_polytope(point)).distance;
        const double tolerance = oracle::tolerance_for(solid, as_polytope(point)) + 1e-14 * largest(point);
        const auto expect_within = [&](double error, const char* what) {
            EXPECT_LE(error, tolerance) << what << ", truly " << truth << " away";
        };
        expect_within(std::abs(found.distance - truth), "distance");
        expect_within(length(point - found.point - found.normal * found.distance), "surface");
        // Corners stick out of merged faces.
        const double standing_out = D == 3 && core.facets != nullptr ? 2 * hull_flatness * oracle::size(solid) : 0;
        expect_within(dot(found.normal, support(core, found.normal) - found.point) - standing_out, "support");
        expect_within(distance_to(corners_of(core, found.kind, found.index), found.point), "named");
        EXPECT_NEAR(length(found.normal), 1, 1e-12);
        ++tally.queries;
        tally.inside += found.distance < 0 ? 1 : 0;
    }
}

template <class T>
class FeaturesOracle : public testing::Test {};
template <int D>
using Dimension = std::integral_constant<int, D>;
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(FeaturesOracle, Dimensions);

TYPED_TEST(FeaturesOracle, AgreesOnRandomShapes) {
    constexpr int D = TypeParam::value;
    Tally tally;
    for (int i = 0; i < oracle::case_count(1200) && !this->HasFailure(); ++i) {
        const std::uint64_t seed = 4711 + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const double size = random.power_of_two(-10, 13);
        const double away = random.chance(0.5) ? 0 : size * random.power_of_two(0, 14);
        oracle::SampleGenerator<D> maker(Random(seed + 1), random.direction<D>() * away, size);
        check(maker.make(static_cast<oracle::Kind>(i % oracle::kind_count)), random, tally);
    }
    EXPECT_GT(tally.queries, 2000);
    EXPECT_GT(tally.inside, tally.queries / 10);
}

TYPED_TEST(FeaturesOracle, AgreesOnDegenerateShapes) {
    constexpr int D = TypeParam::value;
    Tally tally;
    for (int disturbance = 0; disturbance < oracle::perturbation_count; ++disturbance)
        for (int i = 0; i < oracle::case_count(200) && !this->HasFailure(); ++i) {
            const std::uint64_t seed = 99 + static_cast<std::uint64_t>(i);
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", disturbance " << disturbance);
            Random random(seed);
            oracle::LatticeGenerator<D> maker(random, static_cast<oracle::Perturbation>(disturbance));
            check(maker.make(), random, tally);
        }
    EXPECT_GT(tally.queries, 2000);
    EXPECT_GT(tally.inside, tally.queries / 30);
}

TYPED_TEST(FeaturesOracle, AgreesOnWhatIsStretchedFlat) {
    constexpr int D = TypeParam::value;
    Tally tally;
    for (int i = 0; i < oracle::case_count(150) && !this->HasFailure(); ++i) {
        const std::uint64_t seed = 31 + static_cast<std::uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        std::vector<Vec<D>> points;
        for (std::uint32_t k = 2 + random.below(8); k > 0; --k) points.push_back(to_float(random.in_cube<D>()));
        Vec<D> scale, half;
        for (int k = 0; k < D; ++k) {
            scale[k] = random.chance(0.4) ? 0 : random.uniform_float(-2, 2);
            half[k] = random.uniform_float(0, 1);
        }
        const Pose<D> pose{to_float(random.in_cube<D>() * 10.0), random.rotation<D>()};
        const Affine<D> place = affine(pose) * scaling(scale);
        check(
            oracle::sample<D>(oracle::Kind::polytope, at(stretched(*oracle::BuiltHull<D>::build(points), scale), pose),
                              mapped(oracle::hull_of<D>(points), place)),
            random, tally);
        const Box<D> box{points[0], half, random.rotation<D>()};
        check(oracle::sample<D>(oracle::Kind::stretched_box, at(stretched(Box<D>(box), scale), pose),
                                oracle::box_of<D>(place * affine(Pose<D>{box.center, box.rotation}), half)),
              random, tally);
    }
    EXPECT_GT(tally.queries, 1000);
}

}  // namespace
}  // namespace abut
