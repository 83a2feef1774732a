#pragma once

// The signed distance of two convex sets, in double. GJK finds the gap between the cores, EPA their penetration depth;
// the radii are subtracted at the end. An answer whose two bounds differ is computed again by the next method.

#include <abut/convex/gjk/search_options.hpp>
#include <abut/convex/gjk/simplex.hpp>

namespace abut::detail {

/// The vertex indices of the cores that span the closest points on A and on B; 0 for cores without vertices.
template <int D>
using CornerIndices = std::array<std::uint32_t, static_cast<std::size_t>(D) + 1>;
template <int D>
struct ClosestCorners {
    CornerIndices<D> a{}, b{};
    std::size_t count = 1;  ///< of pairs; an index may occur twice
};

template <int D>
ClosestCorners<D> closest_corners(const Simplex<D>& face) {
    ClosestCorners<D> result;
    result.count = face.count;
    for (std::size_t i = 0; i < face.count; ++i) {
        result.a[i] = face.points[i].index_a;
        result.b[i] = face.points[i].index_b;
    }
    return result;
}

template <int D>
struct SignedDistance {
    double distance = 0;        ///< the gap, or minus the penetration depth
    DVec<D> normal;             ///< of length 1, from A to B
    DVec<D> on_a;               ///< in the world; on_b = on_a + distance * normal
    ClosestCorners<D> corners;  ///< at on_a and on_b

    DVec<D> on_b() const { return on_a + normal * distance; }
};

/// Turns the answer for a pair (A, B) into that for (B, A), in place: a copy would read it before all its members have
/// reached memory.
template <int D>
void flip(SignedDistance<D>& distance) {
    distance.on_a = distance.on_b();
    distance.normal = -distance.normal;
    std::swap(distance.corners.a, distance.corners.b);
}
template <class Answer>
Answer flipped(Answer answer) {
    flip(answer);
    return answer;
}

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

/// Whether the two sets share a point.
template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

}  // namespace abut::detail
