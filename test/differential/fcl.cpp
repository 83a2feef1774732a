// FCL in double, with both of its solvers.

#include "peers.hpp"

#include <exception>
#include <memory>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace abut::differential {

using namespace detail;

namespace {

fcl::Vector3d vector(const DVec<3>& v) {
    return {v.x, v.y, v.z};
}

struct Placed {
    std::unique_ptr<fcl::CollisionGeometryd> geometry;
    fcl::Transform3d pose = fcl::Transform3d::Identity();
};

Placed placed(const PeerShape& shape) {
    Placed result;
    if (shape.form == Form::hull) {
        auto points = std::make_shared<std::vector<fcl::Vector3d>>();
        for (const DVec<3>& point : shape.points) points->push_back(vector(point));
        auto faces = std::make_shared<std::vector<int>>();
        for (const std::vector<int>& loop : shape.faces) {
            faces->push_back(static_cast<int>(loop.size()));
            faces->insert(faces->end(), loop.begin(), loop.end());
        }
        result.geometry = std::make_unique<fcl::Convexd>(points, static_cast<int>(shape.faces.size()), faces);
        result.pose.translation() = vector(shape.center);
        return result;
    }
    result.pose.translation() = vector(shape.center + shape.middle());
    if (shape.form == Form::ball) {
        result.geometry = std::make_unique<fcl::Sphered>(shape.radius);
    } else if (shape.form == Form::capsule) {
        // FCL's capsules lie along z.
        const DVec<3> along = shape.points[1] - shape.points[0], z = normalized(along), x = perpendicular(z);
        result.geometry = std::make_unique<fcl::Capsuled>(shape.radius, length(along));
        result.pose.linear() << vector(x), vector(cross(z, x)), vector(z);
    } else {
        result.geometry = std::make_unique<fcl::Boxd>(vector(shape.half * 2.0));
        result.pose.linear() << vector(shape.axes[0]), vector(shape.axes[1]), vector(shape.axes[2]);
    }
    return result;
}

PeerAnswer query(const PeerShape& a, const PeerShape& b, fcl::GJKSolverType solver) {
    try {
        const Placed in_a = placed(a), in_b = placed(b);
        fcl::CollisionRequestd wanted(4, true);
        wanted.gjk_solver_type = solver;
        fcl::CollisionResultd contacts;
        const bool overlap =
            fcl::collide(in_a.geometry.get(), in_a.pose, in_b.geometry.get(), in_b.pose, wanted, contacts) > 0;
        fcl::DistanceRequestd request(true, solver == fcl::GST_LIBCCD);
        request.gjk_solver_type = solver;
        fcl::DistanceResultd gap;
        fcl::distance(in_a.geometry.get(), in_a.pose, in_b.geometry.get(), in_b.pose, request, gap);
        double distance = gap.min_distance;
        if (solver == fcl::GST_INDEP && overlap && !(distance > 0)) {
            // FCL's own solver returns the depth only with contacts, with either sign.
            double depth = 0;
            for (std::size_t i = 0; i < contacts.numContacts(); ++i)
                depth = std::max(depth, std::abs(contacts.getContact(i).penetration_depth));
            distance = -depth;
        }
        const fcl::Vector3d n = (gap.nearest_points[1] - gap.nearest_points[0]).normalized();
        return {PeerAnswer::State::answered, overlap, true, distance, DVec<3>(n.x(), n.y(), n.z())};
    } catch (const std::exception&) {
        return {PeerAnswer::State::refused};
    }
}

}  // namespace

PeerAnswer query_fcl_libccd(const PeerShape& a, const PeerShape& b, double) {
    return query(a, b, fcl::GST_LIBCCD);
}
PeerAnswer query_fcl_indep(const PeerShape& a, const PeerShape& b, double) {
    return query(a, b, fcl::GST_INDEP);
}

}  // namespace abut::differential
