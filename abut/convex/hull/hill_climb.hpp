#pragma once

// Support points of a convex surface by hill climbing: a local maximum is the maximum.

#include <abut/convex/hull/quickhull.hpp>

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace abut::detail {

/// The neighbours of the points of a surface.
class HillClimb {
public:
    HillClimb(std::size_t point_count, const TriangleSurface& surface) {
        set_neighbours(point_count, [&](auto visit) {
            for (std::uint32_t h = 0; h < surface.origin.size(); ++h)
                visit(surface.origin[h], surface.origin[following(h)]);
        });
    }
    /// The faces are loops like those of `Facets`.
    HillClimb(std::size_t point_count, std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends) {
        set_neighbours(point_count, [&](auto visit) {
            std::uint32_t begin = 0;
            for (const std::uint32_t end : loop_ends) {
                for (std::uint32_t i = begin; i < end; ++i) visit(loops[i], loops[i + 1 == end ? begin : i + 1]);
                begin = end;
            }
        });
    }

    /// better(i) returns whether point i is better than the best before, and makes it the best. Returns the best that
    /// is reached from `start`. No point is left twice.
    template <class Better>
    std::uint32_t best(std::uint32_t start, Better better) const {
        better(start);
        for (std::uint32_t at = start;;) {
            std::uint32_t next = at;
            for (const std::uint32_t neighbour : neighbours(at))
                if (better(neighbour)) next = neighbour;
            if (next == at) return at;
            at = next;
        }
    }

private:
    /// each_edge(visit) calls visit(from, to) for each edge in both directions.
    template <class EachEdge>
    void set_neighbours(std::size_t point_count, EachEdge each_edge) {
        ends_.assign(point_count + 1, 0);
        each_edge([&](std::uint32_t from, std::uint32_t) { ++ends_[from + 1]; });
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        neighbours_.resize(ends_.back());
        each_edge([&](std::uint32_t from, std::uint32_t to) { neighbours_[ends_[from]++] = to; });
    }

    std::span<const std::uint32_t> neighbours(std::uint32_t point) const {
        const std::uint32_t begin = point == 0 ? 0 : ends_[point - 1];
        return std::span(neighbours_).subspan(begin, ends_[point] - begin);
    }

    std::vector<std::uint32_t> neighbours_;  ///< of all points, one after the other
    std::vector<std::uint32_t> ends_;        ///< one per point: the end of its neighbours
};

}  // namespace abut::detail
