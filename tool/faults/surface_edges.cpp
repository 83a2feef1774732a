#include "tool/faults/surface_edges.hpp"

#include <abut/broad_phase/bvh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

// Visits runs of elements with equal keys.
template <class T, class Key, class Visit>
void each_run(const std::vector<T>& sorted, Key key, Visit visit) {
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && key(sorted[end]) == key(sorted[begin])) ++end;
        visit(begin, end);
        begin = end;
    }
}

std::pair<std::uint32_t, std::uint32_t> ends_of(const BoundaryEdge& edge) {
    return edge.ends();
}

void sort_by_ends(std::vector<BoundaryEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const BoundaryEdge& a, const BoundaryEdge& b) {
        return std::tuple(ends_of(a), a.triangle, a.from) < std::tuple(ends_of(b), b.triangle, b.from);
    });
}

std::vector<std::uint32_t> unique_triangles(const std::vector<Surface<3>::Facet>& facets) {
    std::vector<std::pair<Surface<3>::Facet, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < facets.size(); ++i) {
        all.emplace_back(facets[i], i);
        std::sort(all.back().first.begin(), all.back().first.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> result;
    each_run(
        all, [](const auto& entry) { return entry.first; },
        [&](std::size_t begin, std::size_t) { result.push_back(all[begin].second); });
    std::sort(result.begin(), result.end());
    return result;
}

// Boundary vertices in a spatial tree, merged by distance.
class BoundaryVertices {
public:
    BoundaryVertices(const Surface<3>& surface, const std::vector<BoundaryEdge>& boundary, float tolerance)
        : surface_(surface), tolerance_(tolerance) {
        for (const BoundaryEdge& edge : boundary) points_.insert(points_.end(), {edge.from, edge.to});
        std::sort(points_.begin(), points_.end());
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
        std::vector<Aabb3> boxes;
        for (const std::uint32_t point : points_) boxes.push_back({surface.points[point], surface.points[point]});
        tree_.build(boxes);
        UnionFind groups(points_.size());
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            tree_.each_overlapping(grown(boxes[i], tolerance), [&](std::uint32_t j) {
                if (length(place(points_[i]) - place(points_[j])) <= static_cast<double>(tolerance)) groups.unite(i, j);
            });
        for (std::size_t i = 0; i < points_.size(); ++i) representative_.push_back(points_[groups.find(i)]);
    }

    /// The representative of a vertex and all vertices merged with it.
    std::uint32_t operator[](std::uint32_t point) const {
        const auto found = std::lower_bound(points_.begin(), points_.end(), point);
        return representative_[static_cast<std::size_t>(found - points_.begin())];
    }

    /// The vertices on an edge between its ends, sorted from `from` to `to`.
    std::vector<std::uint32_t> on(std::uint32_t from, std::uint32_t to) const {
        const DVec<3> start = place(from), direction = place(to) - start;
        const Aabb3 box = merged(Aabb3{surface_.points[from], surface_.points[from]},
                                 Aabb3{surface_.points[to], surface_.points[to]});
        std::vector<std::pair<double, std::uint32_t>> found;
        tree_.each_overlapping(grown(box, tolerance_), [&](std::uint32_t i) {
            const std::uint32_t point = points_[i];
            if (representative_[i] != point || point == from || point == to) return;
            const DVec<3> to_point = place(point) - start;
            const double fraction = dot(to_point, direction) / dot(direction, direction);
            if (fraction > 0 && fraction < 1 &&
                length(to_point - direction * fraction) <= static_cast<double>(tolerance_))
                found.emplace_back(fraction, point);
        });
        std::sort(found.begin(), found.end());
        std::vector<std::uint32_t> result;
        for (const auto& [fraction, point] : found) result.push_back(point);
        return result;
    }

private:
    DVec<3> place(std::uint32_t point) const { return DVec<3>(surface_.points[point]); }

    const Surface<3>& surface_;
    float tolerance_;
    std::vector<std::uint32_t> points_, representative_;
    Bvh<3> tree_;
};

}  // namespace

SurfaceEdges edges_of(const Surface<3>& surface) {
    SurfaceEdges result;
    result.triangles = unique_triangles(surface.facets);
    std::vector<BoundaryEdge> all;
    for (const std::uint32_t triangle : result.triangles)
        for (std::size_t side = 0; side < 3; ++side) {
            const auto& corners = surface.facets[triangle];
            all.push_back({corners[side], corners[(side + 1) % 3], triangle});
        }
    sort_by_ends(all);
    each_run(all, ends_of, [&](std::size_t begin, std::size_t end) {
        const BoundaryEdge &first = all[begin], &second = all[end - 1];
        if (end - begin == 1) {
            result.boundary.push_back(first);
        } else if (end - begin == 2) {
            result.shared.push_back({first.triangle, second.triangle, first.from != second.from});
        } else {
            const auto ascending = std::count_if(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 all.begin() + static_cast<std::ptrdiff_t>(end),
                                                 [](const BoundaryEdge& edge) { return edge.from < edge.to; });
            if (2 * static_cast<std::size_t>(ascending) != end - begin) result.non_manifold.push_back(first);
        }
    });
    return result;
}

WeldedBoundary weld_boundary(const Surface<3>& surface, const std::vector<BoundaryEdge>& boundary, float tolerance) {
    const BoundaryVertices points(surface, boundary, tolerance);
    std::vector<BoundaryEdge> segments;
    for (const BoundaryEdge& edge : boundary) {
        std::uint32_t from = points[edge.from];
        const std::uint32_t to = points[edge.to];
        if (from == to) continue;
        for (const std::uint32_t between : points.on(from, to)) {
            segments.push_back({from, between, edge.triangle});
            from = between;
        }
        segments.push_back({from, to, edge.triangle});
    }
    sort_by_ends(segments);
    WeldedBoundary result;
    each_run(segments, ends_of, [&](std::size_t begin, std::size_t end) {
        std::vector<BoundaryEdge>& to = end - begin == 1 ? result.open : result.cracked;
        to.insert(to.end(), segments.begin() + static_cast<std::ptrdiff_t>(begin),
                  segments.begin() + static_cast<std::ptrdiff_t>(end));
    });
    return result;
}

}  // namespace abut::tool
