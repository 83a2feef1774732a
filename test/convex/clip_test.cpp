// Cuts of single bodies by planes, the half-spaces of bodies, and the clipping of one body by another.

#include "../oracle/random.hpp"
#include <abut/convex/manifold/clip.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using Loop = std::vector<std::uint32_t>;

template <class S>
auto body_of(const S& shape) {
    const auto seen = convex(shape);
    constexpr int D = decltype(seen.place.offset)::length();
    return clip_body(seen, DVec<D>(0.0));
}

ClipBody<3> cube() {
    return body_of(Aabb3{Vec3(0), Vec3(2)});
}

/// Every edge must be used as often in one direction as in the other.
testing::AssertionResult closed(const ClipBody<3>& body) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const Loop& loop : body.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
            if (from != to) balance[std::minmax(from, to)] += from < to ? 1 : -1;
        }
    for (const auto& [edge, sum] : balance)
        if (sum != 0) return testing::AssertionFailure() << "an edge of " << edge.first << " and " << edge.second;
    return testing::AssertionSuccess();
}

double volume(const ClipBody<3>& body) {
    double six = 0;
    for (const Loop& loop : body.loops)
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            six += dot(body.points[loop[0]], cross(body.points[loop[i]], body.points[loop[i + 1]]));
    return six / 6;
}

TEST(Cut, OfACubeOpensItAndClosesItAgain) {
    ClipBody<3> body = cube();
    EXPECT_DOUBLE_EQ(volume(body), 8);
    const DVec<3> diagonal = normalized(DVec<3>(1));
    const auto caps = cut(body, {diagonal, dot(diagonal, DVec<3>(2, 2, 1))}, 1e-14);
    ASSERT_EQ(caps.size(), 1u);
    EXPECT_EQ(caps[0].size(), 3u);
    EXPECT_EQ(body.points.size(), 10u);
    EXPECT_EQ(body.loops.size(), 7u);
    EXPECT_NEAR(volume(body), 8 - 1.0 / 6, 1e-14);
    EXPECT_TRUE(closed(body));
}

TEST(Cut, ThroughCornersAddsNone) {
    ClipBody<3> body = cube();
    const DVec<3> diagonal = normalized(DVec<3>(1));
    const auto caps = cut(body, {diagonal, dot(diagonal, DVec<3>(2, 2, 0))}, 1e-14);
    ASSERT_EQ(caps.size(), 1u);
    EXPECT_EQ(caps[0].size(), 3u);
    EXPECT_EQ(body.points.size(), 7u);
    EXPECT_NEAR(volume(body), 8 - 8.0 / 6, 1e-14);
    EXPECT_TRUE(closed(body));
}

TEST(Cut, InFrontOfEverythingChangesNothing) {
    for (const double offset : {2.0, 3.0}) {
        ClipBody<3> body = cube();
        EXPECT_TRUE(cut(body, {DVec<3>(1, 0, 0), offset}, 1e-14).empty());
        EXPECT_EQ(body.points.size(), 8u);
        EXPECT_EQ(body.loops.size(), 6u);
    }
}

TEST(Cut, LeavesWhatTouchesThePlane) {
    ClipBody<3> face = cube(), edge = cube(), corner = cube(), nothing = cube();
    cut(face, {DVec<3>(1, 0, 0), 0}, 1e-14);
    EXPECT_EQ(face.points.size(), 4u);
    EXPECT_TRUE(closed(face));
    cut(edge, {normalized(DVec<3>(1, 1, 0)), 0}, 1e-14);
    EXPECT_EQ(edge.points, (std::vector<DVec<3>>{{0, 0, 0}, {0, 0, 2}}));
    cut(corner, {normalized(DVec<3>(1, 1, 1)), 0}, 1e-14);
    EXPECT_EQ(corner.points, (std::vector<DVec<3>>{{0, 0, 0}}));
    cut(nothing, {DVec<3>(1, 0, 0), -1e-3}, 1e-14);
    EXPECT_TRUE(nothing.empty());
    EXPECT_TRUE(nothing.points.empty());
}

