#include <abut/bake/weld.hpp>
#include <abut/math/coincident.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace abut {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Welded weld(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    const std::vector<std::uint32_t> stands_for = first_coincident(points);
    std::vector<std::uint32_t> number(points.size(), none);
    Welded result;
    const auto use = [&](std::uint32_t corner) {
        const std::uint32_t point = stands_for[corner];
        if (number[point] == none) {
            number[point] = static_cast<std::uint32_t>(result.points.size());
            result.points.push_back(points[point] + Vec3(0.0f));
        }
        return number[point];
    };
    result.triangles.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        const std::uint32_t a = stands_for[t.x];
        const std::uint32_t b = stands_for[t.y];
        const std::uint32_t c = stands_for[t.z];
        if (a != b && b != c && c != a) result.triangles.push_back(glm::uvec3{use(a), use(b), use(c)});
    }
    return result;
}

}  // namespace abut
