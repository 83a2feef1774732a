// The closed forms of raycasts against independent facts: the depth of the ray's segment in the shape, that the point
// of entry is on the surface and its normal separates, and the result of the iterative raycast. The shapes are of every
// kind, also degenerate; the rays are aimed at corners, run along edges and faces, or start on the surface.

#include "../../corpus/shapes.hpp"
#include "../../oracle/check.hpp"
#include "../../oracle/degenerate.hpp"
#include "../../oracle/pair.hpp"
#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/cylinder.hpp>

#include <iostream>

namespace abut {

using namespace detail;

namespace {

/// The numbers of answers of each kind.
struct Said {
    int undecided = 0, hits = 0, misses = 0;
};

template <int D>
DRay<D> beam_of(const Ray<D>& ray) {
    return {DVec<D>(ray.origin), normalized(DVec<D>(ray.direction)), static_cast<double>(ray.length)};
}

template <int D>
double distance_from(const Convex<D>& shape, const DVec<D>& place) {
    Convex<D> point;
    point.place.offset = place;
    return signed_distance(shape, point).distance;
}

template <int D>
void check(const Convex<D>& shape, const Ray<D>& ray, Said& said) {
    const DRay<D> beam = beam_of(ray);
    const RayEntry<D> entry = ray_entry(shape, beam);
    const double margin = 1e-5 * size(shape) + 16 * oracle::ulp(largest(beam.origin)) + 1e-9 * beam.length;
    // A ray from outside that goes deeper than the tolerance must enter.
    const double start = distance_from(shape, beam.origin);
    const double deepest =
        static_cast<double>(closest(shape, convex(Segment<D>{ray.origin, to_float(beam.at(beam.length))})).distance);
    PartHit<D> searched;
    const bool found = part_hit_by_advance<D>(beam, shape, 0, nullptr, searched);
    if (entry.answer == RayAnswer::undecided) {
        ++said.undecided;
        return;
    }
    if (entry.answer == RayAnswer::misses) {
        ++said.misses;
        if (start > margin) {
            EXPECT_GE(deepest, -margin) << "passed through";
        }
        if (found) {
            // A hit of the iterative raycast alone is a grazing one, or touches at the start within its tolerance.
            EXPECT_TRUE(deepest >= -margin || searched.along <= margin) << deepest << " " << searched.along;
        }
        return;
    }
    ++said.hits;
    EXPECT_GT(entry.along, 0);
    EXPECT_LE(entry.along, beam.length);
    EXPECT_LE(deepest, margin) << "hit what it stays clear of";
    EXPECT_NEAR(distance_from(shape, beam.at(entry.along)), 0, margin) << "not on the surface";
    EXPECT_GT(start, -margin);
    for (const double part : {0.3, 0.9}) EXPECT_GE(distance_from(shape, beam.at(entry.along * part)), -margin);
    const DVec<D> normal = normalized(entry.normal);
    EXPECT_LT(dot(normal, beam.direction), 0);
    EXPECT_LE(dot(normal, support(shape, normal) - beam.at(entry.along)), margin) << "the normal does not separate";
    if (found) {
        EXPECT_NEAR(dot(normal, beam.direction) * (searched.along - entry.along), 0, 4 * margin);
    } else {
        EXPECT_GE(deepest, -margin);
    }
}

/// A ray that starts outside or nearly so, is aimed at or past a corner, along an axis or a side, or starts on the
/// surface.
template <int D>
Ray<D> some_ray(oracle::Random& random, const Convex<D>& shape) {
    const double whole = size(shape) > 0 ? size(shape) : 1;
    const auto corner = [&] { return core_support(shape, random.template direction<D>()).position; };
    const DVec<D> a = corner(), b = corner();
    const DVec<D> aim = random.chance(0.3) ? a : a + (b - a) * random.uniform(-0.2, 1.2);
    DVec<D> along = random.template direction<D>();
    if (random.chance(0.2)) along = axis<D>(static_cast<int>(random.below(D)), random.chance(0.5) ? 1 : -1);
    if (random.chance(0.2)) along = normalized(b - a, along);
    if (random.chance(0.1)) along = shape.place.column[random.below(D)];
    along = normalized(along);
    const double back = random.chance(0.1) ? 0 : whole * random.power_of_two(-3, random.chance(0.2) ? 12 : 3);
    const DVec<D> beside =
        random.chance(0.3) ? random.template direction<D>() * (whole * random.uniform(0, 1)) : DVec<D>(0.0);
    Ray<D> ray{to_float(aim + beside - along * back), to_float(along),
               static_cast<float>(back * random.uniform(0.8, 2) + whole)};
    if (random.chance(0.1) && distance_from(shape, DVec<D>(ray.origin)) > 0) ray.length = static_cast<float>(back);
    return ray;
}

/// Casts rays at a random shape of the style, if it isn't a cloud.
template <int D>
oracle::Kind check_styled_shape(corpus::Style style, int seed, Said& said) {
    SCOPED_TRACE(testing::Message() << "style " << static_cast<int>(style) << ", seed " << seed);
    oracle::Random random(static_cast<std::uint64_t>(1000 * static_cast<int>(style) + seed));
    const double size = random.power_of_two(-8, 10);
    const DVec<D> center = random.direction<D>() * (size * (random.chance(0.5) ? 0 : random.power_of_two(0, 12)));
    const auto sample = corpus::StyledMaker<D>(oracle::Random(random.bits()), size, style).make(center);
    if (sample.kind == oracle::Kind::cloud) return sample.kind;
    const auto& shape = std::get<Convex<D>>(sample.view);
    for (int k = 0; k < 4; ++k) check(shape, some_ray(random, shape), said);
    return sample.kind;
}

template <class T>
class RayEntryOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RayEntryOf, Dimensions);

TYPED_TEST(RayEntryOf, ShapesOfEveryStyle) {
    constexpr int D = TypeParam::value;
    std::array<int, oracle::kind_count> decided{};
    for (int style = 0; style < 5; ++style) {
        Said said;
        for (int i = 0; i < oracle::case_count(1500); ++i) {
            const int before = said.hits + said.misses;
            const oracle::Kind kind = check_styled_shape<D>(static_cast<corpus::Style>(style), i, said);
            decided[static_cast<std::size_t>(kind)] += said.hits + said.misses - before;
        }
        std::cout << "style " << style << ": " << said.hits << " hits, " << said.misses << " misses, " << said.undecided
                  << " undecided\n";
        EXPECT_GT(said.hits, 100);
        EXPECT_GT(said.misses, 100);
    }
    for (int kind = 0; kind < oracle::kind_count; ++kind) {
        const bool searched = kind == static_cast<int>(oracle::Kind::cloud) ||
                              (D == 3 && kind == static_cast<int>(oracle::Kind::segment));
        EXPECT_EQ(decided[static_cast<std::size_t>(kind)] > 100, !searched) << "kind " << kind;
    }
}

TYPED_TEST(RayEntryOf, ShapesOnALattice) {
    constexpr int D = TypeParam::value;
    Said said;
    for (int i = 0; i < oracle::case_count(4000); ++i) {
        SCOPED_TRACE(i);
        oracle::Random random(static_cast<std::uint64_t>(i));
        oracle::LatticeGenerator<D> maker(random,
                                          static_cast<oracle::Perturbation>(random.below(oracle::perturbation_count)));
        const auto sample = maker.make();
        if (sample.kind == oracle::Kind::cloud) continue;
        const auto& shape = std::get<Convex<D>>(sample.view);
        for (int k = 0; k < 4; ++k) check(shape, some_ray(random, shape), said);
    }
    EXPECT_GT(said.hits, 100);
    EXPECT_GT(said.misses, 100);
}

TEST(RayEntry, OfStretchedHullsCylindersAndCones) {
    Said said;
    for (int i = 0; i < oracle::case_count(3000); ++i) {
        SCOPED_TRACE(i);
        oracle::Random random(static_cast<std::uint64_t>(i));
        const auto ray_at = [&](const auto& shape) {
            const Convex<3> seen = view(shape);
            check(seen, some_ray(random, seen), said);
        };
        const Pose3 pose{to_float(random.in_cube<3>() * random.power_of_two(0, 10)), random.rotation<3>()};
        const Vec3 scale = to_float(random.in_cube<3>() * 2.0);
        std::vector<Vec3> points;
        for (std::uint32_t k = 4 + random.below(40); k > 0; --k) points.push_back(to_float(random.direction<3>()));
        const Polyhedron hull = *Polyhedron::build(points);
        const Vec3 a = to_float(random.in_cube<3>()), b = to_float(random.in_cube<3>());
        const float radius = random.uniform_float(0.1, 1);
        ray_at(at(hull, pose));
        ray_at(at(rounded(hull, radius), pose));
        ray_at(at(stretched(hull, scale), pose));
        ray_at(at(Cylinder{a, b, radius}, pose));
        ray_at(at(Cone{a, b, radius}, pose));
        ray_at(at(Cone{{0, 0, 0}, {0, 0, 1}, 1}, pose));
    }
    std::cout << said.hits << " hits, " << said.misses << " misses, " << said.undecided << " undecided\n";
    EXPECT_GT(said.hits, 1000);
    EXPECT_GT(said.misses, 1000);
    EXPECT_LT(said.undecided, (said.hits + said.misses) / 3);
}

TEST(RayEntry, NamesTheFaceItComesThrough) {
    const Polyhedron hull = *Polyhedron::build({{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}, {0, 0, 2}});
    for (std::uint32_t face = 0; face < 4; ++face) {
        const DVec<3> normal(hull.facets().normals[face]);
        DVec<3> middle(0.0);
        for (const std::uint32_t corner : hull.facets().loop(face)) middle += DVec<3>(hull.points()[corner]) / 3.0;
        const auto hit = raycast(Ray3{to_float(middle + normal * 2.0), to_float(-normal), 3}, hull);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->feature, (Feature{0, face, FeatureKind::face}));
        EXPECT_NEAR(hit->distance, 2, 1e-6);
    }
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_EQ(raycast(Ray3{{-5, 0.5f, 0.5f}, {1, 0, 0}}, box)->feature, (Feature{0, 1, FeatureKind::face}));
    EXPECT_EQ(raycast(Ray3{{0.5f, 0.5f, 5}, {0, 0, -1}}, box)->feature, (Feature{0, 4, FeatureKind::face}));
    const Aabb2 square{{0, 0}, {1, 1}};
    EXPECT_EQ(raycast(Ray2{{0.5f, -5}, {0, 1}}, square)->feature, (Feature{0, edge_index(2, 3), FeatureKind::edge}));
    EXPECT_EQ(raycast(Ray2{{5, 0.5f}, {-1, 0}}, square)->feature, (Feature{0, edge_index(0, 2), FeatureKind::edge}));
    const Capsule3 capsule{{0, 0, 0}, {2, 0, 0}, 1};
    EXPECT_EQ(raycast(Ray3{{1, 5, 0}, {0, -1, 0}}, capsule)->feature,
              (Feature{0, edge_index(0, 1), FeatureKind::edge}));
    EXPECT_EQ(raycast(Ray3{{5, 0, 0}, {-1, 0, 0}}, capsule)->feature, (Feature{0, 1, FeatureKind::vertex}));
    const Triangle<3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(raycast(Ray3{{0.2f, 0.2f, 1}, {0, 0, -1}}, triangle)->feature, (Feature{0, 0, FeatureKind::face}));
    EXPECT_EQ(raycast(Ray3{{0.2f, 0.2f, -1}, {0, 0, 1}}, triangle)->feature, (Feature{0, 1, FeatureKind::face}));
    const auto plate = rounded(triangle, 0.5f);
    EXPECT_EQ(raycast(Ray3{{0.2f, 0.2f, 2}, {0, 0, -1}}, plate)->feature, (Feature{0, 0, FeatureKind::face}));
    EXPECT_EQ(raycast(Ray3{{0.2f, 0.2f, -2}, {0, 0, 1}}, plate)->feature, (Feature{0, 1, FeatureKind::face}));
    EXPECT_EQ(raycast(Ray3{{0.5f, -2, 0.1f}, {0, 1, 0}}, plate)->feature,
              (Feature{0, edge_index(0, 1), FeatureKind::edge}));
    EXPECT_EQ(raycast(Ray3{{2, 2, 0.1f}, {-1, -1, 0}}, plate)->feature,
              (Feature{0, edge_index(1, 2), FeatureKind::edge}));
    EXPECT_EQ(raycast(Ray3{{-2, 0.3f, 0.1f}, {1, 0, 0}}, plate)->feature,
              (Feature{0, edge_index(0, 2), FeatureKind::edge}));
    EXPECT_EQ(raycast(Ray3{{3, 0, 0.1f}, {-1, 0, 0}}, plate)->feature, (Feature{0, 1, FeatureKind::vertex}));
    EXPECT_EQ(raycast(Ray3{{0, 3, 0.1f}, {0, -1, 0}}, plate)->feature, (Feature{0, 2, FeatureKind::vertex}));
}

