#include <abut/broad_phase/bvh.hpp>
#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/support.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/order/projection.hpp>
#include <abut/motion/removal_order.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/detail/valid_query.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <set>
#include <span>
#include <vector>

namespace abut::detail {
namespace {

/// An edge of the precedence graph: `upper` has to be removed before `lower`.
struct Precedence {
    std::uint32_t lower, upper;
};

MovingBox<3> moving_box(const Aabb3& box, const DVec<3>& up, double length) {
    const DVec<3> min(box.min), max(box.max);
    return {(min + max) * 0.5, (max - min) * 0.5, up, length};
}

/// A polyline of two segments inside a shape, from its leftmost point via an interior point to its rightmost. Of two
/// shapes that don't overlap, the one with the higher spine at a common x is above the other. Spines of shapes that
/// touch along an edge don't touch. The direction is y.
struct Spine {
    DVec<2> left, middle, right;

    double height(double x) const {
        const DVec<2>&a = x < middle.x ? left : middle, &b = x < middle.x ? middle : right;
        const double width = b.x - a.x;
        return width > 0 ? a.y + (b.y - a.y) * ((x - a.x) / width) : middle.y;
    }
    /// True for a shape of no width: a point, or a segment along the direction.
    bool has_no_width() const { return !(left.x < right.x); }
};

Spine spine_of(const Convex<2>& shape, const DVec<2>& right, const DVec<2>& up) {
    const auto to_sweep_frame = [&](const DVec<2>& point) { return DVec<2>(dot(point, right), dot(point, up)); };
    const DVec<2> first = support(shape, right * -1.0), last = support(shape, right);
    const DVec<2> along = last - first;
    const DVec<2> across = normalized(DVec<2>(-along.y, along.x), up);
    const DVec<2> side = support(shape, across), other_side = support(shape, across * -1.0);
    return {to_sweep_frame(first), to_sweep_frame((first + last + side + other_side) * 0.25), to_sweep_frame(last)};
}

/// Orders two shapes that the sweep line crosses at the same time. It compares in the middle of their common interval,
/// where rounding matters least.
class Below {
public:
    explicit Below(const std::vector<Spine>& spines) : spines_(&spines) {}

    bool operator()(std::uint32_t i, std::uint32_t j) const {
        const Spine &a = (*spines_)[i], &b = (*spines_)[j];
        const double x = 0.5 * (std::max(a.left.x, b.left.x) + std::min(a.right.x, b.right.x));
        const double at_a = a.height(x), at_b = b.height(x);
        return at_a != at_b ? at_a < at_b : i < j;
    }

private:
    const std::vector<Spine>* spines_;
};

using Order = std::set<std::uint32_t, Below>;

/// The order of events at one x: shapes that only share a boundary are never on the line together, and a shape without
/// width is on it with the shapes on both sides.
enum class EventKind : std::uint8_t { ends, passes, begins };

struct Event {
    double x;
    EventKind kind;
    std::uint32_t shape;
};

std::vector<Event> events_of(const std::vector<Spine>& spines) {
    std::vector<Event> events;
    events.reserve(2 * spines.size());
    for (std::uint32_t i = 0; i < spines.size(); ++i) {
        if (spines[i].has_no_width()) {
            // A shape without width is inserted and erased after all others at this x have been inserted.
            events.push_back({spines[i].left.x, EventKind::passes, i});
        } else {
            events.push_back({spines[i].left.x, EventKind::begins, i});
            events.push_back({spines[i].right.x, EventKind::ends, i});
        }
    }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        if (a.x != b.x) return a.x < b.x;
        return a.kind != b.kind ? a.kind < b.kind : a.shape < b.shape;
    });
    return events;
}

/// All edges, sorted by `lower`, then `upper`.
std::vector<Precedence> precedences(std::span<const Convex<3>> shapes, const DVec<3>& up) {
    const DVec<3> x = perpendicular(up), y = cross(up, x);
    std::vector<std::unique_ptr<const Projection>> projections;
    std::vector<Aabb3> boxes;
    Aabb3 all = Aabb3::empty();
    for (const Convex<3>& shape : shapes) {
        projections.push_back(std::make_unique<Projection>(shape, x, y));
        boxes.push_back(bounds(shape));
        all = merged(all, boxes.back());
    }
    Bvh<3> tree;
    tree.build(boxes);
    const double far = length(DVec<3>(all.max) - DVec<3>(all.min));

    const auto is_blocked_by = [&](std::uint32_t lower, std::uint32_t upper) {
        const Convex<3>&a = shapes[lower], &b = shapes[upper];
        if (!(dot(DVec<3>(closest(a, b).normal), up) > 0)) return false;
        return projected_depth(*projections[lower], *projections[upper]) > tolerance_for(a, b);
    };
    std::vector<Precedence> result;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const std::size_t first = result.size();
        tree.sweep(moving_box(boxes[i], up, far), [&](std::uint32_t j) {
            if (j != i && is_blocked_by(i, j)) result.push_back({i, j});
        });
        std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                  [](const Precedence& a, const Precedence& b) { return a.upper < b.upper; });
    }
    return result;
}

