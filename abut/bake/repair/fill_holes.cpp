#include <abut/bake/repair/fill_holes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A closed loop of vertices.
struct Loop {
    std::vector<std::uint32_t> corners;
    std::uint32_t patch = 0;
};

/// All triangulations of a flat hole have the same area. A small weight of their longest edges prefers compact
/// triangles.
constexpr double length_weight = 1e-4;

/// The edges of the surface, including those of new triangles.
class Edges {
public:
    explicit Edges(std::span<const glm::uvec3> triangles) : sorted_(sorted_half_edges(triangles)) {}

    std::span<const HalfEdge> sorted() const { return sorted_; }
    bool has(std::uint32_t a, std::uint32_t b) const {
        return has_edge(sorted_, a, b) || new_.contains({std::min(a, b), std::max(a, b)});
    }
    void add(const glm::uvec3& t) {
        for (const auto& [a, b] : {std::pair(t.x, t.y), std::pair(t.y, t.z), std::pair(t.z, t.x)})
            new_.emplace(std::min(a, b), std::max(a, b));
    }

private:
    std::vector<HalfEdge> sorted_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> new_;
};

class Triangulation {
public:
    Triangulation(const Welded& surface, const Edges& edges, const std::vector<std::uint32_t>& loop)
        : surface_(surface), loop_(loop), size_(loop.size()), cost_(size_ * size_, 0), middle_(size_ * size_, 0) {
        for (std::size_t width = 2; width < size_; ++width)
            for (std::size_t i = 0; i + width < size_; ++i) {
                const std::size_t k = i + width;
                const bool is_border = width + 1 == size_;
                if (!is_border && edges.has(loop[i], loop[k])) {
                    at(cost_, i, k) = infinity;
                    continue;
                }
                double min_cost = infinity;
                for (std::size_t j = i + 1; j < k; ++j) {
                    const double cost = at(cost_, i, j) + at(cost_, j, k) + cost_of(i, j, k);
                    if (cost >= min_cost) continue;
                    min_cost = cost;
                    at(middle_, i, k) = j;
                }
                at(cost_, i, k) = min_cost;
            }
    }

    bool exists() const { return cost_[size_ - 1] < infinity; }

    std::vector<glm::uvec3> triangles() const {
        std::vector<glm::uvec3> result;
        std::vector<std::pair<std::size_t, std::size_t>> stack{{0, size_ - 1}};
        while (!stack.empty()) {
            const auto [i, k] = stack.back();
            stack.pop_back();
            if (k - i < 2) continue;
            const std::size_t j = middle_[i * size_ + k];
            result.emplace_back(loop_[i], loop_[j], loop_[k]);
            stack.emplace_back(j, k);
            stack.emplace_back(i, j);
        }
        return result;
    }

private:
    template <class T>
    T& at(std::vector<T>& table, std::size_t i, std::size_t k) {
        return table[i * size_ + k];
    }

    double cost_of(std::size_t i, std::size_t j, std::size_t k) const {
        const DVec<3> a(surface_.points[loop_[i]]), b(surface_.points[loop_[j]]), c(surface_.points[loop_[k]]);
        const double longest = std::max({length_squared(b - a), length_squared(c - b), length_squared(a - c)});
        return length(cross(b - a, c - a)) + length_weight * longest;
    }

    const Welded& surface_;
    const std::vector<std::uint32_t>& loop_;
    std::size_t size_;
    std::vector<double> cost_;
    std::vector<std::size_t> middle_;
};

double area_of(const Welded& surface, std::span<const glm::uvec3> triangles) {
    double area = 0;
    for (const glm::uvec3& t : triangles) {
        const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
        area += length(cross(b - a, c - a));
    }
    return area;
}

/// The next open side around the hole, found by walking through the triangles at the common corner. `no_index` if a
/// non-manifold or inconsistently oriented edge is in between.
std::uint32_t next_open(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> twin,
                        const std::vector<bool>& is_open, std::uint32_t side) {
    for (std::size_t steps = 0; steps < triangles.size(); ++steps) {
        side = next_side(next_side(side));
        if (is_open[side]) return side;
        if (twin[side] == no_index) return no_index;
        side = twin[side];
    }
    return no_index;
}

std::vector<Loop> loops_of(const Welded& surface, const Patches& patches, std::span<const HalfEdge> sorted) {
    const std::vector<std::uint32_t> twin = twins(sorted);
    std::vector<bool> is_open(twin.size(), false), is_used(twin.size(), false);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() == 1) is_open[edge[0].side] = true;
    });
    std::vector<Loop> result;
    for (std::uint32_t first = 0; first < twin.size(); ++first) {
        if (!is_open[first] || is_used[first]) continue;
        Loop loop{{}, patches.of[first / 3]};
        std::uint32_t side = first;
        do {
            is_used[side] = true;
            loop.corners.push_back(end_of(surface.triangles, side));
            side = next_open(surface.triangles, twin, is_open, side);
        } while (side != no_index && !is_used[side]);
        if (side == first) result.push_back(std::move(loop));
    }
    return result;
}

/// Splits a loop wherever it visits a corner again.
std::vector<Loop> split_at_repeated_corners(const Loop& loop) {
    std::vector<Loop> result;
    Loop rest{{}, loop.patch};
    for (const std::uint32_t corner : loop.corners) {
        const auto before = std::find(rest.corners.begin(), rest.corners.end(), corner);
        if (before != rest.corners.end()) {
            result.push_back({{before, rest.corners.end()}, loop.patch});
            rest.corners.erase(before, rest.corners.end());
        }
        rest.corners.push_back(corner);
    }
    result.push_back(std::move(rest));
    return result;
}

}  // namespace

FilledHoles fill_holes(Welded& surface, Patches& patches, std::uint32_t max_edges, double max_area) {
    std::vector<double> areas(patches.count(), 0.0);
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        areas[patches.of[i]] += area_of(surface, {&surface.triangles[i], 1});

    FilledHoles result;
    Edges edges(surface.triangles);
    for (const Loop& loop_with_touches : loops_of(surface, patches, edges.sorted())) {
        if (loop_with_touches.corners.size() > max_edges) continue;
        for (const Loop& loop : split_at_repeated_corners(loop_with_touches)) {
            if (loop.corners.size() < 3) continue;
            const Triangulation triangulation(surface, edges, loop.corners);
            if (!triangulation.exists()) continue;
            const std::vector<glm::uvec3> triangles = triangulation.triangles();
            if (area_of(surface, triangles) > max_area * areas[loop.patch]) continue;
            for (const glm::uvec3& t : triangles) edges.add(t);
            surface.triangles.insert(surface.triangles.end(), triangles.begin(), triangles.end());
            patches.of.insert(patches.of.end(), triangles.size(), loop.patch);
            ++result.holes;
            result.triangles += triangles.size();
        }
    }
    return result;
}

}  // namespace abut::detail
