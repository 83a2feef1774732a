#include <abut/convex/facets.hpp>

#include <algorithm>
#include <tuple>

namespace abut {

std::vector<FacetEdge> facet_edges(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends) {
    struct Side {
        std::uint32_t low, high, face;
        bool rising;
    };
    std::vector<Side> sides;
    sides.reserve(loops.size());
    std::size_t begin = 0;
    for (std::uint32_t face = 0; face < loop_ends.size(); ++face) {
        const std::size_t end = loop_ends[face];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t from = loops[i], to = loops[i + 1 == end ? begin : i + 1];
            sides.push_back({std::min(from, to), std::max(from, to), face, from < to});
        }
        begin = end;
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tuple(a.low, a.high, !a.rising) < std::tuple(b.low, b.high, !b.rising);
    });
    std::vector<FacetEdge> result;
    result.reserve(sides.size() / 2);
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
        result.push_back({sides[i].low, sides[i].high, sides[i].face, sides[i + 1].face});
    return result;
}

}  // namespace abut
