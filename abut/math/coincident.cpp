#include <abut/math/coincident.hpp>

#include <algorithm>
#include <tuple>

namespace abut {

std::vector<std::uint32_t> first_coincident(std::span<const Vec3> points) {
    const auto key = [&](std::uint32_t i) {
        const Vec3& p = points[i];
        return std::tuple(p.x, p.y, p.z, i);
    };
    std::vector<std::uint32_t> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    std::vector<std::uint32_t> result(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
        result[order[i]] = same ? result[order[i - 1]] : order[i];
    }
    return result;
}

}  // namespace abut
