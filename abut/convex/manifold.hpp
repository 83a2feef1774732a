#pragma once

// The corners of the area in which two convex sets meet: the face of one clipped by the sides of the other's.

#include <abut/convex/face.hpp>
#include <abut/convex/signed_distance.hpp>

namespace abut {

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

/// All points of which some are kept.
template <int D>
struct ManifoldCandidates {
    std::array<ManifoldPoint<D>, Face<D>::capacity + 1> points;
    std::size_t count = 0;

    void push_back(const ManifoldPoint<D>& point) {
        if (count < points.size()) points[count++] = point;
    }
};

/// As many as there is room for: the deepest to within `slack`, and those that keep the most area.
template <int D>
Manifold<D> thinned(const ManifoldCandidates<D>& all, const DVec<D>& normal, double slack);

/// Two sets whose distance is at most `margin`. The points are those at most `margin` apart, among them the deepest; of
/// more than there is room for, those that keep the most area.
template <int D>
Manifold<D> manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                     Trace<D>* trace = nullptr);

/// A set and the half-space dot(normal, p) <= offset; the contact normal, from the set, is -normal.
template <int D>
Manifold<D> manifold_with_plane(const Convex<D>& a, const DVec<D>& normal, double offset, double margin);

}  // namespace abut
