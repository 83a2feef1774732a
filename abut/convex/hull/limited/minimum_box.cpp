#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/limited/minimum_box.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace abut::detail {
namespace {

constexpr std::size_t refined = 3;
constexpr int max_rotations = 30;
constexpr double min_gain = 1e-7;

OrientedBox box_along(std::span<const DVec<3>> points, const std::array<DVec<3>, 3>& axes) {
    OrientedBox result{axes, DVec<3>(std::numeric_limits<double>::infinity()), DVec<3>(0.0)};
    result.high = -result.low;
    for (const DVec<3>& point : points)
        for (int i = 0; i < 3; ++i) {
            const double along = dot(result.axis(i), point);
            result.low[i] = std::min(result.low[i], along);
            result.high[i] = std::max(result.high[i], along);
        }
    return result;
}

/// The box rotated about one of its axes to the minimum volume.
OrientedBox rotated_about(std::span<const DVec<3>> points, const OrientedBox& box, int about) {
    const DVec<3>&up = box.axis(about), &right = box.axis((about + 1) % 3), &ahead = box.axis((about + 2) % 3);
    std::vector<DVec<2>> loop;
    for (const std::uint32_t i : silhouette(points, box, about))
        loop.emplace_back(dot(right, points[i]), dot(ahead, points[i]));
    if (loop.size() < 3) return box;
    const DVec<2> along = minimum_rectangle(loop);
    std::array<DVec<3>, 3> axes{up, normalized(right * along.x + ahead * along.y), DVec<3>(0.0)};
    axes[2] = cross(up, axes[1]);
    std::rotate(axes.begin(), axes.end() - about, axes.end());
    return box_along(points, axes);
}

OrientedBox shrunk(std::span<const DVec<3>> points, OrientedBox best) {
    int idle = 0;
    for (int turn = 0; turn < max_rotations && idle < 3; ++turn) {
        const OrientedBox next = rotated_about(points, best, turn % 3);
        const bool less = next.volume() < best.volume() * (1 - min_gain);
        idle = less ? 0 : idle + 1;
        if (less) best = next;
    }
    return best;
}

}  // namespace

DVec<2> minimum_rectangle(std::span<const DVec<2>> loop) {
    const std::size_t count = loop.size();
    const auto at = [&](std::size_t i) -> const DVec<2>& { return loop[i % count]; };
    DVec<2> best(1, 0);
    double min_area = std::numeric_limits<double>::infinity();
    std::size_t front = 1, top = 1, back = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const DVec<2> along = normalized(at(i + 1) - at(i));
        // The three calipers advance around the loop, each at most once.
        const auto turn = [&](std::size_t& caliper, auto height) {
            while (caliper < i + 2 * count && height(at(caliper + 1)) >= height(at(caliper))) ++caliper;
        };
        front = std::max(front, i + 1);
        turn(front, [&](const DVec<2>& p) { return dot(along, p); });
        top = std::max(top, front);
        turn(top, [&](const DVec<2>& p) { return cross(along, p); });
        back = std::max(back, top);
        turn(back, [&](const DVec<2>& p) { return -dot(along, p); });
        const double area = dot(along, at(front) - at(back)) * cross(along, at(top) - at(i));
        if (!(area < min_area)) continue;
        min_area = area;
        best = along;
    }
    return best;
}

double OrientedBox::volume() const {
    const DVec<3> size = high - low;
    return size.x * size.y * size.z;
}

DVec<3> OrientedBox::share(const DVec<3>& point) const {
    DVec<3> result;
    for (int i = 0; i < 3; ++i) result[i] = (dot(axis(i), point) - low[i]) / (high[i] - low[i]);
    return result;
}

DVec<3> OrientedBox::at(const DVec<3>& share) const {
    DVec<3> result(0.0);
    for (int i = 0; i < 3; ++i) result += axis(i) * (low[i] + (high[i] - low[i]) * share[i]);
    return result;
}

std::vector<std::uint32_t> silhouette(std::span<const DVec<3>> points, const OrientedBox& box, int up) {
    const int right = (up + 1) % 3, ahead = (up + 2) % 3;
    if (!(box.high[right] > box.low[right]) || !(box.high[ahead] > box.low[ahead])) return {};
    std::vector<Vec2> seen;
    for (const DVec<3>& point : points) {
        const DVec<3> share = box.share(point);
        seen.push_back(to_float(DVec<2>(share[right], share[ahead])));
    }
    return hull_loop(seen);
}

OrientedBox minimum_box(std::span<const DVec<3>> points, std::span<const DVec<3>> approximate,
                        std::span<const DVec<3>> normals) {
    std::vector<OrientedBox> boxes;
    for (const DVec<3>& normal : normals) {
        const DVec<3> side = perpendicular(normal);
        boxes.push_back(rotated_about(approximate, box_along(approximate, {normal, side, cross(normal, side)}), 0));
    }
    const auto less = [](const OrientedBox& a, const OrientedBox& b) { return a.volume() < b.volume(); };
    std::stable_sort(boxes.begin(), boxes.end(), less);
    boxes.resize(std::min(boxes.size(), refined));
    for (OrientedBox& box : boxes) box = shrunk(approximate, box);
    return shrunk(points, box_along(points, std::min_element(boxes.begin(), boxes.end(), less)->axes));
}

}  // namespace abut::detail
