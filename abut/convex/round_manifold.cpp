#include <abut/convex/face.hpp>
#include <abut/convex/farthest_point.hpp>
#include <abut/convex/round_manifold.hpp>
#include <abut/convex/round_pairs.hpp>

namespace abut {
namespace {

constexpr double tilt_squared = 1 - aligned * aligned;

/// A segment, and what planes have left of it.
struct Clipped {
    DVec<3> from, to;
    double low = 0, high = 1;
    std::uint32_t low_name = 0, high_name = 1;
    bool empty = false;

    /// Cuts away what lies in front of a plane, by the heights of both ends over it.
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

/// Fills a manifold point by point.
struct Filling {
    Manifold<3>& result;
    const DVec<3> out;  ///< along the normal, from the reference
    const double depth, margin, slack, incident_radius;

    /// A place of the incident core that is `here` deep.
    void add(const DVec<3>& place, double here, std::uint32_t name) {
        here = std::min(here, depth);
        if (here < -margin - slack) return;
        result.points[result.count++] = {place - out * (incident_radius - 0.5 * here),
                                         margin > 0 ? here : std::max(here, 0.0), name};
    }
};

void add_deepest(const SignedDistance<3>& distance, double slack, Manifold<3>& result) {
    const double depth = -distance.distance;
    for (std::size_t i = 0; i < result.count; ++i)
        if (result.points[i].depth >= depth - slack) return;
    result.points[result.count++] = {distance.on_a - distance.normal * (0.5 * depth), depth,
                                     distance.corners.a[0] << 8 ^ distance.corners.b[0]};
}

/// Side by side, each reaches into the other along what they have in common of their way.
void meet_segments(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                   Manifold<3>& result) {
    const DVec<3> origin = core_corner(a, 0), u = core_corner(a, 1) - origin;
    Clipped left{core_corner(b, 0) - origin, core_corner(b, 1) - origin};
    const DVec<3> v = left.to - left.from, &normal = distance.normal;
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), tilt = dot(u, normal);
    const double slack = 1e-6 * std::min(0.5 * std::sqrt(uu) + a.radius, 0.5 * std::sqrt(vv) + b.radius);
    if (uu > 0 && vv > 0 && uv * uv >= aligned * aligned * uu * vv && tilt * tilt <= tilt_squared * uu) {
        const DVec<3> along = normalized(u - normal * tilt), side = cross(along, normal);
        const auto cut = [&](const DVec<3>& plane, double offset, std::uint32_t name) {
            left.cut(dot(plane, left.from) - offset, dot(plane, left.to) - offset, name);
        };
        cut(-along, 0, 0);
        cut(along, dot(along, u), 1);
        cut(-side, a.radius + slack, 0);
        cut(side, a.radius + slack, 1);
        if (!left.empty) {
            // The line of A has a slope, seen along the normal.
            const double rise = tilt / dot(along, u);
            Filling filling{result, normal, -distance.distance, margin, slack, b.radius};
            const auto add = [&](double part, std::uint32_t name) {
                const DVec<3> place = left.at(part);
                const double off = dot(side, place), gap = dot(normal, place) - rise * dot(along, place);
                const double reach = std::sqrt(std::max(0.0, a.radius * a.radius - off * off));
                filling.add(origin + place, reach + b.radius - gap, name);
            };
            add(left.low, left.low_name);
            add(left.high, left.high_name);
        }
    }
    add_deepest(distance, slack, result);
}

/// Half of its length, ball and all.
double reach_of(const Convex<3>& segment) {
    return 0.5 * length(core_corner(segment, 1) - core_corner(segment, 0)) + segment.radius;
}

/// The side of the box that looks along the normal takes what lies over it of the segment.
bool meet_box(const Convex<3>& box, const Convex<3>& segment, const SignedDistance<3>& distance, const DVec<3>& out,
              double margin, Manifold<3>& result) {
    const DVec<3> half = DVec<3>(box.own[0]) * box.scale, local = box.place.transposed(out) / box.scale;
    int up = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(local[i]) > std::abs(local[up])) up = i;
    const int u = (up + 1) % 3, v = (up + 2) % 3;
    if (std::min(half[u], half[v]) <= 1e-5 * std::max(half[u], half[v])) return false;
    const DVec<3> from = core_corner(segment, 0), to = core_corner(segment, 1);
    const double slack = 1e-6 * std::min(length(half) + box.radius, reach_of(segment));
    if (std::abs(local[up]) >= aligned) {
        const double sign = local[up] < 0 ? -1 : 1, slope_u = local[u] / local[up], slope_v = local[v] / local[up];
        // Over the side, and where they come down on it along the normal.
        const auto seen = [&](const DVec<3>& point) {
            DVec<3> place = box.place.transposed(point - box.place.offset) / box.scale;
            const double height = place[up] - sign * half[up];
            place[u] -= slope_u * height;
            place[v] -= slope_v * height;
            place[up] = sign * height;
            return place;
        };
        Clipped left{seen(from), seen(to)};
        const std::uint32_t low = (sign < 0 ? 1u << up : 0u), low_u = 1u << u, low_v = 1u << v;
        left.cut(-left.from[v] - half[v], -left.to[v] - half[v], low | low_u | low_v);
        if (!left.empty) left.cut(left.from[u] - half[u], left.to[u] - half[u], low | low_v);
        if (!left.empty) left.cut(left.from[v] - half[v], left.to[v] - half[v], low);
        if (!left.empty) left.cut(-left.from[u] - half[u], -left.to[u] - half[u], low | low_u);
        if (!left.empty) {
            Filling filling{result, out, -distance.distance, margin, slack, segment.radius};
            const double reach = box.radius + segment.radius, one = 1 / std::abs(local[up]);
            const auto add = [&](double part, std::uint32_t name) {
                const double height = left.from[up] + (left.to[up] - left.from[up]) * part;
                filling.add(part >= 1 ? to : from + (to - from) * part, reach - height * one, name);
            };
            add(left.low, left.low_name);
            add(left.high, left.high_name);
        }
    }
    add_deepest(distance, slack, result);
    return true;
}

/// A face of `solid` with the corners number(i) for i < count, counter-clockwise seen from outside, takes what lies
/// over it of the segment. False where it is too narrow to have a direction.
template <class Number>
bool meet_face(const Convex<3>& solid, std::uint32_t count, const Number& number, const DVec<3>& face_normal,
               const Convex<3>& segment, const SignedDistance<3>& distance, const DVec<3>& out, double slack,
               double margin, Manifold<3>& result) {
    const double along = dot(face_normal, out);
    if (along >= aligned) {
        const DVec<3> origin = core_corner(solid, number(0));
        Clipped left{core_corner(segment, 0) - origin, core_corner(segment, 1) - origin};
        DVec<3> from(0.0), area(0.0), last(0.0);
        double longest = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const DVec<3> to = i + 1 < count ? core_corner(solid, number(i + 1)) - origin : DVec<3>(0.0);
            const DVec<3> side = cross(to - from, out);
            const double offset = dot(side, from);
            if (!left.empty) left.cut(dot(side, left.from) - offset, dot(side, left.to) - offset, number(i));
            longest = std::max(longest, length_squared(to));
            area += cross(last, to);
            last = from = to;
        }
        if (!(length_squared(area) > 1e-6 * longest * longest)) return false;
        if (!left.empty) {
            Filling filling{result, out, -distance.distance, margin, slack, segment.radius};
            const auto add = [&](double part, std::uint32_t name) {
                const DVec<3> place = left.at(part);
                filling.add(origin + place, solid.radius + segment.radius - dot(face_normal, place) / along, name);
            };
            add(left.low, left.low_name);
            add(left.high, left.high_name);
        }
    }
    add_deepest(distance, slack, result);
    return true;
}

