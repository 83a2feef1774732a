#pragma once

// Affine maps in double, the placement of shapes inside the queries. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/pose.hpp>

#include <array>

namespace abut::detail {

/// The map p -> linear * p + offset, stored as columns: column[i] is the image of axis i.
template <int D>
struct Affine {
    std::array<DVec<D>, D> column = identity();
    DVec<D> offset{0.0};

    static constexpr std::array<DVec<D>, D> identity() {
        std::array<DVec<D>, D> result{};
        for (int i = 0; i < D; ++i)
            for (int j = 0; j < D; ++j) result[static_cast<std::size_t>(i)][j] = i == j ? 1.0 : 0.0;
        return result;
    }

    DVec<D> vector(const DVec<D>& v) const {
        if constexpr (D == 2)
            return {column[0].x * v.x + column[1].x * v.y, column[0].y * v.x + column[1].y * v.y};
        else
            return {column[0].x * v.x + column[1].x * v.y + column[2].x * v.z,
                    column[0].y * v.x + column[1].y * v.y + column[2].y * v.z,
                    column[0].z * v.x + column[1].z * v.y + column[2].z * v.z};
    }
    DVec<D> point(const DVec<D>& p) const { return vector(p) + offset; }

    /// The transposed linear part. It maps a world direction to a local one, for support functions.
    DVec<D> transposed(const DVec<D>& v) const {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = dot(column[static_cast<std::size_t>(i)], v);
        return result;
    }
};

template <int D>
Affine<D> operator*(const Affine<D>& outer, const Affine<D>& inner) {
    Affine<D> result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) result.column[i] = outer.vector(inner.column[i]);
    result.offset = outer.point(inner.offset);
    return result;
}

/// The pose as an affine map; the rotation is normalised in double.
Affine<2> affine(const Pose2& pose);
Affine<3> affine(const Pose3& pose);

/// The image of a normal, up to a positive factor: the inverse transpose. Outward stays outward, also under a mirror.
inline DVec<2> mapped_normal(const Affine<2>& map, const DVec<2>& n) {
    const DVec<2>&u = map.column[0], &v = map.column[1];
    const double sign = cross(u, v) < 0 ? -1 : 1;
    return (DVec<2>(v.y, -v.x) * n.x + DVec<2>(-u.y, u.x) * n.y) * sign;
}
inline DVec<3> mapped_normal(const Affine<3>& map, const DVec<3>& n) {
    const DVec<3>&u = map.column[0], &v = map.column[1], &w = map.column[2];
    const double sign = dot(u, cross(v, w)) < 0 ? -1 : 1;
    return (cross(v, w) * n.x + cross(w, u) * n.y + cross(u, v) * n.z) * sign;
}

inline double determinant(const Affine<2>& map) {
    return cross(map.column[0], map.column[1]);
}
inline double determinant(const Affine<3>& map) {
    return dot(map.column[0], cross(map.column[1], map.column[2]));
}

/// The inverse map. `determinant` is that of the map and is not zero.
inline Affine<2> inverse(const Affine<2>& map, double determinant) {
    Affine<2> result;
    result.column[0] = DVec<2>(map.column[1].y, -map.column[0].y) / determinant;
    result.column[1] = DVec<2>(-map.column[1].x, map.column[0].x) / determinant;
    result.offset = -result.vector(map.offset);
    return result;
}
inline Affine<3> inverse(const Affine<3>& map, double determinant) {
    const DVec<3> x = cross(map.column[1], map.column[2]) / determinant;
    const DVec<3> y = cross(map.column[2], map.column[0]) / determinant;
    const DVec<3> z = cross(map.column[0], map.column[1]) / determinant;
    Affine<3> result;
    for (int i = 0; i < 3; ++i) result.column[static_cast<std::size_t>(i)] = DVec<3>(x[i], y[i], z[i]);
    result.offset = -result.vector(map.offset);
    return result;
}

template <int D>
Affine<D> scaling(const Vec<D>& scale) {
    Affine<D> result;
    for (int i = 0; i < D; ++i) result.column[static_cast<std::size_t>(i)] = axis<D>(i, static_cast<double>(scale[i]));
    return result;
}

}  // namespace abut::detail
