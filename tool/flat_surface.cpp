#include "flat_surface.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/groups.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// Of the extent of a curved part: how far its polygon may be from it.
constexpr float curve_tolerance = 1e-4f;
// How far from an edge it is seen what is beside it: as a part of its length, and at least in ulps of its coordinates,
// which is more than answers may be off by.
constexpr float beside = 1e-3f, least_ulps_beside = 64;
// How far apart corners may be, in ulps, that are one: each tile is placed by itself.
constexpr float ulps_apart = 8;

struct Edge {
    Vec2 from{}, to{};
    bool is_line = false;  // of a part that has no area

    float length() const { return glm::distance(from, to); }
};

float largest_coordinate(const Aabb2& box) {
    const Vec2 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    return std::max(reach.x, reach.y);
}

// Of a part with an area counter-clockwise.
void add_edges(const Convex<2>& part, std::vector<Edge>& edges) {
    const Aabb2 box = bounds(View<2>(part));
    const Vec2 extent = box.max - box.min;
    const float tolerance = curve_tolerance * std::max(extent.x, extent.y);
    const Polygon outline = polytope(part, std::max(tolerance, std::numeric_limits<float>::min()));
    const auto corners = outline.points();
    if (outline.rank() == 1) edges.push_back({corners.front(), corners.back(), true});
    if (outline.rank() < 2) return;
    for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

std::vector<Edge> edges_of(const View<2>& shape) {
    std::vector<Edge> edges;
    if (const auto* convex = std::get_if<Convex<2>>(&shape)) add_edges(*convex, edges);
    if (const auto* composite = std::get_if<Composite<2>>(&shape)) {
        std::vector<std::pair<std::uint32_t, std::size_t>> order;  // by the part's number, whatever the order of visits
        std::vector<Edge> visited;
        each_part<2>(*composite, bounds(*composite), [&](const Convex<2>& part, std::uint32_t index) {
            add_edges(part, visited);
            while (order.size() < visited.size()) order.emplace_back(index, order.size());
            return true;
        });
        std::sort(order.begin(), order.end());
        for (const auto& [part, i] : order) edges.push_back(visited[i]);
    }
    return edges;
}

// The edges with corners that they share.
class Outline {
public:
    Outline(const std::vector<Edge>& edges, float tolerance) {
        std::vector<Aabb2> boxes;
        for (const Edge& edge : edges)
            for (const Vec2& end : {edge.from, edge.to}) boxes.push_back(grown(Aabb2{end, end}, 0.5f * tolerance));
        Bvh<2> tree;
        tree.build(boxes);
        Groups groups(boxes.size());
        tree.each_pair([&](std::uint32_t i, std::uint32_t j) { groups.join(i, j); });
        std::vector<std::uint32_t> numbers(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const std::size_t lowest = groups.lowest(i);
            if (lowest == i) {
                numbers[i] = static_cast<std::uint32_t>(points.size());
                points.push_back(i % 2 == 0 ? edges[i / 2].from : edges[i / 2].to);
            } else {
                numbers[i] = numbers[lowest];
            }
        }
        for (std::size_t i = 0; i < edges.size(); ++i) ends_.push_back({numbers[2 * i], numbers[2 * i + 1]});
        find_inner(edges);
    }

    /// Of those of parts with an area that run both ways between two corners all are inner, for both sides of these are
    /// the shape; of those that run one way all but one.
    bool is_inner(std::size_t edge) const { return ends_[edge][0] == ends_[edge][1] || inner_[edge]; }
    const Surface<2>::Facet& ends(std::size_t edge) const { return ends_[edge]; }

    std::vector<Vec2> points;

private:
    void find_inner(const std::vector<Edge>& edges) {
        inner_.resize(edges.size());
        std::vector<std::tuple<Surface<2>::Facet, bool, std::size_t>> areas;  // with corners in order, and which way
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (const auto [from, to] = ends_[i]; !edges[i].is_line)
                areas.emplace_back(Surface<2>::Facet{std::min(from, to), std::max(from, to)}, from < to, i);
        std::sort(areas.begin(), areas.end());
        for (std::size_t begin = 0, end = 0; begin < areas.size(); begin = end) {
            while (end < areas.size() && std::get<0>(areas[end]) == std::get<0>(areas[begin])) ++end;
            const bool both_ways = std::get<1>(areas[begin]) != std::get<1>(areas[end - 1]);
            for (std::size_t i = both_ways ? begin : begin + 1; i < end; ++i) inner_[std::get<2>(areas[i])] = true;
        }
    }

    std::vector<Surface<2>::Facet> ends_;
    std::vector<bool> inner_;
};

std::vector<Edge> without_inner(const std::vector<Edge>& edges, float tolerance) {
    const Outline outline(edges, tolerance);
    std::vector<Edge> result;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (!outline.is_inner(i)) result.push_back(edges[i]);
    return result;
}

// Where an edge meets the ends of another one, or crosses it: fractions of its length.
void add_cuts(const Edge& edge, const Edge& other, double tolerance, std::vector<double>& cuts) {
    const DVec<2> from(edge.from), along = DVec<2>(edge.to) - from;
    const DVec<2> other_from(other.from), other_along = DVec<2>(other.to) - other_from;
    const double length = abut::length(along);
    for (const DVec<2>& end : {other_from, DVec<2>(other.to)})
        if (std::abs(cross(along, end - from)) <= tolerance * length)
            cuts.push_back(dot(end - from, along) / (length * length));
    const double turned = cross(along, other_along);
    if (turned == 0) return;
    const double on_other = cross(other_from - from, along) / turned;
    if (on_other > 0 && on_other < 1) cuts.push_back(cross(other_from - from, other_along) / turned);
}

// What runs along others, or through them, in pieces that have the same on each of their sides all along.
std::vector<Edge> cut(const std::vector<Edge>& edges, float tolerance) {
    std::vector<Aabb2> boxes;
    for (const Edge& edge : edges)
        boxes.push_back(grown(merged(Aabb2{edge.from, edge.from}, Aabb2{edge.to, edge.to}), tolerance));
    Bvh<2> tree;
    tree.build(boxes);
    std::vector<std::vector<double>> cuts(edges.size());
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        add_cuts(edges[i], edges[j], static_cast<double>(tolerance), cuts[i]);
        add_cuts(edges[j], edges[i], static_cast<double>(tolerance), cuts[j]);
    });
    std::vector<Edge> pieces;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        const double least = static_cast<double>(tolerance / edge.length());
        std::sort(cuts[i].begin(), cuts[i].end());
        double begin = 0;
        Vec2 from = edge.from;
        for (const double fraction : cuts[i]) {
            if (!(fraction > begin + least) || !(fraction < 1 - least)) continue;
            const DVec<2> start(edge.from);
            const Vec2 to(start + (DVec<2>(edge.to) - start) * fraction);
            pieces.push_back({from, to, edge.is_line});
            from = to;
            begin = fraction;
        }
        pieces.push_back({from, edge.to, edge.is_line});
    }
    return pieces;
}

