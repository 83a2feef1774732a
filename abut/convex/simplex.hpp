#pragma once

// The simplex that GJK walks with, and its point closest to the origin.

#include <abut/convex/minkowski_difference.hpp>

#include <array>
#include <initializer_list>

namespace abut {

/// 1 to D + 1 points of a Minkowski difference with weights that sum to 1.
template <int D>
struct Simplex {
    std::array<DifferencePoint<D>, static_cast<std::size_t>(D) + 1> points;
    std::array<double, static_cast<std::size_t>(D) + 1> weights{};
    std::size_t count = 0;

    DVec<D> combine(DVec<D> DifferencePoint<D>::*member) const {
        DVec<D> result(0.0);
        for (std::size_t i = 0; i < count; ++i) result += points[i].*member * weights[i];
        return result;
    }
};

/// Reduces the simplex to the face whose inside holds the point closest to the origin, sets its weights, and returns
/// that point. A simplex of D + 1 points that stays whole holds the origin. Voronoi regions of segment and triangle as
/// in Ericson, Real-Time Collision Detection (2005), 5.1.
template <int D>
DVec<D> reduce_to_closest(Simplex<D>& simplex);

/// The part of a face of A - B closest to `target`, weighted there.
template <int D>
Simplex<D> face_near(std::initializer_list<DifferencePoint<D>> corners, const DVec<D>& target);

}  // namespace abut
