#include <abut/convex/face.hpp>
#include <abut/convex/farthest_point.hpp>
#include <abut/convex/manifold/round_manifold.hpp>
#include <abut/convex/pairs/round3.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

constexpr double tilt_squared = 1 - aligned * aligned;

/// A segment with a ball around it, in scalars.
struct RoundSegment {
    DVec<3> from, to;
    double radius;

    explicit RoundSegment(const PlacedSegment& segment)
        : from(lanes::vector(segment.from)), to(lanes::vector(segment.to)), radius(segment.radius[0]) {}
    /// Half of its length, with the ball.
    double reach() const { return 0.5 * length(to - from) + radius; }
};

/// A segment and the part of it that clipping left.
struct Clipped {
    DVec<3> from, to;
    double low = 0, high = 1;
    std::uint32_t low_name = 0, high_name = 1;
    bool empty = false;

    /// Removes the part in front of a plane, from the heights of both ends over it.
    void cut(double at_from, double at_to, std::uint32_t plane_name) {
        const double at_low = at_from + (at_to - at_from) * low, at_high = at_from + (at_to - at_from) * high;
        if (at_low <= 0 && at_high <= 0) return;
        if (at_low > 0 && at_high > 0) {
            empty = true;
            return;
        }
        const double part = low + (high - low) * (at_low / (at_low - at_high));
        const std::uint32_t name = (plane_name + 1) << 16;
        if (at_low > 0) {
            low = part;
            low_name = name;
        } else {
            high = part;
            high_name = name | 1;
        }
    }
    DVec<3> at(double part) const { return part >= 1 ? to : from + (to - from) * part; }
};

/// Writes the points of a manifold.
struct PointWriter {
    Manifold<3>& result;
    const DVec<3> out;  ///< along the normal, from the reference
    const double depth, margin, tolerance, incident_radius;

    /// Adds a point of the incident core that is `here` deep.
    void add(const DVec<3>& place, double here, std::uint32_t name) {
        here = std::min(here, depth);
        if (here < -margin - tolerance) return;
        result.points[result.count++] = {place - out * (incident_radius - 0.5 * here),
                                         margin > 0 ? here : std::max(here, 0.0), name};
    }
};

void add_deepest(const SignedDistance<3>& distance, double tolerance, Manifold<3>& result) {
    const double depth = -distance.distance;
    for (std::size_t i = 0; i < result.count; ++i)
        if (result.points[i].depth >= depth - tolerance) return;
    result.points[result.count++] = {distance.on_a - distance.normal * (0.5 * depth), depth,
                                     distance.corners.a[0] << 8 ^ distance.corners.b[0]};
}

/// Clips two nearly parallel segments to their common range.
void clip_segments(const RoundSegment& a, const RoundSegment& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result) {
    const DVec<3> origin = a.from, u = a.to - origin;
    Clipped clipped{b.from - origin, b.to - origin};
    const DVec<3> v = clipped.to - clipped.from, &normal = distance.normal;
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), tilt = dot(u, normal);
    const bool parallel =
        uu > 0 && vv > 0 && uv * uv >= aligned * aligned * uu * vv && tilt * tilt <= tilt_squared * uu;
    if (!parallel) return add_deepest(distance, 0, result);
    const double tolerance = 1e-6 * std::min(0.5 * square_root(uu) + a.radius, 0.5 * square_root(vv) + b.radius);
    const DVec<3> along = normalized(u - normal * tilt), side = cross(along, normal);
    const auto cut = [&](const DVec<3>& plane, double offset, std::uint32_t name) {
        clipped.cut(dot(plane, clipped.from) - offset, dot(plane, clipped.to) - offset, name);
    };
    cut(-along, 0, 0);
    cut(along, dot(along, u), 1);
    cut(-side, a.radius + tolerance, 0);
    cut(side, a.radius + tolerance, 1);
    if (!clipped.empty) {
        // The slope of A's line, seen along the normal.
        const double rise = tilt / dot(along, u);
        PointWriter writer{result, normal, -distance.distance, margin, tolerance, b.radius};
        const auto add = [&](double part, std::uint32_t name) {
            const DVec<3> place = clipped.at(part);
            const double off = dot(side, place), gap = dot(normal, place) - rise * dot(along, place);
            const double reach = square_root(std::max(0.0, a.radius * a.radius - off * off));
            writer.add(origin + place, reach + b.radius - gap, name);
        };
        add(clipped.low, clipped.low_name);
        add(clipped.high, clipped.high_name);
    }
    add_deepest(distance, tolerance, result);
}

