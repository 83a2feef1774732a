#pragma once

// A convex set as the algorithms of this folder see it: a core, its placement, and a ball around it.
//
//     S = place * (core + inner ball) + ball,     "+" the Minkowski sum
//
// Circles, capsules, rounded boxes and hulls have this one form. Touching cases stay well conditioned: the distance
// between the cores of two touching rounded shapes is the sum of their radii.

#include <abut/convex/facets.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/affine.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>

namespace abut::detail {

struct PointSoa;

/// The kinds of convex cores.
enum class Core : std::uint8_t {
    points,    ///< the hull of 1..n points
    box,       ///< a box about the origin, by its half extents
    discs,     ///< the hull of two parallel discs (D = 3): cylinder, cone
    function,  ///< given by its support function alone
};

/// The placement of a set: place * (set + inner ball) + ball.
template <int D>
struct Placement {
    Affine<D> place;          ///< from the shape's own frame to the world
    bool similar = true;      ///< `place` is a similarity: a ball stays a ball
    double scale = 1;         ///< the scale factor of `place`, if `similar`
    double inner_radius = 0;  ///< of the ball added before `place`
    double radius = 0;        ///< of the ball added after `place`
};

/// The placement followed by `map`. The ball of a set that was stretched and then rounded would become a second
/// ellipsoid under a map that stretches again. It stays a ball inside of that one: its radius changes by the least
/// factor of the map, or less if the map shears.
template <int D>
Placement<D> mapped(const Placement<D>& placement, const Affine<D>& map);

/// A small value that refers to the points, facets or object of a shape and must not outlive it. Members that `core`
/// and `count` don't use stay uninitialised, because every query makes two of these.
template <int D>
struct Convex : Placement<D> {
    Core core = Core::points;
    /// A one-sided part: a segment in 2D or a triangle in 3D. Rays, sweeps and contacts see only its front, as `front`
    /// defines it. Overlap and distance ignore the side.
    bool one_sided = false;
    std::uint32_t count = 1;  ///< of points
    /// Up to three points inline; box: [0] the half extents; discs: [0], [1] their centres.
    std::array<Vec<D>, 3> own{};
    std::array<float, 2> disc_radius;
    const Vec<D>* points = nullptr;   ///< `count` points; null: they are in `own`
    const PointSoa* lanes = nullptr;  ///< the same points as SoA, if a polyhedron has them; else null
    const double* sides =
        nullptr;  ///< SoA rows of a polygon of 3 to `max_soa_edges` edges, as `write_polygon_soa` writes them; or null
    const Facets* facets = nullptr;  ///< of a polyhedron; else null
    const void* object = nullptr;    ///< passed to `function`
    Vec<D> (*function)(const void* object, const Vec<D>& direction) = nullptr;

    /// Written out, so that compilers initialise it member by member: clearing all of it first is slow.
    Convex() {}

    const Vec<D>* vertices() const { return points != nullptr ? points : own.data(); }
};

/// A core of up to three points, with a ball around it.
template <int D>
Convex<D> round_points(std::initializer_list<Vec<D>> points, float radius);

/// The same set with another placement after its own.
template <int D>
Convex<D> placed(const Convex<D>& convex, const Placement<D>& placement);

/// False if a number of it is NaN or infinite. The results of a user's support function are not checked.
template <int D>
bool is_finite(const Convex<D>& convex) {
    // A sum is finite only if all its terms are; none of them is near the largest double. Each axis has its own sum, so
    // that the additions are independent.
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

/// Whether the placement is a similarity of nonzero scale without an inner ball.
template <int D>
bool has_similarity_placement(const Convex<D>& convex) {
    return convex.inner_radius == 0 && convex.similar && convex.scale > 0;
}
/// Whether the set is a point with a radius, in any placement.
template <int D>
bool is_ball(const Convex<D>& convex) {
    return convex.core == Core::points && convex.count == 1 && convex.inner_radius == 0;
}
template <int D>
bool is_plain_box(const Convex<D>& convex) {
    return convex.core == Core::box && has_similarity_placement(convex);
}

/// The support point of a core.
template <int D>
struct CorePoint {
    DVec<D> position{0.0};
    std::uint32_t index = 0;  ///< of the point or corner; 0 for a core without corners
};

/// A corner of a core of points or of a box in its own frame, by its index.
template <int D>
DVec<D> local_corner(const Convex<D>& convex, std::uint32_t index) {
    if (convex.core == Core::points) return DVec<D>(convex.vertices()[index]);
    DVec<D> point(convex.own[0]);
    for (int i = 0; i < D; ++i)
        if ((index >> i & 1u) != 0) point[i] = -point[i];
    return point;
}

/// Whether the index is valid. Round cores have no corners.
template <int D>
bool has_corner(const Convex<D>& convex, std::uint32_t index) {
    if (convex.inner_radius > 0) return false;
    if (convex.core == Core::points) return index < convex.count;
    return convex.core == Core::box && index < 1u << D;
}

/// The front direction of a one-sided part, of any length. For a segment it is on the right of the direction from its
/// first point to its second, for a triangle on the side where it is counter-clockwise. A mirrored part has its front
/// on the same side of itself.
template <int D>
DVec<D> front(const Convex<D>& part);

/// The support point of the core with its inner ball (without the outer ball) along `direction`, of any nonzero length.
/// Of several equally distant points it is the one with the lowest index.
template <int D>
CorePoint<D> core_support(const Convex<D>& convex, const DVec<D>& direction);

/// The support point of the whole set along `direction`.
template <int D>
DVec<D> support(const Convex<D>& convex, const DVec<D>& direction);

/// The bounding box of the set, rounded outwards.
template <int D>
Aabb<D> bounds(const Convex<D>& convex);

/// Some point of the core. Algorithms work relative to it, so that distances don't depend on how far the shapes are
/// from the origin.
template <int D>
DVec<D> reference_point(const Convex<D>& convex);

/// The bounding radius: of a ball around the middle of `bounds` that contains the set; at most sqrt(D) times the
/// minimum.
template <int D>
double size(const Convex<D>& convex);

}  // namespace abut::detail
