#pragma once

// The points of the parts of shapes nearest to a query point, as the filter of internal edges needs them. For .cpp
// files.

#include <abut/query/detail/part_pairs.hpp>

namespace abut::detail {

/// The point of a part nearest to a query point.
template <int D>
struct ClosestPoint {
    double distance = std::numeric_limits<double>::infinity();  ///< negative inside a part
    DVec<D> point{0.0};
    double behind = 0;  ///< how far the query point is behind a one-sided part; otherwise at most 0
};

/// Receives the closest points of the parts one by one. Returns the distance up to which it needs others, which never
/// grows; farther ones may still be visited.
template <int D>
using ClosestPointVisitor = FunctionRef<double(const ClosestPoint<D>& closest)>;
inline constexpr double stop_visiting = -std::numeric_limits<double>::infinity();

/// Visits the closest points of all parts that are at most `within` from the point.
template <int D>
using EachClosestPoint = FunctionRef<void(const DVec<D>& point, double within, ClosestPointVisitor<D> visit)>;

/// Of a distance function: follows the gradient by the distance.
template <int D>
ClosestPoint<D> closest_point_on(const AnyPart<D>& part, const DVec<D>& point);

/// Returns false, and leaves `closest` unspecified, if the part is farther than `within`. This is mostly cheaper than
/// the closest point.
template <int D>
bool find_closest_point(const Convex<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest);
template <int D>
bool find_closest_point(const Part<D>& part, const DVec<D>& point, double within, ClosestPoint<D>& closest) {
    if (part.is_convex()) return find_closest_point(part.convex(), point, within, closest);
    closest = closest_point_on(part, point);
    return closest.distance <= within;
}

/// A box around all points within a distance, expanded by more than rounding.
template <int D>
Aabb<D> box_around(const DVec<D>& point, double within) {
    constexpr double wider = 0x1p-22;
    const auto reach = static_cast<float>(within * (1 + wider) + largest(point) * wider);
    const Vec<D> middle = to_float(point);
    return {middle - reach, middle + reach};
}

/// Visits the closest points of the parts of a shape that isn't convex.
template <int D>
void each_closest_point_on_parts(const View<D>& shape, const DVec<D>& point, double within,
                                 ClosestPointVisitor<D> visit);

/// Visits the closest points of the parts of a shape.
template <int D, class Visit>
void each_closest_point_on(const View<D>& shape, const DVec<D>& point, double within, const Visit& visit) {
    const auto* const convex = std::get_if<Convex<D>>(&shape);
    if (convex == nullptr) return each_closest_point_on_parts<D>(shape, point, within, visit);
    ClosestPoint<D> closest;
    if (find_closest_point(*convex, point, within, closest)) visit(closest);
}

/// The centre of the box around a part; for a half-space, the nearby point itself.
template <int D>
DVec<D> middle_of(const AnyPart<D>& part, const DVec<D>& nearby) {
    return part.is_half_space() ? nearby : DVec<D>(center(bounds(part)));
}

}  // namespace abut::detail
