#pragma once

// Two segments of space with balls around them: where they are nearest, both worked out side by side in the two lanes
// of the vectors that every machine has. For .cpp files.

#include <abut/convex/signed_distance.hpp>
#include <abut/math/lanes-inl.h>

namespace abut {

namespace lanes {

// Lane 0 is of A, lane 1 of B.

inline double of_a(Both v) {
    return v[0];
}
inline double of_b(Both v) {
    return v[1];
}

/// A vector of each.
struct BothVectors {
    Both x, y, z;

    BothVectors operator+(const BothVectors& v) const { return {x + v.x, y + v.y, z + v.z}; }
    BothVectors operator-(const BothVectors& v) const { return {x - v.x, y - v.y, z - v.z}; }
    BothVectors operator*(Both s) const { return {x * s, y * s, z * s}; }
    DVec<3> of_a() const { return {lanes::of_a(x), lanes::of_a(y), lanes::of_a(z)}; }
    DVec<3> of_b() const { return {lanes::of_b(x), lanes::of_b(y), lanes::of_b(z)}; }
};
inline BothVectors both(const DVec<3>& a, const DVec<3>& b) {
    return {both(a.x, b.x), both(a.y, b.y), both(a.z, b.z)};
}
inline BothVectors swapped(const BothVectors& v) {
    return {swapped(v.x), swapped(v.y), swapped(v.z)};
}
inline Both dot(const BothVectors& a, const BothVectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Both sum_of_sizes(const BothVectors& v) {
    return magnitude(v.x) + magnitude(v.y) + magnitude(v.z);
}
}  // namespace lanes

/// Two points with balls around them.
inline void distance_of_points(const DVec<3>& a, double radius_a, const DVec<3>& b, double radius_b,
                               SignedDistance<3>& result) {
    const DVec<3> between = b - a;
    const double gap = length(between);
    result.distance = gap - radius_a - radius_b;
    result.normal = gap > 0 ? between * (1 / gap) : axis<3>(0);
    result.on_a = a + result.normal * radius_a;
}

/// Two segments, an end of each in `from`, the other in `to`.
struct SegmentPair {
    lanes::BothVectors from, to;
    double radius_a, radius_b;
};

/// The signed distance, where it is proven at once: the feet of the common perpendicular or an end and its foot, and
/// the plane between them. False where they nearly cross, are nearly parallel, or not finite; then `result` is of no
/// use. Ericson, Real-Time Collision Detection (2005), 5.1.9.
inline bool distance_of_segments(const SegmentPair& s, SignedDistance<3>& result) {
    using namespace lanes;
    // Below this square of the sine of their angle they are taken for parallel.
    constexpr double parallel = 1e-12;
    // In parts of the coordinates: what is nearer may have a direction that is rounding; so much may a proof fall
    // short.
    constexpr double near = 1e-6, doubt = 1e-9;

    const BothVectors along = s.to - s.from, between_ends = s.from - swapped(s.from);  // in lane 1 from A to B
    const Both square = dot(along, along), rise = dot(along, between_ends), crossed = dot(along, swapped(along));
    const Both squares = square * swapped(square), whole = squares - crossed * crossed;
    if (!(of_a(whole) > parallel * of_a(squares))) return false;

    // Each step is taken, needed or not: which it is can't be guessed, and what is best already stays as it is.
    const Both one = 1 / whole, ones = 1 / square, other_rise = swapped(rise);
    const Both first = part(-(crossed * other_rise + swapped(square) * rise) * one);
    const Both part_b = part((crossed * first - other_rise) * swapped(ones));
    const Both part_a = part((crossed * part_b - rise) * ones);
    const Both parts = lower(part_a, part_b);

    // From each to the other, in its lane.
    const BothVectors on = along * parts, between = swapped(on) - on - between_ends;
    // The root and the quotient side by side, not one after the other.
    const double apart = of_a(dot(between, between)), gap = std::sqrt(apart), one_gap = gap * (1 / apart);
    const Both sizes = sum_of_sizes(along) + sum_of_sizes(between_ends);
    const double scale = of_a(sizes) + of_b(sizes);
    // How far the ends of each reach past the plane through its place.
    const Both slope = dot(along, between), back = -(parts * slope), on_from = (1 - parts) * slope;
    const Both past = greater(back, on_from);
    if (!(gap > near * scale && of_a(past) + of_b(past) <= doubt * scale * gap)) return false;

    result.distance = gap - s.radius_a - s.radius_b;
    result.normal = between.of_a() * one_gap;
    result.on_a = s.from.of_a() + on.of_a() + result.normal * s.radius_a;
    // As masks: a branch, as a comparison would become, can't be guessed.
    const Chosen at_end = parts >= Both{1, 1}, off_start = parts > Both{0, 0};
    result.corners.a[0] = static_cast<std::uint32_t>(at_end[0]) & 1u;
    result.corners.a[1] = static_cast<std::uint32_t>(off_start[0]) & 1u;
    result.corners.b[0] = static_cast<std::uint32_t>(at_end[1]) & 1u;
    result.corners.b[1] = static_cast<std::uint32_t>(off_start[1]) & 1u;
    result.corners.count = 2;
    return true;
}

}  // namespace abut
