#include <abut/io/level_shape.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace abut::detail {
namespace {

// Relative tolerance that absorbs rounding of a right angle or of two equal lengths.
constexpr double relative_tolerance = 1e-9;
constexpr double quarter_turn = 1.57079632679489661923;
// More segments than this indicate a mistaken tolerance and not a finer curve.
constexpr double max_arc_segments = 4096;

bool fits_float(const DVec<2>& v) {
    constexpr double max_value = std::numeric_limits<float>::max();
    return std::abs(v.x) <= max_value && std::abs(v.y) <= max_value;
}

Problem out_of_range() {
    return {ProblemCode::not_finite, "a coordinate is out of the range of floats"};
}
Problem degenerate_problem(const char* what) {
    return {ProblemCode::degenerate, what};
}

bool preserves_right_angles(const Affine<2>& map) {
    return std::abs(dot(map.column[0], map.column[1])) <=
           relative_tolerance * length(map.column[0]) * length(map.column[1]);
}
bool preserves_circles(const Affine<2>& map) {
    const double a = length(map.column[0]), b = length(map.column[1]);
    return preserves_right_angles(map) && std::abs(a - b) <= relative_tolerance * std::max(a, b);
}

// The rotation of the x axis under the map. The columns are perpendicular; the second determines the first if that is
// zero.
Turn rotation_of(const Affine<2>& map) {
    const DVec<2> otherwise = normalized(DVec<2>(map.column[1].y, -map.column[1].x));
    const DVec<2> along = normalized(map.column[0], otherwise);
    return {static_cast<float>(along.x), static_cast<float>(along.y)};
}

Box2 box(const Affine<2>& map, const DVec<2>& size) {
    const Vec2 middle = to_float(map.point(0.5 * size));
    const Vec2 half(0.5 * size.x * length(map.column[0]), 0.5 * size.y * length(map.column[1]));
    // A box is invariant under mirroring, and a rotation by 90 degrees only exchanges its half extents.
    if (map.column[0].y == 0 && map.column[1].x == 0) return {middle, half};
    if (map.column[0].x == 0 && map.column[1].y == 0) return {middle, {half.y, half.x}};
    return {middle, half, rotation_of(map)};
}

// Count of segments of equal angle that approximate an arc.
std::size_t arc_segments(double radius, double angle, double tolerance) {
    // A chord over the angle a deviates from its arc by radius * (1 - cos(a / 2)) <= radius * a^2 / 8.
    const double segments = std::ceil(std::abs(angle) * square_root(radius / (8 * tolerance)));
    return static_cast<std::size_t>(std::clamp(segments, 1.0, max_arc_segments));
}

int sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// Count of sign changes of the edge directions along an axis, once around the closed polygon.
std::size_t sign_changes(std::span<const Vec2> points, int axis) {
    int first = 0, last = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int now =
            sign(static_cast<double>(points[(i + 1) % points.size()][axis]) - static_cast<double>(points[i][axis]));
        if (now == 0) continue;
        if (first == 0) first = now;
        if (last != 0 && now != last) ++count;
        last = now;
    }
    return count + (first != last ? 1 : 0);
}

// A polygon is convex if all corners have the same orientation and it winds around only once.
bool is_convex(std::span<const Vec2> points) {
    int turns = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int turn = orientation(points[i], points[(i + 1) % points.size()], points[(i + 2) % points.size()]);
        if (turn == 0) continue;
        if (turns != 0 && turn != turns) return false;
        turns = turn;
    }
    return turns != 0 && sign_changes(points, 0) <= 2 && sign_changes(points, 1) <= 2;
}

bool has_area(std::span<const Vec2> points) {
    for (const Vec2& p : points)
        if (orientation(points[0], points[1], p) != 0) return true;
    return false;
}

}  // namespace

Affine<2> translation_by(const DVec<2>& by) {
    Affine<2> result;
    result.offset = by;
    return result;
}

Affine<2> scaling_by(const DVec<2>& by) {
    Affine<2> result;
    result.column = {DVec<2>(by.x, 0), DVec<2>(0, by.y)};
    return result;
}

Affine<2> rotation_by(double degrees) {
    const double quarters = degrees / 90, whole = std::round(quarters);
    SinCos turn = sin_cos(quarters * quarter_turn);
    if (quarters == whole) {
        constexpr double sines[] = {0, 1, 0, -1};
        const auto place = static_cast<std::size_t>(std::fmod(std::fmod(whole, 4) + 4, 4));
        turn = {sines[place], sines[(place + 1) % 4]};
    }
    Affine<2> result;
    result.column = {DVec<2>(turn.cos, turn.sin), DVec<2>(-turn.sin, turn.cos)};
    return result;
}

std::vector<DVec<2>> rounded_rectangle_points(const DVec<2>& size, const DVec<2>& radii, double tolerance) {
    const std::size_t segments = arc_segments(std::max(radii.x, radii.y), quarter_turn, tolerance);
    std::vector<DVec<2>> points;
    const DVec<2> corners[] = {{size.x, size.y}, {0, size.y}, {0, 0}, {size.x, 0}};
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        const DVec<2> middle(std::clamp(corners[quarter].x, radii.x, size.x - radii.x),
                             std::clamp(corners[quarter].y, radii.y, size.y - radii.y));
        for (std::size_t i = 0; i <= segments; ++i) {
            const double part = static_cast<double>(quarter) + static_cast<double>(i) / static_cast<double>(segments);
            const SinCos at = sin_cos(quarter_turn * part);
            points.push_back(middle + DVec<2>(radii.x * at.cos, radii.y * at.sin));
        }
    }
    return points;
}

