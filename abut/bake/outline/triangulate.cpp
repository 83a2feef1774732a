#include <abut/bake/outline/reflex_chains.hpp>
#include <abut/bake/outline/ring_sets.hpp>
#include <abut/bake/outline/triangulate.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <memory_resource>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace abut::outline {
namespace {

using detail::no_index;

/// An edge from left to right. Several rings may run along it.
struct Edge {
    std::uint32_t left, right;
    std::uint32_t tag;               ///< the input edge that contains it
    std::uint32_t along = no_index;  ///< the next coincident edge
    std::uint32_t next = no_index;   ///< the next edge with the same left point
};

/// An edge that the sweep line crosses, and the region between it and the next one above.
struct StatusEdge {
    std::uint32_t edge, left, right;
    Vec2 from, to;
    mutable std::uint32_t ring_set = 0;  ///< above the edge
    mutable ReflexChain chain = {};
};

class Sweep {
public:
    Sweep(std::span<const std::span<const Vec2>> rings, Triangulation& result)
        : rings_(rings), result_(result), points_(result.points) {}

    std::optional<Problem> run();

private:
    struct Place {
        std::uint32_t point;
        Vec2 at;
    };
    /// The order of edges and points along the sweep line.
    struct StatusOrder {
        using is_transparent = void;

        static int side(const StatusEdge& edge, const Place& place) {
            return edge.right == place.point ? 0 : orientation(edge.from, edge.to, place.at);
        }
        bool operator()(const StatusEdge& a, const Place& place) const { return side(a, place) > 0; }
        bool operator()(const Place& place, const StatusEdge& a) const { return side(a, place) < 0; }
        bool operator()(const StatusEdge& a, const StatusEdge& b) const {
            if (a.left == b.left) return side(a, {b.right, b.to}) > 0;
            return a.left < b.left ? side(a, {b.left, b.from}) > 0 : side(b, {a.left, a.from}) < 0;
        }
    };
    using Status = std::pmr::set<StatusEdge, StatusOrder>;

    std::optional<Problem> sort_points();
    void add_edges();
    void start(std::uint32_t edge);
    std::optional<Problem> visit(std::uint32_t point, Status& status, ReflexChains& chains);
    std::pair<Status::iterator, Status::iterator> through(const Place& place, const Status& status) const;
    void split_passing(Status::iterator from, Status::iterator to, std::uint32_t point);
    void order_starting(std::uint32_t point);
    std::span<const std::uint32_t> rings_across(std::uint32_t edge);
    std::optional<Problem> crossing(const StatusEdge& a, const StatusEdge& b) const;
    std::string name(std::uint32_t tag) const;
    std::uint32_t ring_of(std::uint32_t tag) const;

    std::span<const std::span<const Vec2>> rings_;
    Triangulation& result_;
    std::vector<Vec2>& points_;
    std::vector<std::uint32_t> first_tags_;  ///< one per ring, and the end
    std::vector<std::uint32_t> numbers_;     ///< one per input point: its index among the sorted points
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> first_edges_;  ///< one per point: the first edge that starts there
    /// one per point: an edge of the status that ends there, or the end if none is known
    std::vector<Status::iterator> ending_;
    Status::iterator status_end_;
    std::vector<std::uint32_t> starting_;
    std::vector<std::uint32_t> across_;
    std::vector<bool> bounds_region_;  ///< one per ring: whether it bounds the region
    RingSets ring_sets_;
};

std::uint32_t Sweep::ring_of(std::uint32_t tag) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first_tags_, tag) - first_tags_.begin() - 1);
}

std::string Sweep::name(std::uint32_t tag) const {
    const std::uint32_t ring = ring_of(tag);
    return std::to_string(tag - first_tags_[ring]) +
           (ring == 0 ? " of the outline" : " of hole " + std::to_string(ring - 1));
}

std::optional<Problem> Sweep::sort_points() {
    std::size_t count = 0;
    for (const std::span<const Vec2> ring : rings_) {
        first_tags_.push_back(static_cast<std::uint32_t>(count));
        count += ring.size();
        if (count >= no_index / 8) return Problem{ProblemCode::too_large, "there are too many points", 0};
    }
    first_tags_.push_back(static_cast<std::uint32_t>(count));

    struct InputPoint {
        Vec2 point;
        std::uint32_t tag;
    };
    std::vector<InputPoint> places;
    places.reserve(count);
    for (const std::span<const Vec2> ring : rings_)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto tag = static_cast<std::uint32_t>(places.size());
            if (!detail::is_finite(ring[i]))
                return Problem{ProblemCode::not_finite, "point " + name(tag) + " is not finite", i};
            places.push_back({ring[i] + Vec2(0.0f), tag});
        }
    std::ranges::sort(places, [](const InputPoint& a, const InputPoint& b) {
        if (a.point.x != b.point.x) return a.point.x < b.point.x;
        if (a.point.y != b.point.y) return a.point.y < b.point.y;
        return a.tag < b.tag;
    });
    numbers_.resize(count);
    points_.reserve(count);
    for (const InputPoint& place : places) {
        if (points_.empty() || points_.back() != place.point) points_.push_back(place.point);
        numbers_[place.tag] = static_cast<std::uint32_t>(points_.size() - 1);
    }
    result_.touching_points = count - points_.size();
    return std::nullopt;
}

