#pragma once

// A convex set as the engines of this folder see it: a core, placed, with a ball rolled around it.
//
//     S = place * (core + inner ball) + ball,     "+" the Minkowski sum
//
// A circle, a capsule, a rounded box and a hull are one thing to them, and touching cases stay well conditioned:
// the cores of two touching rounded shapes are apart by their radii.

#include <abut/convex/facets.hpp>
#include <abut/convex/point_lanes.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/linear.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>

namespace abut {

/// What a convex core is made of.
enum class Core : std::uint8_t {
    points,    ///< the hull of 1..n points
    box,       ///< a box about the origin, by its half extents
    discs,     ///< the hull of two parallel discs (D = 3): cylinder, cone
    function,  ///< known by its support function alone
};

/// How a set is placed: place * (set + inner ball) + ball.
template <int D>
struct Placement {
    Affine<D> place;          ///< from the shape's own frame to the world
    bool similar = true;      ///< place keeps angles: a ball stays a ball
    double scale = 1;         ///< how place changes lengths, where `similar`
    double inner_radius = 0;  ///< of the ball added before `place`
    double radius = 0;        ///< of the ball added after
};

/// The same placement moved, turned or stretched by `map`. What was stretched and then rounded can't be stretched again
/// (its ball would become the sum of two different ellipsoids); poses and uniform scales always work.
template <int D>
Placement<D> mapped(const Placement<D>& placement, const Affine<D>& map);

/// A small value that refers to the points, facets or object of a shape and must not outlive it. What `core` and
/// `count` don't speak of is left as it was: every question makes two of these.
template <int D>
struct Convex : Placement<D> {
    Core core = Core::points;
    /// A segment of the plane, or a triangle in space: rays, sweeps and contacts meet it from its front alone, as
    /// `front` tells. What overlaps it and how far it is doesn't depend on sides.
    bool one_sided = false;
    std::uint32_t count = 1;  ///< of points
    /// Up to three points; box: [0] the half extents; discs: [0], [1] their centres.
    std::array<Vec<D>, 3> own{};
    std::array<float, 2> disc_radius;
    const Vec<D>* points = nullptr;     ///< `count` points; null: they are in `own`
    const PointLanes* lanes = nullptr;  ///< of the same points, where a polyhedron keeps them; else null
    const double* sides = nullptr;   ///< of a polygon of 3 to `most_sides` corners, as `write_sides` has them; or null
    const Facets* facets = nullptr;  ///< of a polyhedron; else null
    const void* object = nullptr;    ///< for `function`
    Vec<D> (*function)(const void* object, const Vec<D>& direction) = nullptr;

    /// Written out, so that compilers fill it member by member: to clear all of it first, as they do otherwise, is
    /// slow.
    Convex() {}

    const Vec<D>* vertices() const { return points != nullptr ? points : own.data(); }
};

/// The core of up to three points, with a ball around it.
template <int D>
Convex<D> round_points(std::initializer_list<Vec<D>> points, float radius);

/// The same set placed once more.
template <int D>
Convex<D> placed(const Convex<D>& convex, const Placement<D>& placement);

/// False where a number of it is NaN or infinite. What a support function of the user returns is not looked at.
template <int D>
bool is_finite(const Convex<D>& convex) {
    // A sum is finite only where all its terms are; none of them is near the largest double. One sum an axis, so that
    // they don't wait for one another.
    DVec<D> sum = convex.place.offset;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) sum += convex.place.column[i];
    double total = convex.radius + convex.inner_radius;
    const std::uint32_t own = convex.core == Core::discs ? 2
                              : convex.core == Core::box ? 1
                              : convex.points == nullptr ? convex.count
                                                         : 0;
    for (std::uint32_t i = 0; i < own; ++i) sum += DVec<D>(convex.own[i]);
    if (convex.core == Core::discs)
        total += static_cast<double>(convex.disc_radius[0]) + static_cast<double>(convex.disc_radius[1]);
    for (int i = 0; i < D; ++i) total += sum[i];
    return std::isfinite(total);
}

/// Placed without being sheared or flattened, and not made round before it is.
template <int D>
bool keeps_its_form(const Convex<D>& convex) {
    return convex.inner_radius == 0 && convex.similar && convex.scale > 0;
}
template <int D>
bool is_plain_box(const Convex<D>& convex) {
    return convex.core == Core::box && keeps_its_form(convex);
}

/// A point of a core, farthest along a direction.
template <int D>
struct CorePoint {
    DVec<D> position{0.0};
    std::uint32_t index = 0;  ///< of the point or corner; 0 where a core has none
};

/// A corner of a core of points or of a box in its own frame, by its number.
template <int D>
DVec<D> own_corner(const Convex<D>& convex, std::uint32_t index) {
    if (convex.core == Core::points) return DVec<D>(convex.vertices()[index]);
    DVec<D> point(convex.own[0]);
    for (int i = 0; i < D; ++i)
        if ((index >> i & 1u) != 0) point[i] = -point[i];
    return point;
}

/// Whether there is one of this number. Cores that are round have none.
template <int D>
bool has_corner(const Convex<D>& convex, std::uint32_t index) {
    if (convex.inner_radius > 0) return false;
    if (convex.core == Core::points) return index < convex.count;
    return convex.core == Core::box && index < 1u << D;
}

/// Where a part that is one-sided looks, of any length: of a segment to the right of the way from its first point to
/// its second, of a triangle to where it is counter-clockwise. What is mirrored keeps its front on the same side of
/// itself.
template <int D>
DVec<D> front(const Convex<D>& part);

/// The farthest point of the core and its inner ball (without the outer ball) along `direction`, which has any length
/// but zero. Where several are equally far, the one of the lowest index.
template <int D>
CorePoint<D> core_support(const Convex<D>& convex, const DVec<D>& direction);

/// The farthest point of the whole set along `direction`.
template <int D>
DVec<D> support(const Convex<D>& convex, const DVec<D>& direction);

/// The least box around the set, rounded outwards.
template <int D>
Aabb<D> bounds(const Convex<D>& convex);

/// Some point of the core: where to look from, so that distances don't depend on how far the shapes are from the
/// origin.
template <int D>
DVec<D> reference_point(const Convex<D>& convex);

/// The bounding radius: of a ball around the middle of `bounds` that holds the set; at most sqrt(D) times the least.
template <int D>
double size(const Convex<D>& convex);

}  // namespace abut
