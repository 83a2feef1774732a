#include <abut/bake/reflex_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/half_edges.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace abut {
namespace {

struct Weighted {
    DVec<3> normal;
    double offset;
    double weight;
};

/// Which planes are taken as one.
std::tuple<double, double, double, double> rounded(const Weighted& plane, double step) {
    constexpr double fine = 1e4;
    return {std::floor(plane.normal.x * fine + 0.5), std::floor(plane.normal.y * fine + 0.5),
            std::floor(plane.normal.z * fine + 0.5), std::floor(plane.offset / step + 0.5)};
}

}  // namespace

std::vector<ParallelPlanes> reflex_planes(const Piece& piece) {
    constexpr std::size_t most = 16;
    constexpr double sharp = 0.25;  // the sine of the bend
    const auto area = [&](std::uint32_t t) {
        const glm::uvec3& corners = piece.triangles[t];
        const DVec<3>& a = piece.points[corners.x];
        return cross(piece.points[corners.y] - a, piece.points[corners.z] - a);
    };
    std::vector<Weighted> planes;
    double extent = 0;
    const std::vector<HalfEdge> sides = sorted_half_edges(piece.triangles);
    each_edge(sides, [&](std::span<const HalfEdge> edge) {
        const auto goes_up = [](const HalfEdge& side) { return side.upwards; };
        const auto above = std::find_if(edge.begin(), edge.end(), goes_up);
        const auto below = std::find_if_not(edge.rbegin(), edge.rend(), goes_up);
        if (above == edge.end() || below == edge.rend()) return;
        const DVec<3>& from = piece.points[above->low];
        const DVec<3> along = piece.points[above->high] - from;
        extent = std::max(extent, largest(along));
        const DVec<3> down = normalized(area(below->side / 3), DVec<3>(0.0)),
                      up = normalized(area(above->side / 3), DVec<3>(0.0));
        const double bend = dot(cross(up, down), normalized(along));
        const bool fold = dot(up, down) < -0.9;
        if (bend > -sharp && !(fold && bend <= 0)) return;
        const double weight = length(along) * (1 - dot(up, down));
        for (const DVec<3>& normal : {down, up}) {
            const bool turn = std::tuple(normal.x, normal.y, normal.z) < std::tuple(0.0, 0.0, 0.0);
            const DVec<3> facing = (turn ? -normal : normal) + DVec<3>(0.0);
            planes.push_back({facing, dot(facing, from), weight});
        }
    });
    const double step = 1e-5 * extent;
    std::sort(planes.begin(), planes.end(), [&](const Weighted& a, const Weighted& b) {
        const auto key = [&](const Weighted& p) {
            return std::tuple(rounded(p, step), p.normal.x, p.normal.y, p.normal.z, p.offset, p.weight);
        };
        return key(a) < key(b);
    });
    std::vector<Weighted> joined;
    for (const Weighted& plane : planes) {
        if (!joined.empty() && rounded(joined.back(), step) == rounded(plane, step))
            joined.back().weight += plane.weight;
        else
            joined.push_back(plane);
    }
    std::stable_sort(joined.begin(), joined.end(),
                     [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; });
    if (joined.size() > most) joined.resize(most);
    std::sort(joined.begin(), joined.end(), [](const Weighted& a, const Weighted& b) {
        return std::tie(a.normal.x, a.normal.y, a.normal.z, a.offset) <
               std::tie(b.normal.x, b.normal.y, b.normal.z, b.offset);
    });
    std::vector<ParallelPlanes> result;
    for (const Weighted& plane : joined) {
        if (result.empty() || result.back().first != plane.normal) result.push_back({plane.normal, {}});
        result.back().second.push_back(plane.offset);
    }
    return result;
}

}  // namespace abut
