#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/limited/minimum_box.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <utility>

namespace abut::detail {
namespace {

constexpr int max_tightenings = 40;

/// One of the remaining lines, in a ring.
struct Line {
    DVec<2> direction{0.0};             ///< of length 1, the inner loop to its left
    DVec<2> start{0.0};                 ///< the intersection with the line before
    std::uint32_t first = 0, last = 0;  ///< the extreme corners of the inner loop across it: two neighbours, or one
    std::uint32_t before = 0, after = 0;
    double cost = 0;  ///< the area that its removal adds
    bool alive = true;
};

class OuterPolygon {
public:
    /// The lines along the edges of `outer`, which contains the inner loop.
    OuterPolygon(std::span<const DVec<2>> inner, std::span<const DVec<2>> outer)
        : inner_(inner), lines_(outer.size()), count_(outer.size()) {
        const auto size = static_cast<std::uint32_t>(outer.size());
        std::uint32_t touched = farthest_of(inner, [&](const DVec<2>& p) { return cross(p, outer[1] - outer[0]); });
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t end = i + 1 == size ? 0 : i + 1;
            lines_[i] = {normalized(outer[end] - outer[i]), outer[i], 0, 0, i == 0 ? size - 1 : i - 1, end};
            const auto rise = [&](std::uint32_t from) {
                return cross(lines_[i].direction, normalized(inner_[next(from)] - inner_[from]));
            };
            constexpr double level = 1e-12;
            while (rise(touched) < -level) touched = next(touched);
            lines_[i].first = touched;
            if (rise(touched) <= level) touched = next(touched);
            lines_[i].last = touched;
        }
    }

    /// Removes lines until `count` are left, or none of them has neighbours that intersect beyond it.
    void simplify(std::size_t count) {
        for (std::uint32_t i = 0; i < lines_.size(); ++i) push(i);
        while (count_ > count && !cheapest_.empty()) {
            const auto [cost, line] = cheapest_.top();
            cheapest_.pop();
            Line& gone = lines_[line];
            if (!gone.alive || gone.cost != cost) continue;
            lines_[gone.after].start = *apex_over(line);
            gone.alive = false;
            lines_[gone.before].after = gone.after;
            lines_[gone.after].before = gone.before;
            --count_;
            for (const std::uint32_t changed :
                 {gone.before, gone.after, lines_[gone.before].before, lines_[gone.after].after})
                push(changed);
        }
    }

    void tighten() {
        for (int round = 0; round < max_tightenings; ++round) {
            double gain = 0, size = 0;
            const std::uint32_t first = some_line();
            std::uint32_t line = first;
            do {
                gain += put_best(line);
                size = std::max(size, length_squared(lines_[line].start - lines_[first].start));
                line = lines_[line].after;
            } while (line != first);
            if (!(gain > 1e-6 * size)) return;
        }
    }

    Loop2 corners() const {
        Loop2 result;
        const std::uint32_t first = some_line();
        std::uint32_t line = first;
        do {
            result.push_back(lines_[line].start);
            line = lines_[line].after;
        } while (line != first);
        return result;
    }

    std::size_t count() const { return count_; }

private:
    std::uint32_t next(std::uint32_t i) const { return i + 1 == inner_.size() ? 0 : i + 1; }
    std::uint32_t some_line() const {
        std::uint32_t result = 0;
        while (!lines_[result].alive) ++result;
        return result;
    }

    /// The intersection of a line's neighbours beyond it; nothing if there is none.
    std::optional<DVec<2>> apex_over(std::uint32_t line) const {
        const Line &before = lines_[lines_[line].before], &after = lines_[lines_[line].after];
        const DVec<2>&a = lines_[line].start, &b = after.start;
        const double turn = cross(before.direction, after.direction);
        const double rise = cross(b - a, after.direction);
        // If all three are equal but for rounding, any point will do.
        if (std::abs(turn) < 1e-14 && dot(before.direction, after.direction) > 0) return (a + b) * 0.5;
        if (!(turn > 1e-9) && !(dot(before.direction, after.direction) > 0 && turn > 0)) return std::nullopt;
        return a + before.direction * std::max(0.0, rise / turn);
    }

    void push(std::uint32_t line) {
        const std::optional<DVec<2>> apex = apex_over(line);
        const DVec<2>&a = lines_[line].start, &b = lines_[lines_[line].after].start;
        lines_[line].cost = apex ? std::abs(cross(*apex - a, b - a)) : -1;
        if (apex) cheapest_.push({lines_[line].cost, line});
    }

