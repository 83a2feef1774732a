#pragma once

// Convex bodies around points, rounded to floats such that they still contain them.

#include <abut/convex/hull/hull.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/detail/plane.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

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

/// The same plane with its sides swapped.
template <int D>
Plane<D> flipped(const Plane<D>& plane) {
    return {-plane.normal, -plane.offset};
}

/// The point with the minimum dot(cost, p) above (or on) all planes, by the dual simplex method (Lemke 1954). Nothing
/// if there is none, or none within 1e4 times `size` of the origin. The normals have length 1; the point may be below a
/// plane by 1e-11 times `size`. Intended for some ten planes, because each step tests all of them.
std::optional<DVec<3>> lowest_above(std::span<const Plane<3>> planes, const DVec<3>& cost, double size);

template <int D>
using HullOf = std::conditional_t<D == 2, Hull2, Hull3>;

/// A convex body in a frame.
template <int D>
struct OuterBody {
    double size = 0;  ///< its area or volume in the world
    std::vector<DVec<D>> corners;
    std::vector<Plane<D>> planes;                     ///< of its faces, outwards
    std::vector<std::vector<std::uint32_t>> through;  ///< one per corner: the planes through it
};

/// The smallest hull with floats as corners of these bodies and, if the limit allows its corners, the bounding box.
/// Every point lies in it, exactly. Nothing if all of them would leave the range of floats.
template <int D>
std::optional<HullOf<D>> smallest_rounded(std::vector<OuterBody<D>> bodies, std::span<const Vec<D>> points,
                                          std::size_t limit, const StretchedFrame<D>& frame);

/// The hull of a few corners, and its area or volume. Nothing if a point lies outside, which is decided exactly. In 3D
/// the faces are decided in the frame, where the hull isn't thin. Normals, offsets and sizes are those of the world,
/// and the offsets bound the points as well.
std::optional<Hull2> hull_around(std::span<const Vec2> corners, std::span<const Vec2> points,
                                 const StretchedFrame<2>& frame);
std::optional<Hull3> hull_around(std::span<const Vec3> corners, std::span<const Vec3> points,
                                 const StretchedFrame<3>& frame);
double size_of(const Hull2& hull);
double size_of(const Hull3& hull);

}  // namespace abut::detail
