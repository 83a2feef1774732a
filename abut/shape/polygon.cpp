#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/polygon_soa.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/polygon.hpp>

#include <algorithm>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr Vec2 origin2(0.0f);

/// Calls visit(a, b) for each triangle of the fan around the first vertex; a and b are relative to it.
template <class Visit>
void each_triangle(std::span<const Vec2> points, Visit visit) {
    const DVec<2> origin(points[0]);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        visit(DVec<2>(points[i]) - origin, DVec<2>(points[i + 1]) - origin);
}

void set_points(Convex<2>& convex, const Polygon& polygon) {
    const std::span<const Vec2> points = polygon.points();
    convex.points = points.data();
    convex.count = static_cast<std::uint32_t>(points.size());
    convex.sides = polygon.sides();
}

/// True if a loop is certain to be a hull loop: it starts at the lexicographically smallest vertex, turns left at each
/// vertex, winds once, and is clearly wider than the flatness tolerance and than `min_width`.
[[gnu::noinline]] bool is_hull_loop(std::span<const Vec2> loop, double min_width) {
    if (loop.size() < 3) return false;
    double area = 0;
    DVec<2> low(loop[0]), high(loop[0]);
    std::size_t x_reversals = 0;
    const DVec<2> first(loop[0]);
    DVec<2> from(loop.back()), at(loop[0]);
    bool was_right = at.x > from.x || (at.x == from.x && at.y > from.y);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec<2> to(loop[i + 1 == loop.size() ? 0 : i + 1]);
        const DVec<2> u = at - from, v = to - at;
        const double left = u.x * v.y, right = u.y * v.x;
        if (!(left - right > 1e-14 * (std::abs(left) + std::abs(right)))) return false;
        const bool is_right = v.x > 0 || (v.x == 0 && v.y > 0);
        x_reversals += is_right != was_right ? 1 : 0;
        was_right = is_right;
        area += cross(at - first, v);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        from = at;
        at = to;
    }
    for (const Vec2& corner : loop.subspan(1))
        if (corner.x < loop[0].x || (corner.x == loop[0].x && corner.y < loop[0].y)) return false;
    const double extent = std::max(high.x - low.x, high.y - low.y);
    return x_reversals == 2 && area > extent * std::max(16 * hull_tolerance * extent, min_width);
}

}  // namespace

Result<Polygon> Polygon::build(const PointSpan<2>& points) {
    return build(points, HullOptions());
}

Result<Polygon> Polygon::build(const PointSpan<2>& points, const HullOptions& options) {
    detail::enter_library();
    Result<Hull2> built = limited_hull(PackedPoints<2>(points).points(), options);
    if (!built) return built.problem();
    Polygon result;
    result.points_ = std::move(built->points);
    result.write_sides();
    return result;
}

Result<Polygon> Polygon::build(std::initializer_list<Vec2> points) {
    return build(std::span<const Vec2>(points.begin(), points.size()));
}

bool Polygon::set_outline(std::span<const Vec2> loop, double min_width) {
    detail::enter_library();
    if (!is_hull_loop(loop, min_width)) return false;
    points_.assign(loop.begin(), loop.end());
    write_sides();
    return true;
}

void Polygon::write_sides() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    const bool has_soa = count > 2 && count <= max_soa_edges;
    sides_.resize(has_soa ? soa_size(count) : 0);
    if (has_soa) abut::write_polygon_soa(points_, sides_.data());
}

std::span<const Vec2> Polygon::points() const {
    return points_.empty() ? std::span<const Vec2>(&origin2, 1) : std::span<const Vec2>(points_);
}

int Polygon::rank() const {
    return static_cast<int>(std::min<std::size_t>(points().size() - 1, 2));
}

double Polygon::area() const {
    detail::enter_library();
    double twice = 0;
    each_triangle(points(), [&](const DVec<2>& a, const DVec<2>& b) { twice += cross(a, b); });
    return 0.5 * twice;
}

Vec2 Polygon::centroid() const {
    detail::enter_library();
    const std::span<const Vec2> corners = points();
    const DVec<2> origin(corners[0]);
    if (rank() < 2) return to_float(0.5 * (origin + DVec<2>(corners.back())));
    double weight = 0;
    DVec<2> sum(0.0);
    each_triangle(corners, [&](const DVec<2>& a, const DVec<2>& b) {
        weight += cross(a, b);
        sum += cross(a, b) * (a + b);
    });
    return to_float(origin + sum / (3 * weight));
}

Vec2 Polygon::normal() const {
    detail::enter_library();
    const std::span<const Vec2> corners = points();
    DVec<2> longest(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const DVec<2> edge = DVec<2>(corners[(i + 1) % corners.size()]) - DVec<2>(corners[i]);
        if (length_squared(edge) > length_squared(longest)) longest = edge;
    }
    return to_float(normalized(DVec<2>(longest.y, -longest.x)));
}

Convex<2> convex(const Polygon& polygon, const Affine<2>& place) {
    Convex<2> result;
    set_points(result, polygon);
    result.place = place;
    return result;
}

Convex<2> convex(const Polygon& polygon, const Pose2& pose) {
    Convex<2> result;
    set_points(result, polygon);
    set_affine(result.place, pose);
    return result;
}

}  // namespace abut
