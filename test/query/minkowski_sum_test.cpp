#include "../oracle/degenerate.hpp"
#include "../oracle/pair.hpp"
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/minkowski_sum.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/cylinder.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

template <int D>
std::vector<Vec<D>> corners(const PolytopeOf<D>& polytope) {
    return {polytope.points().begin(), polytope.points().end()};
}

TEST(MinkowskiSum, OfTwoBoxesIsABox) {
    EXPECT_EQ(corners<2>(minkowski_sum(Box2{{1, 2}, {3, 1}}, Aabb2{{-1, -1}, {1, 1}})),
              (std::vector<Vec2>{{-3, 0}, {5, 0}, {5, 4}, {-3, 4}}));
    const Polyhedron box = minkowski_sum(Box3{{1, 0, 0}, {1, 2, 3}}, Aabb3{{0, 0, 0}, {2, 2, 2}});
    EXPECT_EQ(box.points().size(), 8u);
    EXPECT_EQ(box.volume(), 4 * 6 * 8);
    EXPECT_EQ(box.centroid(), Vec3(2, 1, 1));
}

TEST(MinkowskiSum, OfASquareAndADiamondIsAnOctagon) {
    const Polygon diamond = *Polygon::build({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
    EXPECT_EQ(corners<2>(minkowski_sum(Aabb2{{-1, -1}, {1, 1}}, diamond)),
              (std::vector<Vec2>{{-2, -1}, {-1, -2}, {1, -2}, {2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}}));
}

TEST(MinkowskiSum, OfCrossingSegmentsIsFlat) {
    EXPECT_EQ(minkowski_sum(Segment2{{0, 0}, {2, 0}}, Segment2{{0, 0}, {0, 3}}).area(), 6);
    const Polyhedron flat = minkowski_sum(Segment3{{0, 0, 0}, {2, 0, 0}}, Segment3{{0, 0, 1}, {0, 3, 1}});
    EXPECT_EQ(flat.rank(), 2);
    EXPECT_EQ(flat.area(), 12);
    EXPECT_EQ(minkowski_sum(Segment3{{0, 0, 0}, {2, 0, 0}}, Segment3{{5, 0, 0}, {8, 0, 0}}).rank(), 1);
}

TEST(MinkowskiDifference, OfATriangleAndItselfIsAHexagonAroundZero) {
    const Triangle2 triangle{{1, 1}, {2, 1}, {1, 2}};
    EXPECT_EQ(corners<2>(minkowski_difference(triangle, triangle)),
              (std::vector<Vec2>{{-1, 0}, {0, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 1}}));
}

TEST(MinkowskiDifference, OfDistantShapesKeepsTheirDigits) {
    // A rotated box of half a unit, a million from the origin: its corners as floats would have an error of 0.03.
    const Box2 box{{1e6f, 1e6f}, {0.5f, 0.5f}, {0.6f, 0.8f}};
    const Polygon around_zero = minkowski_difference(box, box);
    EXPECT_NEAR(around_zero.area(), 4, 1e-6);
    EXPECT_TRUE(contains(around_zero, {0, 0}));
    const Box3 solid{{1e6f, 1e6f, -1e6f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f, 0.5f}};
    EXPECT_NEAR(minkowski_difference(solid, solid).volume(), 8, 1e-6);
}

TEST(MinkowskiSum, OfTurnedShapesKeepsTheirDigits) {
    // The triangle is near the other shape only after the pose; in its own frame it is far away.
    const Triangle2 far{{1e6f, 1e6f}, {1e6f + 1, 1e6f}, {1e6f, 1e6f + 1}};
    const auto turned = at(far, Pose2{{0, 0}, {0.6f, 0.8f}});
    EXPECT_NEAR(minkowski_difference(turned, turned).area(), 3, 1e-6);
    const Triangle3 far3{{1e6f, 1e6f, 0}, {1e6f + 1, 1e6f, 0}, {1e6f, 1e6f + 1, 0}};
    const auto turned3 = at(far3, Pose3{{0, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}});
    EXPECT_NEAR(minkowski_difference(turned3, turned3).area(), 6, 1e-6);
}

template <class A, class B>
concept Addable = requires(const A& a, const B& b) {
    minkowski_sum(a, b);
    minkowski_difference(a, b);
};

TEST(MinkowskiSum, TakesPolytopesAlone) {
    static_assert(Addable<Polygon, Box2> && Addable<Polyhedron, At<Stretched<Triangle3>>> && Addable<Aabb3, Segment3>);
    static_assert(!Addable<Polygon, Circle> && !Addable<Sphere, Polyhedron> && !Addable<Capsule2, Capsule2>);
    static_assert(!Addable<Cylinder, Box3> && !Addable<Box3, Cone> && !Addable<Rounded<Box3>, Box3>);
    static_assert(!Addable<Box3, Box2> && !Addable<Box3, oracle::PointCloud<3>>);
    const Polygon near_circle = polytope(Circle{{0, 0}, 1}, 0.01f);
    EXPECT_NEAR(minkowski_sum(near_circle, Aabb2{{-1, -1}, {1, 1}}).area(), 4 + 8 + 3.1416, 0.1);
}

/// The kinds of shapes that are polytopes.
oracle::Kind random_kind(Random& random) {
    constexpr oracle::Kind kinds[] = {oracle::Kind::segment, oracle::Kind::triangle, oracle::Kind::box,
                                      oracle::Kind::aabb,    oracle::Kind::polytope, oracle::Kind::stretched_box};
    return kinds[random.below(6)];
}

template <int D>
oracle::Sample<D> random_polytope(Random& random) {
    const Random own(random.bits());
    const double size = random.power_of_two(-3, 3);
    return oracle::SampleGenerator<D>(own, DVec<D>(0.0), size).make(random_kind(random));
}

template <int D>
oracle::Sample<D> lattice_polytope(oracle::LatticeGenerator<D>& maker) {
    for (;;) {
        oracle::Sample<D> sample = maker.make();
        if (detail::has_corners_only(std::get<Convex<D>>(sample.view))) return sample;
    }
}

/// All sums of a corner of A and a corner of B.
template <int D>
std::vector<Vec<D>> all_sums(const Convex<D>& a, const Convex<D>& b) {
    std::vector<Vec<D>> result;
    for (const Vec<D>& p : detail::core_corners(a))
        for (const Vec<D>& q : detail::core_corners(b))
            result.push_back(to_float(a.place.point(DVec<D>(p)) + b.place.point(DVec<D>(q))));
    return result;
}

/// The error of a sum along a direction: the support of the sum is the sum of the supports.
template <int D>
double error_along(const DVec<D>& n, const Convex<D>& a, const Convex<D>& b, const PolytopeOf<D>& sum) {
    return std::abs(dot(n, support(a, n)) + dot(n, support(b, n)) - dot(n, support(convex(sum), n)));
}

template <int D>
void expect_sum(const Convex<D>& a, const Convex<D>& b, const PolytopeOf<D>& sum, Random random) {
    const double allowed =
        1e-6 * (size(a) + size(b)) + 2 * oracle::ulp(largest(DVec<D>(bounds(a).max)) + largest(DVec<D>(bounds(b).max)));
    for (int i = 0; i < 50; ++i) EXPECT_LE(error_along(random.direction<D>(), a, b, sum), allowed);
    // The face normals of the hull of all corner sums are the directions in which a missing part shows.
    if constexpr (D == 3) {
        const Polyhedron all = *Polyhedron::build(all_sums(a, b));
        for (const Vec3& n : all.facets().normals) EXPECT_LE(error_along(normalized(DVec<3>(n)), a, b, sum), allowed);
    } else {
        const Polygon all = *Polygon::build(all_sums(a, b));
        for (std::size_t i = 0; i < all.points().size(); ++i) {
            const DVec<2> edge = DVec<2>(all.points()[(i + 1) % all.points().size()]) - DVec<2>(all.points()[i]);
            EXPECT_LE(error_along(normalized(DVec<2>(edge.y, -edge.x)), a, b, sum), allowed);
        }
    }
}

template <int D>
void expect_sums_as_large_as_their_parts(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < oracle::case_count(300); ++i) {
        SCOPED_TRACE(i);
        const auto disturbance = static_cast<oracle::Perturbation>(random.below(oracle::perturbation_count));
        oracle::LatticeGenerator<D> maker(random, disturbance);
        const bool lattice = random.chance(0.5);
        const auto make = [&] { return lattice ? lattice_polytope(maker) : random_polytope<D>(random); };
        const oracle::Sample<D> a = make(), b = make();
        expect_sum<D>(convex_of(a), convex_of(b), minkowski_sum(convex_of(a), convex_of(b)), random);
    }
}

TEST(MinkowskiSum, IsAsLargeAsItsParts) {
    expect_sums_as_large_as_their_parts<2>(1);
    expect_sums_as_large_as_their_parts<3>(2);
}

/// On a lattice, coordinates are exact and faces, edges and corners coincide; the answers must be exact.
template <int D>
void expect_exactly_the_hull_of_all_sums(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < oracle::case_count(500); ++i) {
        SCOPED_TRACE(i);
        oracle::LatticeGenerator<D> maker(random, oracle::Perturbation::none);
        const oracle::Sample<D> a = lattice_polytope(maker), b = lattice_polytope(maker);
        const PolytopeOf<D> sum = minkowski_sum(convex_of(a), convex_of(b));
        EXPECT_EQ(corners<D>(sum), corners<D>(*PolytopeOf<D>::build(all_sums(convex_of(a), convex_of(b)))));
        EXPECT_EQ(corners<D>(sum), corners<D>(minkowski_sum(convex_of(b), convex_of(a))));
    }
}

