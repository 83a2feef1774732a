#pragma once

// Vectors of two and three doubles in lane types. They are for code too small for run-time dispatch. Results equal
// those of scalar doubles. For .cpp files.

#include <abut/math/simd/lanes-inl.h>
#include <abut/math/vec.hpp>

#include <bit>
#include <cmath>
#include <cstdint>

namespace abut {

namespace lanes {

inline Double2 double2(double a, double b) {
    return {a, b};
}
inline Double2 double2(double both) {
    return both;
}
inline std::uint32_t lowest_bit(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}
inline Double2 lower(Double2 a, Double2 b) {
    return shuffled<0, 0>(a, b);
}
inline Double2 upper(Double2 a, Double2 b) {
    return shuffled<1, 1>(a, b);
}
/// The lower lane of a and the upper one of b.
inline Double2 ends(Double2 a, Double2 b) {
    return shuffled<0, 1>(a, b);
}
inline Double2 swapped(Double2 v) {
    return shuffled<1, 0>(v, v);
}
/// Clamps to [0, high].
inline Double2 limited(Double2 v, Double2 high) {
    return lesser(greater(v, Double2{0, 0}), high);
}

// 2D vectors: x and y in the two lanes.

inline Double2 first(Double2 v) {
    return lower(v, v);
}
inline Double2 second(Double2 v) {
    return upper(v, v);
}
/// The dot product, in both lanes.
inline Double2 dot(Double2 a, Double2 b) {
    const Double2 products = a * b;
    return products + swapped(products);
}
inline bool finite(Double2 v) {
    const Double2 zero = v - v;
    return bits(zero == zero) == 3;
}
/// The maximum deviation of a square from 1 for the series below.
inline constexpr double near_one = 1e-5;
inline bool are_near_one(Double2 squares) {
    return bits(magnitude(squares - Double2{1, 1}) < double2(near_one)) == 3;
}
inline bool is_near_one(double square) {
    return std::abs(square - 1) < near_one;
}
/// 1 / sqrt for squares near 1, by the series of `unit` for vectors.
inline Double2 inverse_root(Double2 squares) {
    const Double2 excess = squares - Double2{1, 1};
    return Double2{1, 1} - excess * (Double2{0.5, 0.5} - Double2{0.375, 0.375} * excess);
}
/// 1 / sqrt to first order, for results that don't decide ties. It omits 3/8 of the squared deviation: 1e-15 for unit
/// vectors of floats, at most 4e-11.
inline Double2 approximate_inverse_root(Double2 squares) {
    return Double2{1.5, 1.5} - Double2{0.5, 0.5} * squares;
}
/// The squared lengths of two vectors, one in each lane.
inline Double2 squared_lengths(Double2 a, Double2 b) {
    const Double2 x = lower(a, b), y = upper(a, b);
    return x * x + y * y;
}
/// A 3D vector: x and y in one pair of lanes, and z in both lanes of another. Scalars are in both lanes too.
struct Double3 {
    Double2 xy, z;

    Double3 operator+(const Double3& v) const { return {xy + v.xy, z + v.z}; }
    Double3 operator-(const Double3& v) const { return {xy - v.xy, z - v.z}; }
    Double3 operator*(Double2 s) const { return {xy * s, z * s}; }
};
inline Double3 double3(const glm::vec<3, double>& v) {
    return {double2(v.x, v.y), double2(v.z)};
}
inline glm::vec<3, double> vector(const Double3& v) {
    return {v.xy[0], v.xy[1], v.z[0]};
}
/// Loads three floats.
inline Double3 loaded(const glm::vec<3, float>& v) {
    return {loaded(&v.x), loaded_twice(v.z)};
}
/// The dot product, in both lanes.
inline Double2 dot(const Double3& a, const Double3& b) {
    return dot(a.xy, b.xy) + a.z * b.z;
}
inline Double3 magnitude(const Double3& v) {
    return {magnitude(v.xy), magnitude(v.z)};
}
/// Stores three floats.
inline void store(const Double3& v, glm::vec<3, float>& result) {
    store(v.xy, &result.x);
    result.z = static_cast<float>(v.z[0]);
}

}  // namespace lanes
}  // namespace abut
