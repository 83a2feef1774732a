#pragma once

// The signed distance of two convex sets, in double: GJK between the cores, separating axes or the penetration search
// where they overlap, and the radii taken off at the end. An answer that isn't proven by two bounds that agree is asked
// for in another way.

#include <abut/convex/search_options.hpp>
#include <abut/convex/simplex.hpp>

namespace abut {

/// The corners of the cores that a place on A and one on B are made of, by number; those of no corner are 0.
template <int D>
using CornerNumbers = std::array<std::uint32_t, static_cast<std::size_t>(D) + 1>;
template <int D>
struct MeetingCorners {
    CornerNumbers<D> a{}, b{};
    std::size_t count = 1;  ///< of pairs; the same number may be there twice
};

template <int D>
MeetingCorners<D> corners_of(const Simplex<D>& face) {
    MeetingCorners<D> result;
    result.count = face.count;
    for (std::size_t i = 0; i < face.count; ++i) {
        result.a[i] = face.points[i].index_a;
        result.b[i] = face.points[i].index_b;
    }
    return result;
}

template <int D>
struct SignedDistance {
    double distance = 0;        ///< the gap, or minus the least translation that parts them
    DVec<D> normal;             ///< of length 1, from A to B
    DVec<D> on_a;               ///< in the world; on_b = on_a + distance * normal
    MeetingCorners<D> corners;  ///< at on_a and on_b

    DVec<D> on_b() const { return on_a + normal * distance; }
};

/// The same pair, B first.
template <int D>
void turn_round(SignedDistance<D>& distance) {
    distance.on_a = distance.on_b();
    distance.normal = -distance.normal;
    std::swap(distance.corners.a, distance.corners.b);
}

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

/// Whether they have a point in common.
template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

}  // namespace abut
