#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/walk/build/edge_links.hpp>

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace abut::detail {
namespace {

constexpr std::size_t max_triangles_at_edge = 64;

/// The unit vector from the edge into the triangle, at right angles to the edge.
DVec<3> inwards(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, std::uint32_t side) {
    const DVec<3> from(points[start_of(triangles, side)]), to(points[end_of(triangles, side)]);
    const DVec<3> along = normalized(to - from), other = DVec<3>(points[end_of(triangles, next_side(side))]) - from;
    return normalized(other - along * dot(along, other));
}

/// A pair of triangles at an edge; `fold` is -1 if they are coplanar and 1 if one lies on the other.
struct Fold {
    double fold = 0;
    std::size_t a = 0, b = 0;
};

std::vector<Fold> sorted_folds(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                               std::span<const HalfEdge> edge) {
    std::vector<DVec<3>> in;
    for (const HalfEdge& side : edge) in.push_back(inwards(points, triangles, side.side));
    std::vector<Fold> result;
    for (std::size_t a = 0; a < edge.size(); ++a)
        for (std::size_t b = a + 1; b < edge.size(); ++b)
            if (edge[a].side / 3 != edge[b].side / 3) result.push_back({dot(in[a], in[b]), a, b});
    std::sort(result.begin(), result.end(),
              [](const Fold& x, const Fold& y) { return std::tie(x.fold, x.a, x.b) < std::tie(y.fold, y.a, y.b); });
    return result;
}

void link(WalkLinks& links, const HalfEdge& a, const HalfEdge& b) {
    const bool mirrored = a.upwards == b.upwards;
    links.of[a.side / 3][a.side % 3] = WalkLink::to(b.side / 3, b.side % 3, mirrored);
    links.of[b.side / 3][b.side % 3] = WalkLink::to(a.side / 3, a.side % 3, mirrored);
    links.mirrored += mirrored;
}

}  // namespace

WalkLinks link_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    WalkLinks result;
    result.of.resize(triangles.size());
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        result.non_manifold_edges += edge.size() > 2;
        if (edge.size() == 2) {
            link(result, edge[0], edge[1]);
        } else if (edge.size() > 2 && edge.size() <= max_triangles_at_edge) {
            std::vector<bool> linked(edge.size(), false);
            for (const Fold& fold : sorted_folds(points, triangles, edge)) {
                if (linked[fold.a] || linked[fold.b]) continue;
                linked[fold.a] = linked[fold.b] = true;
                link(result, edge[fold.a], edge[fold.b]);
            }
        }
        for (const HalfEdge& side : edge) result.border += result.of[side.side / 3][side.side % 3].is_border();
    });
    return result;
}

}  // namespace abut::detail
