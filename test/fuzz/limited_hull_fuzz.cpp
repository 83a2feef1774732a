// Hulls with a vertex limit of any points, in 2D and 3D, stretched, flat, far away: they contain every point exactly,
// respect the limit, and are no larger than the bounding box.

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
#include <limits>
#include <span>
#include <vector>

namespace {

using namespace abut;
using namespace abut::detail;
using fuzz::require;

constexpr std::size_t max_points = 60;

/// The first bytes select the generator: the limit; coordinates as raw floats, small integers or ulp steps around a
/// point; and the power of two that scales each axis.
struct Recipe {
    std::uint32_t limit;
    int kind;
    std::array<int, 3> exponent;
    float place;
};

template <int D>
std::vector<Vec<D>> points_of(std::span<const std::uint8_t> bytes, const Recipe& recipe) {
    const std::size_t width = recipe.kind == 0 ? sizeof(float) : sizeof(std::int8_t);
    const std::size_t size = width * static_cast<std::size_t>(D);
    std::vector<Vec<D>> result;
    for (; bytes.size() >= size && result.size() < max_points; bytes = bytes.subspan(size)) {
        Vec<D> point;
        for (int i = 0; i < D; ++i) {
            const std::uint8_t* at = bytes.data() + width * static_cast<std::size_t>(i);
            float value = 0;
            if (recipe.kind == 0)
                std::memcpy(&value, at, sizeof(float));
            else
                value = static_cast<float>(static_cast<std::int8_t>(*at));
            if (recipe.kind != 0) value = std::ldexp(value, recipe.exponent[static_cast<std::size_t>(i)]);
            if (recipe.kind == 2) value += recipe.place;
            if (!std::isfinite(value)) return result;
            point[i] = value;
        }
        result.push_back(point);
    }
    return result;
}

/// Whether a Problem is allowed: a hull around such points may exceed the range of floats.
template <int D>
bool is_huge(const std::vector<Vec<D>>& points) {
    for (const Vec<D>& point : points)
        if (largest(DVec<D>(point)) > 0.1 * static_cast<double>(std::numeric_limits<float>::max())) return true;
    return false;
}

void check_plane(const std::vector<Vec2>& points, std::uint32_t limit) {
    double added = -1;
    const Hull2 full = *hull(points);
    const Result<Hull2> built = limited_hull(points, {limit, &added});
    if (!built) {
        require(limit < 4 && is_huge<2>(points));
        return;
    }
    require(built->points.size() <= limit);
    if (full.points.size() <= limit) return;
    require(built->rank == 2 && added >= 0);
    double area = 0;
    const std::size_t count = built->points.size();
    const DVec<2> origin(built->points[0]);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 &a = built->points[i], &b = built->points[(i + 1) % count];
        area += 0.5 * cross(DVec<2>(a) - origin, DVec<2>(b) - origin);
        for (const Vec2& point : points) require(orientation(a, b, point) >= 0);
    }
    const DVec<2> side = min_max<2>(points).sides();
    if (limit >= 4) require(area <= side.x * side.y * (1 + 1e-9));
}

/// Checks exactly that every supporting plane through three corners has all points on its inner side.
void check_held(const std::vector<Vec3>& corners, const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                bool above = false, below = false;
                const auto side = [&](const Vec3& p) { return orientation(corners[i], corners[j], corners[k], p); };
                for (std::size_t l = 0; l < corners.size() && !(above && below); ++l) {
                    const int found = side(corners[l]);
                    above = above || found > 0;
                    below = below || found < 0;
                }
                if (above == below) continue;
                for (const Vec3& point : points) require(above ? side(point) >= 0 : side(point) <= 0);
            }
}

void check_space(const std::vector<Vec3>& points, std::uint32_t limit) {
    double added = -1;
    const Hull3 full = *hull(points);
    const Result<Hull3> built = limited_hull(points, {limit, &added});
    if (!built) {
        require(limit < 8 && is_huge<3>(points));
        return;
    }
    require(built->points.size() <= limit);
    require(built->rank >= full.rank && std::isfinite(built->volume) && std::isfinite(built->area));
    if (full.points.size() <= limit) return;
    for (std::size_t face = 0; face < built->normals.size(); ++face)
        for (const Vec3& point : points)
            require(dot(DVec<3>(built->normals[face]), DVec<3>(point)) <= built->offsets[face]);
    if (built->rank < 3) return;
    check_held(built->points, points);
    const DVec<3> side = min_max<3>(points).sides();
    if (limit >= 8 && full.rank == 3) require(built->volume <= side.x * side.y * side.z * (1 + 1e-9));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 7) return 0;
    const bool in_space = (data[0] & 1u) != 0;
    Recipe recipe{(in_space ? 4u : 3u) + data[1] % 30u, data[0] / 2 % 3, {}, 0};
    for (std::size_t i = 0; i < 3; ++i) recipe.exponent[i] = static_cast<std::int8_t>(data[2 + i]) / 4;
    recipe.place = std::ldexp(static_cast<float>(data[5]), static_cast<std::int8_t>(data[6]) / 4);
    const std::span<const std::uint8_t> bytes(data + 7, size - 7);
    if (in_space) {
        const std::vector<Vec3> points = points_of<3>(bytes, recipe);
        if (!points.empty()) check_space(points, recipe.limit);
    } else {
        const std::vector<Vec2> points = points_of<2>(bytes, recipe);
        if (!points.empty()) check_plane(points, recipe.limit);
    }
    return 0;
}
