#include <abut/math/assert.hpp>
#include <abut/walk/walk_frame.hpp>
#include <abut/walk/walk_slide.hpp>
#include <abut/walk/walk_turn.hpp>
#include <abut/walk/walk_way-inl.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

/// The step is in the frame of the triangle.
Walked walk_on(const WalkTriangle* triangles, const WalkPoint& place, const DVec<2>& step, const WalkOptions& options) {
    const WalkTriangle& walk = triangles[place.triangle];
    const double square = dot(step, step), length = std::sqrt(square);
    ABUT_ASSERT(walk.is_walkable());
    Walked result;
    result.place = place;
    if (!walk.is_walkable() || !(square <= std::numeric_limits<double>::max())) return result;

    const WalkWeights from = shares(place.weights), to = stepped(walk, from, step);
    if (is_within(to)) {
        result.place.weights = in_grains(to);
        result.length = static_cast<float>(length);
        return result;
    }

    WalkWay way{unfolded_ahead(walk, place.triangle, from, step), square, options.max_crossings};
    const WalkStop stop = go_straight(triangles, options, way);
    bool reflected = false;
    if (stop == WalkStop::within) {
        result.place.weights = in_grains(way.here.weights(way.left));
        result.length = static_cast<float>(length);
    } else {
        WalkSlide slide(triangles, options, way);
        slide.run(stop);
        way = slide.way();
        reflected = slide.reflected();
        const double walked = std::min(way.walked / length, length);
        result.place.weights = slide.weights();
        result.length = static_cast<float>(walked);
        result.lost = static_cast<float>(length - walked);
        result.met = slide.met();
        result.side = slide.barrier();
    }
    result.place.triangle = way.here.triangle;
    result.crossings = way.crossings;
    if (way.crossings > 0) {
        const WalkTriangle& last = triangles[way.here.triangle];
        result.turn = turn_along(walk, step, last, way.here.step_in(last), way.here.mirrored != reflected, square);
    }
    return result;
}

}  // namespace

Walked WalkMesh::walk(const WalkPoint& place, const Vec3& step, const WalkOptions& options) const {
    ABUT_ASSERT(is_finite(step));
    const WalkTriangle* triangles = data_->walk.data();
    return walk_on(triangles, place, to_plane_of(triangles[place.triangle], step), options);
}
Walked WalkMesh::walk(const WalkPoint& place, const Vec2& step, const WalkOptions& options) const {
    ABUT_ASSERT(is_finite(step));
    return walk_on(data_->walk.data(), place, DVec<2>(step), options);
}

}  // namespace abut
