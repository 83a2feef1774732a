#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/detail/solid/move_cover.hpp>
#include <abut/query/detail/solid/slide_interval.hpp>
#include <abut/query/raycast.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace abut::detail {
namespace {

/// A ball inside a solid.
struct InnerBall {
    DVec<3> center{0.0};
    double radius = 0;
};

Vec3 middle_of(const Corners& t) {
    return to_float((t[0] + t[1] + t[2]) / 3.0);
}

/// The ball around the middle of a chord that begins at a triangle.
std::optional<InnerBall> inner_ball(const View<3>& shape, const PlacedSolid& solid, std::uint32_t triangle,
                                    double extent) {
    const Corners t = solid.corners(triangle);
    const Vec3 inward = to_float(normalized<3>(cross(t[2] - t[0], t[1] - t[0])));
    const Vec3 start = middle_of(t) + inward * static_cast<float>(1e-4 * extent);
    const std::optional<Hit<3>> end = raycast(Ray3{start, inward, static_cast<float>(extent)}, shape);
    if (!end) return std::nullopt;
    const Vec3 center = start + inward * (0.5f * end->distance);
    if (solid.side_of(DVec<3>(center)) != PointSide::inside) return std::nullopt;
    const float radius = std::abs(closest(shape, Ball<3>{center, 0}).distance);
    if (!(radius > 0)) return std::nullopt;
    return InnerBall{DVec<3>(center), static_cast<double>(radius) * (1 - 1e-4)};
}

/// Balls inside a solid, behind triangles evenly spread over their order.
template <std::size_t N>
std::size_t find_inner_balls(const View<3>& shape, const PlacedSolid& solid, std::array<InnerBall, N>& balls) {
    const double extent = length(DVec<3>(solid.box().max) - DVec<3>(solid.box().min));
    std::size_t count = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const auto triangle = static_cast<std::uint32_t>(i * solid.triangle_count() / N);
        if (const std::optional<InnerBall> ball = inner_ball(shape, solid, triangle, extent)) balls[count++] = *ball;
    }
    return count;
}

}  // namespace

void MoveCover::add_balls(const View<3>& shape_a, const View<3>& shape_b) {
    std::array<InnerBall, max_inner> inner_a, inner_b;
    const std::size_t count_a = find_inner_balls(surface_view(shape_a), a_, inner_a),
                      count_b = find_inner_balls(surface_view(shape_b), b_, inner_b);
    for (std::size_t i = 0; i < count_a; ++i)
        for (std::size_t j = 0; j < count_b; ++j) {
            const DVec<3> center = inner_a[i].center - inner_b[j].center;
            const double radius = inner_a[i].radius + inner_b[j].radius;
            if (is_in_ball(center, radius)) continue;
            x_[ball_count_] = center.x;
            y_[ball_count_] = center.y;
            z_[ball_count_] = center.z;
            radius_[ball_count_] = radius;
            beyond_[ball_count_++] = length_squared(center) - radius * radius;
            min_distance_ = std::max(min_distance_, radius - length(center));
        }
}

void MoveCover::add_pair(std::uint32_t triangle_a, std::uint32_t triangle_b) {
    const Corners a = a_.corners(triangle_a), b = b_.corners(triangle_b);
    const DVec<3> middle_a = (a[0] + a[1] + a[2]) / 3.0, middle_b = (b[0] + b[1] + b[2]) / 3.0;
    double radius_a = 0, radius_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        radius_a = std::max(radius_a, length(a[i] - middle_a));
        radius_b = std::max(radius_b, length(b[i] - middle_b));
    }
    pairs_[next_pair_] = {triangle_a, triangle_b, {middle_a - middle_b, radius_a + radius_b}};
    next_pair_ = (next_pair_ + 1) % max_pairs;
    pair_count_ = std::min(pair_count_ + 1, max_pairs);
}