void Sweep::start(std::uint32_t edge) {
    edges_[edge].next = std::exchange(first_edges_[edges_[edge].left], edge);
}

void Sweep::add_edges() {
    edges_.reserve(numbers_.size());
    first_edges_.assign(points_.size(), no_index);
    for (std::size_t ring = 0; ring < rings_.size(); ++ring)
        for (std::uint32_t tag = first_tags_[ring]; tag < first_tags_[ring + 1]; ++tag) {
            const std::uint32_t last = tag + 1 == first_tags_[ring + 1] ? first_tags_[ring] : tag + 1;
            const auto [left, right] = std::minmax(numbers_[tag], numbers_[last]);
            if (left == right) {
                ++result_.repeated_points;
                continue;
            }
            edges_.push_back({left, right, tag});
            start(static_cast<std::uint32_t>(edges_.size() - 1));
        }
    result_.touching_points -= std::min(result_.touching_points, result_.repeated_points);
}

/// Sorts the edges that start at a point from the lowest to the highest and merges coincident ones: a longer edge
/// continues where the shorter one ends.
void Sweep::order_starting(std::uint32_t point) {
    const auto turn = [&](std::uint32_t a, std::uint32_t b) {
        if (edges_[a].right == edges_[b].right) return 0;
        return orientation(points_[point], points_[edges_[a].right], points_[edges_[b].right]);
    };
    starting_.clear();
    for (std::uint32_t edge = first_edges_[point]; edge != no_index; edge = edges_[edge].next)
        starting_.push_back(edge);
    std::ranges::sort(starting_, [&](std::uint32_t a, std::uint32_t b) {
        const int side = turn(a, b);
        if (side != 0) return side > 0;
        return edges_[a].right != edges_[b].right ? edges_[a].right < edges_[b].right : a < b;
    });
    std::size_t unique_count = 0;
    for (std::size_t i = 0; i < starting_.size(); ++i) {
        const std::uint32_t edge = starting_[i];
        if (unique_count == 0 || turn(starting_[unique_count - 1], edge) != 0) {
            starting_[unique_count++] = edge;
            continue;
        }
        const std::uint32_t first = starting_[unique_count - 1], right = edges_[first].right;
        std::uint32_t last = first;
        while (edges_[last].along != no_index) last = edges_[last].along;
        for (std::uint32_t part = edge; part != no_index;) {
            const std::uint32_t following = edges_[part].along;
            edges_[part].along = no_index;
            if (edges_[part].right != right) {
                edges_.push_back({right, edges_[part].right, edges_[part].tag});
                edges_[part].right = right;
                start(static_cast<std::uint32_t>(edges_.size() - 1));
                ++result_.touching_points;
            }
            edges_[last].along = part;
            last = part;
            part = following;
        }
    }
    starting_.resize(unique_count);
}

std::optional<Problem> Sweep::crossing(const StatusEdge& a, const StatusEdge& b) const {
    const auto side = [&](const StatusEdge& edge, std::uint32_t point) {
        return orientation(points_[edge.left], points_[edge.right], points_[point]);
    };
    if (side(a, b.left) * side(a, b.right) >= 0 || side(b, a.left) * side(b, a.right) >= 0) return std::nullopt;
    const auto [first, second] = std::minmax(edges_[a.edge].tag, edges_[b.edge].tag);
    const Vec2& near = points_[std::min(a.right, b.right)];
    return Problem{ProblemCode::bad_argument,
                   "edge " + name(first) + " crosses edge " + name(second) + ", left of (" + std::to_string(near.x) +
                       ", " + std::to_string(near.y) + ")",
                   first - first_tags_[ring_of(first)]};
}

/// The rings whose boundary the edge is. Pairs that run along it in both directions cancel.
std::span<const std::uint32_t> Sweep::rings_across(std::uint32_t edge) {
    across_.clear();
    for (; edge != no_index; edge = edges_[edge].along) across_.push_back(ring_of(edges_[edge].tag));
    if (across_.size() == 1) return across_;
    std::ranges::sort(across_);
    std::size_t unique_count = 0;
    for (const std::uint32_t ring : across_)
        if (unique_count > 0 && across_[unique_count - 1] == ring)
            --unique_count;
        else
            across_[unique_count++] = ring;
    across_.resize(unique_count);
    return across_;
}

