#include "polytope.hpp"

#include <cstddef>
#include <utility>

namespace abut::oracle {

using namespace detail;

namespace {

/// Whether the line through points i and j has points on both sides, beyond the rounding of doubles.
bool separates_points(const std::vector<Vec<2>>& points, std::uint32_t i, std::uint32_t j) {
    const DVec<2> from(points[i]), along = DVec<2>(points[j]) - from;
    bool left = false, right = false;
    for (const Vec<2>& point : points) {
        const DVec<2> to = DVec<2>(point) - from;
        const double one = along.x * to.y, other = along.y * to.x;
        const double error_bound = 4e-16 * (std::abs(one) + std::abs(other));
        left = left || one - other > error_bound;
        right = right || one - other < -error_bound;
        if (left && right) return true;
    }
    return false;
}

/// The position of a plane relative to the hull.
enum class Plane {
    along,    ///< a supporting plane, to within rounding
    through,  ///< cuts the hull
    unknown,  ///< undefined: its three points are collinear
};

/// Classifies the plane of three of the points. The error bounds are those of Shewchuk's "Adaptive precision
/// floating-point arithmetic" (1997).
Plane plane_of(const std::vector<Vec<3>>& points, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const auto absolute = [](const DVec<3>& v) { return DVec<3>(std::abs(v.x), std::abs(v.y), std::abs(v.z)); };
    const DVec<3> from(points[i]), u = DVec<3>(points[j]) - from, v = DVec<3>(points[k]) - from;
    const DVec<3> normal = cross(u, v), s = absolute(u), t = absolute(v);
    const DVec<3> terms(s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x);
    bool is_defined = false;
    for (int axis = 0; axis < 3; ++axis) is_defined = is_defined || std::abs(normal[axis]) > 4e-16 * terms[axis];
    if (!is_defined) return Plane::unknown;
    bool above = false, below = false;
    for (const Vec<3>& point : points) {
        const DVec<3> to = DVec<3>(point) - from;
        const double height = dot(normal, to), error_bound = 8e-16 * dot(terms, absolute(to));
        above = above || height > error_bound;
        below = below || height < -error_bound;
        if (above && below) return Plane::through;
    }
    return Plane::along;
}

}  // namespace

template <int D>
Polytope<D> hull_of(std::vector<Vec<D>> points, double radius) {
    Polytope<D> result;
    result.points = std::move(points);
    result.radius = radius;
    std::vector<std::uint32_t> different;
    for (std::uint32_t i = 0; i < result.points.size(); ++i) {
        const auto same = [&](std::uint32_t j) { return result.points[i] == result.points[j]; };
        if (std::none_of(different.begin(), different.end(), same)) different.push_back(i);
    }
    const std::size_t count = different.size();
    if constexpr (D == 2) {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!separates_points(result.points, different[i], different[j]))
                    add_edge(result, different[i], different[j]);
    } else {
        if (count == 2) add_edge(result, different[1], different[0]);
        std::vector<bool> used(count * count);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k) {
                    const Plane plane = plane_of(result.points, different[i], different[j], different[k]);
                    if (plane == Plane::through) continue;
                    if (plane == Plane::along) result.triangles.push_back({different[i], different[j], different[k]});
                    for (const auto& [from, to] : {std::array{i, j}, std::array{i, k}, std::array{j, k}}) {
                        if (!used[from * count + to]) add_edge(result, different[from], different[to]);
                        used[from * count + to] = true;
                    }
                }
    }
    return result;
}

template <int D>
Polytope<D> box_between(const Vec<D>& low, const Vec<D>& high, const Affine<D>& place, double radius) {
    Polytope<D> result;
    result.place = place;
    result.radius = radius;
    constexpr std::uint32_t count = 1u << D;
    for (std::uint32_t i = 0; i < count; ++i) {
        Vec<D>& corner = result.points.emplace_back(low);
        for (int axis = 0; axis < D; ++axis)
            if ((i >> axis & 1u) != 0) corner[axis] = high[axis];
        for (std::uint32_t bit = 1; bit < count; bit *= 2)
            if ((i & bit) == 0) result.edges.push_back({i, i | bit});
    }
    for (std::uint32_t bit = 1; bit < count; bit *= 2) result.edge_directions.push_back({0, bit});
    if constexpr (D == 3)
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t across = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
            for (std::uint32_t side : {0u, across}) {
                result.triangles.push_back({side, side | u, side | v});
                result.triangles.push_back({side | u | v, side | u, side | v});
            }
        }
    return result;
}

template Polytope<2> hull_of(std::vector<Vec<2>>, double);
template Polytope<2> box_between(const Vec<2>&, const Vec<2>&, const Affine<2>&, double);
template Polytope<3> hull_of(std::vector<Vec<3>>, double);
template Polytope<3> box_between(const Vec<3>&, const Vec<3>&, const Affine<3>&, double);

}  // namespace abut::oracle