bool MoveCover::has_ball_between(const DVec<3>& first, const DVec<3>& last, double limit) {
    if (limit != limit_of_caps_) {
        limit_of_caps_ = limit;
        cap_count_ = 0;
        for (std::size_t i = 0; i < ball_count_; ++i) {
            const double beyond = beyond_[i];
            if (beyond < 0)
                caps_[cap_count_++] = {static_cast<std::uint32_t>(i), (limit * limit + beyond) / (2 * limit)};
        }
    }
    // The sector is in the hull of 0, both ends and the point where the tangents at the ends meet.
    const bool is_arc = first != last;
    const DVec<3> sum = first + last;
    const double tip_scale = is_arc ? 2 * limit / length_squared(sum) : 0;
    const DVec<3> tip = sum * tip_scale;
    for (std::size_t i = 0; i < cap_count_; ++i) {
        const std::size_t ball = caps_[i].ball;
        const DVec<3> middle = center(ball);
        if (!(dot(first, middle) > caps_[i].min_along)) continue;
        if (is_arc &&
            !(dot(last, middle) > caps_[i].min_along && length_squared(tip) - 2 * dot(tip, middle) + beyond_[ball] < 0))
            continue;
        // Neighbouring directions are in one ball.
        std::swap(caps_[i], caps_[i / 2]);
        return true;
    }
    return false;
}

double MoveCover::end_of_balls_between(const DVec<3>& first, const DVec<3>& last, double limit) {
    if (ball_count_ == 0) return 0;
    if (has_ball_between(first, last, limit)) return limit;
    const DVec<3> middle = first == last ? first : normalized<3>(first + last);
    set_spans(middle, length(first - middle) * limit);
    return end_of_balls(0, 0);
}

void MoveCover::leave(const DVec<3>& direction, double step, double limit, double& distance, DVec<3>& normal) {
    if (distance == 0) set_spans(direction);
    for (bool goes_on = true; goes_on && distance < limit;) {
        goes_on = false;
        const double end = end_of_balls(distance, step);
        if (end > distance) normal = DVec<3>(0.0);
        distance = end;
        for (std::size_t i = 0; i < pair_count_ && distance < limit; ++i) {
            const auto& [a, b, around] = pairs_[i];
            if (length_squared(direction * distance - around.center) >= around.radius * around.radius) continue;
            SlideInterval slide;
            const SlideRange range{distance == 0 ? 0 : distance - step, distance + 2 * step};
            if (!slide_interval(a_.corners(a), b_.corners(b), direction, range, slide)) continue;
            distance = slide.to;
            normal = slide.exit_normal;
            goes_on = true;
        }
    }
}

bool MoveCover::has_ball_at(const DVec<3>& move) const {
    const double squared = length_squared(move);
    for (std::size_t i = 0; i < ball_count_; ++i)
        if (squared - 2 * (x_[i] * move.x + y_[i] * move.y + z_[i] * move.z) + beyond_[i] < 0) return true;
    return false;
}

bool MoveCover::has_pair_at(const DVec<3>& direction, double distance, double step) {
    const DVec<3> move = direction * distance;
    for (std::size_t i = 0; i < pair_count_; ++i) {
        const auto& [a, b, around] = pairs_[i];
        if (length_squared(move - around.center) >= around.radius * around.radius) continue;
        SlideInterval slide;
        if (!slide_interval(a_.corners(a), b_.corners(b), direction, {distance - step, distance + step}, slide))
            continue;
        std::swap(pairs_[i], pairs_[i / 2]);
        return true;
    }
    return false;
}

bool MoveCover::is_in_ball(const DVec<3>& middle, double radius) const {
    for (std::size_t i = 0; i < ball_count_; ++i) {
        const double between = radius_[i] - radius;
        if (between >= 0 && length_squared(middle - center(i)) <= between * between) return true;
    }
    return false;
}

void MoveCover::set_spans(const DVec<3>& direction, double smaller) {
    for (std::size_t i = 0; i < ball_count_; ++i) {
        const double along = x_[i] * direction.x + y_[i] * direction.y + z_[i] * direction.z;
        const double lost = smaller < radius_[i] ? smaller * (2 * radius_[i] - smaller) : radius_[i] * radius_[i];
        const double half = square_root(std::max(0.0, along * along - beyond_[i] - lost));
        from_[i] = along - half;
        to_[i] = along + half;
    }
}

double MoveCover::end_of_balls(double from, double step) const {
    for (double end = from;;) {
        double farther = end;
        for (std::size_t i = 0; i < ball_count_; ++i) farther = std::max(farther, from_[i] < end ? to_[i] : end);
        if (!(farther > end + step)) return farther;
        end = farther;
    }
}

}  // namespace abut::detail