bool meet_triangle(const Convex<3>& triangle, const Convex<3>& segment, const SignedDistance<3>& distance,
                   const DVec<3>& out, double margin, Manifold<3>& result) {
    const DVec<3> a = core_corner(triangle, 0), u = core_corner(triangle, 1) - a, v = core_corner(triangle, 2) - a;
    const DVec<3> area = cross(u, v);
    const double square = length_squared(area), most = std::max(length_squared(u), length_squared(v));
    if (!(square > 1e-6 * most * most)) return false;
    const bool behind = dot(area, out) < 0;
    const double slack = 1e-6 * std::min(std::sqrt(most) + triangle.radius, reach_of(segment));
    return meet_face(
        triangle, 3, [&](std::uint32_t i) { return behind ? 2 - i : i; },
        area * ((behind ? -1 : 1) / std::sqrt(square)), segment, distance, out, slack, margin, result);
}

bool meet_hull(const Convex<3>& hull, const Convex<3>& segment, const SignedDistance<3>& distance, const DVec<3>& out,
               double margin, Manifold<3>& result) {
    const Facets& facets = *hull.facets;
    const std::uint32_t face = farthest_point(facets.normals, hull.place.transposed(out));
    const std::span<const std::uint32_t> loop = facets.loop(face);
    if (loop.size() < 3 || loop.size() > Face<3>::capacity / 2) return false;
    const DVec<3> normal = normalized(hull.place.vector(DVec<3>(facets.normals[face])));
    double farthest = 0;
    for (const std::uint32_t i : loop)
        farthest = std::max(farthest, length_squared(DVec<3>(hull.vertices()[i]) - DVec<3>(hull.vertices()[loop[0]])));
    const double slack = 1e-6 * std::min(hull.scale * std::sqrt(farthest) + hull.radius, reach_of(segment));
    return meet_face(
        hull, static_cast<std::uint32_t>(loop.size()), [&](std::uint32_t i) { return loop[i]; }, normal, segment,
        distance, out, slack, margin, result);
}

/// The side of any solid that is known.
bool meet_solid(const Convex<3>& solid, const Convex<3>& segment, const SignedDistance<3>& distance, const DVec<3>& out,
                double margin, Manifold<3>& result) {
    if (is_plain_box(solid)) return meet_box(solid, segment, distance, out, margin, result);
    if (is_plain_hull(solid)) return meet_hull(solid, segment, distance, out, margin, result);
    return is_round_points(solid, 3) && meet_triangle(solid, segment, distance, out, margin, result);
}

}  // namespace

bool round_manifold(const Convex<3>& a, const Convex<3>& b, const SignedDistance<3>& distance, double margin,
                    Manifold<3>& result) {
    result.count = 0;
    if (is_round_points(a, 1) || is_round_points(b, 1)) {
        add_deepest(distance, 0, result);
        return true;
    }
    if (is_round_points(b, 2)) {
        if (!is_round_points(a, 2)) return meet_solid(a, b, distance, distance.normal, margin, result);
        meet_segments(a, b, distance, margin, result);
        return true;
    }
    return is_round_points(a, 2) && meet_solid(b, a, distance, -distance.normal, margin, result);
}

}  // namespace abut
