#pragma once

// The 2D shapes of the corpus as plain shapes without a pose. They serve to judge queries with closed forms, which use
// no views.

#include "../oracle/sample.hpp"

namespace abut::corpus {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::to_float;

using oracle::Kind;
using oracle::Random;
using oracle::Sample;

/// Refers to data of the sample.
struct PlainSample {
    Sample<2> sample;
    detail::ShapeRef<2> given;
};

template <class S>
PlainSample plain_sample(Kind kind, S shape, oracle::Polytope<2> solid) {
    auto keeper = std::make_shared<const S>(std::move(shape));
    return {{kind, keeper, View<2>(view(*keeper)), std::move(solid)}, shape_ref(*keeper)};
}

/// The box with three given corners, in order.
inline PlainSample plain_box(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
    const DVec<2> along = normalized(b - a);
    const Box2 box{to_float((a + c) * 0.5),
                   to_float(DVec<2>(length(b - a), length(c - b)) * 0.5),
                   {static_cast<float>(along.x), static_cast<float>(along.y)}};
    return plain_sample(Kind::box, box, oracle::box_of<2>(detail::affine(Pose2{box.center, box.rotation}), box.half));
}

/// The shape with its vertices rounded to floats; shapes other than balls and capsules lose their radius.
inline PlainSample plain(const Sample<2>& sample, Random& random) {
    const auto corners = oracle::corners_relative_to(sample.solid, DVec<2>(0.0));
    if ((sample.kind == Kind::box || sample.kind == Kind::aabb) && corners.size() == 4) {
        // The order of the corners is by axes, or around the polygon.
        const bool round = dot(corners[1] - corners[0], corners[2] - corners[1]) <
                           0.5 * length(corners[1] - corners[0]) * length(corners[2] - corners[1]);
        return plain_box(corners[0], corners[1], round ? corners[2] : corners[3]);
    }
    std::vector<Vec2> points;
    for (const DVec<2>& corner : corners) points.push_back(to_float(corner));
    const float radius = static_cast<float>(sample.solid.radius);
    const auto solid = [&](std::vector<Vec2> of, double ball) { return oracle::hull_of<2>(std::move(of), ball); };
    if (points.size() == 1)
        return plain_sample(Kind::ball, Circle{points[0], radius}, solid(points, static_cast<double>(radius)));
    if (points.size() == 2 && radius > 0)
        return plain_sample(Kind::capsule, Capsule2{points[0], points[1], radius},
                            solid(points, static_cast<double>(radius)));
    if (points.size() == 2) return plain_sample(Kind::segment, Segment2{points[0], points[1]}, solid(points, 0));
    if (points.size() == 3 && random.chance(0.5))
        return plain_sample(Kind::triangle, Triangle2{points[0], points[1], points[2]}, solid(points, 0));
    Pose2 pose;
    if (random.chance(0.5)) {
        pose = {points[0], random.rotation<2>()};
        const detail::Affine<2> place = detail::affine(pose);
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = to_float(place.transposed(corners[i] - place.offset));
    }
    Polygon polygon = *Polygon::build(points);
    std::vector<Vec2> built(polygon.points().begin(), polygon.points().end());
    return plain_sample(Kind::polytope, at(std::move(polygon), pose),
                        mapped(solid(std::move(built), 0), detail::affine(pose)));
}

}  // namespace abut::corpus
