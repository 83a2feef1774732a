#pragma once

// Where a straight line comes into a convex set, in closed form: polygons, polyhedra and boxes by cutting the line off
// at their planes, balls, capsules and discs by quadratics, segments and triangles by their line or plane.
// Cyrus, Beck, "Generalized two- and three-dimensional clipping" (1978); Moeller, Trumbore, "Fast, minimum storage
// ray-triangle intersection" (1997).
//
// A closed form answers only where it is sure. What starts on, in or about the set, skims it, or meets a set that is
// all but flat is left to a search. .cpp files only.

#include <abut/convex/feature.hpp>
#include <abut/convex/support.hpp>

namespace abut {

/// A ray in double.
template <int D>
struct Beam {
    DVec<D> origin;
    DVec<D> direction;  ///< of length 1 in the world, or 0; of any, seen from a shape's own frame
    double length;      ///< in lengths of `direction`

    DVec<D> at(double along) const { return origin + direction * along; }
    /// Whether it is its origin alone.
    bool rests() const { return direction == DVec<D>(0.0); }
};

enum class RayAnswer : std::uint8_t { undecided, misses, enters };

template <int D>
struct RayEntry {
    RayAnswer answer = RayAnswer::undecided;
    double along = 0;     ///< in lengths of the direction, more than 0
    DVec<D> normal{0.0};  ///< of any length, out of the set, against the direction
    FeatureKind kind = FeatureKind::none;
    std::uint32_t index = 0;
};

/// Where the beam, coming from outside, enters the placed set. It never leaves out one that reaches deeper in than
/// rounding explains, and where it enters is on the surface, but for some billionths of the distance and the size (and,
/// of a polyhedron, for how flat its faces are).
template <int D>
RayEntry<D> ray_entry(const Convex<D>& convex, const Beam<D>& beam);

}  // namespace abut
