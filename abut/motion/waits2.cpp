// Guibas, Yao, "On translating a set of rectangles" (1980), for any convex shapes: a line parallel to the direction
// sweeps over the plane, and knows in which order the shapes on it lie above one another. A shape that begins is told
// with its neighbours on the line. Whatever lies above another at some place does so by a chain of such pairs: one that
// ends was above what is below it, and below what is above.

#include <abut/motion/waits.hpp>

#include <algorithm>
#include <set>

namespace abut {
namespace {

/// What stands for a shape: a line of two pieces through it, from its leftmost point to its rightmost, by way of one
/// well inside. Of two shapes that don't overlap the one whose line is higher, at any place that both lines cover, is
/// above the other; and even where the shapes touch all along a side, the lines don't. Here y is the way up.
struct Spine {
    DVec<2> left, middle, right;

    double height(double x) const {
        const DVec<2>&a = x < middle.x ? left : middle, &b = x < middle.x ? middle : right;
        const double width = b.x - a.x;
        return width > 0 ? a.y + (b.y - a.y) * ((x - a.x) / width) : middle.y;
    }
    /// No wider than a line: a point, or a segment along the direction.
    bool has_no_width() const { return !(left.x < right.x); }
};

Spine spine_of(const Convex<2>& shape, const DVec<2>& right, const DVec<2>& up) {
    const auto seen = [&](const DVec<2>& point) { return DVec<2>(dot(point, right), dot(point, up)); };
    const DVec<2> first = support(shape, right * -1.0), last = support(shape, right);
    const DVec<2> along = last - first;
    const DVec<2> across = normalized(DVec<2>(-along.y, along.x), up);
    const DVec<2> side = support(shape, across), other_side = support(shape, across * -1.0);
    return {seen(first), seen((first + last + side + other_side) * 0.25), seen(last)};
}

/// Whether i is below j, for two that the line crosses at the same time. Told in the middle of what they have in
/// common, where rounding matters least.
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

/// In this order at one place, so that shapes side by side are never on the line together, while one without width is
/// on it with those that lie to both sides of it.
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
            // Comes, and goes when all others at this place have come.
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

std::vector<Wait> waits(std::span<const Convex<2>> shapes, const DVec<2>& up) {
    const DVec<2> right(up.y, -up.x);
    std::vector<Spine> spines;
    spines.reserve(shapes.size());
    for (const Convex<2>& shape : shapes) spines.push_back(spine_of(shape, right, up));

    std::vector<Wait> result;
    Order on_line{Below(spines)};
    std::vector<Order::iterator> place(shapes.size(), on_line.end());
    const auto put = [&](std::uint32_t shape) {
        const auto here = on_line.insert(shape).first, above = std::next(here);
        place[shape] = here;
        if (here != on_line.begin()) result.push_back({*std::prev(here), shape});
        if (above != on_line.end()) result.push_back({shape, *above});
    };
    const std::vector<Event> events = events_of(spines);
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (events[i].kind == EventKind::begins) put(events[i].shape);
        if (events[i].kind == EventKind::ends) on_line.erase(place[events[i].shape]);
        if (events[i].kind != EventKind::passes) continue;
        std::size_t end = i;
        while (end < events.size() && events[end].kind == EventKind::passes && events[end].x == events[i].x)
            put(events[end++].shape);
        for (std::size_t j = i; j < end; ++j) on_line.erase(place[events[j].shape]);
        i = end - 1;
    }
    return result;
}

}  // namespace abut
