#include <abut/math/detail/coincident.hpp>
#include <abut/math/detail/no_index.hpp>

#include <bit>
#include <cstddef>

namespace abut::detail {
namespace {

/// The hash of a position; -0 counts as 0.
std::size_t hash_of(const Vec3& p) {
    std::uint64_t hash = 0;
    for (glm::length_t i = 0; i < 3; ++i) {
        hash ^= std::bit_cast<std::uint32_t>(p[i] + 0.0f);
        hash *= 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
}

}  // namespace

// Points are inserted in ascending order, so the first point of a position has the lowest index.
std::vector<std::uint32_t> first_coincident(std::span<const Vec3> points) {
    const std::size_t mask = std::bit_ceil(2 * points.size() + 1) - 1;
    std::vector<std::uint32_t> table(mask + 1, no_index), result(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::size_t place = hash_of(points[i]) & mask;
        while (table[place] != no_index && points[table[place]] != points[i]) place = (place + 1) & mask;
        if (table[place] == no_index) table[place] = i;
        result[i] = table[place];
    }
    return result;
}

}  // namespace abut::detail
