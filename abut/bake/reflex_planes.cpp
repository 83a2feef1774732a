#include <abut/bake/reflex_planes.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace abut {
namespace {

struct HalfEdge {
    std::uint32_t low, high;
    std::uint32_t triangle;
    bool up;  // runs from low to high
};

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

std::vector<HalfEdge> half_edges(const Piece& piece) {
    std::vector<HalfEdge> result;
    for (std::uint32_t t = 0; t < piece.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t from = piece.triangles[t][i], to = piece.triangles[t][(i + 1) % 3];
            result.push_back({std::min(from, to), std::max(from, to), t, from < to});
        }
    std::sort(result.begin(), result.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.up, a.triangle) < std::tie(b.low, b.high, b.up, b.triangle);
    });
    return result;
}

}  // namespace

std::vector<ParallelPlanes> reflex_planes(const Piece& piece) {
    constexpr std::size_t most = 16;
    constexpr double sharp = 0.25;  // the sine of the bend
    const std::vector<HalfEdge> edges = half_edges(piece);
    const auto area = [&](std::uint32_t t) {
        const glm::uvec3& corners = piece.triangles[t];
        const DVec<3>& a = piece.points[corners.x];
        return cross(piece.points[corners.y] - a, piece.points[corners.z] - a);
    };
    std::vector<Weighted> planes;
    double extent = 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const HalfEdge &a = edges[i], &b = edges[i + 1];
        if (a.low != b.low || a.high != b.high || a.up == b.up) continue;
        const DVec<3> along = piece.points[a.high] - piece.points[a.low];
        extent = std::max(extent, largest(along));
        const DVec<3> down = normalized(area(a.triangle), DVec<3>(0.0)),
                      up = normalized(area(b.triangle), DVec<3>(0.0));
        const double bend = dot(cross(up, down), normalized(along));
        const bool fold = dot(up, down) < -0.9;
        if (bend > -sharp && !(fold && bend <= 0)) continue;
        const double weight = length(along) * (1 - dot(up, down));
        for (const DVec<3>& normal : {down, up}) {
            const bool turn = std::tuple(normal.x, normal.y, normal.z) < std::tuple(0.0, 0.0, 0.0);
            const DVec<3> facing = (turn ? -normal : normal) + DVec<3>(0.0);
            planes.push_back({facing, dot(facing, piece.points[a.low]), weight});
        }
    }
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
