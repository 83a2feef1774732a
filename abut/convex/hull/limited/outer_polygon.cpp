#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>

namespace abut::detail {
namespace {

constexpr int max_rounds = 40;
constexpr std::size_t max_chosen_edges = 12, pool = 32;

/// One of the remaining lines, in a ring.
struct Line {
    DVec<2> direction{0.0};             ///< of length 1, the inner loop to its left
    DVec<2> start{0.0};                 ///< the intersection with the line before
    std::uint32_t first = 0, last = 0;  ///< the corners of the inner loop on it: two neighbours, or one
    std::uint32_t before = 0, after = 0;
    std::uint32_t version = 0;
    bool alive = true;
};

class OuterPolygon {
public:
    explicit OuterPolygon(std::span<const DVec<2>> inner) : inner_(inner), lines_(inner.size()), count_(inner.size()) {
        const auto size = static_cast<std::uint32_t>(inner.size());
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t end = next(i);
            lines_[i] = {normalized(inner[end] - inner[i]), inner[i], i, end, i == 0 ? size - 1 : i - 1, end};
        }
    }

    void reduce(std::size_t count);
    void choose(std::size_t count);
    void tighten();
    std::vector<DVec<2>> corners() const;
    std::size_t count() const { return count_; }

private:
    struct Removal {
        double area;
        std::uint32_t line, version;
    };
    struct HigherCost {
        bool operator()(const Removal& a, const Removal& b) const {
            return a.area != b.area ? a.area > b.area : a.line > b.line;
        }
    };
    /// The direction along the inner loop in which a line has to roll.
    enum class Roll { back, here, on };
    /// A line between two others, and its end.
    struct Cut {
        Line line;
        Roll roll;
        DVec<2> to{0.0};
    };

    std::uint32_t next(std::uint32_t i) const { return i + 1 == inner_.size() ? 0 : i + 1; }
    std::uint32_t some_line() const;
    std::optional<DVec<2>> apex_over(std::uint32_t line) const;
    void push(std::uint32_t line);
    void remove(std::uint32_t line, const DVec<2>& apex);
    void find_touched(Line& line) const;
    void make_triangle();
    Cut cut_along(const Line& before, const Line& after, std::uint32_t edge) const;
    double put_best(std::uint32_t line);

    std::span<const DVec<2>> inner_;
    std::vector<Line> lines_;
    std::size_t count_;
    std::priority_queue<Removal, std::vector<Removal>, HigherCost> queue_;
};

std::uint32_t OuterPolygon::some_line() const {
    std::uint32_t result = 0;
    while (!lines_[result].alive) ++result;
    return result;
}

/// The intersection of a line's neighbours beyond it; nothing if there is none.
std::optional<DVec<2>> OuterPolygon::apex_over(std::uint32_t line) const {
    const Line &before = lines_[lines_[line].before], &after = lines_[lines_[line].after];
    const DVec<2>&a = lines_[line].start, &b = after.start;
    const double turn = cross(before.direction, after.direction);
    const double rise = cross(b - a, after.direction);
    // If all three are equal but for rounding, any point will do.
    if (std::abs(turn) < 1e-14 && dot(before.direction, after.direction) > 0) return (a + b) * 0.5;
    if (!(turn > 1e-9) && !(dot(before.direction, after.direction) > 0 && turn > 0)) return std::nullopt;
    return a + before.direction * std::max(0.0, rise / turn);
}

void OuterPolygon::push(std::uint32_t line) {
    ++lines_[line].version;
    const std::optional<DVec<2>> apex = apex_over(line);
    if (!apex) return;
    const DVec<2>&a = lines_[line].start, &b = lines_[lines_[line].after].start;
    queue_.push({std::abs(cross(*apex - a, b - a)), line, lines_[line].version});
}

void OuterPolygon::remove(std::uint32_t line, const DVec<2>& apex) {
    Line& gone = lines_[line];
    gone.alive = false;
    lines_[gone.before].after = gone.after;
    lines_[gone.after].before = gone.before;
    lines_[gone.after].start = apex;
    --count_;
}

void OuterPolygon::reduce(std::size_t count) {
    for (std::uint32_t i = 0; i < lines_.size(); ++i)
        if (lines_[i].alive) push(i);
    while (count_ > count && count_ > 4 && !queue_.empty()) {
        const Removal next = queue_.top();
        queue_.pop();
        const Line& line = lines_[next.line];
        if (!line.alive || line.version != next.version) continue;
        remove(next.line, *apex_over(next.line));
        for (const std::uint32_t changed :
             {line.before, line.after, lines_[line.before].before, lines_[line.after].after})
            push(changed);
    }
    if (count == 3 && count_ == 4) make_triangle();
}

/// Chooses the `count` lines of minimum area, all along edges of the inner loop, by dynamic programming from each
/// possible first line.
void OuterPolygon::choose(std::size_t count) {
    constexpr double never = std::numeric_limits<double>::max();
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < lines_.size(); ++i)
        if (lines_[i].alive) numbers.push_back(i);
    const std::size_t size = numbers.size();
    const auto line = [&](std::size_t i) -> const Line& { return lines_[numbers[i % size]]; };

