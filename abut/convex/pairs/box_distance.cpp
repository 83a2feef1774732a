#include <abut/convex/pairs/box_axes.hpp>
#include <abut/convex/pairs/box_closest.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// The tolerance of two bounds that should agree, relative to the sum of all coordinates.
constexpr double box_tolerance = 1e-12;

Triple corner_of_b(const BoxFrame& frame, std::uint32_t number) {
    Triple result{frame.middle[0], frame.middle[1], frame.middle[2]};
    for (std::size_t j = 0; j < 3; ++j) {
        const double reach = (number >> j & 1u) != 0 ? -frame.half_b[j] : frame.half_b[j];
        for (std::size_t i = 0; i < 3; ++i) result[i] += frame.axis_b[j][i] * reach;
    }
    return result;
}

/// From A to a corner of B. Returns false if the distance isn't proven; then `number` is the support corner of B
/// towards A.
bool from_a_to_corner(const BoxFrame& frame, std::uint32_t& number, BoxClosest& closest) {
    const Triple corner = corner_of_b(frame, number);
    Triple between;
    std::uint32_t free = 0, low = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double half = frame.half_a[i];
        const double below_high = corner[i] < half ? corner[i] : half, on_a = below_high > -half ? below_high : -half;
        between[i] = corner[i] - on_a;
        closest.on_a[i] = on_a;
        free |= between[i] == 0 ? 1u << i : 0u;
        low |= between[i] < 0 ? 1u << i : 0u;
    }
    closest.part_a = {low, free};
    closest.part_b = {number, 0};
    const double square = dot(between, between);
    if (!(square > 0)) return false;
    const Triple rotated = frame.along_b(between);
    double plane = dot(between, frame.middle);
    for (std::size_t i = 0; i < 3; ++i)
        plane -= std::abs(between[i]) * frame.half_a[i] + std::abs(rotated[i]) * frame.half_b[i];
    closest.distance = square_root(square);
    if (!(square - plane <= box_tolerance * frame.scale() * closest.distance)) {
        number = 0;
        for (std::size_t j = 0; j < 3; ++j) number |= rotated[j] > 0 ? 1u << j : 0u;
        return false;
    }
    const double one = 1 / closest.distance;
    for (std::size_t i = 0; i < 3; ++i) closest.normal[i] = between[i] * one;
    return true;
}

}  // namespace

bool nearest_from_corner(const BoxFrame& frame, std::uint32_t corner_of_b, BoxClosest& closest) {
    for (int step = 0; step < 3; ++step) {
        const std::uint32_t before = corner_of_b;
        if (from_a_to_corner(frame, corner_of_b, closest)) return true;
        if (corner_of_b == before) return false;
    }
    return false;
}

bool closest_on_edges(const BoxFrame& frame, std::size_t number, BoxClosest& closest) {
    const std::size_t i = number / 3, j = number % 3;
    const Triple axis = edge_axis(frame, number);
    const Triple rotated = frame.along_b(axis);
    const double square = dot(axis, axis), one = 1 / square_root(square);
    if (!(square > min_axis_square)) return false;
    const Triple& edge_b = frame.axis_b[j];
    closest.part_a = {0, 1u << i};
    closest.part_b = {0, 1u << j};

    // The midpoints of the two edges, and the vector between them.
    Triple between{frame.middle[0], frame.middle[1], frame.middle[2]};
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        closest.normal[k] = axis[k] * one;
        closest.on_a[k] = 0;
        if (k != i) {
            closest.on_a[k] = std::copysign(frame.half_a[k], axis[k]);
            closest.part_a.low |= axis[k] < 0 ? 1u << k : 0u;
            between[k] -= closest.on_a[k];
            reach += std::abs(axis[k]) * frame.half_a[k];
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (k == j) continue;
        const double half = std::copysign(frame.half_b[k], rotated[k]);
        closest.part_b.low |= rotated[k] > 0 ? 1u << k : 0u;
        for (std::size_t x = 0; x < 3; ++x) between[x] -= frame.axis_b[k][x] * half;
        reach += std::abs(rotated[k]) * frame.half_b[k];
    }
    const double on_b = (edge_b[i] * between[i] - dot(edge_b, between)) / square;
    const double on_a = between[i] + edge_b[i] * on_b;
    const double tolerance = box_tolerance * frame.scale();
    if (std::abs(on_a) > frame.half_a[i] + tolerance || std::abs(on_b) > frame.half_b[j] + tolerance) return false;
    closest.on_a[i] = std::clamp(on_a, -frame.half_a[i], frame.half_a[i]);
    closest.distance = (dot(axis, frame.middle) - reach) * one;
    return true;
}

}  // namespace abut::detail
