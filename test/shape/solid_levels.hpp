#pragma once

// Levels for solid BSP trees, and a reference for containment: exact winding numbers, face by face.

#include "../../scenes/bumpy_ball.hpp"
#include "../oracle/random.hpp"
#include "meshes.hpp"
#include <abut/math/predicates.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace abut::test {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;

template <int D>
struct Level {
    std::vector<Vec<D>> points;
    std::vector<glm::vec<D, std::uint32_t>> faces;

    SolidBsp<D> tree() const { return *SolidBsp<D>::build(points, faces); }
    Vec<D> corner(std::size_t face, int i) const { return points[faces[face][i]]; }
};

/// Appends an outline; the solid is inside if the outline is counter-clockwise.
inline void add_outline(Level<2>& level, const std::vector<Vec2>& outline) {
    const auto first = static_cast<std::uint32_t>(level.points.size()),
               count = static_cast<std::uint32_t>(outline.size());
    level.points.insert(level.points.end(), outline.begin(), outline.end());
    for (std::uint32_t i = 0; i < count; ++i) level.faces.emplace_back(first + i, first + (i + 1) % count);
}

inline std::vector<Vec2> star(oracle::Random& random, int count, const Vec2& center, double low, double high) {
    std::vector<Vec2> result;
    for (int i = 0; i < count; ++i) {
        const double quarters = 4 * (i + 0.8 * random.unit()) / count, radius = random.uniform(low, high);
        result.push_back(center + Vec2(scenes::on_circle(quarters) * radius));
    }
    return result;
}

/// Integers: corners coincide, faces overlap and cross each other's corners.
template <int D>
void snap(Level<D>& level) {
    for (Vec<D>& point : level.points)
        for (int i = 0; i < D; ++i) point[i] = std::floor(point[i] + 0.5f);
}

template <int D>
void turn_around(Level<D>& level) {
    for (auto& face : level.faces) std::swap(face[0], face[1]);
}

inline Level<3> level_of(const Surface& surface) {
    return {surface.points, surface.triangles};
}

/// The projection of a face from a point along the first axis.
struct Seen {
    int turns = 0;
    bool touches = false;
};

inline bool between(float low, float high, float x) {
    return std::min(low, high) <= x && x <= std::max(low, high);
}

inline Seen seen_from(const Level<2>& level, std::size_t face, const Vec2& p) {
    const Vec2 a = level.corner(face, 0), b = level.corner(face, 1);
    const int left = orientation(a, b, p);
    if (left == 0 && between(a.x, b.x, p.x) && between(a.y, b.y, p.y)) return {0, true};
    if (a.y <= p.y && p.y < b.y && left > 0) return {1, false};
    if (b.y <= p.y && p.y < a.y && left < 0) return {-1, false};
    return {};
}

inline bool in_shadow(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, int skip) {
    const int u = (skip + 1) % 3, v = (skip + 2) % 3;
    const Vec2 s(a[u], a[v]), t(b[u], b[v]), r(c[u], c[v]), q(p[u], p[v]);
    const int first = orientation(s, t, q), second = orientation(t, r, q), third = orientation(r, s, q);
    return (first >= 0 && second >= 0 && third >= 0) || (first <= 0 && second <= 0 && third <= 0);
}

inline Seen seen_from(const Level<3>& level, std::size_t face, const Vec3& p) {
    const Vec3 a = level.corner(face, 0), b = level.corner(face, 1), c = level.corner(face, 2);
    if (on_line(a, b, c)) return {};
    const int side = orientation(a, b, c, p);
    if (side == 0) {
        bool inside = true;
        for (int skip = 0; skip < 3; ++skip) inside = inside && in_shadow(a, b, c, p, skip);
        // A projection without width has no orientation: the box decides.
        for (int i = 0; i < 3; ++i)
            inside = inside && std::min({a[i], b[i], c[i]}) <= p[i] && p[i] <= std::max({a[i], b[i], c[i]});
        return {0, inside};
    }
    int turns = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 from = level.corner(face, i), to = level.corner(face, (i + 1) % 3);
        const bool from_below = from.z <= p.z, to_below = to.z <= p.z;
        if (from_below == to_below) continue;
        const int left = orientation(Vec2(from.y, from.z), Vec2(to.y, to.z), Vec2(p.y, p.z));
        if (from_below && left > 0) ++turns;
        if (to_below && left < 0) --turns;
    }
    const Vec2 s(a.y, a.z), t(b.y, b.z), r(c.y, c.z);
    const int facing = orientation(s, t, r);  // the sign of the normal along the axis
    if (facing == 0 || (side < 0) != (facing > 0)) return {};
    return {turns, false};
}

