#pragma once

// Upper bounds of shortest paths over triangles in space: paths along segments between points on the edges. And the
// angles beside a path at a corner, which decide whether it can be shortened there.

#include <abut/math/dvec.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;

/// A graph of points on the edges of triangles, with a segment between any two of one triangle. Its shortest path is no
/// shorter than the geodesic.
class EdgePointGraph {
public:
    /// `between` points are added within each edge. Triangles share points by index.
    EdgePointGraph(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, int between)
        : triangles_(triangles.begin(), triangles.end()), of_triangle_(triangles.size()) {
        for (const Vec3& point : points) nodes_.emplace_back(point);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
                const auto [edge, is_new] =
                    edges.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(nodes_.size()));
                if (is_new)
                    for (int i = 1; i <= between; ++i)
                        nodes_.push_back(nodes_[a] +
                                         (nodes_[b] - nodes_[a]) * (static_cast<double>(i) / (between + 1)));
                of_triangle_[t].push_back(a);
                for (int i = 0; i < between; ++i)
                    of_triangle_[t].push_back(edge->second + static_cast<std::uint32_t>(i));
            }
        at_node_.resize(nodes_.size());
        for (std::uint32_t t = 0; t < of_triangle_.size(); ++t)
            for (const std::uint32_t node : of_triangle_[t]) at_node_[node].push_back(t);
    }

    /// The least cost from a point of a triangle to one of another, by Dijkstra 1959. `costs` holds the cost per length
    /// of each triangle; along an edge it is the lesser of two.
    double min_cost(std::uint32_t from_triangle, const DVec<3>& from, std::uint32_t to_triangle, const DVec<3>& to,
                    std::span<const float> costs = {}) const {
        const auto cost = [&](std::uint32_t triangle) {
            return costs.empty() ? 1.0 : static_cast<double>(costs[triangle]);
        };
        double best = from_triangle == to_triangle ? cost(to_triangle) * length(to - from)
                                                   : std::numeric_limits<double>::infinity();
        std::vector<double> distance(nodes_.size(), std::numeric_limits<double>::infinity());
        std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>,
                            std::greater<>>
            queue;
        for (const std::uint32_t node : of_triangle_[from_triangle]) {
            distance[node] = cost(from_triangle) * length(nodes_[node] - from);
            queue.emplace(distance[node], node);
        }
        while (!queue.empty()) {
            const auto [reached, node] = queue.top();
            queue.pop();
            if (reached > distance[node] || reached >= best) continue;
            for (const std::uint32_t t : at_node_[node]) {
                if (t == to_triangle) best = std::min(best, reached + cost(t) * length(to - nodes_[node]));
                for (const std::uint32_t other : of_triangle_[t]) {
                    const double by = reached + cost(t) * length(nodes_[other] - nodes_[node]);
                    if (by < distance[other]) {
                        distance[other] = by;
                        queue.emplace(by, other);
                    }
                }
            }
        }
        return best;
    }

private:
    std::vector<glm::uvec3> triangles_;
    std::vector<DVec<3>> nodes_;
    std::vector<std::vector<std::uint32_t>> of_triangle_, at_node_;
};

/// The angles of the surface at a corner on the two sides of a path through it; infinite on a side with a border. The
/// directions lead from the corner along the surface. The corner must not be a non-manifold vertex.
inline std::pair<double, double> angles_beside(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                               std::uint32_t corner, const DVec<3>& before, const DVec<3>& after) {
    struct Wedge {
        std::uint32_t next, last;
        double angle;
    };
    std::vector<Wedge> fan;
    const auto angle = [](const DVec<3>& a, const DVec<3>& b) { return std::atan2(length(cross(a, b)), dot(a, b)); };
    for (const glm::uvec3& t : triangles)
        for (int k = 0; k < 3; ++k)
            if (t[k] == corner) {
                const std::uint32_t next = t[(k + 1) % 3], last = t[(k + 2) % 3];
                const DVec<3> at(points[corner]);
                fan.push_back({next, last, angle(DVec<3>(points[next]) - at, DVec<3>(points[last]) - at)});
            }
    const DVec<3> at(points[corner]);
    // The wedge that contains a direction, and the angle from its first side.
    const auto find = [&](const DVec<3>& direction) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity(), from_first = 0;
        for (std::size_t i = 0; i < fan.size(); ++i) {
            const double a = angle(DVec<3>(points[fan[i].next]) - at, direction);
            const double b = angle(direction, DVec<3>(points[fan[i].last]) - at);
            if (a + b - fan[i].angle < least) {
                least = a + b - fan[i].angle;
                best = i;
                from_first = a;
            }
        }
        return std::pair(best, from_first);
    };
    const auto [first, first_angle] = find(before);
    const auto [second, second_angle] = find(after);
    // The angle from one to the other, counter-clockwise.
    const auto sweep = [&](std::size_t from, double from_angle, std::size_t to, double to_angle) {
        if (from == to && to_angle >= from_angle) return to_angle - from_angle;
        double sum = fan[from].angle - from_angle;
        std::size_t now = from;
        for (std::size_t step = 0; step < fan.size(); ++step) {
            std::size_t next = fan.size();
            for (std::size_t i = 0; i < fan.size(); ++i)
                if (fan[i].next == fan[now].last) next = i;
            if (next == fan.size()) return std::numeric_limits<double>::infinity();
            if (next == to) return sum + to_angle;
            sum += fan[next].angle;
            now = next;
        }
        return sum;
    };
    return {sweep(first, first_angle, second, second_angle), sweep(second, second_angle, first, first_angle)};
}

}  // namespace abut::oracle