TEST(MinkowskiSum, IsTheHullOfAllSumsOnALattice) {
    expect_exactly_the_hull_of_all_sums<2>(3);
    expect_exactly_the_hull_of_all_sums<3>(4);
}

template <int D>
PolytopeOf<D> random_hull(Random& random) {
    std::vector<Vec<D>> points;
    for (std::uint32_t i = 1 + random.below(20); i > 0; --i) points.push_back(to_float(random.in_cube<D>()));
    return *PolytopeOf<D>::build(points);
}

template <int D>
bool in_order(const Vec<D>& a, const Vec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

template <int D>
void expect_sums_of_corners(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < oracle::case_count(100); ++i) {
        SCOPED_TRACE(i);
        const PolytopeOf<D> a = random_hull<D>(random), b = random_hull<D>(random);
        std::vector<Vec<D>> sums = all_sums<D>(convex(a), convex(b));
        std::sort(sums.begin(), sums.end(), in_order<D>);
        const PolytopeOf<D> sum = minkowski_sum(a, b);
        for (const Vec<D>& corner : sum.points())
            EXPECT_TRUE(std::binary_search(sums.begin(), sums.end(), corner, in_order<D>));

        // All corners take part: b is mirrored, as in the difference, and rotated, which keeps its faces.
        expect_sum<D>(convex(a), convex(b), sum, random);
        const Convex<D> negative = mapped(convex(b), scaling(Vec<D>(-1)));
        expect_sum<D>(convex(a), negative, minkowski_difference(a, b), random);
        const Convex<D> turned = mapped(convex(b), affine(Pose<D>{Vec<D>(1), random.rotation<D>()}));
        expect_sum<D>(convex(a), turned, minkowski_sum(convex(a), turned), random);

        EXPECT_EQ(corners<D>(minkowski_sum(b, a)), corners<D>(sum));
        const PolytopeOf<D> point = *PolytopeOf<D>::build({Vec<D>(0)});
        EXPECT_EQ(corners<D>(minkowski_sum(a, point)), corners<D>(a));
        EXPECT_EQ(corners<D>(minkowski_difference(a, point)), corners<D>(a));
        const Vec<D> displacement = to_float(random.in_cube<D>() * 3.0);
        const auto moved = at(a, Pose<D>{displacement, no_rotation<D>}),
                   moved_sum = at(sum, Pose<D>{displacement, no_rotation<D>});
        const PolytopeOf<D> sum_of_moved = minkowski_sum(moved, b);
        for (int k = 0; k < 20; ++k) {
            const DVec<D> n = random.direction<D>();
            EXPECT_NEAR(dot(n, support(view(moved_sum), n)), dot(n, support(convex(sum_of_moved), n)), 3e-6);
        }
    }
}

