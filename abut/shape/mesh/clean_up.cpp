#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/clean_up.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A triangle by its sorted corners, with the parity of the permutation.
struct UnorderedTriangle {
    Corners corners{};
    std::uint32_t triangle = 0;
    bool is_even = true;
};

std::vector<UnorderedTriangle> sorted_by_corners(const std::vector<glm::uvec3>& triangles) {
    std::vector<UnorderedTriangle> result;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3& t = triangles[i];
        Corners corners{t.x, t.y, t.z};
        std::sort(corners.begin(), corners.end());
        const bool is_even = (t.x < t.y) + (t.y < t.z) + (t.z < t.x) == 2;
        result.push_back({corners, i, is_even});
    }
    std::sort(result.begin(), result.end(), [](const UnorderedTriangle& a, const UnorderedTriangle& b) {
        return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
    });
    return result;
}

/// Removes the marked triangles; returns their number.
std::size_t remove_marked(std::vector<glm::uvec3>& triangles, const std::vector<bool>& removed) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (!removed[i]) triangles[count++] = triangles[i];
    const std::size_t removed_count = triangles.size() - count;
    triangles.resize(count);
    return removed_count;
}

/// Marks the walls that only divide a volume which is closed without them. `removed` holds the triangles that are
/// marked already, of which one per wall is not. Connected components of walls are found by union-find.
void remove_partitions(const std::vector<glm::uvec3>& triangles, const std::vector<std::uint32_t>& walls,
                       std::vector<bool>& removed) {
    std::vector<bool> is_wall(triangles.size(), false);
    for (const std::uint32_t wall : walls) is_wall[wall] = true;
    UnionFind components(triangles.size());
    std::vector<std::uint32_t> bounded_by_surface, needed;
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        std::size_t walls_here = 0, others = 0;
        std::uint32_t first = no_index;
        for (const HalfEdge& side : edge) {
            const std::uint32_t triangle = side.side / 3;
            if (removed[triangle]) continue;
            (is_wall[triangle] ? walls_here : others) += 1;
            if (!is_wall[triangle]) continue;
            if (first == no_index)
                first = triangle;
            else
                components.unite(first, triangle);
        }
        if (walls_here == 0) return;
        if (others % 2 != 0 || others + walls_here == 1)
            needed.push_back(first);
        else if (others > 0)
            bounded_by_surface.push_back(first);
    });
    std::vector<bool> partitions(triangles.size(), false);
    for (const std::uint32_t wall : bounded_by_surface) partitions[components.find(wall)] = true;
    for (const std::uint32_t wall : needed) partitions[components.find(wall)] = false;
    for (const std::uint32_t wall : walls)
        if (partitions[components.find(wall)]) removed[wall] = true;
}

/// The longest side, the first of equals; the third corner lies on it.
std::uint32_t longest_side(const Welded& surface, std::uint32_t triangle) {
    std::uint32_t result = 3 * triangle;
    double longest = -1;
    for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        const DVec<3> from(surface.points[start_of(surface.triangles, side)]);
        const double length = length_squared(DVec<3>(surface.points[end_of(surface.triangles, side)]) - from);
        if (length <= longest) continue;
        longest = length;
        result = side;
    }
    return result;
}

class SliverFlipPass {
public:
    SliverFlipPass(Welded& surface, std::vector<std::uint32_t>& source)
        : surface_(surface),
          source_(source),
          sorted_(sorted_half_edges(surface.triangles)),
          twins_(twins(sorted_)),
          changed_(surface.triangles.size(), false) {}

    /// Divides the neighbour across the longest side. Returns false if that isn't possible.
    bool flip(std::uint32_t sliver) {
        const std::uint32_t side = longest_side(surface_, sliver), beyond = twins_[side];
        if (beyond == no_index) return false;
        const std::uint32_t neighbour = beyond / 3;
        if (changed_[sliver] || changed_[neighbour]) return false;
        std::vector<glm::uvec3>& triangles = surface_.triangles;
        const std::uint32_t c = start_of(triangles, side), a = end_of(triangles, side);
        const std::uint32_t b = end_of(triangles, next_side(side)), x = end_of(triangles, next_side(beyond));
        if (b == x || has_edge(sorted_, b, x) || !new_edges_.insert({std::min(b, x), std::max(b, x)}).second)
            return false;
        triangles[sliver] = {a, b, x};
        triangles[neighbour] = {b, c, x};
        source_[sliver] = source_[neighbour];
        changed_[sliver] = changed_[neighbour] = true;
        return true;
    }

private:
    Welded& surface_;
    std::vector<std::uint32_t>& source_;
    std::vector<HalfEdge> sorted_;
    std::vector<std::uint32_t> twins_;
    std::vector<bool> changed_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> new_edges_;
};

std::vector<std::uint32_t> slivers(const Welded& surface) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        const glm::uvec3& t = surface.triangles[i];
        if (has_zero_area(surface.points[t.x], surface.points[t.y], surface.points[t.z])) result.push_back(i);
    }
    return result;
}

}  // namespace

std::size_t remove_duplicate_triangles(Welded& surface) {
    const std::vector<UnorderedTriangle> sorted = sorted_by_corners(surface.triangles);
    std::vector<bool> removed(surface.triangles.size(), false);
    std::vector<std::uint32_t> walls;
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin, even = 0;
        for (; end < sorted.size() && sorted[end].corners == sorted[begin].corners; ++end) even += sorted[end].is_even;
        const std::size_t odd = end - begin - even;
        const bool majority_even = even == odd ? sorted[begin].is_even : even > odd;
        bool found_one = false;
        for (std::size_t i = begin; i < end; ++i) {
            const bool remains = !found_one && sorted[i].is_even == majority_even;
            removed[sorted[i].triangle] = !remains;
            found_one = found_one || remains;
            if (remains && even == odd) walls.push_back(sorted[i].triangle);
        }
        begin = end;
    }
    if (!walls.empty()) remove_partitions(surface.triangles, walls, removed);
    return remove_marked(surface.triangles, removed);
}

SliverFlips flip_slivers(Welded& surface) {
    constexpr int max_passes = 64;
    SliverFlips result;
    result.source.resize(surface.triangles.size());
    std::iota(result.source.begin(), result.source.end(), 0u);
    std::vector<std::uint32_t> left = slivers(surface);
    for (int iteration = 0; iteration < max_passes && !left.empty(); ++iteration) {
        SliverFlipPass pass(surface, result.source);
        std::size_t done = 0;
        for (const std::uint32_t sliver : left) done += pass.flip(sliver);
        result.flipped += done;
        if (done == 0) break;
        left = slivers(surface);
    }
    result.left.assign(surface.triangles.size(), false);
    for (const std::uint32_t sliver : left) result.left[sliver] = true;
    return result;
}

std::size_t remove_slivers(Welded& surface) {
    const SliverFlips done = flip_slivers(surface);
    return done.flipped + remove_marked(surface.triangles, done.left);
}

}  // namespace abut::detail
