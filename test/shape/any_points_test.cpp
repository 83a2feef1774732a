// Polygon and Polyhedron take every non-empty set of finite points, and every query returns valid answers for the
// result.
#include "../oracle/random.hpp"
#include "../oracle/rational.hpp"
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/predicates.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

using oracle::Random;
using oracle::Rational;

template <int D>
struct PointSet {
    std::string name;
    std::vector<Vec<D>> points;
    int rank;
    bool has_neighbours = true;  ///< whether neighbours of its own size are in the range of float
};

template <int D>
std::vector<Vec<D>> mapped(std::vector<Vec<D>> points, const Vec<D>& factor, const Vec<D>& offset = Vec<D>(0.0f)) {
    for (Vec<D>& point : points) point = point * factor + offset;
    return points;
}

template <int D>
std::vector<Vec<D>> repeated(const std::vector<Vec<D>>& points, int times) {
    std::vector<Vec<D>> result;
    for (int i = 0; i < times; ++i) result.insert(result.end(), points.begin(), points.end());
    return result;
}

template <int D>
std::vector<Vec<D>> joined(std::vector<Vec<D>> points, const std::vector<Vec<D>>& others) {
    points.insert(points.end(), others.begin(), others.end());
    return points;
}

/// Points of a lattice of side 2 around the origin: `sides` points along each axis.
template <int D>
std::vector<Vec<D>> lattice(int sides) {
    std::vector<Vec<D>> result{Vec<D>(0.0f)};
    for (int i = 0; i < D; ++i) {
        std::vector<Vec<D>> longer;
        for (const Vec<D>& point : result)
            for (int k = 0; k < sides; ++k) {
                longer.push_back(point);
                longer.back()[i] = static_cast<float>(2 * k) / static_cast<float>(sides - 1) - 1;
            }
        result = longer;
    }
    return result;
}

/// Points on the segment from -end to end.
template <int D>
std::vector<Vec<D>> along(const Vec<D>& end, int count) {
    std::vector<Vec<D>> result;
    for (int i = 0; i < count; ++i)
        result.push_back(end * (static_cast<float>(2 * i) / static_cast<float>(count - 1) - 1));
    return result;
}

std::vector<Vec2> ring(int count, double radius, double first_angle) {
    std::vector<Vec2> result;
    for (int i = 0; i < count; ++i) {
        const double angle = first_angle + 2 * 3.14159265358979323846 * i / count;
        result.push_back(to_float(DVec<2>(std::cos(angle), std::sin(angle)) * radius));
    }
    return result;
}
/// Two rings of points on one circle.
std::vector<Vec2> two_rings() {
    return joined(ring(32, 1, 0.1), ring(24, 1, 0.123));
}
std::vector<Vec3> at_height(const std::vector<Vec2>& points, float z) {
    std::vector<Vec3> result;
    for (const Vec2& point : points) result.emplace_back(point, z);
    return result;
}
std::vector<Vec3> turned(std::vector<Vec3> points) {
    const Affine<3> place = affine(Pose3{Vec3(0.0f), Random(5).rotation<3>()});
    for (Vec3& point : points) point = to_float(place.point(DVec<3>(point)));
    return points;
}

template <int D>
std::vector<Vec<D>> random_cloud(int count) {
    Random random(77);
    std::vector<Vec<D>> result;
    for (int i = 0; i < count; ++i) result.push_back(to_float(random.in_cube<D>()));
    return result;
}

constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();