TEST(MinkowskiSum, IsMadeOfSumsOfCornersCommutesAndMovesAlong) {
    expect_sums_of_corners<2>(5);
    expect_sums_of_corners<3>(6);
}

TEST(MinkowskiSum, OfStretchedPolyhedraLooksAtTheirFacesAgain) {
    // Stretching bends faces that were planar within rounding, flattens solids, and turns faces into lines.
    Random random(10);
    for (int i = 0; i < oracle::case_count(200); ++i) {
        SCOPED_TRACE(i);
        std::vector<Vec3> points;
        for (std::uint32_t k = 4 + random.below(12); k > 0; --k)
            points.emplace_back(random.below(3), random.below(3), random.below(3));
        const bool lattice = random.chance(0.5);
        const Polyhedron a = lattice ? *Polyhedron::build(points) : random_hull<3>(random), b = random_hull<3>(random);
        Vec3 scale;
        for (int k = 0; k < 3; ++k) scale[k] = random.chance(0.3) ? 0 : static_cast<float>(random.power_of_two(-20, 2));
        const Rotation<3> rotation = lattice ? no_rotation<3> : random.rotation<3>();
        const Convex<3> stretched = mapped(mapped(convex(a), affine(Pose3{Vec3(1), rotation})), scaling(scale));
        expect_sum<3>(stretched, convex(b), minkowski_sum(stretched, convex(b)), random);
    }
}

