#include "tool/objects/flat_surface.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace abut::tool {

using namespace detail;

namespace {

// Maximum distance of a curved part from its polygon, relative to its extent.
constexpr float curve_tolerance = 1e-4f;
// Distance of the side test from an edge: relative to its length, and at least this many ulps of its coordinates, which
// exceeds the error of `contains`.
constexpr float side_offset = 1e-3f, min_side_offset_ulps = 64;
// Vertices closer than this many ulps are merged: each tile is placed separately.
constexpr float weld_ulps = 8;

struct Edge {
    Vec2 from{}, to{};
    bool is_line = false;  // belongs to a part without area

    float length() const { return glm::distance(from, to); }
};

float largest_coordinate(const Aabb2& box) {
    const Vec2 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    return std::max(reach.x, reach.y);
}

// Adds the edges of a part; counter-clockwise if it has an area.
void add_edges(const Convex<2>& part, std::vector<Edge>& edges) {
    const Aabb2 box = bounds(View<2>(part));
    const Vec2 extent = box.max - box.min;
    const float tolerance = curve_tolerance * std::max(extent.x, extent.y);
    const Polygon loops = polytope(part, std::max(tolerance, std::numeric_limits<float>::min()));
    const auto corners = loops.points();
    if (loops.rank() == 1) edges.push_back({corners.front(), corners.back(), true});
    if (loops.rank() < 2) return;
    for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

// The sides of full tiles that other full tiles lie against.
class TileSides {
public:
    explicit TileSides(const TileMap& map) : tiles_(map.tiles()), columns_(map.columns()), rows_(map.rows()) {}

    bool is_inside(std::uint32_t tile) const {
        return tiles_[tile] == Tile::full && has_full(tile, {-1, 0}) && has_full(tile, {1, 0}) &&
               has_full(tile, {0, -1}) && has_full(tile, {0, 1});
    }
    bool is_internal(std::uint32_t tile, const Edge& edge, const Vec2& center) const {
        if (tiles_[tile] != Tile::full) return false;
        const Vec2 out = 0.5f * (edge.from + edge.to) - center;
        const bool is_across_x = std::abs(out.x) > std::abs(out.y);
        const int sign = (is_across_x ? out.x : out.y) > 0 ? 1 : -1;
        return has_full(tile, is_across_x ? glm::ivec2(sign, 0) : glm::ivec2(0, sign));
    }

private:
    bool has_full(std::uint32_t tile, const glm::ivec2& step) const {
        const std::int64_t x = tile % columns_ + step.x, y = tile / columns_ + step.y;
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return false;
        return tiles_[static_cast<std::size_t>(x + y * columns_)] == Tile::full;
    }

    std::span<const Tile> tiles_;
    std::int64_t columns_, rows_;
};

// Edges of a tile map, without those between two full tiles; nothing if there are too many.
std::optional<std::vector<Edge>> edges_of(const View<2>& shape, const TileMap& map) {
    std::vector<Edge> edges, of_tile;
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    const TileSides sides(map);
    const auto& composite = std::get<Composite<2>>(shape);
    each_part<2>(composite, bounds(composite), [&](const Convex<2>& part, std::uint32_t index) {
        if (sides.is_inside(index)) return true;
        of_tile.clear();
        add_edges(part, of_tile);
        const Vec2 center = abut::center(bounds(View<2>(part)));
        for (const Edge& edge : of_tile) {
            if (sides.is_internal(index, edge, center)) continue;
            order.emplace_back(index, edges.size());
            edges.push_back(edge);
        }
        return edges.size() <= max_outline_edges;
    });
    if (edges.size() > max_outline_edges) return std::nullopt;
    std::sort(order.begin(), order.end());
    std::vector<Edge> sorted;
    sorted.reserve(edges.size());
    for (const auto& [part, i] : order) sorted.push_back(edges[i]);
    return sorted;
}

// Nothing if there are too many.
std::optional<std::vector<Edge>> edges_of(const View<2>& shape) {
    std::vector<Edge> edges;
    if (const auto* convex = std::get_if<Convex<2>>(&shape)) add_edges(*convex, edges);
    if (const auto* composite = std::get_if<Composite<2>>(&shape)) {
        std::vector<std::pair<std::uint32_t, std::size_t>> order;  // sorted by part, independent of the order of visits
        std::vector<Edge> visited;
        each_part<2>(*composite, bounds(*composite), [&](const Convex<2>& part, std::uint32_t index) {
            add_edges(part, visited);
            while (order.size() < visited.size()) order.emplace_back(index, order.size());
            return visited.size() <= 2 * max_outline_edges;
        });
        if (visited.size() > 2 * max_outline_edges) return std::nullopt;
        std::sort(order.begin(), order.end());
        for (const auto& [part, i] : order) edges.push_back(visited[i]);
    }
    return edges;
}

// Edges with shared vertices.
class EdgeLoops {
public:
    EdgeLoops(const std::vector<Edge>& edges, float tolerance) {
        std::vector<Aabb2> boxes;
        for (const Edge& edge : edges)
            for (const Vec2& end : {edge.from, edge.to}) boxes.push_back(grown(Aabb2{end, end}, 0.5f * tolerance));
        Bvh<2> tree;
        tree.build(boxes);
        UnionFind groups(boxes.size());
        tree.each_pair([&](std::uint32_t i, std::uint32_t j) { groups.unite(i, j); });
        std::vector<std::uint32_t> numbers(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const std::size_t lowest = groups.find(i);
            if (lowest == i) {
                numbers[i] = static_cast<std::uint32_t>(points.size());
                points.push_back(i % 2 == 0 ? edges[i / 2].from : edges[i / 2].to);
            } else {
                numbers[i] = numbers[lowest];
            }
        }
        for (std::size_t i = 0; i < edges.size(); ++i) ends_.push_back({numbers[2 * i], numbers[2 * i + 1]});
        find_internal(edges);
    }

    /// True if the edge is internal. If edges of parts with areas run in both directions between two vertices, all of
    /// them are internal: the shape is on both sides. If they run in one direction, all but one are.
    bool is_internal(std::size_t edge) const { return ends_[edge][0] == ends_[edge][1] || internal_[edge]; }
    const Surface<2>::Facet& ends(std::size_t edge) const { return ends_[edge]; }

    std::vector<Vec2> points;

private:
    void find_internal(const std::vector<Edge>& edges) {
        internal_.resize(edges.size());
        std::vector<std::tuple<Surface<2>::Facet, bool, std::size_t>> areas;  // with sorted vertices, and the direction
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (const auto [from, to] = ends_[i]; !edges[i].is_line)
                areas.emplace_back(Surface<2>::Facet{std::min(from, to), std::max(from, to)}, from < to, i);
        std::sort(areas.begin(), areas.end());
        for (std::size_t begin = 0, end = 0; begin < areas.size(); begin = end) {
            while (end < areas.size() && std::get<0>(areas[end]) == std::get<0>(areas[begin])) ++end;
            const bool both_directions = std::get<1>(areas[begin]) != std::get<1>(areas[end - 1]);
            for (std::size_t i = both_directions ? begin : begin + 1; i < end; ++i)
                internal_[std::get<2>(areas[i])] = true;
        }
    }

    std::vector<Surface<2>::Facet> ends_;
    std::vector<bool> internal_;
};

std::vector<Edge> without_internal(const std::vector<Edge>& edges, float tolerance) {
    const EdgeLoops loops(edges, tolerance);
    std::vector<Edge> result;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (!loops.is_internal(i)) result.push_back(edges[i]);
    return result;
}

// Adds the fractions of an edge at which another edge crosses it or ends on it.
void add_intersections(const Edge& edge, const Edge& other, double tolerance, std::vector<double>& splits) {
    const DVec<2> from(edge.from), along = DVec<2>(edge.to) - from;
    const DVec<2> other_from(other.from), other_along = DVec<2>(other.to) - other_from;
    const double length = abut::detail::length(along);
    for (const DVec<2>& end : {other_from, DVec<2>(other.to)})
        if (std::abs(cross(along, end - from)) <= tolerance * length)
            splits.push_back(dot(end - from, along) / (length * length));
    const double cross_product = cross(along, other_along);
    if (cross_product == 0) return;
    const double on_other = cross(other_from - from, along) / cross_product;
    if (on_other > 0 && on_other < 1) splits.push_back(cross(other_from - from, other_along) / cross_product);
}

// Splits edges at all intersections, so that each side of a segment is uniform. Nothing if there are too many.
std::optional<std::vector<Edge>> split(const std::vector<Edge>& edges, float tolerance) {
    std::vector<Aabb2> boxes;
    for (const Edge& edge : edges)
        boxes.push_back(grown(merged(Aabb2{edge.from, edge.from}, Aabb2{edge.to, edge.to}), tolerance));
    Bvh<2> tree;
    tree.build(boxes);
    std::vector<std::vector<double>> splits(edges.size());
    std::size_t crossings = 0;
    const auto count_inner = [](const std::vector<double>& fractions, std::size_t first) {
        return std::count_if(fractions.begin() + static_cast<std::ptrdiff_t>(first), fractions.end(),
                             [](double fraction) { return fraction > 1e-3 && fraction < 1 - 1e-3; });
    };
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        const std::size_t first = splits[i].size();
        add_intersections(edges[i], edges[j], static_cast<double>(tolerance), splits[i]);
        add_intersections(edges[j], edges[i], static_cast<double>(tolerance), splits[j]);
        crossings += count_inner(splits[i], first) > 0 ? 1 : 0;
        return crossings <= max_outline_crossings;
    });
    if (crossings > max_outline_crossings) return std::nullopt;
    std::vector<Edge> segments;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        const double min_fraction = static_cast<double>(tolerance / edge.length());
        std::sort(splits[i].begin(), splits[i].end());
        double begin = 0;
        Vec2 from = edge.from;
        for (const double fraction : splits[i]) {
            if (!(fraction > begin + min_fraction) || !(fraction < 1 - min_fraction)) continue;
            const DVec<2> start(edge.from);
            const Vec2 to(start + (DVec<2>(edge.to) - start) * fraction);
            segments.push_back({from, to, edge.is_line});
            from = to;
            begin = fraction;
        }
        segments.push_back({from, edge.to, edge.is_line});
    }
    return segments;
}

