#include <abut/bake/solid.hpp>
#include <abut/convex/bounding_ball.hpp>
#include <abut/convex/hull/hill_climb.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace abut {

using namespace detail;

namespace {

struct Edge {
    std::uint32_t from, to;
    std::uint32_t opposite;  // the third corner of its triangle
};

bool before(const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
}

std::vector<Edge> sorted_edges(std::span<const glm::uvec3> triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const glm::uvec3& t : triangles) {
        edges.push_back({t.x, t.y, t.z});
        edges.push_back({t.y, t.z, t.x});
        edges.push_back({t.z, t.x, t.y});
    }
    std::sort(edges.begin(), edges.end(), before);
    return edges;
}

/// The opposite half-edge. Null if there is none, or if there are several.
const Edge* twin(std::span<const Edge> edges, const Edge& edge) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), Edge{edge.to, edge.from, 0}, before);
    return last - first == 1 ? &*first : nullptr;
}

/// The signed distance from the plane through three points, counter-clockwise seen from the front. Zero if these are
/// collinear.
class Plane {
public:
    Plane(const Vec3& a, const Vec3& b, const Vec3& c)
        : point_(a), normal_(normalized(cross(DVec<3>(b) - point_, DVec<3>(c) - point_), DVec<3>(0.0))) {}

    double height(const Vec3& p) const { return dot(normal_, DVec<3>(p) - point_); }

private:
    DVec<3> point_;
    DVec<3> normal_;
};

}  // namespace

double signed_volume(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    if (points.empty()) return 0;
    const DVec<3> origin(points.front());
    double six_volumes = 0;
    for (const glm::uvec3& t : triangles)
        six_volumes +=
            dot(DVec<3>(points[t.x]) - origin, cross(DVec<3>(points[t.y]) - origin, DVec<3>(points[t.z]) - origin));
    return six_volumes / 6;
}

bool is_convex_solid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    constexpr std::size_t tetrahedron = 4;
    if (triangles.size() < tetrahedron) return false;
    const double tolerance = 1e-5 * ball_around<3>(points).radius;

    // 1. The surface is closed, and no edge is reflex. This test rejects nearly every concave surface.
    const std::vector<Edge> edges = sorted_edges(triangles);
    for (const Edge& edge : edges) {
        const Edge* other = twin(edges, edge);
        if (other == nullptr) return false;
        const Plane plane(points[edge.from], points[edge.to], points[edge.opposite]);
        if (plane.height(points[other->opposite]) > tolerance) return false;
    }
    if (!(signed_volume(points, triangles) > 0)) return false;

    // 2. Many reflex edges within the tolerance can add up, and disconnected bodies pass the first test.
    const Result<Hull3> corners = hull(points);
    if (!corners || corners->rank < 3) return false;
    const HillClimb hill_climb(corners->points.size(), corners->loops, corners->loop_ends);
    std::uint32_t highest = 0;  // neighbouring triangles have neighbouring support points
    return std::all_of(triangles.begin(), triangles.end(), [&](const glm::uvec3& t) {
        const Plane plane(points[t.x], points[t.y], points[t.z]);
        double max_height = -std::numeric_limits<double>::infinity();
        highest = hill_climb.best(highest, [&](std::uint32_t i) {
            const double height = plane.height(corners->points[i]);
            if (!(height > max_height)) return false;
            max_height = height;
            return true;
        });
        return max_height <= tolerance;
    });
}

}  // namespace abut