// Whether the middle of one of the sides of an edge, its right one or with -1 its left one, isn't in the shape.
bool is_free(const View<2>& shape, const Edge& edge, float side) {
    const Vec2 along = edge.to - edge.from, right(along.y, -along.x);
    const float most = largest_coordinate(merged(Aabb2{edge.from, edge.from}, Aabb2{edge.to, edge.to}));
    const float away =
        std::max(beside * edge.length(), least_ulps_beside * std::numeric_limits<float>::epsilon() * most);
    return !contains(shape, edge.from + 0.5f * along + right * (side * away / edge.length()));
}

}  // namespace

Surface<2> surface_of(const View<2>& shape, bool filled) {
    const float tolerance = ulps_apart * std::numeric_limits<float>::epsilon() * largest_coordinate(bounds(shape));
    const bool is_convex = std::holds_alternative<Convex<2>>(shape);
    std::vector<Edge> edges = edges_of(shape);
    if (filled && !is_convex) edges = cut(without_inner(edges, tolerance), tolerance);
    Outline outline(edges, tolerance);
    Surface<2> surface;
    const auto add = [&](const Surface<2>::Facet& facet, bool two_sided) {
        surface.facets.push_back(facet);
        surface.two_sided.push_back(two_sided);
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (outline.is_inner(i)) continue;
        const Edge& edge = edges[i];
        const auto [from, to] = outline.ends(i);
        const bool is_open = edge.is_line && !filled;
        const bool right = is_open || is_convex || is_free(shape, edge, 1);
        const bool left = is_open || (edge.is_line && is_free(shape, edge, -1));
        if (right) add({from, to}, left);
        if (left && !right) add({to, from}, false);
    }
    surface.points = std::move(outline.points);
    return surface;
}

}  // namespace abut::tool
