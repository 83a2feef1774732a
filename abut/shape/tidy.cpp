#include <abut/math/dvec.hpp>
#include <abut/math/groups.hpp>
#include <abut/shape/half_edges.hpp>
#include <abut/shape/tidy.hpp>
#include <abut/shape/zero_area.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A triangle by its corners alone, and which way round it has them.
struct Unwound {
    Corners corners{};
    std::uint32_t triangle = 0;
    bool is_even = true;
};

std::vector<Unwound> sorted_by_corners(const std::vector<glm::uvec3>& triangles) {
    std::vector<Unwound> result;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3& t = triangles[i];
        Corners corners{t.x, t.y, t.z};
        std::sort(corners.begin(), corners.end());
        const bool is_even = (t.x < t.y) + (t.y < t.z) + (t.z < t.x) == 2;
        result.push_back({corners, i, is_even});
    }
    std::sort(result.begin(), result.end(), [](const Unwound& a, const Unwound& b) {
        return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
    });
    return result;
}

/// Removes the triangles that are marked.
std::size_t drop(std::vector<glm::uvec3>& triangles, const std::vector<bool>& goes) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (!goes[i]) triangles[kept++] = triangles[i];
    const std::size_t dropped = triangles.size() - kept;
    triangles.resize(kept);
    return dropped;
}

/// Marks walls that only part what is closed without them as such that go, too. `goes` tells the triangles that go
/// already, and leaves one of each wall.
void drop_partitions(const std::vector<glm::uvec3>& triangles, const std::vector<std::uint32_t>& walls,
                     std::vector<bool>& goes) {
    std::vector<bool> is_wall(triangles.size(), false);
    for (const std::uint32_t wall : walls) is_wall[wall] = true;
    Groups pieces(triangles.size());
    std::vector<std::uint32_t> at_sides, needed;
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        std::size_t walls_here = 0, others = 0;
        std::uint32_t first = no_side;
        for (const HalfEdge& side : edge) {
            const std::uint32_t triangle = side.side / 3;
            if (goes[triangle]) continue;
            (is_wall[triangle] ? walls_here : others) += 1;
            if (!is_wall[triangle]) continue;
            if (first == no_side)
                first = triangle;
            else
                pieces.join(first, triangle);
        }
        if (walls_here == 0) return;
        if (others % 2 != 0 || others + walls_here == 1)
            needed.push_back(first);
        else if (others > 0)
            at_sides.push_back(first);
    });
    std::vector<bool> parts(triangles.size(), false);
    for (const std::uint32_t wall : at_sides) parts[pieces.lowest(wall)] = true;
    for (const std::uint32_t wall : needed) parts[pieces.lowest(wall)] = false;
    for (const std::uint32_t wall : walls)
        if (parts[pieces.lowest(wall)]) goes[wall] = true;
}

/// The side opposite of which the third corner lies: the longest, of several the first.
std::uint32_t longest_side(const Welded& surface, std::uint32_t triangle) {
    std::uint32_t result = 3 * triangle;
    double most = -1;
    for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        const DVec<3> from(surface.points[start_of(surface.triangles, side)]);
        const double length = length_squared(DVec<3>(surface.points[end_of(surface.triangles, side)]) - from);
        if (length <= most) continue;
        most = length;
        result = side;
    }
    return result;
}

class SliverRound {
public:
    SliverRound(Welded& surface, std::vector<std::uint32_t>& part_of)
        : surface_(surface),
          part_of_(part_of),
          sorted_(sorted_half_edges(surface.triangles)),
          twins_(twins(sorted_)),
          touched_(surface.triangles.size(), false) {}

    /// Whether a neighbour was cut.
    bool cut(std::uint32_t sliver) {
        const std::uint32_t side = longest_side(surface_, sliver), beyond = twins_[side];
        if (beyond == no_side) return false;
        const std::uint32_t neighbour = beyond / 3;
        if (touched_[sliver] || touched_[neighbour]) return false;
        std::vector<glm::uvec3>& triangles = surface_.triangles;
        const std::uint32_t c = start_of(triangles, side), a = end_of(triangles, side);
        const std::uint32_t b = end_of(triangles, next_side(side)), x = end_of(triangles, next_side(beyond));
        if (b == x || has_edge(sorted_, b, x) || !new_edges_.insert({std::min(b, x), std::max(b, x)}).second)
            return false;
        triangles[sliver] = {a, b, x};
        triangles[neighbour] = {b, c, x};
        part_of_[sliver] = part_of_[neighbour];
        touched_[sliver] = touched_[neighbour] = true;
        return true;
    }

private:
    Welded& surface_;
    std::vector<std::uint32_t>& part_of_;
    std::vector<HalfEdge> sorted_;
    std::vector<std::uint32_t> twins_;
    std::vector<bool> touched_;
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

std::size_t drop_doubles(Welded& surface) {
    const std::vector<Unwound> sorted = sorted_by_corners(surface.triangles);
    std::vector<bool> goes(surface.triangles.size(), false);
    std::vector<std::uint32_t> walls;
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin, even = 0;
        for (; end < sorted.size() && sorted[end].corners == sorted[begin].corners; ++end) even += sorted[end].is_even;
        const std::size_t odd = end - begin - even;
        const bool stays_even = even == odd ? sorted[begin].is_even : even > odd;
        bool has_one = false;
        for (std::size_t i = begin; i < end; ++i) {
            const bool stays = !has_one && sorted[i].is_even == stays_even;
            goes[sorted[i].triangle] = !stays;
            has_one = has_one || stays;
            if (stays && even == odd) walls.push_back(sorted[i].triangle);
        }
        begin = end;
    }
    if (!walls.empty()) drop_partitions(surface.triangles, walls, goes);
    return drop(surface.triangles, goes);
}

CutSlivers cut_slivers(Welded& surface) {
    constexpr int most_rounds = 64;
    CutSlivers result;
    result.part_of.resize(surface.triangles.size());
    std::iota(result.part_of.begin(), result.part_of.end(), 0u);
    std::vector<std::uint32_t> left = slivers(surface);
    for (int round = 0; round < most_rounds && !left.empty(); ++round) {
        SliverRound cuts(surface, result.part_of);
        std::size_t done = 0;
        for (const std::uint32_t sliver : left) done += cuts.cut(sliver);
        result.cut += done;
        if (done == 0) break;
        left = slivers(surface);
    }
    result.left.assign(surface.triangles.size(), false);
    for (const std::uint32_t sliver : left) result.left[sliver] = true;
    return result;
}

std::size_t drop_slivers(Welded& surface) {
    const CutSlivers done = cut_slivers(surface);
    return done.cut + drop(surface.triangles, done.left);
}

}  // namespace abut
