#include <abut/bake/bodies.hpp>
#include <abut/bake/solid.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace abut {
namespace {

/// As many triangles run along each edge one way as the other.
bool is_closed(const Piece& piece) {
    struct Edge {
        std::uint32_t low, high;
        int way;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * piece.triangles.size());
    for (const glm::uvec3& t : piece.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t from = t[i], to = t[(i + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.way) < std::tie(b.low, b.high, b.way);
    });
    for (std::size_t i = 0; i < edges.size();) {
        const Edge& first = edges[i];
        int sum = 0;
        for (; i < edges.size() && edges[i].low == first.low && edges[i].high == first.high; ++i) sum += edges[i].way;
        if (sum != 0) return false;
    }
    return true;
}

}  // namespace

std::vector<Piece> bodies_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, double thickness) {
    Piece whole;
    whole.points.assign(points.begin(), points.end());
    whole.triangles.assign(triangles.begin(), triangles.end());
    whole.closed = false;
    std::vector<Piece> bodies = connected(whole);
    for (Piece& body : bodies) {
        body.closed = is_closed(body);
        body.volume = measured_volume(body);
    }
    give_hollows(bodies);
    for (Piece& body : bodies) {
        if (body.closed && body.volume > 0) continue;
        body.closed = false;
        body.thickness = thickness;
        body.volume = measured_volume(body);
    }
    return bodies;
}

bool is_convex(const Piece& body) {
    if (!body.closed || !body.cap_edges.empty()) return false;
    std::vector<Vec3> points;
    points.reserve(body.points.size());
    for (const DVec<3>& p : body.points) points.push_back(to_float(p));
    return is_convex_solid(points, body.triangles);
}

}  // namespace abut
