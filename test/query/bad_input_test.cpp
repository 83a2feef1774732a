// NaN and infinity in queries: an assertion if they are enabled, and neutral answers.

#include "../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/voxel_map.hpp>

namespace {
int assertions_expected = 0;
}

namespace abut {

// The assertion handler of this program: an unexpected assertion is a failure.
void assert_failed(const char* expression, const char* file, int line) {
    if (assertions_expected == 0) ADD_FAILURE_AT(file, line) << "assertion failed: " << expression;
}

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

class ExpectAssertions {
public:
    ExpectAssertions() { ++assertions_expected; }
    ~ExpectAssertions() { --assertions_expected; }
    ExpectAssertions(const ExpectAssertions&) = delete;
    ExpectAssertions& operator=(const ExpectAssertions&) = delete;
};

template <int D>
void expect_harmless(const View<D>& bad, const View<D>& good) {
    const ExpectAssertions expected;
    for (const auto& [a, b] : {std::pair{&bad, &good}, std::pair{&good, &bad}}) {
        EXPECT_FALSE(overlaps(*a, *b));
        const Closest<D> found = closest(*a, *b);
        EXPECT_EQ(found.distance, infinity);
        EXPECT_TRUE(oracle::is_unit(found.normal));
        EXPECT_TRUE(detail::is_finite<D>(found.on_a) && detail::is_finite<D>(found.on_b));
        const Contact<D> touch = contact(*a, *b);
        EXPECT_FALSE(touch);
        EXPECT_TRUE(oracle::is_unit(touch.normal));
        EXPECT_FALSE(sweep(*a, Vec<D>(1), *b));
    }
    EXPECT_FALSE(sweep(bad, Motion<D>{{}, {}, Angle<D>(1)}, good, Motion<D>{}));
    EXPECT_FALSE(sweep(good, Pose<D>{}, Pose<D>{}, bad, Pose<D>{}, Pose<D>{}));
    EXPECT_FALSE(contains(bad, Vec<D>(0)));
    EXPECT_FALSE(raycast(Ray<D>::between(Vec<D>(-5), Vec<D>(5)), bad));
}

template <class S>
void expect_harmless(const char* name, const S& bad) {
    constexpr int D = dimension<S>;
    SCOPED_TRACE(name);
    const Ball<D> ball{Vec<D>(0), 1};
    expect_harmless<D>(View<D>(view(bad)), View<D>(view(ball)));
}

TEST(BadInput, InShapesOfThePlaneIsHarmless) {
    for (const float bad : {nan, infinity, -infinity}) {
        expect_harmless("center", Circle{{0, bad}, 1});
        expect_harmless("radius", Circle{{0, 0}, bad});
        expect_harmless("end", Capsule<2>{{0, 0}, {bad, 0}, 1});
        expect_harmless("half", Box2{{0, 0}, {1, bad}});
        expect_harmless("cosine", Box2{{0, 0}, {1, 1}, {bad, 1}});
        expect_harmless("turn", Box2{{0, 0}, {1, 1}, {bad, bad}});
        expect_harmless("corner", Aabb2{{0, 0}, {1, bad}});
        expect_harmless("segment", Segment<2>{{0, 0}, {0, bad}});
        expect_harmless("triangle", Triangle<2>{{0, 0}, {1, 1}, {bad, 0}});
        expect_harmless("position", at(Circle{{0, 0}, 1}, Pose2{{bad, 0}}));
        expect_harmless("polygon", at(*Polygon::build({{0, 0}, {1, 0}, {0, 1}}), Pose2{{bad, 0}}));
        expect_harmless("rounding", rounded(Circle{{0, 0}, 1}, bad));
        expect_harmless("scale", stretched(Circle{{0, 0}, 1}, Vec2(1, bad)));
        expect_harmless("border", HalfSpace2{{0, 1}, bad});
        expect_harmless("direction", HalfSpace2{{bad, 1}, 0});
    }
}

TEST(BadInput, InShapesOfSpaceIsHarmless) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}};
    const Mesh mesh = *Mesh::build(points, triangles);
    for (const float bad : {nan, infinity, -infinity}) {
        expect_harmless("center", Sphere{{0, bad, 0}, 1});
        expect_harmless("end", Capsule<3>{{0, 0, 0}, {bad, 0, 0}, 1});
        expect_harmless("half", Box3{{0, 0, 0}, {1, bad, 1}});
        expect_harmless("rotation", Box3{{0, 0, 0}, {1, 1, 1}, glm::quat(1, bad, 0, 0)});
        expect_harmless("whole rotation", Box3{{0, 0, 0}, {1, 1, 1}, glm::quat(bad, bad, bad, bad)});
        expect_harmless("triangle", Triangle<3>{{0, 0, 0}, {1, 1, 0}, {bad, 0, 0}});
        expect_harmless("cylinder", Cylinder{{0, 0, 0}, {0, 1, 0}, bad});
        expect_harmless("cone", Cone{{0, 0, bad}, {0, 1, 0}, 1});
        expect_harmless("polyhedron", at(*Polyhedron::build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), Pose3{{0, 0, bad}}));
        expect_harmless("mesh", at(mesh, Pose3{{bad, 0, 0}}));
        expect_harmless("rounded mesh", rounded(mesh, bad));
        expect_harmless("stretched mesh", stretched(mesh, Vec3(1, 1, bad)));
        expect_harmless("border", HalfSpace3{{0, 1, 0}, bad});
        expect_harmless("direction", HalfSpace3{{bad, bad, bad}, 0});
    }
}

