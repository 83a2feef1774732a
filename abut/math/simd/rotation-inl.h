#pragma once

// Rotation matrices of quaternions in lane types, for code that makes and uses one in the same place. For .cpp files.

#include <abut/math/simd/double2-inl.h>

#include <array>
#include <cstddef>

#include <glm/ext/quaternion_float.hpp>

namespace abut::lanes {

inline void put(const Double3& v, double* numbers) {
    put(v.xy, numbers);
    numbers[2] = v.z[0];
}

/// A 3x3 rotation matrix by rows; the last elements of the first two rows are stored as those of the last column.
struct Turned {
    Double2 row_x, row_y, row_z, column_z;
    Double2 last;  ///< element (2, 2), in both lanes

    Double3 first_column() const { return {lower(row_x, row_y), first(row_z)}; }
    Double3 second_column() const { return {upper(row_x, row_y), second(row_z)}; }
    Double3 last_column() const { return {column_z, last}; }

    // Bit for bit equal to the functions of Affine.

    Double3 vector(const Double3& v) const {
        const Double2 x = row_x * v.xy, y = row_y * v.xy;
        return {lower(x, y) + upper(x, y) + column_z * v.z, dot(row_z, v.xy) + last * v.z};
    }
    Double3 transposed(const Double3& v) const {
        return {row_x * first(v.xy) + row_y * second(v.xy) + row_z * v.z, dot(column_z, v.xy) + last * v.z};
    }
};

/// The matrix of a nonzero quaternion, bit for bit that of `set_affine`.
[[gnu::always_inline]] inline Turned turned(const glm::quat& q) {
    // Independent of glm's storage order.
    constexpr bool w_is_last = offsetof(glm::quat, w) > offsetof(glm::quat, z);
    const Double2 xy = loaded(&q.x),
                  zw = w_is_last ? loaded(&q.z) : double2(static_cast<double>(q.z), static_cast<double>(q.w));
    const Double2 squares = xy * xy + zw * zw, s = 2 / (squares + swapped(squares)), z = first(zw), w = second(zw);
    const Double2 sxy = xy * s, sz = z * s;
    const Double2 xx_yy = xy * sxy, zz = z * sz, xz_yz = xy * sz, twist = swapped(w * sxy);
    const Double2 diagonal = 1 - (swapped(xx_yy) + zz), product = xy * swapped(sxy), wz = w * sz;
    const Double2 plus = xz_yz + twist, minus = xz_yz - twist;
    return {.row_x = lower(diagonal, product - wz),
            .row_y = ends(product + wz, diagonal),
            .row_z = ends(minus, plus),
            .column_z = ends(plus, minus),
            .last = 1 - (xx_yy + swapped(xx_yy))};
}

/// The matrix of the columns times a number.
inline Turned scaled(const std::array<glm::vec<3, double>, 3>& columns, double number) {
    const auto& [x, y, z] = columns;
    const Double2 s = double2(number);
    return {.row_x = double2(x.x, y.x) * s,
            .row_y = double2(x.y, y.y) * s,
            .row_z = double2(x.z, y.z) * s,
            .column_z = double2(z.x, z.y) * s,
            .last = double2(z.z) * s};
}

}  // namespace abut::lanes