/// Point sets of any dimension.
template <int D>
std::vector<PointSet<D>> common_sets() {
    Vec<D> slanted, one_axis(0.0f);
    for (int i = 0; i < D; ++i) slanted[i] = static_cast<float>(3 * i + 1);
    one_axis[D - 1] = 1;
    const std::vector<Vec<D>> cube = lattice<D>(2), cloud = random_cloud<D>(60);
    std::vector<PointSet<D>> result{
        {"a point", {slanted}, 0},
        {"a point many times", repeated<D>({slanted}, 9), 0},
        {"zeros of both signs", {Vec<D>(0.0f), Vec<D>(-0.0f)}, 0},
        {"two points", {slanted, -slanted}, 1},
        {"neighbouring floats", {Vec<D>(1.0f), Vec<D>(1.0f + 0x1p-23f)}, 1},
        {"collinear", along(slanted, 9), 1},
        {"collinear, each many times", repeated(along(slanted, 9), 3), 1},
        {"collinear but for rounding", along(slanted / 7.0f, 50), 1},
        {"along an axis", along(one_axis, 5), 1},
        {"a cube", cube, D},
        {"a cube, each many times", repeated(cube, 5), D},
        {"a lattice", lattice<D>(5), D},
        {"random", cloud, D},
        {"far from the origin", mapped<D>(cube, Vec<D>(0.5f), Vec<D>(1e6f)), D},
        {"where floats are whole numbers", mapped<D>(cube, Vec<D>(1.0f), Vec<D>(16777000.0f)), D},
        {"a point far away from many", joined<D>(cloud, {slanted * 1e30f}), 1},
        {"the least and the greatest", {Vec<D>(least), Vec<D>(-least), Vec<D>(most)}, 1, false},
        {"all that floats span", mapped<D>(cube, Vec<D>(most)), D, false},
        {"denormal", mapped<D>(cube, Vec<D>(least)), D, false},
    };
    for (const int exponent : {-38, -20, -6, 6, 20, 38})
        result.push_back({"random, times 1e" + std::to_string(exponent),
                          mapped<D>(cloud, Vec<D>(static_cast<float>(std::pow(10.0, exponent)))), D,
                          std::abs(exponent) < 30});
    Vec<D> thin(1.0f);
    thin[0] = 1e-6f;
    result.push_back({"nearly flat", mapped<D>(cloud, thin), D});
    thin[0] = 1e-8f;
    result.push_back({"flat within the tolerance", mapped<D>(cloud, thin), D - 1});
    return result;
}

std::vector<PointSet<2>> sets(std::integral_constant<int, 2>) {
    std::vector<PointSet<2>> result = common_sets<2>();
    result.push_back({"two rings on one circle", two_rings(), 2});
    return result;
}

std::vector<PointSet<3>> sets(std::integral_constant<int, 3>) {
    std::vector<PointSet<3>> result = common_sets<3>();
    const std::vector<Vec3> square = at_height(lattice<2>(5), 0), cloud = random_cloud<3>(60);
    const std::vector<Vec3> rings = at_height(two_rings(), 0);
    const std::vector<Vec3> concentric = joined(at_height(ring(20, 1, 0), 0), at_height(ring(30, 0.5, 0), 0));
    const std::vector<Vec3> drum = joined(at_height(two_rings(), -1), at_height(two_rings(), 1));
    result.insert(result.end(), {
                                    {"coplanar", square, 2},
                                    {"coplanar, each many times", repeated(square, 3), 2},
                                    {"coplanar but for rounding", turned(square), 2},
                                    {"coplanar, far from the origin", mapped<3>(square, Vec3(1), Vec3(1e5f)), 2},
                                    {"coplanar, slanted", {{0, 0, 0}, {3, 1, 4}, {2, 7, 1}, {5, 8, 5}, {8, 9, 9}}, 2},
                                    {"coplanar and small", mapped<3>(square, Vec3(1e-30f)), 2},
                                    {"coplanar and large", mapped<3>(square, Vec3(1e30f)), 2},
                                    {"two rings on one circle", rings, 2},
                                    {"two rings on one circle, turned", turned(rings), 2},
                                    {"two rings around one centre", concentric, 2},
                                    {"rings at both ends", drum, 3},
                                    {"rings at both ends, turned", turned(drum), 3},
                                    {"a needle", mapped<3>(cloud, Vec3(1e-5f, 1, 1e-5f)), 3},
                                    {"a turned flake", turned(mapped<3>(cloud, Vec3(1, 1e-6f, 1))), 3},
                                });
    return result;
}

void expect_exact(const Polygon& polygon, const std::vector<Vec2>& points) {
    const std::span<const Vec2> loop = polygon.points();
    const double extent = abut::detail::extent<2>(points);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        EXPECT_NE(std::find(points.begin(), points.end(), a), points.end()) << "a corner from nowhere";
        if (polygon.rank() == 2) {
            EXPECT_EQ(orientation(a, b, loop[(i + 2) % loop.size()]), 1);
            for (const Vec2& point : points) EXPECT_GE(orientation(a, b, point), 0) << "a point outside";
        } else if (polygon.rank() == 1) {
            const DVec<2> across = perpendicular(DVec<2>(b) - DVec<2>(a));
            for (const Vec2& point : points)
                EXPECT_LE(std::abs(dot(across, DVec<2>(point) - DVec<2>(a))), 1.2e-7 * extent);
        }
    }
}

Rational exact_dot(const Vec3& a, const Vec3& b) {
    return Rational(a.x) * Rational(b.x) + Rational(a.y) * Rational(b.y) + Rational(a.z) * Rational(b.z);
}

