#include <abut/convex/hull/limited/linear_program.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <cstddef>

namespace abut::detail {
namespace {

constexpr double far_away = 1e4, below = 1e-11, min_pivot = 1e-9;
constexpr int max_steps = 100;

/// The vertex of three planes, with the cost as a sum of their normals.
struct Corner {
    std::array<Plane<3>, 3> planes;
    std::array<std::uint32_t, 3> number{no_index, no_index, no_index};
    std::array<double, 3> weight{};

    /// x with normal[0] x[0] + normal[1] x[1] + normal[2] x[2] == v.
    std::array<double, 3> parts(const DVec<3>& v) const {
        const DVec<3>&a = planes[0].normal, &b = planes[1].normal, &c = planes[2].normal;
        const double inverse = 1 / dot(a, cross(b, c));
        return {dot(v, cross(b, c)) * inverse, dot(v, cross(c, a)) * inverse, dot(v, cross(a, b)) * inverse};
    }
    DVec<3> point() const {
        const DVec<3>&a = planes[0].normal, &b = planes[1].normal, &c = planes[2].normal;
        return (cross(b, c) * planes[0].offset + cross(c, a) * planes[1].offset + cross(a, b) * planes[2].offset) /
               dot(a, cross(b, c));
    }
};

}  // namespace

std::optional<DVec<3>> lowest_above(std::span<const Plane<3>> planes, const DVec<3>& cost, double size) {
    // Without planes: the lowest point of a large box.
    Corner corner;
    for (std::size_t i = 0; i < 3; ++i) {
        const int along = static_cast<int>(i);
        const double sign = cost[along] < 0 ? -1 : 1;
        corner.planes[i] = {axis<3>(along, sign), -far_away * size};
        corner.weight[i] = sign * cost[along];
    }
    for (int step = 0; step < max_steps; ++step) {
        const DVec<3> p = corner.point();
        std::uint32_t entering = no_index;
        double depth = below * size;
        for (std::uint32_t i = 0; i < planes.size(); ++i) {
            const double under = planes[i].offset - dot(planes[i].normal, p);
            if (under > depth) {
                depth = under;
                entering = i;
            }
        }
        if (entering == no_index) {
            for (const std::uint32_t number : corner.number)
                if (number == no_index) return std::nullopt;
            return p;
        }
        const std::array<double, 3> parts = corner.parts(planes[entering].normal);
        std::size_t leaving = 3;
        for (std::size_t i = 0; i < 3; ++i)
            if (parts[i] > min_pivot &&
                (leaving == 3 || corner.weight[i] * parts[leaving] < corner.weight[leaving] * parts[i]))
                leaving = i;
        if (leaving == 3) return std::nullopt;
        const double weight = corner.weight[leaving] / parts[leaving];
        for (std::size_t i = 0; i < 3; ++i) corner.weight[i] -= weight * parts[i];
        corner.weight[leaving] = weight;
        corner.planes[leaving] = planes[entering];
        corner.number[leaving] = entering;
    }
    return std::nullopt;
}

}  // namespace abut::detail
