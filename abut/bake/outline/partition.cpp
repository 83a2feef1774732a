#include <abut/bake/outline/partition.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>

namespace abut::outline {

using detail::no_index;

Partition::Partition(const Triangulation& triangles, bool conforming)
    : points_(triangles.points),
      origins_(triangles.origins),
      twins_(triangles.twins),
      next_(origins_.size()),
      before_(origins_.size()),
      faces_at_(points_.size(), 0),
      face_count_(origins_.size() / 3),
      conforming_(conforming) {
    for (std::uint32_t i = 0; i < origins_.size(); ++i) {
        next_[i] = i % 3 == 2 ? i - 2 : i + 1;
        before_[i] = i % 3 == 0 ? i + 2 : i - 1;
        ++faces_at_[origins_[i]];
    }
    const auto sides_of_cuts = static_cast<std::int64_t>(origins_.size() - corners());
    pieces_less_holes_ = static_cast<std::int64_t>(face_count_) - sides_of_cuts / 2;
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
    for (const std::uint32_t edge : {half_edge, twins_[half_edge]}) next_[edge] = no_index;
    --face_count_;
}

/// The last half-edge around the interior from the origin of a boundary half-edge.
std::uint32_t Partition::last_around(std::uint32_t first) const {
    std::uint32_t last = first;
    while (twins_[before_[last]] != no_index) last = twins_[before_[last]];
    return last;
}

std::vector<std::uint8_t> Partition::split_counts() const {
    std::vector<std::uint8_t> result(origins_.size(), 0);
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (twins_[first] != no_index) continue;
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

void Partition::merge_all() {
    const std::vector<std::uint8_t> split_count = split_counts();
    for (int round = 0; round <= 2; ++round)
        for (std::uint32_t edge = 0; edge < origins_.size(); ++edge)
            if (split_count[edge] == round && twins_[edge] != no_index && edge < twins_[edge] &&
                next_[edge] != no_index && convex_without(edge))
                remove(edge);
}

std::size_t Partition::corners() const {
    return static_cast<std::size_t>(std::ranges::count(twins_, no_index));
}

std::size_t Partition::reflex_corners() const {
    std::size_t result = 0;
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (twins_[first] != no_index) continue;
        const std::uint32_t last = last_around(first);
        if (last != first && orientation(at(before_[last]), at(first), at(next_[first])) < 0) ++result;
    }
    return result;
}

std::vector<std::uint32_t> Partition::faces() const {
    std::vector<std::uint32_t> result;
    std::vector<bool> seen(origins_.size(), false);
    for (std::uint32_t first = 0; first < origins_.size(); ++first) {
        if (next_[first] == no_index || seen[first]) continue;
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
