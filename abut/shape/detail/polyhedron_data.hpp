#pragma once

// The data of a Polyhedron. For .cpp files.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/point_soa.hpp>
#include <abut/shape/polyhedron.hpp>

#include <utility>
#include <vector>

namespace abut {

struct Polyhedron::Data {
    explicit Data(detail::Hull3 built)
        : hull(std::move(built)),
          facets{hull.normals, hull.loops, hull.loop_ends, hull.edges, hull.offsets},
          columns(3 * detail::padded_count(hull.points.size())),
          lanes(detail::make_soa(hull.points, columns.data())),
          ball(detail::ball_around<3>(hull.points)) {}
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;

    detail::Hull3 hull;
    detail::Facets facets;  ///< refers to `hull`
    std::vector<float> columns;
    detail::PointSoa lanes;  ///< refers to `columns`
    detail::BoundingBall<3> ball;
};

}  // namespace abut