/// Clips the segment to the face of the box along the normal.
bool clip_to_box(const PlacedBox& box, const RoundSegment& segment, const SignedDistance<3>& distance,
                 const DVec<3>& out, double margin, Manifold<3>& result) {
    const DVec<3> half = lanes::vector(box.half), local = lanes::vector(box.axes.transposed(lanes::double3(out)));
    const double radius = box.radius[0];
    int up = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(local[i]) > std::abs(local[up])) up = i;
    const int u = (up + 1) % 3, v = (up + 2) % 3;
    if (std::min(half[u], half[v]) <= 1e-5 * std::max(half[u], half[v])) return false;
    if (std::abs(local[up]) < aligned) return deepest_point(distance, result);
    const DVec<3>&from = segment.from, &to = segment.to;
    const double tolerance = 1e-6 * std::min(length(half) + radius, segment.reach());
    const double sign = local[up] < 0 ? -1 : 1, slope_u = local[u] / local[up], slope_v = local[v] / local[up];
    // Relative to the face, projected onto it along the normal.
    const auto seen = [&](const DVec<3>& point) {
        DVec<3> place = lanes::vector(box.axes.transposed(lanes::double3(point) - box.center));
        const double height = place[up] - sign * half[up];
        place[u] -= slope_u * height;
        place[v] -= slope_v * height;
        place[up] = sign * height;
        return place;
    };
    Clipped clipped{seen(from), seen(to)};
    const std::uint32_t low = (sign < 0 ? 1u << up : 0u), low_u = 1u << u, low_v = 1u << v;
    clipped.cut(-clipped.from[v] - half[v], -clipped.to[v] - half[v], low | low_u | low_v);
    if (!clipped.empty) clipped.cut(clipped.from[u] - half[u], clipped.to[u] - half[u], low | low_v);
    if (!clipped.empty) clipped.cut(clipped.from[v] - half[v], clipped.to[v] - half[v], low);
    if (!clipped.empty) clipped.cut(-clipped.from[u] - half[u], -clipped.to[u] - half[u], low | low_u);
    if (!clipped.empty) {
        PointWriter writer{result, out, -distance.distance, margin, tolerance, segment.radius};
        const double reach = radius + segment.radius, one = 1 / std::abs(local[up]);
        const auto add = [&](double part, std::uint32_t name) {
            const double height = clipped.from[up] + (clipped.to[up] - clipped.from[up]) * part;
            writer.add(part >= 1 ? to : from + (to - from) * part, reach - height * one, name);
        };
        add(clipped.low, clipped.low_name);
        add(clipped.high, clipped.high_name);
    }
    add_deepest(distance, tolerance, result);
    return true;
}

/// Clips the segment to a face of `solid` with the corners number(i) for i < count, counter-clockwise seen from
/// outside. Returns false if the face is too narrow to have a direction.
template <class Number>
bool clip_to_face(const Convex<3>& solid, std::uint32_t count, const Number& number, const DVec<3>& face_normal,
                  const RoundSegment& segment, const SignedDistance<3>& distance, const DVec<3>& out, double tolerance,
                  double margin, Manifold<3>& result) {
    const double along = dot(face_normal, out);
    if (along < aligned) return deepest_point(distance, result);
    const DVec<3> origin = core_corner(solid, number(0));
    Clipped clipped{segment.from - origin, segment.to - origin};
    DVec<3> from(0.0), area(0.0), last(0.0);
    double longest = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<3> to = i + 1 < count ? core_corner(solid, number(i + 1)) - origin : DVec<3>(0.0);
        const DVec<3> side = cross(to - from, out);
        const double offset = dot(side, from);
        if (!clipped.empty) clipped.cut(dot(side, clipped.from) - offset, dot(side, clipped.to) - offset, number(i));
        longest = std::max(longest, length_squared(to));
        area += cross(last, to);
        last = from = to;
    }
    if (!(length_squared(area) > 1e-6 * longest * longest)) return false;
    if (!clipped.empty) {
        PointWriter writer{result, out, -distance.distance, margin, tolerance, segment.radius};
        const auto add = [&](double part, std::uint32_t name) {
            const DVec<3> place = clipped.at(part);
            writer.add(origin + place, solid.radius + segment.radius - dot(face_normal, place) / along, name);
        };
        add(clipped.low, clipped.low_name);
        add(clipped.high, clipped.high_name);
    }
    add_deepest(distance, tolerance, result);
    return true;
}

