#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>

namespace abut::detail {

std::vector<HalfEdge> sorted_half_edges(std::span<const glm::uvec3> triangles) {
    // A counting sort by the lower end point leaves short rows to sort.
    std::uint32_t points = 0;
    for (const glm::uvec3& t : triangles) points = std::max({points, t.x + 1, t.y + 1, t.z + 1});
    const auto each_side = [&](const auto& visit) {
        std::uint32_t side = 0;
        for (const glm::uvec3& t : triangles)
            for (const auto& [from, to] : {std::pair(t.x, t.y), std::pair(t.y, t.z), std::pair(t.z, t.x)})
                visit(HalfEdge{std::min(from, to), std::max(from, to), side++, from < to});
    };
    std::vector<std::uint32_t> row(std::size_t{points} + 2, 0);
    each_side([&](const HalfEdge& edge) { ++row[std::size_t{edge.low} + 2]; });
    for (std::size_t i = 2; i < row.size(); ++i) row[i] += row[i - 1];
    std::vector<HalfEdge> result(3 * triangles.size());
    each_side([&](const HalfEdge& edge) { result[row[std::size_t{edge.low} + 1]++] = edge; });
    const auto at = [&](std::size_t i) { return result.begin() + static_cast<std::ptrdiff_t>(i); };
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
        std::sort(at(row[i]), at(row[i + 1]), [](const HalfEdge& a, const HalfEdge& b) {
            const auto key = [](const HalfEdge& edge) { return std::uint64_t{edge.high} << 32 | edge.side; };
            return key(a) < key(b);
        });
    return result;
}

bool has_edge(std::span<const HalfEdge> sorted, std::uint32_t a, std::uint32_t b) {
    const std::pair ends(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), ends,
                                        [](const HalfEdge& edge, const auto& sought) { return edge.ends() < sought; });
    return found != sorted.end() && found->ends() == ends;
}

std::vector<std::uint32_t> twins(std::span<const HalfEdge> sorted) {
    std::vector<std::uint32_t> result(sorted.size(), no_index);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2 || edge[0].upwards == edge[1].upwards) return;
        result[edge[0].side] = edge[1].side;
        result[edge[1].side] = edge[0].side;
    });
    return result;
}

EdgeFaults edge_faults(std::span<const glm::uvec3> triangles) {
    EdgeFaults result;
    result.closed = !triangles.empty();
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        const auto upwards = static_cast<std::size_t>(
            std::count_if(edge.begin(), edge.end(), [](const HalfEdge& side) { return side.upwards; }));
        result.boundary += edge.size() == 1;
        result.non_manifold += edge.size() > 2;
        result.inconsistent += edge.size() == 2 && upwards != 1;
        result.closed = result.closed && 2 * upwards == edge.size();
    });
    return result;
}

}  // namespace abut::detail