/// Edges whose transitive closure is the whole relation. `up` has length 1, all numbers are finite. O(n log n).
std::vector<Precedence> precedences(std::span<const Convex<2>> shapes, const DVec<2>& up) {
    const DVec<2> right(up.y, -up.x);
    std::vector<Spine> spines;
    spines.reserve(shapes.size());
    for (const Convex<2>& shape : shapes) spines.push_back(spine_of(shape, right, up));

    std::vector<Precedence> result;
    Order status{Below(spines)};
    std::vector<Order::iterator> place(shapes.size(), status.end());
    const auto insert = [&](std::uint32_t shape) {
        const auto here = status.insert(shape).first, above = std::next(here);
        place[shape] = here;
        if (here != status.begin()) result.push_back({*std::prev(here), shape});
        if (above != status.end()) result.push_back({shape, *above});
    };
    const std::vector<Event> events = events_of(spines);
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (events[i].kind == EventKind::begins) insert(events[i].shape);
        if (events[i].kind == EventKind::ends) status.erase(place[events[i].shape]);
        if (events[i].kind != EventKind::passes) continue;
        std::size_t end = i;
        while (end < events.size() && events[end].kind == EventKind::passes && events[end].x == events[i].x)
            insert(events[end++].shape);
        for (std::size_t j = i; j < end; ++j) status.erase(place[events[j].shape]);
        i = end - 1;
    }
    return result;
}

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

/// For each shape, the end `to` of every edge that has it as its end `from`.
Buckets adjacency_lists(std::size_t count, const std::vector<Precedence>& edges, std::uint32_t Precedence::*from,
                        std::uint32_t Precedence::*to) {
    return in_buckets(count, [&](auto add) {
        for (const Precedence& edge : edges) add(edge.*from, edge.*to);
    });
}

/// Follows the lowest blocker from shape to shape until one repeats.
std::vector<std::uint32_t> find_cycle(const Buckets& uppers, const std::vector<bool>& removed) {
    std::uint32_t at = 0;
    while (removed[at]) ++at;
    std::vector<std::uint32_t> path;
    for (std::size_t step = 0; step <= removed.size(); ++step) {
        const auto repeated = std::find(path.begin(), path.end(), at);
        if (repeated != path.end()) {
            path.erase(path.begin(), repeated);
            break;
        }
        path.push_back(at);
        std::uint32_t next = static_cast<std::uint32_t>(removed.size());
        for (const std::uint64_t upper : uppers.bucket(at))
            if (!removed[upper]) next = std::min(next, static_cast<std::uint32_t>(upper));
        at = next;
    }
    std::rotate(path.begin(), std::min_element(path.begin(), path.end()), path.end());
    return path;
}

/// Topological sort, lowest index first: Kahn, "Topological sorting of large networks" (1962). The result depends only
/// on the precedence relation, and not on which of its edges are listed.
RemovalOrder topological_order(std::size_t count, const std::vector<Precedence>& edges) {
    const Buckets lowers = adjacency_lists(count, edges, &Precedence::upper, &Precedence::lower);
    std::vector<std::size_t> blocker_count(count, 0);
    for (const Precedence& edge : edges) ++blocker_count[edge.lower];

    RemovalOrder result;
    result.order.reserve(count);
    std::vector<bool> removed(count, false);
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> free;
    for (std::uint32_t i = 0; i < count; ++i)
        if (blocker_count[i] == 0) free.push(i);
    while (!free.empty()) {
        const std::uint32_t next = free.top();
        free.pop();
        result.order.push_back(next);
        removed[next] = true;
        for (const std::uint64_t below : lowers.bucket(next))
            if (--blocker_count[below] == 0) free.push(static_cast<std::uint32_t>(below));
    }
    if (result.order.size() < count) {
        const Buckets uppers = adjacency_lists(count, edges, &Precedence::lower, &Precedence::upper);
        result.cycle = find_cycle(uppers, removed);
    }
    return result;
}

}  // namespace

template <int D>
RemovalOrder removal_order(std::span<const Convex<D>> shapes, const Vec<D>& direction) {
    detail::enter_library();
    const bool is_direction = is_finite(direction) && direction != Vec<D>(0);
    ABUT_ASSERT(is_direction);
    std::vector<Convex<D>> finite;
    std::vector<std::uint32_t> index;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        if (!detail::is_valid_query(shapes[i])) continue;
        finite.push_back(shapes[i]);
        index.push_back(i);
    }
    std::vector<Precedence> edges;
    if (is_direction) edges = precedences(finite, normalized(DVec<D>(direction)));
    for (Precedence& edge : edges) edge = {index[edge.lower], index[edge.upper]};
    return topological_order(shapes.size(), edges);
}

template RemovalOrder removal_order(std::span<const Convex<2>>, const Vec<2>&);
template RemovalOrder removal_order(std::span<const Convex<3>>, const Vec<3>&);

}  // namespace abut