/// Expects no point above a plane: in double, and exactly for solids, whose planes are moved out by more than rounding.
/// The faces are a closed surface; without rounding they are exactly convex.
void expect_exact(const Polyhedron& polyhedron, const std::vector<Vec3>& points) {
    const Facets& facets = polyhedron.facets();
    const std::span<const Vec3> corners = polyhedron.points();
    for (const Vec3& corner : corners)
        EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end()) << "a corner from nowhere";
    if (polyhedron.rank() < 2) {
        EXPECT_TRUE(facets.normals.empty());
        return;
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t face = 0; face < facets.normals.size(); ++face) {
        const Vec3& normal = facets.normals[face];
        const double offset = polyhedron.offsets()[face];
        EXPECT_NEAR(length(DVec<3>(normal)), 1, 1e-6);
        for (const Vec3& point : points) {
            EXPECT_LE(dot(DVec<3>(normal), DVec<3>(point)), offset) << "a point outside";
            if (polyhedron.rank() == 3) {
                EXPECT_LE(exact_dot(normal, point), Rational(offset)) << "a point outside";
            }
        }
        const std::span<const std::uint32_t> loop = facets.loop(face);
        for (std::size_t i = 0; i < loop.size(); ++i)
            EXPECT_TRUE(edges.emplace(loop[i], loop[(i + 1) % loop.size()]).second);
    }
    for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from}));
    EXPECT_EQ(corners.size() + facets.normals.size(), edges.size() / 2 + 2) << "Euler";
    EXPECT_EQ(facets.edges.size(), edges.size() / 2);
}

template <class Shape, int D>
Shape expect_built(const PointSet<D>& set) {
    const auto built = Shape::build(set.points);
    EXPECT_TRUE(built);
    EXPECT_EQ(built->rank(), set.rank);
    EXPECT_TRUE(is_finite<D>(built->centroid()));
    EXPECT_TRUE(is_finite(convex(*built)));
    expect_exact(*built, set.points);

    std::vector<Vec<D>> backwards(set.points.rbegin(), set.points.rend());
    const auto again = Shape::build(backwards);
    EXPECT_TRUE(
        std::equal(built->points().begin(), built->points().end(), again->points().begin(), again->points().end()));
    return *built;
}

TEST(AnyPoints, MakeAPolygon) {
    for (const PointSet<2>& set : sets(std::integral_constant<int, 2>())) {
        SCOPED_TRACE(set.name);
        expect_built<Polygon>(set);
    }
}

TEST(AnyPoints, MakeAPolyhedron) {
    for (const PointSet<3>& set : sets(std::integral_constant<int, 3>())) {
        SCOPED_TRACE(set.name);
        expect_built<Polyhedron>(set);
    }
}

// On a lattice nothing is rounded: a polyhedron is convex to the last bit.
TEST(AnyPoints, OfALatticeMakeAPolyhedronThatIsConvexExactly) {
    int faces = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const auto coordinate = [&] { return static_cast<float>(random.below(200)); };
        std::vector<Vec3> points;
        for (int i = 0; i < 20; ++i) points.push_back({coordinate(), coordinate(), coordinate()});
        const Polyhedron built = *Polyhedron::build(points);
        const Facets& facets = built.facets();
        for (std::size_t face = 0; face < facets.normals.size(); ++face) {
            const std::span<const std::uint32_t> loop = facets.loop(face);
            const auto corner = [&](std::size_t i) { return built.points()[loop[i % loop.size()]]; };
            for (std::size_t i = 0; i < loop.size(); ++i) {
                EXPECT_FALSE(on_line(corner(i), corner(i + 1), corner(i + 2)));
                EXPECT_TRUE(in_plane(corner(0), corner(1), corner(2), corner(i)));
                for (const Vec3& point : points)
                    EXPECT_LE(orientation(corner(i), corner(i + 1), corner(i + 2), point), 0);
            }
            ++faces;
        }
    }
    EXPECT_GT(faces, 1000);
}

template <int D>
void expect_unit(const Vec<D>& normal) {
    EXPECT_NEAR(length(DVec<D>(normal)), 1, 1e-6);
}

