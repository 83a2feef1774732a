// Rays without a direction. Regression: they were infinite rays along +x, which hit a sphere of center 3 at 2.

#include "../../oracle/random.hpp"
#include "../drawn_shapes.hpp"
#include "../user_functions.hpp"
#include <abut/abut.hpp>

#include <array>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D>
Vec<D> first_axis(float x) {
    Vec<D> result(0.0f);
    result[0] = x;
    return result;
}

template <int D>
Ray<D> at_rest(const Vec<D>& origin, float length = std::numeric_limits<float>::infinity()) {
    return {origin, Vec<D>(0.0f), length};
}

/// A ray at rest hits at its own origin, or not at all.
template <int D>
void expect_hit_at_origin(const std::optional<Hit<D>>& hit, const Vec<D>& origin) {
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0);
    EXPECT_EQ(hit->distance, 0);
    EXPECT_EQ(hit->point, origin);
    EXPECT_TRUE(hit->started_inside);
    EXPECT_NEAR(length(DVec<D>(hit->normal)), 1, 1e-6);
}

/// Shapes that contain `inside`, and lie in +x of `origin`.
template <int D, class S>
void expect_only_from_inside(const S& shape, const Vec<D>& inside, const Vec<D>& outside, const char* name) {
    SCOPED_TRACE(name);
    for (const float reach : {0.0f, 1.0f, 100.0f, std::numeric_limits<float>::infinity()}) {
        EXPECT_FALSE(raycast(at_rest<D>(outside, reach), shape));
        expect_hit_at_origin<D>(raycast(at_rest<D>(inside, reach), shape), inside);
        std::vector<Hit<D>> all;
        raycast_all(at_rest<D>(outside, reach), shape, all);
        EXPECT_TRUE(all.empty());
        raycast_all(at_rest<D>(inside, reach), shape, all);
        EXPECT_EQ(all.size(), 1u);
        World<D> world;
        world.add(shape);
        for (int updated = 0; updated < 2; ++updated, world.update()) {
            EXPECT_FALSE(world.raycast(at_rest<D>(outside, reach)));
            EXPECT_FALSE(world.raycast_any(at_rest<D>(outside, reach)));
            EXPECT_TRUE(world.raycast_all(at_rest<D>(outside, reach)).empty());
            const auto hit = world.raycast(at_rest<D>(inside, reach));
            ASSERT_TRUE(hit);
            expect_hit_at_origin<D>(hit->hit, inside);
        }
    }
}

TEST(RaycastAtRest, HitsOnlyWhatContainsItsOriginInThePlane) {
    const Vec2 inside{0.2f, 0.1f}, outside{-3, 0.1f};
    const Box2 box{{0, 0}, {1, 1}, Turn::by(0.5f)};
    const auto polygon = Polygon::build(std::vector<Vec2>{{-1, -1}, {1, -1}, {0, 1}});
    const auto chain = Chain::build({{1, 0}, {-1, 0}}, false);
    expect_only_from_inside<2>(Circle{{0, 0}, 1}, inside, outside, "circle");
    expect_only_from_inside<2>(at(Circle{{1, 0}, 1}, Pose2{{-1, 0}}), inside, outside, "circle by a pose");
    expect_only_from_inside<2>(Capsule2{{-1, 0}, {1, 0}, 1}, inside, outside, "capsule");
    expect_only_from_inside<2>(box, inside, outside, "box");
    expect_only_from_inside<2>(Aabb2{{-1, -1}, {1, 1}}, inside, outside, "aabb");
    expect_only_from_inside<2>(*polygon, Vec2{0.1f, -0.2f}, outside, "polygon");
    expect_only_from_inside<2>(at(*polygon, Pose2{{0, 0}, Turn::by(1)}), inside, outside, "polygon by a pose");
    expect_only_from_inside<2>(Triangle2{{-1, -1}, {1, -1}, {0, 1}}, Vec2{0.1f, -0.2f}, outside, "triangle");
    expect_only_from_inside<2>(HalfSpace2{{-1, 0}, 0}, inside, outside, "half-plane");
    expect_only_from_inside<2>(rounded(box, 0.5f), inside, outside, "rounded box");
    expect_only_from_inside<2>(rounded(Segment2{{-1, 0}, {1, 0}}, 0.5f), inside, outside, "rounded segment");
    expect_only_from_inside<2>(stretched(Circle{{0, 0}, 1}, {2, 1}), inside, outside, "ellipse");
    expect_only_from_inside<2>(rounded(*chain, 0.5f), inside, outside, "rounded chain");
    expect_only_from_inside<2>(*Compound2::build({box, Circle{{5, 0}, 1}}), inside, outside, "compound");
    expect_only_from_inside<2>(users::Blob<2>{}, inside, outside, "distance function");
    expect_only_from_inside<2>(at(users::Brick<2>{}, Pose2{{0, 0}, Turn::by(1)}), inside, outside, "placed function");
}

