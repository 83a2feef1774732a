#include "peers.hpp"

#include <abut/shape/polyhedron.hpp>

namespace abut::differential {

using namespace detail;

namespace {

bool is_box(oracle::Kind kind) {
    return kind == oracle::Kind::box || kind == oracle::Kind::aabb || kind == oracle::Kind::stretched_box;
}

/// The peers need the faces of a hull, which abut provides. The points are the sample's, at their pose.
bool make_hull(const oracle::Polytope<3>& solid, PeerShape& shape) {
    const Polyhedron hull = *Polyhedron::build(solid.points);
    if (hull.rank() < 2) return false;
    Affine<3> place = solid.place;
    place.offset -= shape.center;
    for (const Vec3& point : hull.points()) shape.points.push_back(place.point(DVec<3>(point)));
    const Facets& facets = hull.facets();
    for (std::size_t face = 0; face < facets.loop_ends.size(); ++face) {
        std::vector<int>& loop = shape.faces.emplace_back();
        for (const std::uint32_t i : facets.loop(face)) loop.push_back(static_cast<int>(i));
    }
    return true;
}

}  // namespace

std::optional<PeerShape> peer_shape(const oracle::Sample<3>& sample) {
    const oracle::Polytope<3>& solid = sample.solid;
    PeerShape shape;
    shape.center = DVec<3>(to_float(oracle::middle(solid)));
    shape.size = oracle::size(solid);
    shape.radius = solid.radius;
    if (solid.points.size() <= 2) {
        shape.form = solid.points.size() == 1 ? Form::ball : Form::capsule;
        shape.points = oracle::corners_relative_to(solid, shape.center);
        return shape;
    }
    if (solid.radius > 0) return std::nullopt;
    if (is_box(sample.kind) && sample.kind != oracle::Kind::stretched_box) {
        shape.form = Form::box;
        shape.points = oracle::corners_relative_to(solid, shape.center);
        shape.axes = solid.place.column;
        shape.half = (DVec<3>(solid.points.back()) - DVec<3>(solid.points.front())) * 0.5;
        return shape;
    }
    if (!make_hull(solid, shape)) return std::nullopt;
    return shape;
}

}  // namespace abut::differential
