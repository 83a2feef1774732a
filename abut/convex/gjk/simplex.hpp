#pragma once

// The simplex of GJK and its point closest to the origin.

#include <abut/convex/gjk/minkowski_difference.hpp>

#include <array>
#include <initializer_list>

namespace abut::detail {

/// 1 to D + 1 points of the Minkowski difference, with weights that sum to 1.
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

/// Reduces the simplex to the face whose interior contains the point closest to the origin, sets the weights, and
/// returns that point. A simplex that still has D + 1 points contains the origin. The Voronoi region tests of segment
/// and triangle follow Ericson, Real-Time Collision Detection (2005), 5.1.
template <int D>
DVec<D> reduce_to_closest(Simplex<D>& simplex);

/// The sub-simplex of a face of A - B that is closest to `target`, with the weights of the closest point.
template <int D>
Simplex<D> closest_subsimplex(std::initializer_list<DifferencePoint<D>> corners, const DVec<D>& target);

}  // namespace abut::detail
