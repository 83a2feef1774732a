#pragma once

// The matrix of a rotation, two numbers at a time, where it is made and used in one piece. For .cpp files.

#include <abut/math/lanes-inl.h>

#include <cstddef>

#include <glm/ext/quaternion_float.hpp>

namespace abut::lanes {

/// Its three rows, of which the last numbers of the first two are kept as those of the last column.
struct Turned {
    Both row_x, row_y, row_z, column_z;
    Both last;  ///< of the last row and column, in both lanes

    Spatial first_column() const { return {lower(row_x, row_y), first(row_z)}; }
    Spatial second_column() const { return {upper(row_x, row_y), second(row_z)}; }
    Spatial last_column() const { return {column_z, last}; }

    // As of an Affine, to the last bit.

    Spatial vector(const Spatial& v) const {
        const Both x = row_x * v.xy, y = row_y * v.xy;
        return {lower(x, y) + upper(x, y) + column_z * v.z, dot(row_z, v.xy) + last * v.z};
    }
    Spatial transposed(const Spatial& v) const {
        return {row_x * first(v.xy) + row_y * second(v.xy) + row_z * v.z, dot(column_z, v.xy) + last * v.z};
    }
};

/// As `set_affine` makes it, of what is not zero.
inline Turned turned(const glm::quat& q) {
    // However glm is told to store them.
    constexpr bool w_is_last = offsetof(glm::quat, w) > offsetof(glm::quat, z);
    const Both xy = loaded(&q.x),
               zw = w_is_last ? loaded(&q.z) : both(static_cast<double>(q.z), static_cast<double>(q.w));
    const Both squares = xy * xy + zw * zw, s = 2 / (squares + swapped(squares)), z = first(zw), w = second(zw);
    const Both sxy = xy * s, sz = z * s;
    const Both xx_yy = xy * sxy, zz = z * sz, xz_yz = xy * sz, twist = swapped(w * sxy);
    const Both diagonal = 1 - (swapped(xx_yy) + zz), product = xy * swapped(sxy), wz = w * sz;
    const Both plus = xz_yz + twist, minus = xz_yz - twist;
    const auto ends = [](Both a, Both b) { return __builtin_shufflevector(a, b, 0, 3); };
    return {.row_x = lower(diagonal, product - wz),
            .row_y = ends(product + wz, diagonal),
            .row_z = ends(minus, plus),
            .column_z = ends(plus, minus),
            .last = 1 - (xx_yy + swapped(xx_yy))};
}

}  // namespace abut::lanes
