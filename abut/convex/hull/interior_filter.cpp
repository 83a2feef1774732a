// The gauge of a convex body about an inner point, the reciprocal of its extent along a direction, is a convex function
// on each face of a cube of directions. A plane above the gauge at the four corners of a cell is above it on all of the
// cell.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/interior_filter.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

namespace abut::detail {
namespace {

constexpr std::size_t min_points = 2000;  ///< below this number of points the filter doesn't pay

/// Points this deep inside, relative to the distance of the surface from the centre, are removed. Far above the
/// rounding of floats in the map and in the planes.
constexpr double depth = 0x1p-14;

/// Thinner bodies, relative to their extent, and bodies outside of this range of sizes are not filtered.
constexpr double min_thickness = 0x1p-12, min_extent = 0x1p-60, max_extent = 0x1p60;

/// Directions from a centre, in coordinates scaled so that the bounding box is about a cube: six faces of rows x rows
/// cells each.
struct DirectionMap {
    Vec3 center, stretch;
    std::uint32_t rows;

    std::uint32_t cells() const { return 6 * rows * rows; }
    Vec3 local(const Vec3& point) const { return (point - center) * stretch; }
    std::uint32_t cell(const Vec3& local) const {
        const float x = std::abs(local.x), y = std::abs(local.y), z = std::abs(local.z);
        const int up = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
        const float largest_coordinate = std::max(std::max(x, y), std::max(z, std::numeric_limits<float>::min()));
        const float half = 0.5f * static_cast<float>(rows);
        const auto place = [&](int axis) {
            return std::min(rows - 1, static_cast<std::uint32_t>(local[axis] / largest_coordinate * half + half));
        };
        const std::uint32_t face = 2 * static_cast<std::uint32_t>(up) + (local[up] < 0 ? 1 : 0);
        return (face * rows + place((up + 1) % 3)) * rows + place((up + 2) % 3);
    }

    /// The direction to a corner of the cells of a face; 1 or -1 on the face's axis.
    DVec<3> corner(std::uint32_t face, std::uint32_t column, std::uint32_t row) const {
        const int up = static_cast<int>(face / 2);
        DVec<3> result;
        result[up] = face % 2 == 0 ? 1 : -1;
        result[(up + 1) % 3] = 2.0 * column / rows - 1;
        result[(up + 2) % 3] = 2.0 * row / rows - 1;
        return result;
    }
};

/// The farthest point of each non-empty cell, in the order of the cells.
std::vector<Vec3> farthest_points(std::span<const Vec3> points, const DirectionMap& map) {
    struct Farthest {
        float square = -1;
        Vec3 point;
    };
    std::vector<Farthest> found(map.cells());
    for (const Vec3& point : points) {
        const Vec3 local = map.local(point);
        const float square = local.x * local.x + local.y * local.y + local.z * local.z;
        Farthest& best = found[map.cell(local)];
        if (square > best.square || (square == best.square && less(point, best.point))) best = {square, point};
    }
    std::vector<Vec3> result;
    for (const Farthest& best : found)
        if (best.square >= 0) result.push_back(without_negative_zero(best.point));
    return result;
}

/// A closed convex surface around the origin.
class Body {
public:
    /// Nothing if the hull of the points is so flat that the centre of the map is not well inside.
    static std::optional<Body> around(std::span<const Vec3> points, DirectionMap& map) {
        const HullGrid grid = on_grid(points);
        const Spread spread = spread_of(grid, min_thickness * (grid.tolerance / hull_tolerance));
        if (spread.rank < 3) return std::nullopt;
        Body result;
        result.surface_ = quickhull(grid.points, spread.points, grid.tolerance);

        DVec<3> sum(0.0);
        for (const Vec3& point : points) sum += DVec<3>(point);
        map.center = to_float(sum / static_cast<double>(points.size()));
        for (const Vec3& point : points)
            result.corners_.push_back((DVec<3>(point) - DVec<3>(map.center)) * DVec<3>(map.stretch));
        for (std::size_t h = 0; h < result.surface_.origin.size(); h += 3) {
            const DVec<3>& a = result.corners_[result.surface_.origin[h]];
            const DVec<3>& b = result.corners_[result.surface_.origin[h + 1]];
            const DVec<3>& c = result.corners_[result.surface_.origin[h + 2]];
            const DVec<3> normal = cross(b - a, c - a);
            if (!(dot(normal, a) > 0x1p-30 * length(normal))) return std::nullopt;
        }
        return result;
    }

