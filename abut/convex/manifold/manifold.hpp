#pragma once

// The contact manifold of two convex sets: the incident face clipped by the side planes of the reference face.

#include <abut/convex/face.hpp>
#include <abut/convex/gjk/signed_distance.hpp>

namespace abut::detail {

template <int D>
struct ManifoldPoint {
    DVec<D> position;  ///< midway between the two surfaces along the normal
    double depth;
    std::uint32_t feature;
};

template <int D>
struct Manifold {
    std::array<ManifoldPoint<D>, D == 2 ? 2 : 4> points;
    std::size_t count = 0;
};

/// All clipped points, before the reduction.
template <int D>
struct ManifoldCandidates {
    std::array<ManifoldPoint<D>, Face<D>::capacity + 1> points;
    std::size_t count = 0;

    void push_back(const ManifoldPoint<D>& point) {
        if (count < points.size()) points[count++] = point;
    }
};

/// Reduces the candidates to the capacity of a manifold: the deepest to within `tolerance`, and those that span the
/// largest area.
template <int D>
Manifold<D> reduced_manifold(const ManifoldCandidates<D>& all, const DVec<D>& normal, double tolerance);

/// For two sets whose distance is at most `margin`. The points have gaps of at most `margin`, and the deepest is among
/// them; surplus points are reduced to those that span the largest area.
///
/// A's face is the reference if it is aligned with the normal, even where B's is aligned better. Both faces are clipped
/// along the normal, so either choice gives the same points, but their features depend on it.
template <int D>
Manifold<D> manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                     Trace<D>* trace = nullptr);

/// The contact area of two sets along a normal.
template <int D>
struct ContactArea {
    ManifoldCandidates<D> points;  ///< corners of the area, before the reduction
    bool a_is_reference = false;   ///< the points are those of B's face, clipped by the sides of A's
};

/// The set to whose face the other one's is clipped, if that has a face along the normal.
enum class ReferenceFace : std::uint8_t { of_a, of_b };

/// The contact area along a normal from A to B: the incident face clipped by the side planes of the reference face. No
/// point is deeper than `depth`. The area is empty unless one of the sets has a face along the normal, or both have an
/// edge.
template <int D>
ContactArea<D> contact_area(const Convex<D>& a, const Convex<D>& b, ReferenceFace reference, const DVec<D>& normal,
                            double depth, double margin);

/// For a set and the half-space dot(normal, p) <= offset. The contact normal, away from the set, is -normal.
template <int D>
Manifold<D> manifold_with_plane(const Convex<D>& a, const DVec<D>& normal, double offset, double margin);

}  // namespace abut::detail