/// Queries with shapes of its own size beside and inside of it, and with itself.
template <int D, class S>
void expect_answers(const S& shape) {
    const Aabb<D> box = bounds(convex(shape));
    const DVec<D> middle = 0.5 * (DVec<D>(box.min) + DVec<D>(box.max));
    const double around = 0.5 * length(DVec<D>(box.max) - DVec<D>(box.min));
    const double magnitude = std::max(largest(DVec<D>(box.min)), largest(DVec<D>(box.max)));
    const double size =
        std::max({around, 1e-3 * magnitude, 1e-30});  // of the other shapes, limited by the resolution of floats
    const double margin = 1e-5 * size + 16 * 0x1p-23 * magnitude;

    EXPECT_TRUE(overlaps(shape, shape));
    const Closest<D> itself = closest(shape, shape);
    EXPECT_LE(itself.distance, margin);
    expect_unit<D>(itself.normal);

    const DVec<D> away = normalized(DVec<D>(1.0) + axis<D>(0));
    const Ball<D> apart{to_float(middle + 4 * (around + size) * away), static_cast<float>(size)};
    EXPECT_FALSE(overlaps(shape, apart));
    EXPECT_FALSE(contact(shape, apart));
    const Closest<D> gap = closest(shape, apart);
    EXPECT_GT(gap.distance, size);
    EXPECT_LT(gap.distance, 8 * (around + size));
    expect_unit<D>(gap.normal);
    EXPECT_GT(dot(DVec<D>(gap.normal), away), 0);
    EXPECT_TRUE(contains(box, to_float(DVec<D>(gap.on_a) + (middle - DVec<D>(gap.on_a)) * 1e-4)) || around == 0);

    // A ball around each corner overlaps it, and so does every shape through a ball in its middle.
    for (const Vec<D>& corner : shape.points().first(std::min<std::size_t>(shape.points().size(), 8))) {
        const Ball<D> ball{corner, static_cast<float>(0.1 * size)};
        EXPECT_TRUE(overlaps(shape, ball));
        EXPECT_TRUE(overlaps(ball, shape));
        const Contact<D> touch = contact(shape, ball);
        EXPECT_TRUE(touch);
        EXPECT_GE(touch.depth, 0.1 * size - margin);
        expect_unit<D>(touch.normal);
        EXPECT_LE(closest(shape, corner).distance, margin);
    }
    const Ball<D> inside{shape.centroid(), static_cast<float>(0.5 * size)};
    EXPECT_TRUE(overlaps(shape, inside));
    EXPECT_LE(closest(inside, shape).distance, -0.5 * size + margin);
    EXPECT_GE(contact(inside, shape).depth, 0.5 * size - margin);

    // A ray from outside to its centroid hits, unless its width is zero.
    const DVec<D> centroid(shape.centroid());
    const Vec<D> from = to_float(centroid + 2 * (around + size) * away);
    const auto hit = raycast(Ray<D>::between(from, to_float(centroid - (around + size) * away)), shape);
    if (shape.rank() == D) {
        EXPECT_TRUE(hit);
    }
    if (hit) {
        EXPECT_FALSE(hit->started_inside);
        expect_unit<D>(hit->normal);
        EXPECT_LE(closest(shape, hit->point).distance, margin);
    }
}

TEST(AnyPoints, OfThePlaneAnswerEveryQuestion) {
    for (const PointSet<2>& set : sets(std::integral_constant<int, 2>())) {
        SCOPED_TRACE(set.name);
        if (set.has_neighbours) expect_answers<2>(*Polygon::build(set.points));
    }
}

TEST(AnyPoints, OfSpaceAnswerEveryQuestion) {
    for (const PointSet<3>& set : sets(std::integral_constant<int, 3>())) {
        SCOPED_TRACE(set.name);
        if (set.has_neighbours) expect_answers<3>(*Polyhedron::build(set.points));
    }
}

// A ray perpendicular to a flat polygon hits it, from either side.
TEST(AnyPoints, InAPlaneStopARayAcross) {
    for (const PointSet<3>& set : sets(std::integral_constant<int, 3>())) {
        if (set.rank != 2 || !set.has_neighbours) continue;
        SCOPED_TRACE(set.name);
        const Polyhedron flat = *Polyhedron::build(set.points);
        const double size = abut::detail::size(convex(flat));
        for (const Vec3& normal : flat.facets().normals) {
            const DVec<3> centroid(flat.centroid()), up(normal);
            const auto hit =
                raycast(Ray3::between(to_float(centroid + size * up), to_float(centroid - size * up)), flat);
            ASSERT_TRUE(hit);
            EXPECT_GT(dot(DVec<3>(hit->normal), up), 0.99);
            EXPECT_NEAR(hit->distance, size, 1e-5 * size + 16 * 0x1p-23 * largest(centroid));
        }
    }
}

}  // namespace
}  // namespace abut::test
