// Rays at balls, and in the plane at polygons of few sides, answered from the shapes as they were given, without views
// of them. What isn't plain, as where a ray grazes or begins on the surface, is left to the view.

#include <abut/convex/ray/closed_forms.hpp>
#include <abut/math/set_affine.hpp>
#include <abut/math/simd/double2-inl.h>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/polygon.hpp>

namespace abut {
namespace {

using lanes::Double2;

/// What a ball is begun outside of: its radius, and what may be rounding.
constexpr double outside = 1 + 4 * ray_tolerance;

// False where the answer isn't plain; `result` is as it was then. Comparisons are such that what is not a number, or
// has no end, isn't plain. Distances over lengths without end are 0.

bool meet_sphere(const Ray3& ray, const ShapeRef<3>& given, std::optional<Hit<3>>& result) {
    const Sphere& sphere = given.as<Sphere>();
    const DVec<3> from(ray.origin), direction(ray.direction), way = unit(direction), middle(sphere.center);
    const DVec<3> center = (given.pose != nullptr ? placed<3>(middle, *given.pose) : middle) - from;
    const double radius = static_cast<double>(sphere.radius), length = static_cast<double>(ray.length);
    const double nearest = dot(center, way), square = length_squared(center), reach = radius * outside;
    if (!(radius > 0 && square > reach * reach && std::isfinite(square + nearest) && length >= 0)) return false;
    if (direction == DVec<3>(0.0)) return true;
    // The square is taken of the distance at which it passes the middle, which keeps its digits however far the sphere
    // is.
    const DVec<3> passes = center - way * nearest;
    const double half_chord = radius * radius - length_squared(passes);
    if (!(nearest > 0 && half_chord >= 0)) return true;
    const double half = std::sqrt(half_chord), along = nearest - half;
    if (along > length) return true;
    Hit<3>& hit = result.emplace();
    hit.distance = static_cast<float>(along);
    hit.fraction = static_cast<float>(along / length);
    hit.point = to_float(from + way * along);
    hit.normal = to_float((passes + way * half) * (-1 / radius));
    hit.feature.kind = FeatureKind::vertex;
    return true;
}

/// Finds the side by which the ray comes in, by the side of its line on which the corners lie. No number of the ray or
/// the pose is divided by its length before that: signs don't change by it.
bool meet_polygon(const Ray<2>& ray, const ShapeRef<2>& given, std::optional<Hit<2>>& result) {
    const Polygon& polygon = given.as<Polygon>();
    if (polygon.sides() == nullptr) return false;
    PolygonSoa sides;
    sides.view_rows(polygon.sides(), polygon.side_count());
    const Pose2& pose = pose_or_none(given.pose);
    const Double2 turn = lanes::loaded(&pose.rotation.cos), direction = lanes::loaded(&ray.direction.x);
    const Double2 squares = lanes::squared_lengths(turn, direction), scales = lanes::approximate_inverse_root(squares);
    const double length = static_cast<double>(ray.length);
    if (!lanes::are_near_one(squares) || !(length >= 0)) return false;

    // As the polygon sees them, but for the scales.
    const Double2 cos = lanes::first(turn), sin = lanes::second(turn) * Double2{1, -1};
    const Double2 from = lanes::loaded(&ray.origin.x), offset = from - lanes::loaded(&pose.position.x);
    const Double2 origin = cos * offset + sin * lanes::swapped(offset);
    const Double2 way = cos * direction + sin * lanes::swapped(direction);
    // Corners are as long as they are; so that a length need not be waited for, it is theirs that is scaled.
    const Double2 crossed = way * lanes::swapped(origin);
    const Double2 line = lanes::first(crossed) - lanes::second(crossed);
    const Double2 way_to_corners = way * lanes::double2(2 - scales[0]);
    const Double2 way_x = lanes::first(way_to_corners), way_y = lanes::second(way_to_corners);
    std::uint32_t left = 0;
    for (std::size_t i = 0; i < sides.count; i += 2)
        left |= lanes::signs((line + way_y * lanes::at(sides.x + i)) - way_x * lanes::at(sides.y + i)) << i;
    const std::uint32_t all = (2u << (sides.count - 1)) - 1;
    left &= all;
    // What is not a number, or has no end, is never more than this.
    const double doubt = ray_tolerance * (std::abs(origin[0]) + std::abs(origin[1]) + sides.size);
    if (left == 0 || left == all) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < sides.count; ++i)
            nearest = std::min(nearest, std::abs(way_x[0] * sides.y[i] - way_y[0] * sides.x[i] - line[0]));
        return nearest > 2 * doubt;
    }
    const std::uint32_t next = left >> 1 | left << (sides.count - 1), side = lanes::lowest_bit(left & ~next);
    const double x = sides.normal_x[side], y = sides.normal_y[side];
    const double height = (x * origin[0] + y * origin[1]) * scales[0] - sides.offset[side];
    if (!(height > doubt)) {
        const std::uint32_t last = lanes::lowest_bit(~left & next & all);
        return dot(sides.normal(last), {origin[0], origin[1]}) * scales[0] - sides.offset[last] > doubt;
    }
    const double sinks = -(x * way[0] + y * way[1]) * (scales[0] * scales[1]);
    if (!(sinks >= 1e-6)) return false;
    const double along = height / sinks;
    if (along > length) return true;
    Hit<2>& hit = result.emplace();
    hit.distance = static_cast<float>(along);
    hit.fraction = static_cast<float>(along / length);
    const double part = along * scales[1], turned_x = x * scales[0], turned_y = y * scales[0];
    lanes::store(from + direction * lanes::double2(part), &hit.point.x);
    lanes::store(cos * lanes::double2(turned_x, turned_y) - sin * lanes::double2(turned_y, turned_x), &hit.normal.x);
    hit.feature.kind = FeatureKind::edge;
    hit.feature.index = edge_index(side, sides.after(side));
    return true;
}

