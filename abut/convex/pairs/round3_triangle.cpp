// A point or a segment and a triangle, relative to the triangle's first corner.

#include <abut/convex/pairs/round3.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// Slivers, whose edges enclose no sine above a thousandth, are left to the general algorithms.
constexpr double min_segment_sine_squared = 1e-6;

struct SeenTriangle {
    DVec<3> origin;  ///< the first corner, in the world
    std::array<DVec<3>, 3> corners;
    DVec<3> area;   ///< normal to the triangle
    double square;  ///< of its length

    explicit SeenTriangle(const Convex<3>& convex) {
        origin = core_corner(convex, 0);
        corners = {DVec<3>(0.0), core_corner(convex, 1) - origin, core_corner(convex, 2) - origin};
        area = cross(corners[1], corners[2]);
        square = length_squared(area);
    }
    bool is_thin() const {
        return !(square > min_segment_sine_squared * length_squared(corners[1]) * length_squared(corners[2]));
    }

    /// Whether a point at this height, times |area|, is farther from the plane than `reach`. Rounded outwards, so that
    /// a point just within reach isn't lost.
    bool is_beyond(double height, double reach) const { return height * height > reach * reach * square * (1 + 1e-9); }
    /// Whether the projection of a point lies within the triangle.
    bool is_over(const DVec<3>& point) const {
        const double b = dot(area, cross(point, corners[2])), c = dot(area, cross(corners[1], point));
        return b >= 0 && c >= 0 && b + c <= square;
    }
    double support_along(const DVec<3>& direction) const {
        return std::max({0.0, dot(direction, corners[1]), dot(direction, corners[2])});
    }
};

/// A point on a triangle and the corners that span it; the first is repeated for missing ones.
struct TrianglePoint {
    DVec<3> point;
    std::array<std::uint32_t, 3> corners;
};

TrianglePoint on_edge(const SeenTriangle& t, std::uint32_t from, std::uint32_t to, double part) {
    if (part <= 0) return {t.corners[from], {from, from, from}};
    if (part >= 1) return {t.corners[to], {to, to, to}};
    return {t.corners[from] + (t.corners[to] - t.corners[from]) * part, {from, to, from}};
}

void name_corners(const TrianglePoint& on_triangle, std::uint32_t first, std::uint32_t last,
                  ClosestCorners<3>& corners) {
    corners.count = 3;
    for (std::size_t i = 0; i < 3; ++i) {
        corners.a[i] = on_triangle.corners[i];
        corners.b[i] = i == 0 ? first : last;
    }
}

/// The closest point on an edge or corner, by Voronoi regions. Returns false if the point projects into the triangle.
/// Ericson, Real-Time Collision Detection (2005), 5.1.5.
bool nearest_beside(const SeenTriangle& t, const DVec<3>& point, TrianglePoint& place) {
    const DVec<3>&b = t.corners[1], &c = t.corners[2];
    const double bb = dot(b, b), bc = dot(b, c), cc = dot(c, c);
    const double b0 = dot(b, point), c0 = dot(c, point), b1 = b0 - bb, c1 = c0 - bc, b2 = b0 - bc, c2 = c0 - cc;
    if (b0 <= 0 && c0 <= 0) {
        place = on_edge(t, 0, 1, 0);
    } else if (b1 >= 0 && c1 <= b1) {
        place = on_edge(t, 0, 1, 1);
    } else if (c2 >= 0 && b2 <= c2) {
        place = on_edge(t, 0, 2, 1);
    } else if (b0 >= 0 && b1 <= 0 && b0 * c1 - b1 * c0 <= 0) {
        place = on_edge(t, 0, 1, b0 / bb);
    } else if (c0 >= 0 && c2 <= 0 && b2 * c0 - b0 * c2 <= 0) {
        place = on_edge(t, 0, 2, c0 / cc);
    } else if (c1 >= b1 && b2 >= c2 && b1 * c2 - b2 * c1 <= 0) {
        place = on_edge(t, 1, 2, (c1 - b1) / ((c1 - b1) + (b2 - c2)));
    } else {
        return false;
    }
    return true;
}

