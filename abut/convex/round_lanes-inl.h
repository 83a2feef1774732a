#pragma once

// Two points or two segments of space with balls around them: where they are nearest. So little that it is done in
// place. For .cpp files.

#include <abut/convex/signed_distance.hpp>
#include <abut/math/lanes-inl.h>

#include <bit>

namespace abut {

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
    lanes::Spatial from_a, to_a, from_b, to_b;
    lanes::Both radius_a, radius_b;  ///< in both lanes
};

struct SegmentMeeting {
    lanes::Both distance;          ///< in both lanes
    lanes::Spatial normal, on_a;   ///< as in a SignedDistance
    std::size_t place_a, place_b;  ///< 0 at the start, 1 between, 2 at the end
};

/// Of a part of the way from 0 to 1, by its bits: which it is can't be guessed.
inline std::size_t place_on_way(double part) {
    const auto bits = std::bit_cast<std::uint64_t>(part), end = std::bit_cast<std::uint64_t>(1.0);
    return static_cast<std::size_t>(bits != 0) + static_cast<std::size_t>(bits == end);
}

/// Where they are nearest: the feet of the common perpendicular, or an end and its foot. False where that is in doubt:
/// where they nearly cross, are nearly parallel, very large or small, or not finite; then `result` is of no use.
/// Ericson, Real-Time Collision Detection (2005), 5.1.9.
inline bool meet(const SegmentPair& s, SegmentMeeting& result) {
    using namespace lanes;
    // Squares of the sine of their angle, and of the gap in parts of their lengths. So far from where it is in doubt,
    // rounding moves the places by at most 1e-9 of what they are apart, and along one another.
    constexpr double parallel = 1e-6, near = 1e-10, most = 1e200;

    const Spatial along_a = s.to_a - s.from_a, along_b = s.to_b - s.from_b, between_ends = s.from_a - s.from_b;
    const Both square_a = dot(along_a, along_a), square_b = dot(along_b, along_b), crossed = dot(along_a, along_b);
    const Both rise_a = dot(along_a, between_ends), rise_b = dot(along_b, between_ends);
    const Both squares = square_a * square_b, whole = squares - crossed * crossed;

    // Each step is taken, needed or not: which it is can't be guessed, and what is best already stays as it is. Parts
    // of the ways are left multiplied by what they are to be divided by, so that the next step needn't wait for that.
    // What is at an end is told so, whatever the quotient rounds to.
    const Both end{1, 1};
    const Both whole_a = whole * squares, one_a = 1 / whole_a, whole_b = whole * square_b;
    const Both first = limited(crossed * rise_b - square_b * rise_a, whole);
    const Both far_b = limited(crossed * first + rise_b * whole, whole_b);
    const Both part_b = lesser(greater(far_b * (square_a * one_a), chosen(far_b >= whole_b, end)), end);
    const Both part_a = limited((crossed * far_b - rise_a * whole_b) * one_a, end);
    if (!(whole[0] > parallel * squares[0] && whole_a[0] + one_a[0] < most)) return false;

    const Spatial on_a = along_a * part_a, between = along_b * part_b - between_ends - on_a;
    // The root and the quotient side by side, not one after the other.
    const Both apart = dot(between, between), gap = root(apart);
    if (!(apart[0] > near * (square_a[0] + square_b[0]))) return false;
    result.distance = gap - s.radius_a - s.radius_b;
    result.normal = between * (gap * (1 / apart));
    result.on_a = s.from_a + on_a + result.normal * s.radius_a;
    result.place_a = place_on_way(part_a[0]);
    result.place_b = place_on_way(part_b[0]);
    return true;
}

}  // namespace abut