TEST(Cut, OfFlatBodies) {
    ClipBody<3> triangle = body_of(Triangle<3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
    EXPECT_TRUE(cut(triangle, {DVec<3>(1, 0, 0), 1}, 1e-14).empty());
    EXPECT_EQ(triangle.points.size(), 4u);
    EXPECT_TRUE(closed(triangle));
    ClipBody<3> segment = body_of(Segment<3>{{0, 0, 0}, {4, 0, 0}});
    cut(segment, {DVec<3>(1, 0, 0), 1}, 1e-14);
    EXPECT_EQ(segment.points, (std::vector<DVec<3>>{{0, 0, 0}, {1, 0, 0}}));
    ClipBody<2> square = body_of(Aabb2{Vec2(0), Vec2(2)});
    cut(square, {DVec<2>(0, 1), 1}, 1e-14);
    EXPECT_EQ(square.points.size(), 4u);
    EXPECT_EQ(square.loops.size(), 1u);
    cut(square, {DVec<2>(0, 1), 0}, 1e-14);
    EXPECT_EQ(square.points.size(), 2u);
}

// Planes with small integer coefficients, which often contain corners, edges and faces.
TEST(Cut, StaysClosedThroughManyCuts) {
    int cuts = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        ClipBody<3> body = body_of(Aabb3{Vec3(-2), Vec3(2)});
        for (int i = 0; i < 12 && !body.empty(); ++i) {
            const auto whole = [&] { return static_cast<double>(random.below(5)) - 2; };
            const DVec<3> normal(whole(), whole(), whole());
            if (normal == DVec<3>(0.0)) continue;
            const double before = volume(body);
            // Without a tolerance, some corners that lie on the plane up to rounding count as cut.
            const double tolerance = seed % 2 == 0 ? 0 : 1e-14;
            cut(body, {normalized(normal), static_cast<double>(random.below(3)) / length(normal)}, tolerance);
            EXPECT_TRUE(closed(body));
            EXPECT_LE(volume(body), before + 1e-12);
            EXPECT_GE(volume(body), -1e-12);
            ++cuts;
        }
    }
    EXPECT_GT(cuts, 2000);
}

TEST(ClipPlanes, HoldTheBody) {
    const auto count = [](const auto& body) {
        const auto found = clip_planes(body);
        for (const auto& plane : found.planes) {
            EXPECT_NEAR(length(plane.normal), 1, 1e-14);
            for (const auto& point : body.points) EXPECT_LE(dot(plane.normal, point), plane.offset);
        }
        EXPECT_LT(found.excess, 1e-12);
        return found.planes.size();
    };
    EXPECT_EQ(count(cube()), 6u);
    EXPECT_EQ(count(body_of(Box3{Vec3(1), Vec3(1, 2, 0)})), 6u);
    EXPECT_EQ(count(body_of(Box3{Vec3(1), Vec3(0, 2, 0)})), 6u);
    EXPECT_EQ(count(body_of(Box3{Vec3(1), Vec3(0)})), 6u);
    EXPECT_EQ(count(body_of(Triangle<3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}})), 5u);
    EXPECT_EQ(count(body_of(Triangle<3>{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}})), 6u);
    EXPECT_EQ(count(body_of(Polyhedron())), 6u);
    EXPECT_EQ(count(body_of(Aabb2{Vec2(0), Vec2(2)})), 4u);
    EXPECT_EQ(count(body_of(Triangle<2>{{0, 0}, {0, 2}, {2, 0}})), 3u);
    EXPECT_EQ(count(body_of(Segment<2>{{0, 0}, {2, 1}})), 4u);
    EXPECT_EQ(count(body_of(Polygon())), 4u);
}

TEST(ClipPlanes, OfWhatIsStretchedFlatAreThoseOfTheFlatShape) {
    const auto squashed = mapped(convex(Aabb3{Vec3(-1), Vec3(1)}),
                                 scaling(Vec3(1, 1, 0)) * affine(Pose3{Vec3(0), turn_about(Vec3(1, 0, 0), 0.5f)}));
    Convex<3> seen = convex(Aabb3{Vec3(-1), Vec3(1)});
    static_cast<Placement<3>&>(seen) = squashed;
    const ClipPlanes<3> found = clip_planes(clip_body(seen, DVec<3>(0.0)));
    EXPECT_EQ(found.planes.size(), 6u);  // two sides, four edges
    EXPECT_NEAR(std::abs(found.planes[0].normal.z), 1, 1e-12);
    EXPECT_NEAR(found.planes[0].offset, 0, 1e-12);
}

