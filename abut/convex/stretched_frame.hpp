#pragma once

// A frame in which any set of points is about as wide as it is long and high.

#include <abut/math/linear.hpp>
#include <abut/math/vec.hpp>

#include <optional>
#include <span>

namespace abut {

/// A map of the world and its inverse. What is thin, long or far from the origin in the world is ordinary in the frame,
/// and an affine map keeps the ratio of any two volumes: what adds least in one adds least in the other.
template <int D>
struct StretchedFrame {
    DVec<D> origin;       ///< a point of the world; the maps see all relative to it, which costs no digits
    Affine<D> into, out;  ///< from the world and to it

    DVec<D> from_world(const DVec<D>& p) const { return into.point(p - origin); }
    DVec<D> to_world(const DVec<D>& p) const { return origin + out.point(p); }
};

/// The frame whose axes go along the farthest two corners, to the corner farthest from their line, and in space across
/// both, and in which the bounding box of the points is the cube of side 1 around the origin. The corners are some of
/// the points, in an order of their own. Nothing where the points have no area (in space no volume) in doubles.
std::optional<StretchedFrame<2>> stretched_frame(std::span<const Vec2> corners, std::span<const Vec2> points);
std::optional<StretchedFrame<3>> stretched_frame(std::span<const Vec3> corners, std::span<const Vec3> points);

}  // namespace abut