bool clip_to_triangle(const Convex<3>& triangle, const RoundSegment& segment, const SignedDistance<3>& distance,
                      const DVec<3>& out, double margin, Manifold<3>& result) {
    const DVec<3> a = core_corner(triangle, 0), u = core_corner(triangle, 1) - a, v = core_corner(triangle, 2) - a;
    const DVec<3> area = cross(u, v);
    const double square = length_squared(area), longest_squared = std::max(length_squared(u), length_squared(v));
    if (!(square > 1e-6 * longest_squared * longest_squared)) return false;
    const bool behind = dot(area, out) < 0;
    const double tolerance = 1e-6 * std::min(square_root(longest_squared) + triangle.radius, segment.reach());
    return clip_to_face(
        triangle, 3, [&](std::uint32_t i) { return behind ? 2 - i : i; },
        area * ((behind ? -1 : 1) / square_root(square)), segment, distance, out, tolerance, margin, result);
}

bool clip_to_hull(const Convex<3>& hull, const RoundSegment& segment, const SignedDistance<3>& distance,
                  const DVec<3>& out, double margin, Manifold<3>& result) {
    const Facets& facets = *hull.facets;
    const std::uint32_t face = farthest_point(facets.normals, hull.place.transposed(out));
    const std::span<const std::uint32_t> loop = facets.loop(face);
    if (loop.size() < 3 || loop.size() > Face<3>::capacity / 2) return false;
    const DVec<3> normal = normalized(hull.place.vector(DVec<3>(facets.normals[face])));
    double farthest = 0;
    for (const std::uint32_t i : loop)
        farthest = std::max(farthest, length_squared(DVec<3>(hull.vertices()[i]) - DVec<3>(hull.vertices()[loop[0]])));
    const double tolerance = 1e-6 * std::min(hull.scale * square_root(farthest) + hull.radius, segment.reach());
    return clip_to_face(
        hull, static_cast<std::uint32_t>(loop.size()), [&](std::uint32_t i) { return loop[i]; }, normal, segment,
        distance, out, tolerance, margin, result);
}

/// Clips the segment to the reference face of a triangle or polyhedron.
bool clip_to_solid(const Convex<3>& solid, const Convex<3>& other, const SignedDistance<3>& distance,
                   const DVec<3>& out, double margin, Manifold<3>& result) {
    return with_core(other, [&](const auto& core) {
        if constexpr (std::is_same_v<decltype(core), const PlacedSegment&>) {
            const RoundSegment segment(core);
            if (is_plain_hull(solid)) return clip_to_hull(solid, segment, distance, out, margin, result);
            return is_round_points(solid, 3) && clip_to_triangle(solid, segment, distance, out, margin, result);
        }
        return false;
    });
}

}  // namespace

bool core_manifold(const PlacedSegment& a, const PlacedSegment& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result) {
    result.count = 0;
    clip_segments(RoundSegment(a), RoundSegment(b), distance, margin, result);
    return true;
}
bool core_manifold(const PlacedBox& a, const PlacedSegment& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result) {
    result.count = 0;
    return clip_to_box(a, RoundSegment(b), distance, distance.normal, margin, result);
}
bool core_manifold(const PlacedSegment& a, const PlacedBox& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result) {
    result.count = 0;
    return clip_to_box(b, RoundSegment(a), distance, -distance.normal, margin, result);
}
bool core_manifold(const PlacedBox&, const PlacedBox&, const SignedDistance<3>&, double, Manifold<3>&) {
    return false;
}
bool deepest_point(const SignedDistance<3>& distance, Manifold<3>& result) {
    result.count = 0;
    add_deepest(distance, 0, result);
    return true;
}

bool round_manifold(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                    Manifold<3>& result) {
    result.count = 0;
    if (is_round_points(a, 1) || is_round_points(b, 1)) return deepest_point(distance, result);
    const auto of_cores = [&](const auto& x) {
        return with_core(b, [&](const auto& y) { return core_manifold(x, y, distance, margin, result); });
    };
    return with_core(a, of_cores) || clip_to_solid(a, b, distance, distance.normal, margin, result) ||
           clip_to_solid(b, a, distance, -distance.normal, margin, result);
}

}  // namespace abut::detail