    /// An upper bound of the gauge along a direction, near the direction of the last call; infinity if none is found.
    double gauge(const DVec<3>& direction) {
        for (std::size_t step = 0; step < surface_.normals.size(); ++step) {
            const std::uint32_t h = 3 * triangle_;
            const DVec<3>&a = corners_[surface_.origin[h]], &b = corners_[surface_.origin[h + 1]],
                  &c = corners_[surface_.origin[h + 2]];
            // These weights express the direction in the three corners, up to a common scale. If none is negative, the
            // direction passes through the triangle.
            const double weights[] = {dot(direction, cross(b, c)), dot(direction, cross(c, a)),
                                      dot(direction, cross(a, b))};
            const double* smallest = std::min_element(weights, weights + 3);
            if (*smallest >= 0) return (weights[0] + weights[1] + weights[2]) / dot(a, cross(b, c));
            const auto opposite = static_cast<std::uint32_t>((smallest - weights + 1) % 3);
            triangle_ = surface_.twin[h + opposite] / 3;
        }
        return std::numeric_limits<double>::infinity();
    }

private:
    TriangleSurface surface_;
    std::vector<DVec<3>> corners_;  ///< one per point, in the map's coordinates
    std::uint32_t triangle_ = 0;
};

/// The plane above the gauge of a cell, given at its corners in the order (0, 0), (0, 1), (1, 0), (1, 1).
Vec3 plane_above(const std::array<double, 4>& gauge, const DVec<3>& low_corner, int up, double width) {
    const int right = (up + 1) % 3, ahead = (up + 2) % 3;
    DVec<3> plane;
    plane[right] = ((gauge[2] - gauge[0]) + (gauge[3] - gauge[1])) / (2 * width);
    plane[ahead] = ((gauge[1] - gauge[0]) + (gauge[3] - gauge[2])) / (2 * width);
    // With these slopes opposite corners have equal heights over the plane.
    const double level = std::max(gauge[0], gauge[1] - plane[ahead] * width);
    plane[up] = low_corner[up] * (level - plane[right] * low_corner[right] - plane[ahead] * low_corner[ahead]);
    return to_float(plane);
}

/// One per cell: a point of the cell with dot(plane, local) <= 1 is in the body. NaN if that isn't known.
std::vector<Vec3> planes_of(Body& body, const DirectionMap& map) {
    const std::uint32_t rows = map.rows, across = rows + 1;
    std::vector<Vec3> result;
    result.reserve(map.cells());
    std::vector<double> gauges(across * across);
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t i = 0; i < across * across; ++i)
            gauges[i] = body.gauge(map.corner(face, i / across, i % across));
        for (std::uint32_t i = 0; i < rows; ++i)
            for (std::uint32_t j = 0; j < rows; ++j) {
                const double* here = &gauges[i * across + j];
                const std::array<double, 4> gauge{here[0], here[1], here[across], here[across + 1]};
                const bool known = std::isfinite(gauge[0] + gauge[1] + gauge[2] + gauge[3]);
                result.push_back(
                    known ? plane_above(gauge, map.corner(face, i, j), static_cast<int>(face / 2), 2.0 / rows)
                          : Vec3(std::numeric_limits<float>::quiet_NaN()));
            }
    }
    return result;
}

}  // namespace

std::vector<Vec3> without_interior_points(std::span<const Vec3> points) {
    std::vector<Vec3> all(points.begin(), points.end());
    if (points.size() < min_points) return all;
    const auto [low, high] = min_max<3>(points);
    const DVec<3> side = high - low;
    const double extent = largest(side);
    if (!(extent > min_extent && extent < max_extent) || std::min({side.x, side.y, side.z}) < min_thickness * extent)
        return all;
    DirectionMap map{to_float(0.5 * (low + high)), to_float(2.0 / side), 8};
    while (map.rows < 32 && map.rows * map.rows * map.rows * map.rows * 40 < points.size()) map.rows *= 2;

    std::optional<Body> body = Body::around(farthest_points(points, map), map);
    if (!body) return all;
    const std::vector<Vec3> planes = planes_of(*body, map);
    const auto inside = [&](const Vec3& point) {
        const Vec3 local = map.local(point);
        const Vec3& plane = planes[map.cell(local)];
        return plane.x * local.x + plane.y * local.y + plane.z * local.z < static_cast<float>(1 - depth);
    };
    all.clear();
    std::copy_if(points.begin(), points.end(), std::back_inserter(all), std::not_fn(inside));
    return all;
}

}  // namespace abut::detail
