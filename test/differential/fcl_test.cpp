// Distances and decisions against FCL in double, with both of its solvers.

#include "../../bench/fcl.hpp"

#include "compare.hpp"

#include <memory>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace abut::differential {
namespace {

using bench::to_fcl;
using Geometry = std::unique_ptr<fcl::CollisionGeometryd>;

Geometry geometry_of(const Box3& box) {
    return std::make_unique<fcl::Boxd>(2 * to_fcl(box.half));
}
Geometry geometry_of(const Sphere& ball) {
    return std::make_unique<fcl::Sphered>(ball.radius);
}
Geometry geometry_of(const Capsule3& capsule) {
    return std::make_unique<fcl::Capsuled>(capsule.radius, capsule.b.y - capsule.a.y);
}
Geometry geometry_of(const Polyhedron& hull) {
    auto points = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3& point : hull.points()) points->push_back(to_fcl(point));
    auto faces = std::make_shared<std::vector<int>>();
    const Facets& facets = hull.facets();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : facets.loop_ends) {
        faces->push_back(static_cast<int>(end - begin));
        for (; begin < end; ++begin) faces->push_back(static_cast<int>(facets.loops[begin]));
    }
    return std::make_unique<fcl::Convexd>(points, static_cast<int>(facets.loop_ends.size()), faces);
}

/// FCL's capsules lie along z, ours along y.
fcl::Transform3d pose_of(const Body& body) {
    fcl::Transform3d result = to_fcl(body.pose);
    if (std::holds_alternative<Capsule3>(body.shape))
        result.linear() *= (fcl::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
    return result;
}

std::optional<Answer> ask(const Body& a, const Body& b, fcl::GJKSolverType solver) {
    const auto make = [](const Body& body) {
        return std::visit([](const auto& shape) { return geometry_of(shape); }, body.shape);
    };
    const Geometry geometry_a = make(a), geometry_b = make(b);
    const fcl::Transform3d pose_a = pose_of(a), pose_b = pose_of(b);
    fcl::DistanceRequestd request(true, solver == fcl::GST_LIBCCD);
    request.gjk_solver_type = solver;
    fcl::DistanceResultd gap;
    fcl::distance(geometry_a.get(), pose_a, geometry_b.get(), pose_b, request, gap);
    if (gap.min_distance > 0) {
        const fcl::Vector3d n = (gap.nearest_points[1] - gap.nearest_points[0]).normalized();
        return Answer{gap.min_distance, DVec<3>(n.x(), n.y(), n.z())};
    }
    if (solver == fcl::GST_LIBCCD) return Answer{gap.min_distance};

    // FCL's own solver knows the depth only as that of contacts, of either sign.
    fcl::CollisionRequestd contact_request(4, true);
    contact_request.gjk_solver_type = solver;
    fcl::CollisionResultd contacts;
    fcl::collide(geometry_a.get(), pose_a, geometry_b.get(), pose_b, contact_request, contacts);
    if (contacts.numContacts() == 0) return {};
    double depth = 0;
    for (std::size_t i = 0; i < contacts.numContacts(); ++i)
        depth = std::max(depth, std::abs(contacts.getContact(i).penetration_depth));
    return Answer{-depth};
}

TEST(Fcl, AgreesOnDistancesAndOverlapsWithLibccd) {
    const auto ask_fcl = [](const Body& a, const Body& b) { return ask(a, b, fcl::GST_LIBCCD); };
    const Tally tally = compare("fcl with libccd", ask_fcl, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

// Its penetration search goes wrong for most pairs of hulls; its gaps and decisions are sound.
TEST(Fcl, AgreesOnDistancesAndOverlapsWithItsOwnSolver) {
    const auto ask_fcl = [](const Body& a, const Body& b) { return ask(a, b, fcl::GST_INDEP); };
    const Tally tally = compare("fcl with its own solver", ask_fcl, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
}

}  // namespace
}  // namespace abut::differential
