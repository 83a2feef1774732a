// Hulls of any points, in 2D and 3D, with any limit: they contain all points to within the tolerance, and all numbers
// are finite.

#include "bytes.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace {

using namespace abut;
using namespace abut::detail;
using fuzz::require;

constexpr std::size_t max_points = 200;

/// The first byte selects the kind of points, the second the limit; the others are coordinates: raw floats, or steps of
/// a coarse lattice, where many points are coplanar.
template <int D>
std::vector<Vec<D>> points_of(std::span<const std::uint8_t> bytes, bool lattice) {
    const std::size_t width = lattice ? 1 : sizeof(float), size = width * static_cast<std::size_t>(D);
    std::vector<Vec<D>> result;
    for (; bytes.size() >= size && result.size() < max_points; bytes = bytes.subspan(size)) {
        Vec<D> point;
        for (int i = 0; i < D; ++i) {
            const std::uint8_t* at = bytes.data() + width * static_cast<std::size_t>(i);
            if (lattice)
                point[i] = static_cast<float>(*at);
            else
                std::memcpy(&point[i], at, sizeof(float));
        }
        result.push_back(point);
    }
    return result;
}

template <int D>
bool any_not_finite(const std::vector<Vec<D>>& points) {
    return std::any_of(points.begin(), points.end(), [](const Vec<D>& point) { return !is_finite<D>(point); });
}

void check_plane(const std::vector<Vec2>& points, std::uint32_t limit) {
    double added = -1;
    const Result<Hull2> full = hull(points), built = limited_hull(points, {limit, &added});
    require(static_cast<bool>(full) == (!points.empty() && !any_not_finite<2>(points)));
    if (!built) {
        require(!full || limit < 3 || built.problem().code == ProblemCode::too_large);
        return;
    }
    require(limit == 0 || built->points.size() <= limit);
    require(!any_not_finite<2>(built->points));
    if (built->points == full->points) return;
    require(added >= 0);
    for (std::size_t i = 0; i < built->points.size(); ++i)
        for (const Vec2& point : full->points)
            require(orientation(built->points[i], built->points[(i + 1) % built->points.size()], point) >= 0);
}

/// All points are below all planes, up to the rounding of doubles.
void check_faces(const Hull3& hull, const std::vector<Vec3>& points) {
    double largest_coordinate = 0;
    for (const Vec3& point : hull.points) largest_coordinate = std::max(largest_coordinate, largest(DVec<3>(point)));
    for (std::size_t face = 0; face < hull.normals.size(); ++face) {
        const DVec<3> normal(hull.normals[face]);
        require(std::abs(length(normal) - 1) < 1e-5);
        for (const Vec3& point : points)
            require(dot(normal, DVec<3>(point)) <=
                    hull.offsets[face] + 1e-6 * extent<3>(hull.points) + 1e-14 * largest_coordinate);
    }
}

void check_space(const std::vector<Vec3>& points, std::uint32_t limit) {
    double added = -1;
    const Result<Hull3> full = hull(points), built = limited_hull(points, {limit, &added});
    require(static_cast<bool>(full) == (!points.empty() && !any_not_finite<3>(points)));
    if (!built) {
        require(!full || limit < 4 || built.problem().code == ProblemCode::too_large);
        return;
    }
    require(limit == 0 || built->points.size() <= limit);
    require(!any_not_finite<3>(built->points) && std::isfinite(built->volume) && std::isfinite(built->area));
    require(built->rank >= full->rank);
    if (built->rank == 3 && built->points != full->points) require(added >= 0);
    check_faces(*built, points);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const bool in_space = (data[0] & 1u) != 0, lattice = (data[0] & 2u) != 0;
    const std::uint32_t limit = data[1] % 40;
    const std::span<const std::uint8_t> bytes(data + 2, size - 2);
    if (in_space)
        check_space(points_of<3>(bytes, lattice), limit);
    else
        check_plane(points_of<2>(bytes, lattice), limit);
    return 0;
}
