#include <abut/bake/solid.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
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
    const DVec<3>& normal() const { return normal_; }

private:
    DVec<3> point_;
    DVec<3> normal_;
};

/// The support function of a hull by hill climbing from vertex to vertex; a convex body has no other local maximum.
/// Each search starts at the previous result (a warm start): consecutive triangles are neighbours.
class HillClimb {
public:
    explicit HillClimb(const Hull3& hull) : hull_(hull), first_(hull.points.size() + 1, 0) {
        for (const std::uint32_t corner : hull.loops) ++first_[corner + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        next_.resize(hull.loops.size());
        std::vector<std::uint32_t> filled(first_.begin(), first_.end() - 1);
        std::uint32_t begin = 0;
        for (const std::uint32_t end : hull.loop_ends) {
            for (std::uint32_t i = begin; i < end; ++i)
                next_[filled[hull.loops[i]]++] = hull.loops[i + 1 == end ? begin : i + 1];
            begin = end;
        }
    }

    const Vec3& farthest(const DVec<3>& direction) {
        const auto reach = [&](std::uint32_t corner) { return dot(direction, DVec<3>(hull_.points[corner])); };
        double best = reach(at_);
        for (bool is_improving = true; is_improving;) {
            is_improving = false;
            for (std::uint32_t i = first_[at_]; i < first_[at_ + 1]; ++i) {
                const double next_reach = reach(next_[i]);
                if (next_reach <= best) continue;
                best = next_reach;
                at_ = next_[i];
                is_improving = true;
                break;
            }
        }
        return hull_.points[at_];
    }

private:
    const Hull3& hull_;
    std::vector<std::uint32_t> first_;  // one per vertex: where its neighbours begin in next_
    std::vector<std::uint32_t> next_;   // each edge occurs for both its ends, once in each loop
    std::uint32_t at_ = 0;
};

double bounding_radius(std::span<const Vec3> points) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& p : points) box = merged(box, Aabb3{p, p});
    const DVec<3> middle(center(box));
    double radius = 0;
    for (const Vec3& p : points) radius = std::max(radius, length(DVec<3>(p) - middle));
    return radius;
}

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
    const double tolerance = 1e-5 * bounding_radius(points);

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
    HillClimb hill_climb(*corners);
    return std::all_of(triangles.begin(), triangles.end(), [&](const glm::uvec3& t) {
        const Plane plane(points[t.x], points[t.y], points[t.z]);
        return plane.height(hill_climb.farthest(plane.normal())) <= tolerance;
    });
}

}  // namespace abut