void set_result(const SeenTriangle& t, const Convex<3>& triangle, const Convex<3>& other, double distance,
                const DVec<3>& normal, const DVec<3>& on_triangle, SignedDistance<3>& result) {
    result.distance = distance - triangle.radius - other.radius;
    result.normal = normal;
    result.on_a = t.origin + on_triangle + normal * triangle.radius;
}

/// A direction out of the triangle with the separation of triangle and segment along it.
struct TriangleDirection {
    double separation;
    DVec<3> out;
    std::uint32_t from = 0, to = 0;  ///< the edge of the triangle; equal: its face
};

/// The direction of minimum depth among all face normals of the Minkowski difference: the triangle's normal, and the
/// cross products of its edges with the segment.
TriangleDirection separating_direction(const SeenTriangle& t, const DVec<3>& p, const DVec<3>& q, double scale) {
    const double one = 1 / square_root(t.square), at_p = dot(t.area, p) * one, at_q = dot(t.area, q) * one;
    const double above = std::min(at_p, at_q), below = -std::max(at_p, at_q);
    TriangleDirection best{std::max(above, below), t.area * (above >= below ? one : -one)};
    const DVec<3> along = q - p;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        const DVec<3> edge = t.corners[j] - t.corners[i], across = cross(edge, along);
        const double square = length_squared(across);
        if (!(square > 1e-18 * length_squared(edge) * length_squared(along))) continue;
        const double inwards = dot(across, t.corners[k] - t.corners[i]);
        const DVec<3> out = across * ((inwards > 0 ? -1 : 1) / square_root(square));
        const double separation = std::min(dot(out, p), dot(out, q)) - t.support_along(out);
        if (separation > best.separation + round3_tolerance * scale) best = {separation, out, i, j};
    }
    return best;
}

/// The cores overlap or nearly touch, with a gap of `gap`.
bool deep_in_triangle(const SeenTriangle& t, const Convex<3>& triangle, const Convex<3>& segment, const DVec<3>& p,
                      const DVec<3>& q, double scale, double gap, SignedDistance<3>& result) {
    const TriangleDirection direction = separating_direction(t, p, q, scale);
    if (direction.separation > 0 && gap - direction.separation > round3_tolerance * scale) return false;
    if (direction.from == direction.to) {
        const std::uint32_t end = dot(direction.out, q) < dot(direction.out, p) ? 1 : 0;
        const DVec<3>& deepest = end == 0 ? p : q;
        if (!t.is_over(deepest)) return false;
        const TrianglePoint place{deepest - direction.out * direction.separation, {0, 1, 2}};
        name_corners(place, end, end, result.corners);
        set_result(t, triangle, segment, direction.separation, direction.out, place.point, result);
        return true;
    }
    const DVec<3>& corner = t.corners[direction.from];
    const DVec<3> edge = t.corners[direction.to] - corner, along = q - p;
    const SegmentParameters places = closest_parameters(edge, along, corner - p);
    const TrianglePoint place = on_edge(t, direction.from, direction.to, places.on_a);
    if (largest(p + along * places.on_b - place.point - direction.out * direction.separation) >
        round3_tolerance * scale)
        return false;
    name_corners(place, places.on_b >= 1 ? 1 : 0, places.on_b <= 0 ? 0 : 1, result.corners);
    set_result(t, triangle, segment, direction.separation, direction.out, place.point, result);
    return true;
}

}  // namespace

bool triangle_point(const Convex<3>& triangle, const Convex<3>& point, SignedDistance<3>& result) {
    const SeenTriangle t(triangle);
    if (t.is_thin()) return false;
    const DVec<3> seen = core_corner(point, 0) - t.origin;
    TrianglePoint place;
    if (!nearest_beside(t, seen, place)) {
        const double one = 1 / square_root(t.square), height = dot(t.area, seen) * one;
        const DVec<3> normal = t.area * (height < 0 ? -one : one);
        place = {seen - normal * std::abs(height), {0, 1, 2}};
        name_corners(place, 0, 0, result.corners);
        set_result(t, triangle, point, std::abs(height), normal, place.point, result);
        return true;
    }
    const DVec<3> between = seen - place.point;
    const double gap = length(between), scale = std::max({largest(t.corners[1]), largest(t.corners[2]), largest(seen)});
    if (!(gap > min_round3_gap * scale)) return false;
    const DVec<3> normal = between * (1 / gap);
    if (!(dot(normal, place.point) >= t.support_along(normal) - round3_tolerance * scale)) return false;
    name_corners(place, 0, 0, result.corners);
    set_result(t, triangle, point, gap, normal, place.point, result);
    return true;
}

