#include <abut/bake/solid.hpp>
#include <abut/convex/hull.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace abut {
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

/// The same edge seen from the other side; nothing where there is none, or where there are several.
const Edge* twin(std::span<const Edge> edges, const Edge& edge) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), Edge{edge.to, edge.from, 0}, before);
    return last - first == 1 ? &*first : nullptr;
}

/// How far a point is in front of the plane through three others, counter-clockwise seen from the front. Zero where
/// these lie on a line.
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

/// The farthest corner of a hull in a direction, by going from corner to corner as long as that leads on: on a convex
/// body there is no other summit. Begins where the last one was found, which for triangles in order is next door.
class Climber {
public:
    explicit Climber(const Hull3& hull) : hull_(hull), first_(hull.points.size() + 1, 0) {
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
        for (bool climbs = true; climbs;) {
            climbs = false;
            for (std::uint32_t i = first_[at_]; i < first_[at_ + 1]; ++i) {
                const double further = reach(next_[i]);
                if (further <= best) continue;
                best = further;
                at_ = next_[i];
                climbs = true;
                break;
            }
        }
        return hull_.points[at_];
    }

private:
    const Hull3& hull_;
    std::vector<std::uint32_t> first_;  // where a corner's neighbours begin in next_
    std::vector<std::uint32_t> next_;   // each edge is there from both its ends: one in each loop it is part of
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
    const double margin = 1e-5 * bounding_radius(points);

    // 1. Closed; and across each edge the neighbour bends back. This is where nearly everything concave is found out.
    const std::vector<Edge> edges = sorted_edges(triangles);
    for (const Edge& edge : edges) {
        const Edge* other = twin(edges, edge);
        if (other == nullptr) return false;
        const Plane plane(points[edge.from], points[edge.to], points[edge.opposite]);
        if (plane.height(points[other->opposite]) > margin) return false;
    }
    if (!(signed_volume(points, triangles) > 0)) return false;

    // 2. Many small bends the wrong way, each within the margin, can add up, and so can separate bodies.
    const Result<Hull3> corners = hull(points);
    if (!corners || corners->rank < 3) return false;
    Climber climber(*corners);
    return std::all_of(triangles.begin(), triangles.end(), [&](const glm::uvec3& t) {
        const Plane plane(points[t.x], points[t.y], points[t.z]);
        return plane.height(climber.farthest(plane.normal())) <= margin;
    });
}

}  // namespace abut