/// Whether two faces are coplanar, with opposite normals.
inline bool back_to_back(const Level<2>& level, std::size_t f, std::size_t g) {
    const DVec<2> u(level.corner(f, 1) - level.corner(f, 0)), v(level.corner(g, 1) - level.corner(g, 0));
    return orientation(level.corner(f, 0), level.corner(f, 1), level.corner(g, 0)) == 0 &&
           orientation(level.corner(f, 0), level.corner(f, 1), level.corner(g, 1)) == 0 && dot(u, v) < 0;
}
inline bool back_to_back(const Level<3>& level, std::size_t f, std::size_t g) {
    const auto normal = [&](std::size_t face) {
        const DVec<3> a(level.corner(face, 0));
        return cross(DVec<3>(level.corner(face, 1)) - a, DVec<3>(level.corner(face, 2)) - a);
    };
    bool flat = true;
    for (int i = 0; i < 3; ++i)
        flat = flat && orientation(level.corner(f, 0), level.corner(f, 1), level.corner(f, 2), level.corner(g, i)) == 0;
    return flat && dot(normal(f), normal(g)) < 0;
}

enum class Place { outside, inside, on_nothing };

/// `hollow`: the solid is unbounded outside. A point on two faces back to back may be undecided, as they may border
/// nothing.
template <int D>
Place place_in(const Level<D>& level, const Vec<D>& p, bool hollow) {
    int turns = hollow ? 1 : 0;
    std::vector<std::size_t> touched;
    for (std::size_t face = 0; face < level.faces.size(); ++face) {
        const Seen seen = seen_from(level, face, p);
        turns += seen.turns;
        if (seen.touches) touched.push_back(face);
    }
    for (const std::size_t f : touched)
        for (const std::size_t g : touched)
            if (back_to_back(level, f, g)) return Place::on_nothing;
    return turns > 0 || !touched.empty() ? Place::inside : Place::outside;
}

/// The intersection of a ray with a face, in lengths of its direction; the sign is above zero where it enters.
struct Crossing {
    double along = 0;
    int turns = 0;
    bool sure = true;  ///< false if it hits the border of the face, or is nearly parallel to it
};

inline Crossing crossing_of(const Level<2>& level, std::size_t face, const DVec<2>& origin, const DVec<2>& direction) {
    const DVec<2> a = DVec<2>(level.corner(face, 0)) - origin, side = DVec<2>(level.corner(face, 1)) - origin - a;
    const double slope = cross(side, direction), tolerance = 1e-6 * length(side);
    if (slope == 0) return {0, 0, std::abs(cross(side, a)) > tolerance};
    const double part = cross(direction, a) / slope, along = cross(side, a) / slope;
    if (part < -1e-6 || part > 1 + 1e-6) return {};
    const bool border = part < 1e-6 || part > 1 - 1e-6 || std::abs(slope) < tolerance;
    return {along, slope > 0 ? 1 : -1, !border};
}

inline Crossing crossing_of(const Level<3>& level, std::size_t face, const DVec<3>& origin, const DVec<3>& direction) {
    const DVec<3> a = DVec<3>(level.corner(face, 0)) - origin, b = DVec<3>(level.corner(face, 1)) - origin,
                  c = DVec<3>(level.corner(face, 2)) - origin, normal = cross(b - a, c - a);
    const double slope = -dot(normal, direction), size = length(normal);
    if (size == 0) return {};
    if (slope == 0) return {0, 0, std::abs(dot(normal, a)) > 1e-6 * size};
    const std::array<double, 3> sides{dot(direction, cross(a, b)), dot(direction, cross(b, c)),
                                      dot(direction, cross(c, a))};
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    const double tolerance = 1e-6 * size;
    if (*least<-tolerance&& * most> tolerance) return {};
    return {-dot(normal, a) / slope, slope > 0 ? 1 : -1,
            (*least > tolerance || *most < -tolerance) && std::abs(slope) > tolerance};
}

/// The first point where a ray enters the solid; infinite without one, NaN if rounding may decide.
template <int D>
double first_entry(const Level<D>& level, const Vec<D>& from, const DVec<D>& direction, bool hollow) {
    std::vector<Crossing> crossings;
    int turns = hollow ? 1 : 0;
    for (std::size_t face = 0; face < level.faces.size(); ++face) {
        const Seen seen = seen_from(level, face, from);
        turns += seen.turns;
        const Crossing here = crossing_of(level, face, DVec<D>(from), direction);
        if (!here.sure || seen.touches) return std::nan("");
        if (here.turns != 0 && here.along > 0) crossings.push_back(here);
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.along < b.along; });
    for (const Crossing& here : crossings) {
        const bool was_open = turns <= 0;
        turns += here.turns;
        if (was_open && turns > 0) return here.along;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace abut::test