TriangleClosest closest_point_on_triangle(const Convex<3>& triangle, const DVec<3>& point, double within,
                                          double& distance, DVec<3>& closest) {
    const SeenTriangle t(triangle);
    if (t.is_thin()) return TriangleClosest::unknown;
    const DVec<3> seen = point - t.origin;
    const double height = dot(t.area, seen), reach = within + triangle.radius;
    if (t.is_beyond(height, reach)) return TriangleClosest::beyond;
    TrianglePoint place;
    if (nearest_beside(t, seen, place)) {
        distance = length(seen - place.point);
    } else {
        const double one = 1 / square_root(t.square);
        place.point = seen - t.area * (height * one * one);
        distance = std::abs(height) * one;
    }
    closest = t.origin + place.point;
    if (triangle.radius > 0) {
        if (!(distance > 0)) return TriangleClosest::unknown;
        closest += (seen - place.point) * (triangle.radius / distance);
        distance -= triangle.radius;
    }
    return TriangleClosest::found;
}

PairAnswer triangle_segment(const Convex<3>& triangle, const Convex<3>& segment, double reach,
                            SignedDistance<3>& result) {
    const SeenTriangle t(triangle);
    if (t.is_thin()) return PairAnswer::unknown;
    const DVec<3> p = core_corner(segment, 0) - t.origin, q = core_corner(segment, 1) - t.origin, along = q - p;
    const double scale = std::max({largest(t.corners[1]), largest(t.corners[2]), largest(p), largest(q)});
    const double at_p = dot(t.area, p), at_q = dot(t.area, q);
    if ((at_p > 0) == (at_q > 0)) {
        // The point of the segment nearest to the plane is its lower end.
        const std::uint32_t end = std::abs(at_q) < std::abs(at_p) ? 1 : 0;
        if (t.is_beyond(end == 0 ? at_p : at_q, reach + triangle.radius + segment.radius)) return PairAnswer::no;
        const DVec<3>& lower = end == 0 ? p : q;
        if (t.is_over(lower)) {
            const double one = 1 / square_root(t.square), height = std::abs(end == 0 ? at_p : at_q) * one;
            const DVec<3> normal = t.area * (at_p > 0 ? one : -one);
            const TrianglePoint place{lower - normal * height, {0, 1, 2}};
            name_corners(place, end, end, result.corners);
            set_result(t, triangle, segment, height, normal, place.point, result);
            return PairAnswer::yes;
        }
    } else if (t.is_over(p + along * (at_p / (at_p - at_q)))) {
        return deep_in_triangle(t, triangle, segment, p, q, scale, 0, result) ? PairAnswer::yes : PairAnswer::unknown;
    }

    SegmentParameters best{0, 0};
    std::uint32_t nearest = 0;
    double minimum = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < 3; ++i) {
        const DVec<3>& from = t.corners[i];
        const DVec<3> edge = t.corners[(i + 1) % 3] - from;
        const SegmentParameters places = closest_parameters(edge, along, from - p);
        const double distance = length_squared(from + edge * places.on_a - p - along * places.on_b);
        if (distance >= minimum) continue;
        minimum = distance;
        best = places;
        nearest = i;
    }
    const TrianglePoint place = on_edge(t, nearest, (nearest + 1) % 3, best.on_a);
    const DVec<3> between = p + along * best.on_b - place.point;
    const double gap = length(between);
    if (!(gap > min_round3_gap * scale))
        return deep_in_triangle(t, triangle, segment, p, q, scale, gap, result) ? PairAnswer::yes : PairAnswer::unknown;
    const DVec<3> normal = between * (1 / gap);
    const double proven = std::min(dot(normal, p), dot(normal, q)) - t.support_along(normal);
    if (!(gap - proven <= round3_tolerance * scale)) return PairAnswer::unknown;
    name_corners(place, best.on_b >= 1 ? 1 : 0, best.on_b <= 0 ? 0 : 1, result.corners);
    set_result(t, triangle, segment, gap, normal, place.point, result);
    return PairAnswer::yes;
}

}  // namespace abut::detail