    // Twice the area between two lines and the inner loop.
    std::vector<double> around(inner_.size() + 1, 0);
    for (std::uint32_t i = 0; i < inner_.size(); ++i) around[i + 1] = around[i] + cross(inner_[i], inner_[next(i)]);
    std::vector<double> between(size * size, never);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = i + 1; j < i + size; ++j) {
            const DVec<2>&a = inner_[line(i).last], &b = inner_[line(j).first];
            const double turn = cross(line(i).direction, line(j).direction);
            if (!(turn > 1e-9)) continue;
            const DVec<2> apex = a + line(i).direction * (cross(b - a, line(j).direction) / turn);
            double outline = around[line(j).first] - around[line(i).last];
            if (line(j).first < line(i).last) outline += around.back();
            between[i * size + j % size] = cross(a, apex) + cross(apex, b) - outline;
        }

    double min_area = never;
    std::vector<std::size_t> best;
    std::vector<double> cost(count * size);
    std::vector<std::size_t> from(count * size);
    for (std::size_t start = 0; start + count <= size; ++start) {
        std::fill(cost.begin(), cost.end(), never);
        cost[start] = 0;
        for (std::size_t step = 1; step < count; ++step)
            for (std::size_t i = start; i < size; ++i) {
                const double so_far = cost[(step - 1) * size + i];
                if (!(so_far < min_area)) continue;
                for (std::size_t j = i + 1; j < size; ++j) {
                    const double more = between[i * size + j];
                    if (more == never || !(so_far + more < cost[step * size + j])) continue;
                    cost[step * size + j] = so_far + more;
                    from[step * size + j] = i;
                }
            }
        for (std::size_t last = start; last < size; ++last) {
            const double so_far = cost[(count - 1) * size + last], more = between[last * size + start];
            if (so_far == never || more == never || !(so_far + more < min_area)) continue;
            min_area = so_far + more;
            best.assign(count, last);
            for (std::size_t step = count - 1; step > 0; --step) best[step - 1] = from[step * size + best[step]];
        }
    }
    if (best.empty()) return;
    std::vector<bool> chosen(lines_.size(), false);
    for (const std::size_t i : best) chosen[numbers[i]] = true;
    for (const std::uint32_t number : numbers)
        if (!chosen[number]) remove(number, lines_[number].start);
    for (const std::size_t i : best) {
        Line& here = lines_[numbers[i]];
        const Line& before = lines_[here.before];
        const DVec<2> offset = inner_[here.first] - inner_[before.last];
        here.start = inner_[before.last] +
                     before.direction * (cross(offset, here.direction) / cross(before.direction, here.direction));
    }
}

/// The corner of the inner loop farthest outside of a line, or the edge along it.
void OuterPolygon::find_touched(Line& line) const {
    std::uint32_t touched = 0;
    for (std::uint32_t i = 1; i < inner_.size(); ++i)
        if (cross(line.direction, inner_[i] - inner_[touched]) < 0) touched = i;
    const auto along = [&](std::uint32_t from, std::uint32_t to) {
        const DVec<2> edge = inner_[to] - inner_[from];
        return std::abs(cross(line.direction, edge)) <= 1e-12 * length(edge);
    };
    const std::uint32_t before = touched == 0 ? static_cast<std::uint32_t>(inner_.size()) - 1 : touched - 1;
    line.first = along(before, touched) ? before : touched;
    line.last = along(touched, next(touched)) ? next(touched) : touched;
}