// True if the side of the edge's midpoint, right (1) or left (-1), is outside of the shape.
bool is_free(const View<2>& shape, const Edge& edge, float side) {
    const Vec2 along = edge.to - edge.from, right(along.y, -along.x);
    const float coordinate = largest_coordinate(merged(Aabb2{edge.from, edge.from}, Aabb2{edge.to, edge.to}));
    const float offset = std::max(side_offset * edge.length(),
                                  min_side_offset_ulps * std::numeric_limits<float>::epsilon() * coordinate);
    return !contains(shape, edge.from + 0.5f * along + right * (side * offset / edge.length()));
}

}  // namespace

Result<Surface<2>> surface_of(const View<2>& shape, bool filled, const TileMap* tiles) {
    const float tolerance = weld_ulps * std::numeric_limits<float>::epsilon() * largest_coordinate(bounds(shape));
    const bool is_convex = std::holds_alternative<Convex<2>>(shape);
    std::optional<std::vector<Edge>> found = tiles != nullptr ? edges_of(shape, *tiles) : edges_of(shape);
    if (!found)
        return Problem{ProblemCode::too_large,
                       "its outline has more than " + std::to_string(max_outline_edges) + " edges, the limit"};
    if (filled && !is_convex) found = split(without_internal(*found, tolerance), tolerance);
    if (!found)
        return Problem{ProblemCode::too_large, "its outline crosses itself more than " +
                                                   std::to_string(max_outline_crossings) + " times, the limit"};
    const std::vector<Edge> edges = *std::move(found);
    EdgeLoops loops(edges, tolerance);
    Surface<2> surface;
    const auto add = [&](const Surface<2>::Facet& facet, bool two_sided) {
        surface.facets.push_back(facet);
        surface.two_sided.push_back(two_sided);
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (loops.is_internal(i)) continue;
        const Edge& edge = edges[i];
        const auto [from, to] = loops.ends(i);
        const bool is_open = edge.is_line && !filled;
        const bool right = is_open || is_convex || is_free(shape, edge, 1);
        const bool left = is_open || (edge.is_line && is_free(shape, edge, -1));
        if (right) add({from, to}, left);
        if (left && !right) add({to, from}, false);
    }
    surface.points = std::move(loops.points);
    return surface;
}

}  // namespace abut::tool
