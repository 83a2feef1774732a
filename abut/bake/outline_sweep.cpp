#include <abut/bake/outline_chains.hpp>
#include <abut/bake/outline_coverage.hpp>
#include <abut/bake/outline_sweep.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <memory_resource>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace abut::outline {
namespace {

/// From left to right. Several rings may run along it.
struct Edge {
    std::uint32_t left, right;
    std::uint32_t tag;           ///< the input edge it is a part of
    std::uint32_t along = none;  ///< the next edge that is the same
    std::uint32_t next = none;   ///< the next that starts from the same point
};

/// An edge that the sweep line crosses, and what is between it and the next above.
struct Crossed {
    std::uint32_t edge, left, right;
    Vec2 from, to;
    mutable std::uint32_t coverage = 0;  ///< above
    mutable Chain chain = {};
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
    /// The order of edges that the sweep line crosses, and of a point among them.
    struct Below {
        using is_transparent = void;

        static int side(const Crossed& edge, const Place& place) {
            return edge.right == place.point ? 0 : orientation(edge.from, edge.to, place.at);
        }
        bool operator()(const Crossed& a, const Place& place) const { return side(a, place) > 0; }
        bool operator()(const Place& place, const Crossed& a) const { return side(a, place) < 0; }
        bool operator()(const Crossed& a, const Crossed& b) const {
            if (a.left == b.left) return side(a, {b.right, b.to}) > 0;
            return a.left < b.left ? side(a, {b.left, b.from}) > 0 : side(b, {a.left, a.from}) < 0;
        }
    };
    using Status = std::pmr::set<Crossed, Below>;

    std::optional<Problem> number_points();
    void add_edges();
    void start(std::uint32_t edge);
    std::optional<Problem> visit(std::uint32_t point, Status& status, Chains& chains);
    std::pair<Status::iterator, Status::iterator> through(const Place& place, const Status& status) const;
    void split_passing(Status::iterator from, Status::iterator to, std::uint32_t point);
    void order_starting(std::uint32_t point);
    std::span<const std::uint32_t> rings_across(std::uint32_t edge);
    std::optional<Problem> crossing(const Crossed& a, const Crossed& b) const;
    std::string name(std::uint32_t tag) const;
    std::uint32_t ring_of(std::uint32_t tag) const;

    std::span<const std::span<const Vec2>> rings_;
    Triangulation& result_;
    std::vector<Vec2>& points_;
    std::vector<std::uint32_t> first_tags_;  ///< one a ring, and the end
    std::vector<std::uint32_t> numbers_;     ///< one an input point: where it is among the sorted ones
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> first_edges_;  ///< one a point: of those that start there
    std::vector<Status::iterator> ending_;    ///< one a point: of the edges crossed one that ends there, or none known
    Status::iterator status_end_;
    std::vector<std::uint32_t> starting_;
    std::vector<std::uint32_t> across_;
    std::vector<bool> works_;  ///< one a ring: whether it bounds what is left
    Coverages coverages_;
};

std::uint32_t Sweep::ring_of(std::uint32_t tag) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first_tags_, tag) - first_tags_.begin() - 1);
}

std::string Sweep::name(std::uint32_t tag) const {
    const std::uint32_t ring = ring_of(tag);
    return std::to_string(tag - first_tags_[ring]) +
           (ring == 0 ? " of the outline" : " of hole " + std::to_string(ring - 1));
}

