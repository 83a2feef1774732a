// Sweep line of Guibas, Yao, "On translating a set of rectangles" (1980), for any convex shapes. A line parallel to the
// direction sweeps the plane; its status is the order of the shapes on it from bottom to top. An inserted shape makes
// edges with its neighbours on the line. The relation "lies above" is the transitive closure of these edges.

#include <abut/motion/order/precedence.hpp>

#include <algorithm>
#include <set>

namespace abut::detail {
namespace {

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

}  // namespace

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

}  // namespace abut::detail
