#pragma once

// Of many points, the plane that each is highest above.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// Points above it: dot(normal, p) > offset.
struct OrientedPlane {
    DVec<3> normal;
    double offset = 0;
};

/// Columns for so many points need room for this many more, which are read and written as well.
inline constexpr std::size_t highest_plane_padding = 8;

struct PointColumns {
    const double *x, *y, *z;
    std::size_t count;
};

/// One a point: how high it is above the plane that it is highest above, dot(normal, p) - offset, and the number of
/// that plane, the first of several. There is at least one plane. The same bits on every kind of vector unit.
void highest_planes(std::span<const OrientedPlane> planes, const PointColumns& points, double* heights,
                    double* numbers);

}  // namespace abut