/// The edges of the status that end in a point or pass through it. They are neighbours, and mostly one of them is
/// known.
std::pair<Sweep::Status::iterator, Sweep::Status::iterator> Sweep::through(const Place& place,
                                                                           const Status& status) const {
    auto from = ending_[place.point];
    if (from == status.end()) from = status.lower_bound(place);
    auto to = from;
    while (from != status.begin() && StatusOrder::side(*std::prev(from), place) == 0) --from;
    while (to != status.end() && StatusOrder::side(*to, place) == 0) ++to;
    return {from, to};
}

void Sweep::split_passing(Status::iterator from, Status::iterator to, std::uint32_t point) {
    for (auto i = from; i != to; ++i)
        if (i->right != point) {
            ++result_.touching_points;
            if (ending_[i->right] == i) ending_[i->right] = status_end_;
            for (std::uint32_t edge = i->edge; edge != no_index; edge = edges_[edge].along) {
                edges_.push_back({point, edges_[edge].right, edges_[edge].tag});
                start(static_cast<std::uint32_t>(edges_.size() - 1));
            }
        }
}

std::optional<Problem> Sweep::visit(std::uint32_t point, Status& status, ReflexChains& chains) {
    const Place place{point, points_[point]};
    const auto [from, to] = through(place, status);
    split_passing(from, to, point);
    order_starting(point);

    const bool any_ends = from != to;
    const auto below = from == status.begin() ? status.end() : std::prev(from);
    const std::uint32_t ring_set_below = below == status.end() ? RingSets::nothing : below->ring_set;
    const bool solid_below = ring_sets_.solid(ring_set_below);
    std::uint32_t ring_set_above = ring_set_below;
    ReflexChain above;
    if (any_ends) {
        const auto highest = std::prev(to);
        for (auto i = from; i != highest; ++i)
            if (ring_sets_.solid(i->ring_set)) chains.add_on_top(i->chain, point);
        ring_set_above = highest->ring_set;
        above = highest->chain;
        if (solid_below) chains.add_on_top(below->chain, point);
        if (ring_sets_.solid(ring_set_above)) chains.add_at_bottom(above, point);
    }
    const auto next = status.erase(from, to);

    std::uint32_t ring_set = ring_set_below;
    auto highest = status.end();
    for (const std::uint32_t edge : starting_) {
        const std::span<const std::uint32_t> rings = rings_across(edge);
        if (rings.empty()) {
            ++result_.cancelled_edges;
            continue;
        }
        const bool was_solid = ring_sets_.solid(ring_set);
        for (const std::uint32_t ring : rings) ring_set = ring_sets_.toggled(ring_set, ring);
        const bool is_solid = ring_sets_.solid(ring_set);
        if (was_solid != is_solid)
            for (const std::uint32_t ring : rings) bounds_region_[ring] = true;
        const bool is_first = highest == status.end();
        const std::uint32_t right = edges_[edge].right;
        highest = status.insert(next, {edge, point, right, points_[point], points_[right], ring_set});
        ending_[right] = highest;
        if (is_solid) highest->chain = chains.begin(point);
        if (is_first && below != status.end())
            if (auto problem = crossing(*below, *highest)) return problem;
    }
    if (highest == status.end()) {
        if (!any_ends) return std::nullopt;
        if (solid_below) chains.join(below->chain, above);
        if (below == status.end() || next == status.end()) return std::nullopt;
        return crossing(*below, *next);
    }
    if (!any_ends && solid_below) above = chains.split(below->chain, point);
    highest->ring_set = ring_set_above;
    highest->chain = above;
    return next == status.end() ? std::nullopt : crossing(*highest, *next);
}

std::optional<Problem> Sweep::run() {
    if (auto problem = sort_points()) return problem;
    add_edges();
    result_.origins.reserve(6 * result_.points.size());
    result_.twins.reserve(6 * result_.points.size());
    bounds_region_.assign(rings_.size(), false);
    std::pmr::monotonic_buffer_resource memory;
    Status status(&memory);
    status_end_ = status.end();
    ending_.assign(points_.size(), status_end_);
    ReflexChains chains(result_);
    for (std::uint32_t point = 0; point < points_.size(); ++point)
        if (auto problem = visit(point, status, chains)) return problem;
    for (std::size_t hole = 1; hole < rings_.size(); ++hole)
        if (!bounds_region_[hole] && !rings_[hole].empty()) ++result_.idle_holes;
    return std::nullopt;
}

}  // namespace

Result<Triangulation> triangulate(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes) {
    std::vector<std::span<const Vec2>> rings{outline};
    rings.insert(rings.end(), holes.begin(), holes.end());
    Triangulation result;
    if (auto problem = Sweep(rings, result).run()) return *problem;
    return result;
}

}  // namespace abut::outline