bool meet_circle(const Ray<2>& ray, const ShapeRef<2>& given, std::optional<Hit<2>>& result) {
    const Circle& circle = given.as<Circle>();
    const Double2 from = lanes::loaded(&ray.origin.x), direction = lanes::loaded(&ray.direction.x);
    Double2 middle = lanes::loaded(&circle.center.x);
    if (given.pose != nullptr) {
        const DVec<2> point = placed<2>(DVec<2>(circle.center), *given.pose);
        middle = lanes::double2(point.x, point.y);
    }
    const Double2 squares = lanes::dot(direction, direction), scale = lanes::approximate_inverse_root(squares);
    // Along the ray, and across it.
    const Double2 center = middle - from;
    const Double2 parts =
        (lanes::first(direction) * center * Double2{1, -1} + lanes::second(direction) * lanes::swapped(center)) * scale;
    const double radius = static_cast<double>(circle.radius), length = static_cast<double>(ray.length);
    const double square = lanes::dot(parts, parts)[0], reach = radius * outside;
    if (!(lanes::is_near_one(squares[0]) && radius > 0 && square > reach * reach &&
          square < std::numeric_limits<double>::max() && length >= 0))
        return false;
    const double half_chord = radius * radius - parts[1] * parts[1];
    if (!(parts[0] > 0 && half_chord >= 0)) return true;
    const double half = std::sqrt(half_chord), along = parts[0] - half;
    if (along > length) return true;
    Hit<2>& hit = result.emplace();
    hit.distance = static_cast<float>(along);
    hit.fraction = static_cast<float>(along / length);
    const Double2 way = direction * scale, across = parts / lanes::double2(radius);
    lanes::store(from + way * lanes::double2(along), &hit.point.x);
    // In parts of the radius, whose squares add up to 1.
    const double back = half / radius;
    lanes::store(lanes::swapped(way) * Double2{-1, 1} * lanes::second(across) - way * lanes::double2(back),
                 &hit.normal.x);
    hit.feature.kind = FeatureKind::vertex;
    return true;
}

bool direct_raycast(const Ray<2>& ray, const ShapeRef<2>& shape, std::optional<Hit<2>>& result) {
    if (shape.kind == ShapeKind::polytope) return meet_polygon(ray, shape, result);
    return shape.kind == ShapeKind::ball && meet_circle(ray, shape, result);
}
bool direct_raycast(const Ray<3>& ray, const ShapeRef<3>& shape, std::optional<Hit<3>>& result) {
    return shape.kind == ShapeKind::ball && meet_sphere(ray, shape, result);
}

template <int D>
[[gnu::noinline]] void by_view(const Ray<D>& ray, const ShapeRef<D>& shape, const QueryOptions<D>& options,
                               std::optional<Hit<D>>& result) {
    result = raycast(ray, convex_of(shape), options);
}

}  // namespace

template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const ShapeRef<D>& shape, const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    if (options.trace != nullptr || !direct_raycast(ray, shape, result)) by_view(ray, shape, options, result);
    return result;
}

template std::optional<Hit<2>> raycast(const Ray<2>&, const ShapeRef<2>&, const QueryOptions<2>&);
template std::optional<Hit<3>> raycast(const Ray<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