// The search stepped by the computed distance, whose error of 2e-7 of the size is more than the thickness of these
// hulls: the rays went through them, up to 2,000 tolerances deep.
TEST(RayEntry, SearchesDontStepThroughANearlyFlatHull) {
    Said said;
    for (const int seed : {9898, 10957, 13820, 14123, 14757}) check_styled_shape<3>(corpus::Style{2}, seed, said);
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__)
    // Elsewhere arguments are evaluated in another order, so the seeds make other hulls.
    EXPECT_GT(said.hits, 4);
#else
    EXPECT_GT(said.hits, 0);
#endif
}

TEST(RayEntry, MeetsAFlatHullFromBothSides) {
    const Polyhedron flat = *Polyhedron::build({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    ASSERT_EQ(flat.rank(), 2);
    for (const float side : {-1.0f, 1.0f}) {
        const Ray3 ray{{0.3f, 0.2f, 2 * side}, {0, 0, -side}, 5};
        EXPECT_EQ(ray_entry(convex(flat), beam_of(ray)).answer, RayAnswer::enters);
        const auto hit = raycast(ray, flat);
        ASSERT_TRUE(hit);
        EXPECT_FLOAT_EQ(hit->distance, 2);
        EXPECT_EQ(hit->normal, Vec3(0, 0, side));
        EXPECT_FALSE(raycast(Ray3{{1.3f, 0.2f, 2 * side}, {0, 0, -side}, 5}, flat));
    }
}

}  // namespace
}  // namespace abut
