#include <abut/convex/hull/limited/vertex_graph.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace abut::detail {

VertexGraph::VertexGraph(const ConvexSurface& surface)
    : points_(surface.points), neighbours_(surface.triangles.origin.size()), ends_(surface.points.size() + 1, 0) {
    const std::vector<std::uint32_t>& origin = surface.triangles.origin;
    for (const std::uint32_t from : origin) ++ends_[from + 1];
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    for (std::uint32_t h = 0; h < origin.size(); ++h) neighbours_[ends_[origin[h]]++] = origin[following(h)];
}

/// Hill climbing. better(i) returns whether point i is better than the best before, and makes it the best. No point is
/// visited twice.
template <class Better>
std::uint32_t VertexGraph::hill_climb(std::uint32_t start, Better better) const {
    better(start);
    for (std::uint32_t at = start;;) {
        std::uint32_t next = at;
        for (std::uint32_t i = at == 0 ? 0 : ends_[at - 1]; i < ends_[at]; ++i)
            if (better(neighbours_[i])) next = neighbours_[i];
        if (next == at) return at;
        at = next;
    }
}

std::uint32_t VertexGraph::highest(const DVec<3>& direction, std::uint32_t start) const {
    double max_height = -std::numeric_limits<double>::infinity();
    return hill_climb(start, [&](std::uint32_t i) {
        const double height = dot(direction, points_[i]);
        if (!(height > max_height)) return false;
        max_height = height;
        return true;
    });
}

std::uint32_t VertexGraph::first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal, double near,
                                         std::uint32_t start) const {
    // Seen along the line; the plane begins upside down.
    double best_x = -1, best_y = 1e-9;
    return hill_climb(start, [&](std::uint32_t i) {
        const DVec<3> seen = points_[i] - from;
        const double x = dot(on, seen), y = std::max(0.0, -dot(normal, seen));
        if (!(x * best_y - y * best_x > 0) || x * x + y * y <= near * near) return false;
        best_x = x;
        best_y = y;
        return true;
    });
}

}  // namespace abut::detail