/// Runs all queries on a level.
template <class S>
void expect_harmless_to(const char* name, const S& level) {
    constexpr int D = dimension<S>;
    SCOPED_TRACE(name);
    for (const float bad : {nan, infinity, -infinity}) {
        Vec<D> place(0);
        place[1] = bad;
        expect_harmless<D>(View<D>(view(Ball<D>{place, 1})), View<D>(view(level)));
        const ExpectAssertions expected;
        EXPECT_FALSE(contains(level, place));
        EXPECT_EQ(closest(level, place).distance, infinity);
        EXPECT_FALSE(raycast(Ray<D>{place, Vec<D>(1), 10}, level));
        EXPECT_FALSE(sweep(Ball<D>{Vec<D>(0), 1}, place, level));
        expect_harmless("placed", at(level, Pose<D>{place}));
    }
}

TEST(BadInput, ToLevelsIsHarmless) {
    const Chain chain = *Chain::build({{-1, -1}, {1, -1}, {0, 1}}, true);
    const TileMap map = *TileMap::build(std::vector<Tile>(9, Tile::full), 3, 1.0f);
    const HeightField field = *HeightField::build(std::vector<float>(9, 0.0f), 3, 1.0f);
    const VoxelMap voxels = *VoxelMap::build(std::vector<std::uint64_t>{~std::uint64_t{0}}, {3, 3, 3}, 1.0f);
    expect_harmless_to("chain", chain);
    expect_harmless_to("voxel map", voxels);
    expect_harmless_to("tile map", map);
    expect_harmless_to("height field", field);
    expect_harmless_to("compound", *Compound2::build({chain, map, Circle{{0, 0}, 1}}));
    expect_harmless_to("compound in space", *Compound3::build({field, Sphere{{0, 0, 0}, 1}}));
    // An unbounded box is a valid query.
    int seen = 0;
    const Aabb3 everywhere{Vec3(-infinity), Vec3(infinity)};
    const auto count = [&seen](const Triangle3&, std::uint32_t) { return ++seen > 0; };
    each_part(field, everywhere, count);
    EXPECT_EQ(seen, 8);
    seen = 0;
    each_part(voxels, everywhere, [&seen](const detail::Convex<3>&, std::uint32_t) { return ++seen > 0; });
    EXPECT_EQ(seen, 27);
    EXPECT_TRUE(raycast(Ray3{{0.5f, 0.7f, 9}, {0, 0, -1}, infinity}, field));
    EXPECT_TRUE(raycast(Ray2{{0.5f, 9}, {0, -1}, infinity}, map));
}

TEST(BadInput, InPointsAndRaysIsHarmless) {
    const ExpectAssertions expected;
    const Sphere sphere{{0, 0, 0}, 1};
    for (const float bad : {nan, infinity, -infinity}) {
        EXPECT_FALSE(contains(sphere, Vec3(0, bad, 0)));
        EXPECT_EQ(closest(sphere, Vec3(0, bad, 0)).distance, infinity);
        EXPECT_FALSE(raycast(Ray3{{bad, 0, 0}, {1, 0, 0}, 10}, sphere));
        EXPECT_FALSE(raycast(Ray3{{-5, 0, 0}, {1, bad, 0}, 10}, sphere));
        EXPECT_FALSE(sweep(sphere, Vec3(10, bad, 0), Sphere{{5, 0, 0}, 1}));
        EXPECT_FALSE(sweep(sphere, Vec3(10, 0, 0), Sphere{{5, 0, 0}, 1}, Vec3(bad, 0, 0)));
    }
    EXPECT_FALSE(raycast(Ray3{{-5, 0, 0}, {1, 0, 0}, nan}, sphere));
}

TEST(BadInput, InMotionsIsHarmless) {
    const ExpectAssertions expected;
    const Sphere sphere{{0, 0, 0}, 1};
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    for (const float bad : {nan, infinity, -infinity}) {
        EXPECT_FALSE(sweep(box, Motion3{{{bad, 0, 0}}, {}, {}}, sphere));
        EXPECT_FALSE(sweep(box, Motion3{{}, {0, bad, 0}, {}}, sphere));
        EXPECT_FALSE(sweep(box, Motion3{{}, {}, {0, 0, bad}}, sphere));
        EXPECT_FALSE(sweep(sphere, Pose3{}, Pose3{{0, 0, 0}, glm::quat(bad, 0, 0, 0)}, box, Pose3{}, Pose3{}));
    }
}

TEST(BadInput, OfTurnsWithoutLengthCountsAsNone) {
    EXPECT_FLOAT_EQ(closest(Box2{{0, 0}, {1, 1}, {0, 0}}, Vec2(3, 0)).distance, 2);
    EXPECT_FLOAT_EQ(closest(Box3{{0, 0, 0}, {1, 1, 1}, glm::quat(0, 0, 0, 0)}, Vec3(3, 0, 0)).distance, 2);
}

/// A shape whose owner divides by zero.
struct Broken {
    [[maybe_unused]] friend Aabb3 bounds(const Broken&) { return {{-1, -1, -1}, {1, 1, 1}}; }
    friend Vec3 support(const Broken&, const Vec3&) { return {nan, nan, nan}; }
};

TEST(BadInput, FromAUsersSupportFunctionEnds) {
    const ExpectAssertions expected;
    overlaps(Broken(), Sphere{{0, 0, 0}, 1});
    closest(Broken(), Box3{{0, 0, 0}, {1, 1, 1}});
    contact(Broken(), Broken());
    raycast(Ray3{{-5, 0, 0}, {1, 0, 0}, 10}, Broken());
    sweep(Broken(), Vec3(10, 0, 0), Box3{{5, 0, 0}, {1, 1, 1}});
    sweep(Broken(), Motion3{{{-5, 0, 0}}, {10, 0, 0}, {1, 2, 3}}, Box3{{0, 0, 0}, {1, 1, 1}});
}

}  // namespace
}  // namespace abut
