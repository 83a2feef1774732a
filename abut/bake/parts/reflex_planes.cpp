#include <abut/bake/parts/reflex_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace abut::detail {
namespace {

struct Weighted {
    DVec<3> normal;
    double offset;
    double weight;
};

/// Planes with equal keys are merged.
std::tuple<double, double, double, double> quantised(const Weighted& plane, double step) {
    constexpr double fine = 1e4;
    return {std::floor(plane.normal.x * fine + 0.5), std::floor(plane.normal.y * fine + 0.5),
            std::floor(plane.normal.z * fine + 0.5), std::floor(plane.offset / step + 0.5)};
}

}  // namespace

std::vector<ParallelPlanes> reflex_planes(const Piece& piece) {
    constexpr std::size_t max_planes = 16;
    constexpr double sharp = 0.25;  // sine of the dihedral angle
    const auto area = [&](std::uint32_t t) {
        const glm::uvec3& corners = piece.triangles[t];
        const DVec<3>& a = piece.points[corners.x];
        return cross(piece.points[corners.y] - a, piece.points[corners.z] - a);
    };
    std::vector<Weighted> planes;
    double extent = 0;
    const std::vector<HalfEdge> half_edges = sorted_half_edges(piece.triangles);
    each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
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
        const bool is_fold = dot(up, down) < -0.9;
        if (bend > -sharp && !(is_fold && bend <= 0)) return;
        const double weight = length(along) * (1 - dot(up, down));
        for (const DVec<3>& normal : {down, up}) {
            const bool flip = std::tuple(normal.x, normal.y, normal.z) < std::tuple(0.0, 0.0, 0.0);
            const DVec<3> facing = (flip ? -normal : normal) + DVec<3>(0.0);
            planes.push_back({facing, dot(facing, from), weight});
        }
    });
    const double step = 1e-5 * extent;
    std::sort(planes.begin(), planes.end(), [&](const Weighted& a, const Weighted& b) {
        const auto key = [&](const Weighted& p) {
            return std::tuple(quantised(p, step), p.normal.x, p.normal.y, p.normal.z, p.offset, p.weight);
        };
        return key(a) < key(b);
    });
    std::vector<Weighted> merged;
    for (const Weighted& plane : planes) {
        if (!merged.empty() && quantised(merged.back(), step) == quantised(plane, step))
            merged.back().weight += plane.weight;
        else
            merged.push_back(plane);
    }
    std::stable_sort(merged.begin(), merged.end(),
                     [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; });
    if (merged.size() > max_planes) merged.resize(max_planes);
    std::sort(merged.begin(), merged.end(), [](const Weighted& a, const Weighted& b) {
        return std::tie(a.normal.x, a.normal.y, a.normal.z, a.offset) <
               std::tie(b.normal.x, b.normal.y, b.normal.z, b.offset);
    });
    std::vector<ParallelPlanes> result;
    for (const Weighted& plane : merged) {
        if (result.empty() || result.back().first != plane.normal) result.push_back({plane.normal, {}});
        result.back().second.push_back(plane.offset);
    }
    return result;
}

}  // namespace abut::detail