TEST(MinkowskiSum, OfNearlyParallelPolygons) {
    // The normals are so close that their arcs on the Gauss map end at each other's ends.
    Random random(11);
    for (int i = 0; i < oracle::case_count(300); ++i) {
        SCOPED_TRACE(i);
        std::vector<Vec3> points;
        const Affine<3> turn = affine(Pose3{Vec3(0), random.rotation<3>()});
        for (std::uint32_t k = 3 + random.below(30); k > 0; --k) {
            const DVec<2> flat = random.in_cube<2>();
            points.push_back(to_float(turn.point(DVec<3>(flat.x, flat.y, 0))));
        }
        const Polyhedron a = *Polyhedron::build(points);
        const Vec3 axis = to_float(random.direction<3>() * random.power_of_two(-28, -10));
        const Convex<3> b = mapped(convex(a), affine(Pose3{Vec3(0), glm::quat(1, axis.x, axis.y, axis.z)}));
        expect_sum<3>(convex(a), b, minkowski_sum(convex(a), b), random);
        expect_sum<3>(convex(a), mapped(b, scaling(Vec3(-1))), minkowski_difference(convex(a), b), random);
    }
}

struct Seen {
    int pairs = 0, overlapping = 0;
};

template <int D>
void expect_difference_knows(const oracle::Sample<D>& a, const oracle::Sample<D>& b, Seen& seen) {
    const oracle::Truth<D> truth = oracle::truth(a.solid, b.solid);
    const double margin = oracle::tolerance_for(a.solid, b.solid);
    const PolytopeOf<D> difference = minkowski_difference(convex_of(a), convex_of(b));
    const Closest<D> from_zero = closest(difference, Vec<D>(0)), between = closest(a.view, b.view);
    ++seen.pairs;
    seen.overlapping += truth.overlap ? 1 : 0;
    // One tolerance is for the rounding of the difference, one for the query.
    EXPECT_NEAR(static_cast<double>(from_zero.distance), truth.distance, 2 * margin);
    EXPECT_NEAR(from_zero.distance, between.distance, 2 * margin);
    if (std::abs(truth.distance) <= margin) return;
    EXPECT_EQ(contains(difference, Vec<D>(0)), truth.overlap);
    EXPECT_EQ(overlaps(a.view, b.view), truth.overlap);
}