Result<PlacedShape> place_rectangle(const Affine<2>& map, const DVec<2>& size) {
    if (!fits_float(map.offset) || !fits_float(map.point(size)) || !fits_float(map.point({size.x, 0})) ||
        !fits_float(map.point({0, size.y})))
        return out_of_range();
    if (preserves_right_angles(map)) {
        const Box2 result = box(map, size);
        if (result.half == Vec2(0, 0)) return degenerate_problem("a rectangle without extent");
        return PlacedShape{result, {}, false};
    }
    const DVec<2> corners[] = {{0, 0}, {size.x, 0}, size, {0, size.y}};
    return place_polyline(map, corners, true, true);
}

Result<PlacedShape> place_rounded_rectangle(const Affine<2>& map, const DVec<2>& size, const DVec<2>& radii,
                                            double tolerance) {
    const DVec<2> clamped_radii(std::min(radii.x, 0.5 * size.x), std::min(radii.y, 0.5 * size.y));
    if (!(clamped_radii.x > 0 && clamped_radii.y > 0)) return place_rectangle(map, size);
    if (2.0 * clamped_radii == size) return place_ellipse(map * translation_by(0.5 * size), clamped_radii);
    if (!preserves_circles(map) || clamped_radii.x != clamped_radii.y)
        return place_polyline(map, rounded_rectangle_points(size, clamped_radii, tolerance), true, true);
    const auto radius = static_cast<float>(clamped_radii.x * length(map.column[0]));
    const DVec<2> inner = size - 2.0 * clamped_radii;
    if (inner.x > 0 && inner.y > 0) {
        const Result<PlacedShape> core = place_rectangle(map * translation_by(clamped_radii), inner);
        if (!core) return core.problem();
        return PlacedShape{RoundedBox{std::get<Box2>(core->shape), radius}, {}, false};
    }
    const DVec<2> a = map.point(clamped_radii), b = map.point(size - clamped_radii);
    if (!fits_float(a) || !fits_float(b)) return out_of_range();
    return PlacedShape{Capsule2{to_float(a), to_float(b), radius}, {}, false};
}

Result<PlacedShape> place_ellipse(const Affine<2>& map, const DVec<2>& radii) {
    const Affine<2> whole = map * scaling_by(radii);
    const DVec<2>&u = whole.column[0], &v = whole.column[1];
    if (!fits_float(whole.offset) || !fits_float(u) || !fits_float(v)) return out_of_range();
    const Vec2 middle = to_float(whole.offset);
    if (preserves_circles(whole)) {
        const auto radius = static_cast<float>(length(u));
        if (radius == 0) return degenerate_problem("a circle without extent");
        return PlacedShape{Circle{middle, radius}, {}, false};
    }
    // The half axes are the eigenvectors of M M^T; their lengths are the square roots of the eigenvalues.
    const double p = u.x * u.x + v.x * v.x, q = u.x * u.y + v.x * v.y, r = u.y * u.y + v.y * v.y;
    const double longer = 0.5 * (p + r) + length(DVec<2>(0.5 * (p - r), q));
    const double half = square_root(longer), other = std::abs(cross(u, v)) / half;
    if (!(static_cast<float>(other) > 0)) return degenerate_problem("an ellipse without an area");
    const DVec<2> along = normalized(p >= r ? DVec<2>(longer - r, q) : DVec<2>(q, longer - p));
    const Pose2 pose{middle, {static_cast<float>(along.x), static_cast<float>(along.y)}};
    return PlacedShape{Ellipse{Circle{{}, 1}, Vec2(half, other)}, pose, false};
}

Result<PlacedShape> place_polyline(const Affine<2>& map, std::span<const DVec<2>> points, bool closed, bool filled) {
    std::vector<Vec2> line;
    line.reserve(points.size());
    for (const DVec<2>& point : points) {
        const DVec<2> placed = map.point(point);
        if (!fits_float(placed)) return out_of_range();
        const Vec2 rounded = to_float(placed) + Vec2(0, 0);  // -0 becomes 0
        if (line.empty() || line.back() != rounded) line.push_back(rounded);
    }
    while (closed && line.size() > 1 && line.back() == line.front()) line.pop_back();
    if (line.size() < 2) return degenerate_problem("a line without length");
    const bool encloses = closed && line.size() >= 3 && has_area(line);
    if (encloses && filled && is_convex(line)) {
        Result<Polygon> built = Polygon::build(line);
        if (!built) return built.problem();
        return PlacedShape{*std::move(built), {}, false};
    }
    Result<Chain> built = Chain::build(line, closed && line.size() >= 3);
    if (!built) return built.problem();
    return PlacedShape{*std::move(built), {}, filled && encloses};
}

AnyShape<2> any_shape(const PlacedShape& shape) {
    return std::visit([&](const auto& inner) { return AnyShape<2>(at(inner, shape.pose)); }, shape.shape);
}

Result<PlacedShape> join_shapes(std::vector<PlacedShape> shapes) {
    if (shapes.size() == 1) return std::move(shapes.front());
    std::vector<AnyShape<2>> children;
    bool filled = false;
    for (const PlacedShape& shape : shapes) {
        children.push_back(any_shape(shape));
        filled = filled || shape.filled;
    }
    Result<Compound2> built = Compound2::build(children);
    if (!built) return built.problem();
    return PlacedShape{*std::move(built), {}, filled};
}

}  // namespace abut::detail
