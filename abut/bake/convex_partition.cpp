#include <abut/bake/convex_partition.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>

namespace abut::outline {

Partition::Partition(const Triangulation& triangles, bool conforming)
    : points_(triangles.points),
      origins_(triangles.origins),
      twins_(triangles.twins),
      next_(origins_.size()),
      before_(origins_.size()),
      faces_at_(points_.size(), 0),
      conforming_(conforming) {
    for (std::uint32_t i = 0; i < origins_.size(); ++i) {
        next_[i] = i % 3 == 2 ? i - 2 : i + 1;
        before_[i] = i % 3 == 0 ? i + 2 : i - 1;
        ++faces_at_[origins_[i]];
    }
}

bool Partition::convex_without(std::uint32_t half_edge) const {
    for (const std::uint32_t edge : {half_edge, twins_[half_edge]}) {
        const int turn = orientation(at(before_[edge]), at(edge), at(next_[next_[twins_[edge]]]));
        if (turn < 0 || (turn == 0 && conforming_ && faces_at_[origins_[edge]] > 2)) return false;
    }
    return true;
}

void Partition::remove(std::uint32_t half_edge) {
    for (const std::uint32_t edge : {half_edge, twins_[half_edge]}) {
        const std::uint32_t before = before_[edge], after = next_[twins_[edge]];
        next_[before] = after;
        before_[after] = before;
        --faces_at_[origins_[edge]];
    }
    for (const std::uint32_t edge : {half_edge, twins_[half_edge]}) next_[edge] = none;
}

/// Of a half-edge of the boundary: the last one from the same corner around the inside.
std::uint32_t Partition::last_around(std::uint32_t first) const {
    std::uint32_t last = first;
    while (twins_[before_[last]] != none) last = twins_[before_[last]];
    return last;
}

std::vector<std::uint8_t> Partition::uses() const {
    std::vector<std::uint8_t> result(origins_.size(), 0);
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (twins_[first] != none) continue;
        const Vec2 &corner = at(first), &after = at(next_[first]);
        const std::uint32_t last = last_around(first);
        const Vec2& before = at(before_[last]);
        if (last == first || orientation(before, corner, after) >= 0) continue;
        for (std::uint32_t edge = first; edge != last;) {
            edge = twins_[before_[edge]];
            const Vec2& end = at(next_[edge]);
            if (orientation(before, corner, end) < 0 || orientation(end, corner, after) < 0) continue;
            ++result[edge];
            ++result[twins_[edge]];
        }
    }
    return result;
}

/// Edges that split two corners each, no corner twice: such edges spare one. Corners with one edge to choose from come
/// first (Karp and Sipser 1981).
std::vector<bool> Partition::pairs(const std::vector<std::uint8_t>& use, std::vector<bool>& paired) const {
    std::vector<std::uint32_t> choices(points_.size(), 0), first(points_.size() + 1, 0), edges;
    const auto is_choice = [&](std::uint32_t edge) { return twins_[edge] != none && use[edge] == 2; };
    for (std::uint32_t edge = 0; edge < origins_.size(); ++edge)
        if (is_choice(edge)) ++first[origins_[edge] + 1];
    for (std::size_t i = 0; i < points_.size(); ++i) {
        choices[i] = first[i + 1];
        first[i + 1] += first[i];
    }
    edges.resize(first.back());
    std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
    for (std::uint32_t edge = 0; edge < origins_.size(); ++edge)
        if (is_choice(edge)) edges[filled[origins_[edge]]++] = edge;

    std::vector<bool> result(origins_.size(), false);
    paired.assign(points_.size(), false);
    std::vector<std::uint32_t> single;
    const auto pair_at = [&](std::uint32_t point) {
        if (paired[point]) return;
        std::uint32_t best = none, fewest = none;
        for (std::uint32_t i = first[point]; i < first[point + 1]; ++i) {
            const std::uint32_t other = origins_[twins_[edges[i]]];
            if (!paired[other] && choices[other] < fewest) {
                fewest = choices[other];
                best = edges[i];
            }
        }
        if (best == none) return;
        result[best] = result[twins_[best]] = true;
        for (const std::uint32_t end : {point, origins_[twins_[best]]}) {
            paired[end] = true;
            for (std::uint32_t i = first[end]; i < first[end + 1]; ++i)
                if (--choices[origins_[twins_[edges[i]]]] == 1) single.push_back(origins_[twins_[edges[i]]]);
        }
    };
    const auto pair_singles = [&] {
        while (!single.empty()) {
            const std::uint32_t point = single.back();
            single.pop_back();
            pair_at(point);
        }
    };
    for (std::uint32_t point = 0; point < points_.size(); ++point)
        if (choices[point] == 1) single.push_back(point);
    pair_singles();
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
        pair_at(point);
        pair_singles();
    }
    return result;
}

void Partition::merge_all() {
    const std::vector<std::uint8_t> use = uses();
    std::vector<bool> paired;
    const std::vector<bool> chosen = pairs(use, paired);
    for (int round = 0; round < 4; ++round)
        for (std::uint32_t edge = 0; edge < origins_.size(); ++edge) {
            if (twins_[edge] == none || twins_[edge] < edge || next_[edge] == none) continue;
            const int needed =
                chosen[edge] ? 3 : std::max(0, use[edge] - paired[origins_[edge]] - paired[origins_[twins_[edge]]]);
            if (needed == round && convex_without(edge)) remove(edge);
        }
}

std::size_t Partition::corners() const {
    return static_cast<std::size_t>(std::ranges::count(twins_, none));
}

std::size_t Partition::reflex_corners() const {
    std::size_t result = 0;
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (twins_[first] != none) continue;
        const std::uint32_t last = last_around(first);
        if (last != first && orientation(at(before_[last]), at(first), at(next_[first])) < 0) ++result;
    }
    return result;
}

std::int64_t Partition::pieces_less_holes() const {
    std::int64_t faces_less_cuts = 0;
    for (std::uint32_t i = 0; i < origins_.size(); ++i)
        if (twins_[i] != none && next_[i] != none) --faces_less_cuts;
    return faces_less_cuts / 2 + static_cast<std::int64_t>(faces().size());
}

std::vector<std::uint32_t> Partition::faces() const {
    std::vector<std::uint32_t> result;
    std::vector<bool> seen(origins_.size(), false);
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (next_[first] == none || seen[first]) continue;
        result.push_back(first);
        std::uint32_t edge = first;
        do {
            seen[edge] = true;
            edge = next_[edge];
        } while (edge != first);
    }
    return result;
}

}  // namespace abut::outline