template <int D>
void expect_differences_know(std::uint64_t seed) {
    Random random(seed);
    Seen seen;
    for (int i = 0; i < oracle::case_count(300); ++i) {
        SCOPED_TRACE(i);
        const oracle::Kind kind_a = random_kind(random), kind_b = random_kind(random);
        const oracle::SamplePair<D> pair = oracle::random_pair<D>(random, kind_a, kind_b);
        expect_difference_knows(pair.a, pair.b, seen);
    }
    EXPECT_GT(seen.overlapping, 0.3 * seen.pairs);
    EXPECT_LT(seen.overlapping, 0.7 * seen.pairs);
    for (int i = 0; i < oracle::case_count(300); ++i) {
        SCOPED_TRACE(i);
        const auto disturbance = static_cast<oracle::Perturbation>(random.below(oracle::perturbation_count));
        oracle::LatticeGenerator<D> maker(random, disturbance);
        const oracle::Sample<D> a = lattice_polytope(maker), b = lattice_polytope(maker);
        expect_difference_knows(a, b, seen);
    }
}

TEST(MinkowskiDifference, KnowsWhetherAndHowFarTheyAreApart) {
    expect_differences_know<2>(7);
    expect_differences_know<3>(8);
}

/// The picture of docs/minkowski.md: two shapes, their sum, their difference.
std::string picture() {
    const Style blue{{37, 99, 235}, 2, {37, 99, 235, 38}}, orange{{217, 119, 6}, 2, {245, 158, 11, 56}};
    const Style purple{{124, 58, 237}, 2, {124, 58, 237, 38}}, slid{{217, 119, 6, 130}, 1.5f, transparent, true};
    const Style answer{{225, 29, 72}, 2}, dark{{30, 41, 59}}, axes{{148, 163, 184}, 1};
    SvgCanvas canvas({{0, 0}, {18, 6.8f}}, 50, {248, 250, 252});
    const Polygon a = *Polygon::build({{-1, -0.6f}, {1.1f, -0.9f}, {1.4f, 0.6f}, {-0.3f, 1.2f}});
    const Polygon b = *Polygon::build({{0.7f, 0.2f}, {1.9f, 0.4f}, {1.1f, 1.4f}});

    const auto panel = [&](const Vec2& zero, const char* title, const char* meaning) {
        canvas.line({zero.x - 2.6f, zero.y}, {zero.x + 2.9f, zero.y}, axes);
        canvas.line({zero.x, zero.y - 2.3f}, {zero.x, zero.y + 2.9f}, axes);
        canvas.set_text_height(18);
        canvas.text({zero.x, 0.75f}, title, dark);
        canvas.set_text_height(14);
        canvas.text({zero.x, 0.3f}, meaning, {{100, 116, 139}});
        canvas.set_text_height(18);
        return Pose2{zero, no_rotation<2>};
    };

    const Pose2 apart = panel({3, 3.7f}, "a, b", "they overlap");
    draw(canvas, at(a, apart), blue);
    draw(canvas, at(b, apart), orange);
    canvas.text(apart * Vec2(-0.2f, 0.35f), "a", blue);
    canvas.text(apart * Vec2(1.3f, 0.85f), "b", orange);

    const Pose2 added = panel({8.6f, 3.7f}, "minkowski_sum(a, b)", "b at every point of a");
    draw(canvas, at(minkowski_sum(a, b), added), purple);
    draw(canvas, at(a, added), blue);
    for (const Vec2& corner : a.points()) draw(canvas, at(at(b, Pose2{corner, no_rotation<2>}), added), slid);

    const Pose2 subtracted = panel({15, 3.7f}, "minkowski_difference(a, b)", "0 is inside: they overlap");
    const Polygon difference = minkowski_difference(a, b);
    draw(canvas, at(difference, subtracted), purple);
    draw_arrow(canvas, subtracted * Vec2(0), subtracted * closest(difference, Vec2(0)).on_a, answer);
    canvas.point(subtracted * Vec2(0), answer);
    return canvas.document();
}

TEST(MinkowskiSum, HasThePictureOfTheDocumentation) {
    std::ifstream file(ABUT_SOURCE_FOLDER "/docs/minkowski.svg", std::ios::binary);
    const std::string shown{std::istreambuf_iterator<char>(file), {}};
    const std::string drawn = picture();
    if (drawn == shown) return;
    const std::string renewed = testing::TempDir() + "minkowski.svg";
    std::ofstream(renewed, std::ios::binary) << drawn;
    FAIL() << "docs/minkowski.svg is not what abut draws now; if it should be, copy " << renewed;
}

}  // namespace
}  // namespace abut