    /// Moves a line between its neighbours to the minimum area, and returns the gain.
    double put_best(std::uint32_t line) {
        Line& here = lines_[line];
        Line &before = lines_[here.before], &after = lines_[here.after];
        const double turn = cross(before.direction, after.direction);
        if (std::abs(turn) < 1e-9) return 0;
        const DVec<2> apex =
            before.start + before.direction * (cross(after.start - before.start, after.direction) / turn);

        // The line rolls along the inner loop until it touches with its midpoint, in an edge or a corner.
        const auto size = static_cast<std::uint32_t>(inner_.size());
        std::uint32_t low = before.last, high = low + (after.first + size - low) % size;
        Line best;
        DVec<2> to(0.0);
        bool found = false;
        while (low < high && !found) {
            const std::uint32_t middle = low + (high - low) / 2, edge = middle % size;
            const DVec<2>& origin = inner_[edge];
            const DVec<2> along = inner_[next(edge)] - origin;
            const double in = cross(before.direction, along), out = cross(along, after.direction);
            best.start = before.start + before.direction * (cross(origin - before.start, along) / in);
            to = origin + along * (cross(after.start - origin, after.direction) / out);
            best.first = edge;
            best.last = next(edge);
            const double reach = dot((best.start + to) * 0.5 - origin, along);
            if (!(in > 0) || (out > 0 && reach < 0))
                high = middle;
            else if (!(out > 0) || reach > length_squared(along))
                low = middle + 1;
            else
                found = true;
        }
        if (!found) {
            best.first = best.last = low % size;
            const DVec<2>&previous = inner_[(low + size - 1) % size], &at = inner_[low % size];
            const DVec<2> seen = at - apex;  // before.direction x + after.direction y
            const double x = cross(seen, after.direction) / turn, y = cross(before.direction, seen) / turn;
            best.start = apex + before.direction * (2 * x);
            to = apex + after.direction * (2 * y);
            if (best.start == to || !(cross(at - previous, to - best.start) >= 0) ||
                !(cross(to - best.start, inner_[next(best.last)] - at) >= 0))
                return 0;
        }
        const double gain = cross(here.start - apex, after.start - apex) - cross(best.start - apex, to - apex);
        if (!(gain > 0)) return 0;
        here.direction = normalized(to - best.start);
        here.start = best.start;
        here.first = best.first;
        here.last = best.last;
        after.start = to;
        return gain;
    }

    std::span<const DVec<2>> inner_;
    std::vector<Line> lines_;
    std::size_t count_;
    using Removal = std::pair<double, std::uint32_t>;  ///< the cost of a line, and its number
    std::priority_queue<Removal, std::vector<Removal>, std::greater<>> cheapest_;
};

/// The corners whose edges have directions, and different ones, beyond rounding.
Loop2 distinct_corners(std::span<const DVec<2>> loop) {
    const auto is_straight = [](const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
        constexpr double rounding = 1e-12;
        const DVec<2> in = b - a, out = c - b;
        return length(in) <= rounding || length(out) <= rounding || cross(normalized(in), normalized(out)) <= rounding;
    };
    Loop2 result;
    const auto remove_straight = [&](const DVec<2>& next) {
        while (result.size() > 1 && is_straight(result[result.size() - 2], result.back(), next)) result.pop_back();
    };
    for (const DVec<2>& point : loop) {
        remove_straight(point);
        result.push_back(point);
    }
    remove_straight(result[0]);
    if (result.size() > 2 && is_straight(result.back(), result[0], result[1])) result.erase(result.begin());
    return result;
}

/// The minimum oriented rectangle, or a triangle of twice its area around it.
Loop2 rectangle_around(std::span<const DVec<2>> inner, bool as_triangle, const Affine<2>& seen) {
    Loop2 loop;
    for (const DVec<2>& point : inner) loop.push_back(seen.vector(point));
    const DVec<2> along = minimum_rectangle(loop), across(-along.y, along.x);
    const auto reach = [&](const DVec<2>& direction) {
        return dot(direction, loop[farthest_of(loop, [&](const DVec<2>& p) { return dot(direction, p); })]);
    };
    const double left = -reach(-along), low = -reach(-across);
    const DVec<2> corner = along * left + across * low, right = along * (reach(along) - left),
                  up = across * (reach(across) - low);
    loop = {corner, corner + right, corner + right + up, corner + up};
    if (as_triangle) loop = {corner, corner + right * 2.0, corner + up * 2.0};
    const Affine<2> back = inverse(seen, determinant(seen));
    for (DVec<2>& point : loop) point = back.vector(point);
    if (area_of(loop) < 0) std::reverse(loop.begin(), loop.end());
    return loop;
}

}  // namespace

double area_of(std::span<const DVec<2>> loop) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) twice += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
    return 0.5 * twice;
}

std::vector<Loop2> outer_polygons(std::span<const DVec<2>> loop, std::size_t count, const Affine<2>& seen) {
    const Loop2 inner = distinct_corners(loop);
    if (inner.size() < 3) return {};
    OuterPolygon simplified(inner, inner), rectangle(inner, rectangle_around(inner, count == 3, seen));
    simplified.simplify(count);
    std::vector<Loop2> result;
    for (OuterPolygon* polygon : {&simplified, &rectangle}) {
        if (polygon->count() > count) continue;
        polygon->tighten();
        result.push_back(polygon->corners());
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Loop2& a, const Loop2& b) { return area_of(a) < area_of(b); });
    return result;
}

}  // namespace abut::detail
