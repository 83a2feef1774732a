// Closed forms of rays against balls, and in the plane against polygons of few edges, without views of the shapes. They
// leave hard cases to the view: a ray that grazes, or starts on the surface.

#include <abut/convex/ray/closed_forms.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/raycast.hpp>

namespace abut {

using namespace detail;

namespace {

/// A ray starts outside of a ball beyond the radius times this, which allows for rounding.
constexpr double outside_factor = 1 + 4 * ray_tolerance;

// These return false, and leave `result` unchanged, in hard cases. Comparisons are written so that NaN and infinity are
// hard cases. Distances over infinite lengths are 0.

bool hit_sphere(const Ray3& ray, const ShapeRef<3>& given, std::optional<Hit<3>>& result) {
    const Sphere& sphere = given.as<Sphere>();
    const DVec<3> from(ray.origin), direction(ray.direction), unit_direction = unit(direction), middle(sphere.center);
    const DVec<3> center = (given.pose != nullptr ? placed<3>(middle, *given.pose) : middle) - from;
    const double radius = static_cast<double>(sphere.radius), length = static_cast<double>(ray.length);
    const double nearest = dot(center, unit_direction), square = length_squared(center),
                 reach = radius * outside_factor;
    if (!(radius > 0 && square > reach * reach && std::isfinite(square + nearest) && length >= 0)) return false;
    if (direction == DVec<3>(0.0)) return true;
    // The square of the distance at which the ray passes the centre, which stays precise for a distant sphere.
    const DVec<3> passes = center - unit_direction * nearest;
    const double half_chord = radius * radius - length_squared(passes);
    if (!(nearest > 0 && half_chord >= 0)) return true;
    const double half = square_root(half_chord), along = nearest - half;
    if (along > length) return true;
    Hit<3>& hit = result.emplace();
    hit.distance = static_cast<float>(along);
    hit.fraction = static_cast<float>(along / length);
    hit.point = to_float(from + unit_direction * along);
    hit.normal = to_float((passes + unit_direction * half) * (-1 / radius));
    hit.feature.kind = FeatureKind::vertex;
    return true;
}

/// Finds the edge through which the ray enters, by the side of the ray's line on which the vertices lie. Before that no
/// number of the ray or the pose is normalised, as signs don't depend on lengths.
bool hit_polygon(const Ray<2>& ray, const ShapeRef<2>& given, std::optional<Hit<2>>& result) {
    const Polygon& polygon = given.as<Polygon>();
    if (polygon.sides() == nullptr) return false;
    PolygonSoa sides;
    sides.view_rows(polygon.sides(), polygon.side_count());
    const Pose2& pose = pose_or_none(given.pose);
    const Double2 turn = lanes::loaded(&pose.rotation.cos), direction = lanes::loaded(&ray.direction.x);
    const Double2 squares = lanes::squared_lengths(turn, direction), scales = lanes::approximate_inverse_root(squares);
    const double length = static_cast<double>(ray.length);
    if (!lanes::are_near_one(squares) || !(length >= 0)) return false;

    // In the frame of the polygon, not normalised.
    const Double2 cos = lanes::first(turn), sin = lanes::second(turn) * Double2{1, -1};
    const Double2 from = lanes::loaded(&ray.origin.x), offset = from - lanes::loaded(&pose.position.x);
    const Double2 origin = cos * offset + sin * lanes::swapped(offset);
    const Double2 local_direction = cos * direction + sin * lanes::swapped(direction);
    // The direction is scaled in place of the vertices, so that nothing waits for a length.
    const Double2 crossed = local_direction * lanes::swapped(origin);
    const Double2 line = lanes::first(crossed) - lanes::second(crossed);
    const Double2 scaled_direction = local_direction * lanes::double2(2 - scales[0]);
    const Double2 scaled_x = lanes::first(scaled_direction), scaled_y = lanes::second(scaled_direction);
    std::uint32_t left = 0;
    Double2 nearest = lanes::double2(std::numeric_limits<double>::infinity());
    const double* numbers = sides.at(0);
    for (std::uint32_t block = 0; block < sides.count; block += soa_lanes, numbers += soa_rows * soa_lanes) {
        for (std::uint32_t i = 0; i < soa_lanes; i += 2) {
            const Double2 x = lanes::aligned_at(numbers + i), y = lanes::aligned_at(numbers + soa_lanes + i);
            const Double2 beside = (line + scaled_y * x) - scaled_x * y;
            left |= lanes::signs(beside) << (block + i);
            nearest = lanes::lesser(lanes::magnitude(beside), nearest);
        }
    }
    const std::uint32_t all = (2u << (sides.count - 1)) - 1;
    left &= all;
    // NaN and infinity are never greater than this.
    const double tolerance = ray_tolerance * (std::abs(origin[0]) + std::abs(origin[1]) + sides.size());
    if (left == 0 || left == all) return std::min(nearest[0], nearest[1]) > 2 * tolerance;
    const std::uint32_t next = left >> 1 | left << (sides.count - 1), side = lanes::lowest_bit(left & ~next);
    const double x = sides.normal_x(side), y = sides.normal_y(side);
    const double height = (x * origin[0] + y * origin[1]) * scales[0] - sides.offset(side);
    if (!(height > tolerance)) {
        const std::uint32_t last = lanes::lowest_bit(~left & next & all);
        return dot(sides.normal(last), {origin[0], origin[1]}) * scales[0] - sides.offset(last) > tolerance;
    }
    const double sinks = -(x * local_direction[0] + y * local_direction[1]) * (scales[0] * scales[1]);
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

bool hit_circle(const Ray<2>& ray, const ShapeRef<2>& given, std::optional<Hit<2>>& result) {
    const Circle& circle = given.as<Circle>();
    const Double2 from = lanes::loaded(&ray.origin.x), direction = lanes::loaded(&ray.direction.x);
    const Double2 squares = lanes::dot(direction, direction), scale = lanes::approximate_inverse_root(squares);
    // Along the ray, and across it.
    const Double2 center = placed_center(given) - from;
    const Double2 parts =
        (lanes::first(direction) * center * Double2{1, -1} + lanes::second(direction) * lanes::swapped(center)) * scale;
    const double radius = static_cast<double>(circle.radius), length = static_cast<double>(ray.length);
    const double square = lanes::dot(parts, parts)[0], reach = radius * outside_factor;
    if (!(lanes::is_near_one(squares[0]) && radius > 0 && square > reach * reach &&
          square < std::numeric_limits<double>::max() && length >= 0))
        return false;
    const double half_chord = radius * radius - parts[1] * parts[1];
    if (!(parts[0] > 0 && half_chord >= 0)) return true;
    const double half = square_root(half_chord), along = parts[0] - half;
    if (along > length) return true;
    Hit<2>& hit = result.emplace();
    hit.distance = static_cast<float>(along);
    hit.fraction = static_cast<float>(along / length);
    const Double2 unit_direction = direction * scale, across = parts / lanes::double2(radius);
    lanes::store(from + unit_direction * lanes::double2(along), &hit.point.x);
    // As fractions of the radius, whose squares add up to 1.
    const double back = half / radius;
    lanes::store(
        lanes::swapped(unit_direction) * Double2{-1, 1} * lanes::second(across) - unit_direction * lanes::double2(back),
        &hit.normal.x);
    hit.feature.kind = FeatureKind::vertex;
    return true;
}

bool closed_form_raycast(const Ray<2>& ray, const ShapeRef<2>& shape, std::optional<Hit<2>>& result) {
    if (shape.kind == ShapeKind::polytope) return hit_polygon(ray, shape, result);
    return shape.kind == ShapeKind::ball && hit_circle(ray, shape, result);
}
bool closed_form_raycast(const Ray<3>& ray, const ShapeRef<3>& shape, std::optional<Hit<3>>& result) {
    return shape.kind == ShapeKind::ball && hit_sphere(ray, shape, result);
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
    if (options.trace != nullptr || !closed_form_raycast(ray, shape, result)) by_view(ray, shape, options, result);
    return result;
}

template std::optional<Hit<2>> raycast(const Ray<2>&, const ShapeRef<2>&, const QueryOptions<2>&);
template std::optional<Hit<3>> raycast(const Ray<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