/// Replaces four corners by three: two adjacent edges stay, and the third edge has the opposite corner as its midpoint,
/// or runs along one of the other two edges. It takes the smallest area.
void OuterPolygon::make_triangle() {
    const std::vector<DVec<2>> quad = corners();
    double min_area = std::numeric_limits<double>::max();
    std::array<DVec<2>, 3> best{};
    const auto offer = [&](const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
        const double area = cross(b - a, c - a);
        if (!(area < min_area)) return;
        min_area = area;
        best = {a, b, c};
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const DVec<2>& a = quad[i];
        const DVec<2> b = quad[(i + 1) % 4] - a, c = quad[(i + 2) % 4] - a, d = quad[(i + 3) % 4] - a;
        const double x = cross(c, d) / cross(b, d), y = cross(b, c) / cross(b, d);  // c = b x + d y
        if (x >= 0.5 && y >= 0.5) offer(a, a + b * (2 * x), a + d * (2 * y));
        const double turn = cross(b, c - d), along = cross(d, c - d) / turn;
        if (turn < 0 && along < std::numeric_limits<double>::max()) offer(a, a + b * along, a + d);
    }
    lines_.assign(3, {});
    for (std::uint32_t i = 0; i < 3; ++i) {
        const DVec<2> direction = normalized(best[(i + 1) % 3] - best[i]);
        lines_[i] = {direction, best[i], 0, 0, (i + 2) % 3, (i + 1) % 3};
        find_touched(lines_[i]);
    }
    count_ = 3;
}

/// The line along an edge of the inner loop, between its two neighbours.
OuterPolygon::Cut OuterPolygon::cut_along(const Line& before, const Line& after, std::uint32_t edge) const {
    const DVec<2>& origin = inner_[edge];
    const DVec<2> direction = inner_[next(edge)] - origin;
    const double in = cross(before.direction, direction), out = cross(direction, after.direction);
    if (!(in > 0)) return {{}, Roll::back};
    if (!(out > 0)) return {{}, Roll::on};
    const DVec<2> from = before.start + before.direction * (cross(origin - before.start, direction) / in);
    const DVec<2> to = origin + direction * (cross(after.start - origin, after.direction) / out);
    const double middle = dot((from + to) * 0.5 - origin, direction);
    const Roll roll = middle < 0 ? Roll::back : middle > length_squared(direction) ? Roll::on : Roll::here;
    return {{normalized(direction), from, edge, next(edge)}, roll, to};
}

/// Moves a line between its neighbours to the minimum area, and returns the gain.
double OuterPolygon::put_best(std::uint32_t line) {
    Line& here = lines_[line];
    Line &before = lines_[here.before], &after = lines_[here.after];
    const double turn = cross(before.direction, after.direction);
    if (std::abs(turn) < 1e-9) return 0;
    const DVec<2> apex = before.start + before.direction * (cross(after.start - before.start, after.direction) / turn);

    // The line rolls along the inner loop until it touches with its midpoint.
    const auto size = static_cast<std::uint32_t>(inner_.size());
    std::uint32_t low = 0, high = (after.first + size - before.last) % size;
    std::optional<Cut> found;
    while (low < high && !found) {
        const std::uint32_t middle = low + (high - low) / 2;
        const Cut cut = cut_along(before, after, (before.last + middle) % size);
        if (cut.roll == Roll::here) found = cut;
        if (cut.roll == Roll::back) high = middle;
        if (cut.roll == Roll::on) low = middle + 1;
    }
    if (!found) {
        const std::uint32_t touched = (before.last + low) % size;
        const DVec<2> seen = inner_[touched] - apex;  // before.direction x + after.direction y
        const double x = cross(seen, after.direction) / turn, y = cross(before.direction, seen) / turn;
        const DVec<2> from = apex + before.direction * (2 * x), to = apex + after.direction * (2 * y);
        const DVec<2>&previous = inner_[(touched + size - 1) % size], &at = inner_[touched];
        if (from == to || !(cross(at - previous, to - from) >= 0) ||
            !(cross(to - from, inner_[next(touched)] - at) >= 0))
            return 0;
        found = Cut{{normalized(to - from), from, touched, touched}, Roll::here, to};
    }
    const double gain =
        cross(after.start - apex, here.start - apex) * -1 - cross(found->to - apex, found->line.start - apex) * -1;
    if (!(gain > 0)) return 0;
    here.direction = found->line.direction;
    here.start = found->line.start;
    here.first = found->line.first;
    here.last = found->line.last;
    after.start = found->to;
    return gain;
}

void OuterPolygon::tighten() {
    for (int round = 0; round < max_rounds; ++round) {
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

std::vector<DVec<2>> OuterPolygon::corners() const {
    std::vector<DVec<2>> result;
    const std::uint32_t first = some_line();
    std::uint32_t line = first;
    do {
        result.push_back(lines_[line].start);
        line = lines_[line].after;
    } while (line != first);
    return result;
}

}  // namespace

std::vector<DVec<2>> outer_polygon(std::span<const DVec<2>> loop, std::size_t count) {
    OuterPolygon outer(loop);
    if (count <= max_chosen_edges) {
        outer.reduce(std::max<std::size_t>(pool, count));
        if (outer.count() > count) outer.choose(count);
    }
    outer.reduce(count);
    outer.tighten();
    return outer.corners();
}

}  // namespace abut::detail
