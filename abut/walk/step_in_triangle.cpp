// The two elementary operations of a walk: a step in a triangle, and the crossing of an edge.

#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/parallel_transport.hpp>
#include <abut/walk/unfolded_triangle-inl.h>

#include <algorithm>
#include <limits>

namespace abut {

using namespace detail;

namespace {

WalkedInTriangle step_in_triangle(const WalkTriangle& walk, const WalkPoint& place, const DVec<2>& step) {
    // Steps are rounded to float when they cross an edge. Without this tolerance a step along an edge could cross it
    // back and forth forever.
    constexpr double rounding = 0x1p-22;
    const double length = square_root(dot(step, step));
    ABUT_ASSERT(walk.is_walkable());
    WalkedInTriangle result;
    result.end = place;
    if (!walk.is_walkable() || !(length <= std::numeric_limits<double>::max())) return result;
    const WalkWeights from = normalised_weights(place.weights), to = stepped(walk, from, step);
    if (is_within(to)) {
        result.end.weights = quantised_weights(to);
        return result;
    }
    const UnfoldedTriangle here = unfolded_ahead(walk, place.triangle, from, step, rounding);
    const double fraction = here.crossing();
    result.end.weights = here.weights_at(fraction);
    result.fraction = static_cast<float>(std::clamp(here.at(fraction)[0] / dot(step, step), 0.0, 1.0));
    result.side = here.side;
    return result;
}

}  // namespace

WalkedInTriangle WalkMesh::walk_in_triangle(const WalkPoint& place, const Vec3& step) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite(step));
    const WalkTriangle& walk = data_->walk[place.triangle];
    return step_in_triangle(walk, place, to_plane_of(walk, step));
}
WalkedInTriangle WalkMesh::walk_in_triangle(const WalkPoint& place, const Vec2& step) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite(step));
    return step_in_triangle(data_->walk[place.triangle], place, DVec<2>(step));
}

std::optional<EdgeCrossing> WalkMesh::cross_edge(const WalkPoint& place) const {
    detail::enter_library();
    for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t opposite = next_corner(next_corner(side));
        if (place.weights[static_cast<glm::length_t>(opposite)] != 0) continue;
        if (std::optional<EdgeCrossing> crossing = cross_edge(place, side)) return crossing;
    }
    return std::nullopt;
}

std::optional<EdgeCrossing> WalkMesh::cross_edge(const WalkPoint& place, std::uint32_t side) const {
    detail::enter_library();
    ABUT_ASSERT(side < 3);
    const auto of = [&](std::uint32_t corner) { return place.weights[static_cast<glm::length_t>(corner)]; };
    const std::uint32_t end = next_corner(side);
    ABUT_ASSERT(of(next_corner(end)) == 0);
    const WalkTriangle& from = data_->walk[place.triangle];
    const WalkLink link = from.link[side];
    if (link.is_border()) return std::nullopt;
    const WalkTriangle& to = data_->walk[link.triangle()];
    const std::uint32_t beyond = link.side(), beyond_end = next_corner(beyond);

    EdgeCrossing result;
    result.place.triangle = link.triangle();
    result.place.weights = Vec3(0);
    result.place.weights[static_cast<glm::length_t>(link.mirrored() ? beyond : beyond_end)] = of(side);
    result.place.weights[static_cast<glm::length_t>(link.mirrored() ? beyond_end : beyond)] = of(end);
    // The direction of the side in both frames.
    const DVec<2> along = normalized(WalkFrame(from).corner(end) - WalkFrame(from).corner(side));
    const DVec<2> along_beyond = normalized(WalkFrame(to).corner(beyond_end) - WalkFrame(to).corner(beyond));
    result.rotation =
        transport_along(from, along, to, link.mirrored() ? along_beyond : -along_beyond, link.mirrored(), 1);
    return result;
}

}  // namespace abut
