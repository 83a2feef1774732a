#pragma once

// The closest points of two balls, or of two capsules in 3D. Inline, because they are short. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/math/simd/double2-inl.h>

#include <bit>

namespace abut::detail {

/// Two points with balls around them.
inline void distance_of_points(const DVec<3>& a, double radius_a, const DVec<3>& b, double radius_b,
                               SignedDistance<3>& result) {
    const DVec<3> between = b - a;
    const double gap = length(between);
    result.distance = gap - radius_a - radius_b;
    result.normal = gap > 0 ? between * (1 / gap) : axis<3>(0);
    result.on_a = a + result.normal * radius_a;
}

/// Two segments with balls around them.
struct SegmentPair {
    lanes::Double3 from_a, to_a, from_b, to_b;
    lanes::Double2 radius_a, radius_b;  ///< in both lanes
};

struct SegmentClosest {
    lanes::Double2 distance;       ///< in both lanes
    lanes::Double3 normal, on_a;   ///< as in a SignedDistance
    std::size_t place_a, place_b;  ///< 0 at the start, 1 between, 2 at the end
};

/// From a parameter in [0, 1], by its bits, because a branch can't be predicted.
inline std::size_t segment_feature(double part) {
    const auto bits = std::bit_cast<std::uint64_t>(part), end = std::bit_cast<std::uint64_t>(1.0);
    return static_cast<std::size_t>(bits != 0) + static_cast<std::size_t>(bits == end);
}

/// The closest points: the ends of the common perpendicular, or an end and its projection. Returns false, with `result`
/// undefined, if the segments nearly cross, are nearly parallel, very large or small, or not finite. Ericson, Real-Time
/// Collision Detection (2005), 5.1.9.
inline bool closest_on_segments(const SegmentPair& s, SegmentClosest& result) {
    using namespace lanes;
    // Squares of the sine of their angle, and of the gap relative to their lengths. Within these limits rounding moves
    // the closest points along the segments by at most 1e-9 of their distance.
    constexpr double parallel = 1e-6, near = 1e-10, max_square = 1e200;

    const Double3 along_a = s.to_a - s.from_a, along_b = s.to_b - s.from_b, between_ends = s.from_a - s.from_b;
    const Double2 square_a = dot(along_a, along_a), square_b = dot(along_b, along_b), crossed = dot(along_a, along_b);
    const Double2 rise_a = dot(along_a, between_ends), rise_b = dot(along_b, between_ends);
    const Double2 squares = square_a * square_b, whole = squares - crossed * crossed;

    // All steps run without branches, which can't be predicted; a step that isn't needed changes nothing. Parameters
    // stay multiplied by their denominators, so that the next step doesn't wait for a division. A point at an end gets
    // the exact parameter, whatever the quotient rounds to.
    const Double2 end{1, 1};
    const Double2 whole_a = whole * squares, one_a = 1 / whole_a, whole_b = whole * square_b;
    const Double2 first = limited(crossed * rise_b - square_b * rise_a, whole);
    const Double2 far_b = limited(crossed * first + rise_b * whole, whole_b);
    const Double2 part_b = lesser(greater(far_b * (square_a * one_a), select(far_b >= whole_b, end)), end);
    const Double2 part_a = limited((crossed * far_b - rise_a * whole_b) * one_a, end);
    if (!(whole[0] > parallel * squares[0] && whole_a[0] + one_a[0] < max_square)) return false;

    const Double3 on_a = along_a * part_a, between = along_b * part_b - between_ends - on_a;
    // The root and the quotient run in parallel.
    const Double2 apart = dot(between, between), gap = root(apart);
    if (!(apart[0] > near * (square_a[0] + square_b[0]))) return false;
    result.distance = gap - s.radius_a - s.radius_b;
    result.normal = between * (gap * (1 / apart));
    result.on_a = s.from_a + on_a + result.normal * s.radius_a;
    result.place_a = segment_feature(part_a[0]);
    result.place_b = segment_feature(part_b[0]);
    return true;
}

}  // namespace abut::detail
