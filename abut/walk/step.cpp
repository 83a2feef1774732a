#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/geodesic-inl.h>
#include <abut/walk/parallel_transport.hpp>
#include <abut/walk/slide.hpp>

#include <algorithm>
#include <limits>

namespace abut {

using namespace detail;

namespace {

/// `step` is in the frame of the triangle.
Walked walk_on(const WalkTriangle* triangles, const WalkPoint& place, const DVec<2>& step, const WalkOptions& options) {
    const WalkTriangle& walk = triangles[place.triangle];
    const double square = dot(step, step), length = square_root(square);
    ABUT_ASSERT(walk.is_walkable());
    Walked result;
    result.place = place;
    if (!walk.is_walkable() || !(square <= std::numeric_limits<double>::max())) return result;

    const WalkWeights from = normalised_weights(place.weights), to = stepped(walk, from, step);
    if (is_within(to)) {
        result.place.weights = quantised_weights(to);
        result.length = static_cast<float>(length);
        return result;
    }

    WalkGeodesic geodesic{unfolded_ahead(walk, place.triangle, from, step), square, options.max_crossings};
    const WalkStop stop = trace_geodesic(triangles, options, geodesic);
    bool reflected = false;
    if (stop == WalkStop::within) {
        result.place.weights = quantised_weights(geodesic.here.weights(geodesic.remaining));
        result.length = static_cast<float>(length);
    } else {
        WalkSlide slide(triangles, options, geodesic);
        slide.run(stop);
        geodesic = slide.geodesic();
        reflected = slide.reflected();
        const double walked = std::min(geodesic.walked / length, length);
        result.place.weights = slide.weights();
        result.length = static_cast<float>(walked);
        result.lost = static_cast<float>(length - walked);
        result.met = slide.met();
        result.side = slide.barrier();
    }
    result.place.triangle = geodesic.here.triangle;
    result.crossings = geodesic.crossings;
    if (geodesic.crossings > 0) {
        const WalkTriangle& last = triangles[geodesic.here.triangle];
        result.turn =
            transport_along(walk, step, last, geodesic.here.step_in(last), geodesic.here.mirrored != reflected, square);
    }
    return result;
}

}  // namespace

Walked WalkMesh::walk(const WalkPoint& place, const Vec3& step, const WalkOptions& options) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite(step));
    const WalkTriangle* triangles = data_->walk.data();
    return walk_on(triangles, place, to_plane_of(triangles[place.triangle], step), options);
}
Walked WalkMesh::walk(const WalkPoint& place, const Vec2& step, const WalkOptions& options) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite(step));
    return walk_on(data_->walk.data(), place, DVec<2>(step), options);
}

}  // namespace abut