TEST(Clip, OfWhatLiesInsideIsItself) {
    const Polyhedron inner =
        *Polyhedron::build({{0.1f, 0.2f, 0.3f}, {0.7f, 0.1f, 0}, {0, 0.6f, 0.2f}, {0.3f, 0.3f, 1}});
    const Box3 outer{Vec3(0), Vec3(5), turn_about(Vec3(0, 0, 1), 0.3f)};
    const std::vector<DVec<3>> expected{inner.points().begin(), inner.points().end()};
    EXPECT_EQ(clip(convex(inner), convex(outer)), expected);
    EXPECT_EQ(clip(convex(outer), convex(inner)), expected);
}

TEST(Clip, OfWhatIsApartIsEmpty) {
    EXPECT_TRUE(clip(convex(Aabb3{Vec3(0), Vec3(1)}), convex(Aabb3{Vec3(2), Vec3(3)})).empty());
    EXPECT_TRUE(clip(convex(Segment<2>{{0, 0}, {1, 0}}), convex(Segment<2>{{2, 0}, {3, 1}})).empty());
}

TEST(Clip, ReportsEachCut) {
    Trace<2> trace;
    clip(convex(Aabb2{Vec2(0), Vec2(2)}), convex(Aabb2{Vec2(1), Vec2(4)}), &trace);
    ASSERT_EQ(trace.steps.size(), 4u);
    std::vector<float> offsets;
    for (const auto& step : trace.steps) {
        const auto& found = std::get<ClipStep<2>>(step);
        EXPECT_EQ(found.points.size(), 4u);
        offsets.push_back(found.offset);
        for (const Vec2& point : found.points) EXPECT_LE(dot(DVec<2>(found.normal), DVec<2>(point)), found.offset);
    }
    EXPECT_EQ(std::multiset<float>(offsets.begin(), offsets.end()), (std::multiset<float>{-1, -1, 4, 4}));

    Trace<3> in_space;
    clip(convex(Aabb3{Vec3(0), Vec3(2)}), convex(Aabb3{Vec3(1, 1, -1), Vec3(4)}), &in_space);
    int faces = 0;
    for (const auto& step : in_space.steps) faces += std::get<ClipStep<3>>(step).points.size() == 4 ? 1 : 0;
    EXPECT_EQ(faces, 2);
    EXPECT_EQ(in_space.steps.size(), 6u);
}

// Faces of a flake are merged if their angle is up to 1e-6 of its extent. Their planes then intersect far outside of
// the flake: a result once stuck out by up to 70,000 tolerances.
TEST(Clip, StaysWithinTheRimOfAFlake) {
    std::size_t max_cuts = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        std::vector<Vec3> rim;
        float reach = 0;
        for (int i = 0; i < 30; ++i) {
            const DVec<3> u = random.direction<3>();
            rim.push_back(to_float(DVec<3>(u.x, u.y, 3e-6 * u.z)));
            reach = std::max(reach, rim.back().x);
        }
        const Polyhedron flake = *Polyhedron::build(rim);
        Trace<3> trace;
        const auto found = clip(convex(flake), convex(Aabb3{Vec3(-0.5f), Vec3(3)}), &trace);
        max_cuts = std::max(max_cuts, trace.steps.size());
        trace.clear();
        const auto again = clip(convex(Aabb3{Vec3(-0.5f), Vec3(0.9f)}), convex(flake), &trace);
        max_cuts = std::max(max_cuts, trace.steps.size());
        ASSERT_FALSE(found.empty());
        ASSERT_FALSE(again.empty());
        for (const DVec<3>& point : found) EXPECT_LE(point.x, reach + 1e-6);
        for (const DVec<3>& point : again) {
            EXPECT_LE(length(point), 1 + 1e-6);
            EXPECT_LE(std::abs(point.z), 4e-6);
        }
    }
    EXPECT_LT(max_cuts, 200u);
}

}  // namespace
}  // namespace abut
