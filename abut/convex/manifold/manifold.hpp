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
template <int D>
Manifold<D> manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                     Trace<D>* trace = nullptr);

/// For a set and the half-space dot(normal, p) <= offset. The contact normal, away from the set, is -normal.
template <int D>
Manifold<D> manifold_with_plane(const Convex<D>& a, const DVec<D>& normal, double offset, double margin);

}  // namespace abut::detail
