#pragma once

// An affine frame in which a set of points is about as wide as it is long and high.

#include <abut/math/affine.hpp>

#include <optional>
#include <span>

namespace abut::detail {

/// A map of the world and its inverse. A thin, long or distant body is well conditioned in the frame. An affine map
/// preserves ratios of volumes, so the minimum added volume is the same in both.
template <int D>
struct StretchedFrame {
    DVec<D> origin;       ///< a point of the world; the maps work relative to it, without loss of precision
    Affine<D> into, out;  ///< from the world and to it

    DVec<D> from_world(const DVec<D>& p) const { return into.point(p - origin); }
    DVec<D> to_world(const DVec<D>& p) const { return origin + out.point(p); }
};

/// The axes go from the farthest two corners, to the corner farthest from their line, and in 3D orthogonal to both. The
/// bounding box of the points becomes the cube of side 1 around the origin. The corners are some of the points, in any
/// order. Nothing if the points have no area (in 3D no volume) in double.
template <int D>
std::optional<StretchedFrame<D>> stretched_frame(std::span<const Vec<D>> corners, std::span<const Vec<D>> points);

}  // namespace abut::detail