TEST(RaycastAtRest, HitsOnlyWhatContainsItsOriginInSpace) {
    const Vec3 inside{0.2f, 0.1f, 0.05f}, outside{-3, 0.1f, 0.05f};
    const Box3 box{{0, 0, 0}, {1, 1, 1}, turn_about({0, 0, 1}, 0.5f)};
    const auto hull = Polyhedron::build(std::vector<Vec3>{{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}, {0, 0, 2}});
    const auto mesh =
        Mesh::build(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, std::vector{glm::uvec3{0, 1, 2}});
    expect_only_from_inside<3>(Sphere{{0, 0, 0}, 1}, inside, outside, "sphere");
    expect_only_from_inside<3>(at(Sphere{{1, 0, 0}, 1}, Pose3{{-1, 0, 0}}), inside, outside, "sphere by a pose");
    expect_only_from_inside<3>(Capsule3{{-1, 0, 0}, {1, 0, 0}, 1}, inside, outside, "capsule");
    expect_only_from_inside<3>(box, inside, outside, "box");
    expect_only_from_inside<3>(Aabb3{{-1, -1, -1}, {1, 1, 1}}, inside, outside, "aabb");
    expect_only_from_inside<3>(*hull, inside, outside, "polyhedron");
    expect_only_from_inside<3>(Cylinder{{-1, 0, 0}, {1, 0, 0}, 1}, inside, outside, "cylinder");
    expect_only_from_inside<3>(Cone{{-1, 0, 0}, {1, 0, 0}, 1}, inside, outside, "cone");
    expect_only_from_inside<3>(HalfSpace3{{-1, 0, 0}, 0}, inside, outside, "half-space");
    expect_only_from_inside<3>(rounded(box, 0.5f), inside, outside, "rounded box");
    expect_only_from_inside<3>(stretched(Sphere{{0, 0, 0}, 1}, {2, 1, 1}), inside, outside, "ellipsoid");
    expect_only_from_inside<3>(stretched(Cylinder{{-1, 0, 0}, {1, 0, 0}, 1}, {2, 1, 1}), inside, outside,
                               "stretched cylinder");
    expect_only_from_inside<3>(rounded(*mesh, 0.5f), inside, outside, "rounded mesh");
    expect_only_from_inside<3>(*Compound3::build({box, Sphere{{5, 0, 0}, 1}}), inside, outside, "compound");
    expect_only_from_inside<3>(users::Blob<3>{}, inside, outside, "distance function");
    expect_only_from_inside<3>(stretched(users::Brick<3>{}, {1, 2, 1}), inside, outside, "stretched function");
}

TEST(RaycastAtRest, LeavesWhatHasNoInside) {
    const auto mesh =
        Mesh::build(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, std::vector{glm::uvec3{0, 1, 2}});
    const auto chain = Chain::build({{1, 0}, {-1, 0}}, false);
    for (const float x : {0.0f, -2.0f}) {
        EXPECT_FALSE(raycast(at_rest<3>({x, 0, 0}), *mesh));
        EXPECT_FALSE(raycast(at_rest<3>({x, 0, 0}), at(*mesh, Pose3{{0, 0, 0}, turn_about({1, 0, 0}, 1)})));
        EXPECT_FALSE(raycast(at_rest<3>({x, 0, 0}), Triangle3{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}));
        EXPECT_FALSE(raycast(at_rest<2>({x, 0}), *chain));
        EXPECT_FALSE(raycast(at_rest<2>({x, 0}), Segment2{{-1, 0}, {1, 0}}));
    }
}