std::optional<Problem> Sweep::number_points() {
    std::size_t count = 0;
    for (const std::span<const Vec2> ring : rings_) {
        first_tags_.push_back(static_cast<std::uint32_t>(count));
        count += ring.size();
        if (count >= none / 8) return Problem{ProblemCode::too_large, "there are too many points", 0};
    }
    first_tags_.push_back(static_cast<std::uint32_t>(count));

    struct Given {
        Vec2 point;
        std::uint32_t tag;
    };
    std::vector<Given> places;
    places.reserve(count);
    for (const std::span<const Vec2> ring : rings_)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto tag = static_cast<std::uint32_t>(places.size());
            if (!is_finite(ring[i]))
                return Problem{ProblemCode::not_finite, "point " + name(tag) + " is not finite", i};
            places.push_back({ring[i] + Vec2(0.0f), tag});
        }
    std::ranges::sort(places, [](const Given& a, const Given& b) {
        if (a.point.x != b.point.x) return a.point.x < b.point.x;
        if (a.point.y != b.point.y) return a.point.y < b.point.y;
        return a.tag < b.tag;
    });
    numbers_.resize(count);
    points_.reserve(count);
    for (const Given& place : places) {
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
    first_edges_.assign(points_.size(), none);
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

/// Those that start from a point, from the lowest up, each direction once: what is longer goes on where the shorter
/// ends.
void Sweep::order_starting(std::uint32_t point) {
    const auto turn = [&](std::uint32_t a, std::uint32_t b) {
        if (edges_[a].right == edges_[b].right) return 0;
        return orientation(points_[point], points_[edges_[a].right], points_[edges_[b].right]);
    };
    starting_.clear();
    for (std::uint32_t edge = first_edges_[point]; edge != none; edge = edges_[edge].next) starting_.push_back(edge);
    std::ranges::sort(starting_, [&](std::uint32_t a, std::uint32_t b) {
        const int side = turn(a, b);
        if (side != 0) return side > 0;
        return edges_[a].right != edges_[b].right ? edges_[a].right < edges_[b].right : a < b;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < starting_.size(); ++i) {
        const std::uint32_t edge = starting_[i];
        if (kept == 0 || turn(starting_[kept - 1], edge) != 0) {
            starting_[kept++] = edge;
            continue;
        }
        const std::uint32_t first = starting_[kept - 1], right = edges_[first].right;
        std::uint32_t last = first;
        while (edges_[last].along != none) last = edges_[last].along;
        for (std::uint32_t part = edge; part != none;) {
            const std::uint32_t following = edges_[part].along;
            edges_[part].along = none;
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
    starting_.resize(kept);
}

std::optional<Problem> Sweep::crossing(const Crossed& a, const Crossed& b) const {
    const auto side = [&](const Crossed& edge, std::uint32_t point) {
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

/// The edge without what runs along it there and back: the rings that change across it.
std::span<const std::uint32_t> Sweep::rings_across(std::uint32_t edge) {
    across_.clear();
    for (; edge != none; edge = edges_[edge].along) across_.push_back(ring_of(edges_[edge].tag));
    if (across_.size() == 1) return across_;
    std::ranges::sort(across_);
    std::size_t kept = 0;
    for (const std::uint32_t ring : across_)
        if (kept > 0 && across_[kept - 1] == ring)
            --kept;
        else
            across_[kept++] = ring;
    across_.resize(kept);
    return across_;
}

/// The edges that end in a point or go through it. They are neighbours; mostly one of them is known.
std::pair<Sweep::Status::iterator, Sweep::Status::iterator> Sweep::through(const Place& place,
                                                                           const Status& status) const {
    auto from = ending_[place.point];
    if (from == status.end()) from = status.lower_bound(place);
    auto to = from;
    while (from != status.begin() && Below::side(*std::prev(from), place) == 0) --from;
    while (to != status.end() && Below::side(*to, place) == 0) ++to;
    return {from, to};
}

void Sweep::split_passing(Status::iterator from, Status::iterator to, std::uint32_t point) {
    for (auto i = from; i != to; ++i)
        if (i->right != point) {
            ++result_.touching_points;
            if (ending_[i->right] == i) ending_[i->right] = status_end_;
            for (std::uint32_t edge = i->edge; edge != none; edge = edges_[edge].along) {
                edges_.push_back({point, edges_[edge].right, edges_[edge].tag});
                start(static_cast<std::uint32_t>(edges_.size() - 1));
            }
        }
}

std::optional<Problem> Sweep::visit(std::uint32_t point, Status& status, Chains& chains) {
    const Place place{point, points_[point]};
    const auto [from, to] = through(place, status);
    split_passing(from, to, point);
    order_starting(point);

    const bool any_ends = from != to;
    const auto below = from == status.begin() ? status.end() : std::prev(from);
    const std::uint32_t coverage_below = below == status.end() ? Coverages::nothing : below->coverage;
    const bool solid_below = coverages_.solid(coverage_below);
    std::uint32_t coverage_above = coverage_below;
    Chain above;
    if (any_ends) {
        const auto highest = std::prev(to);
        for (auto i = from; i != highest; ++i)
            if (coverages_.solid(i->coverage)) chains.add_on_top(i->chain, point);
        coverage_above = highest->coverage;
        above = highest->chain;
        if (solid_below) chains.add_on_top(below->chain, point);
        if (coverages_.solid(coverage_above)) chains.add_at_bottom(above, point);
    }
    const auto next = status.erase(from, to);

    std::uint32_t coverage = coverage_below;
    auto highest = status.end();
    for (const std::uint32_t edge : starting_) {
        const std::span<const std::uint32_t> rings = rings_across(edge);
        if (rings.empty()) {
            ++result_.cancelled_edges;
            continue;
        }
        const bool was_solid = coverages_.solid(coverage);
        for (const std::uint32_t ring : rings) coverage = coverages_.toggled(coverage, ring);
        const bool is_solid = coverages_.solid(coverage);
        if (was_solid != is_solid)
            for (const std::uint32_t ring : rings) works_[ring] = true;
        const bool is_first = highest == status.end();
        const std::uint32_t right = edges_[edge].right;
        highest = status.insert(next, {edge, point, right, points_[point], points_[right], coverage});
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
    highest->coverage = coverage_above;
    highest->chain = above;
    return next == status.end() ? std::nullopt : crossing(*highest, *next);
}

std::optional<Problem> Sweep::run() {
    if (auto problem = number_points()) return problem;
    add_edges();
    result_.origins.reserve(6 * result_.points.size());
    result_.twins.reserve(6 * result_.points.size());
    works_.assign(rings_.size(), false);
    std::pmr::monotonic_buffer_resource memory;
    Status status(&memory);
    status_end_ = status.end();
    ending_.assign(points_.size(), status_end_);
    Chains chains(result_);
    for (std::uint32_t point = 0; point < points_.size(); ++point)
        if (auto problem = visit(point, status, chains)) return problem;
    for (std::size_t hole = 1; hole < rings_.size(); ++hole)
        if (!works_[hole] && !rings_[hole].empty()) ++result_.idle_holes;
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
