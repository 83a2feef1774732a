#pragma once

// Convex bodies around points, rounded to floats such that they still contain them.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/limited/linear_program.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace abut::detail {

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