/// A ray from a point to itself has length 0: it hits no shape that does not contain the point.
TEST(RaycastAtRest, BetweenAPlaceAndItselfNothingElseIsHit) {
    oracle::Random random(1);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec2 place = to_float(random.in_cube<2>() * 2.0);
        const Circle circle{{0, 0}, 1};
        const bool is_hit = raycast(Ray2::between(place, place), circle).has_value();
        EXPECT_TRUE(!is_hit || closest(circle, place).distance <= 1e-5f) << "number " << i << " from seed 1";
        hits += is_hit;
    }
    EXPECT_GT(hits, 100);
}

template <int D>
void compare_with_distances(std::uint64_t seed) {
    oracle::Random random(seed);
    int hits = 0, total = 0;
    for (int i = 0; i < 3000; ++i) {
        DrawnShapes<D> shapes(random);
        const Vec<D> origin = shapes.point(1);
        shapes.draw([&](const auto& shape) {
            const auto hit = raycast(at_rest<D>(origin), shape);
            const float distance = closest(shape, origin).distance;
            ++total;
            hits += hit.has_value();
            if (std::abs(distance) > 1e-4f) {
                EXPECT_EQ(hit.has_value(), distance < 0) << "number " << i << " from seed " << seed;
            }
            if (!hit) return;
            EXPECT_EQ(hit->distance, 0);
            EXPECT_EQ(hit->fraction, 0);
            EXPECT_EQ(hit->point, origin);
            EXPECT_TRUE(hit->started_inside || distance >= -1e-4f);
        });
    }
    EXPECT_GT(hits, total / 20);
    EXPECT_LT(hits, total - total / 10);
}

TEST(RaycastAtRest, HitsWhatIsNotApartFromItsOrigin) {
    compare_with_distances<2>(2);
    compare_with_distances<3>(3);
}

template <class Phase, int D>
void expect_boxes_around(std::uint64_t seed) {
    oracle::Random random(seed);
    std::vector<Aabb<D>> boxes(300);
    for (Aabb<D>& box : boxes) {
        const Vec<D> low = to_float(random.in_cube<D>() * 3.0);
        box = {low, low + Vec<D>(random.uniform_float(0.1, 2))};
    }
    Phase phase;
    phase.build(boxes);
    std::size_t found = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec<D> origin = to_float(random.in_cube<D>() * 3.0);
        std::vector<std::uint32_t> visited, around;
        phase.raycast(at_rest<D>(origin), [&](std::uint32_t item) { visited.push_back(item); });
        for (std::uint32_t item = 0; item < boxes.size(); ++item)
            if (contains(boxes[item], origin)) around.push_back(item);
        std::sort(visited.begin(), visited.end());
        EXPECT_EQ(visited, around) << "ray " << i << " of seed " << seed;
        found += around.size();
    }
    EXPECT_GT(found, 100u);
}

TEST(RaycastAtRest, EachBroadPhaseVisitsTheBoxesAroundIt) {
    expect_boxes_around<BruteForce<2>, 2>(4);
    expect_boxes_around<SweepAndPrune<2>, 2>(4);
    expect_boxes_around<Grid<2>, 2>(4);
    expect_boxes_around<LayeredGrid<2>, 2>(4);
    expect_boxes_around<Bvh<2>, 2>(4);
    expect_boxes_around<Bsp<2>, 2>(4);
    expect_boxes_around<BruteForce<3>, 3>(5);
    expect_boxes_around<SweepAndPrune<3>, 3>(5);
    expect_boxes_around<Grid<3>, 3>(5);
    expect_boxes_around<LayeredGrid<3>, 3>(5);
    expect_boxes_around<Bvh<3>, 3>(5);
    expect_boxes_around<Bsp<3>, 3>(5);
}

}  // namespace
}  // namespace abut
