#pragma once

// The oriented box of least volume around points, by a local search from many starts: a slow reference.

#include "../random.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/math/affine.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace abut::oracle {

using detail::axis;
using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::perpendicular;

/// The axes of a box and the lengths of its sides.
struct OrientedBox {
    std::array<DVec<3>, 3> axes;
    DVec<3> size{0.0};

    double volume() const { return size.x * size.y * size.z; }
};

inline OrientedBox box_along(std::span<const DVec<3>> points, const std::array<DVec<3>, 3>& axes) {
    OrientedBox result{axes};
    for (int i = 0; i < 3; ++i) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const DVec<3>& p : points) {
            const double along = dot(axes[static_cast<std::size_t>(i)], p);
            low = std::min(low, along);
            high = std::max(high, along);
        }
        result.size[i] = high - low;
    }
    return result;
}

/// The direction of the edge of the points' hull whose bounding rectangle has the least area. By brute force over all
/// edges.
inline DVec<2> min_area_rectangle_direction(std::vector<DVec<2>> points) {
    std::sort(points.begin(), points.end(),
              [](const DVec<2>& a, const DVec<2>& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<DVec<2>> loop;
    for (int chain = 0; chain < 2; ++chain) {
        const std::size_t first = loop.size();
        for (const DVec<2>& p : points) {
            while (loop.size() >= first + 2 &&
                   cross(loop.back() - loop[loop.size() - 2], p - loop[loop.size() - 2]) <= 0)
                loop.pop_back();
            loop.push_back(p);
        }
        loop.pop_back();
        std::reverse(points.begin(), points.end());
    }
    DVec<2> best(1, 0);
    double min_area = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec<2> along = normalized(loop[(i + 1) % loop.size()] - loop[i]);
        double low = 0, high = 0, up = 0;
        for (const DVec<2>& p : loop) {
            low = std::min(low, dot(along, p - loop[i]));
            high = std::max(high, dot(along, p - loop[i]));
            up = std::max(up, cross(along, p - loop[i]));
        }
        if (!((high - low) * up < min_area)) continue;
        min_area = (high - low) * up;
        best = along;
    }
    return best;
}

/// Minimises the box over rotations about one axis after the other, until none reduces its volume.
inline OrientedBox refined(std::span<const DVec<3>> points, std::array<DVec<3>, 3> axes) {
    OrientedBox best = box_along(points, axes);
    for (int idle = 0, about = 0; idle < 3; about = (about + 1) % 3) {
        const auto i = static_cast<std::size_t>(about);
        const DVec<3> w = best.axes[i], u = best.axes[(i + 1) % 3], v = best.axes[(i + 2) % 3];
        std::vector<DVec<2>> projected;
        for (const DVec<3>& p : points) projected.emplace_back(dot(u, p), dot(v, p));
        const DVec<2> along = min_area_rectangle_direction(projected);
        std::array<DVec<3>, 3> rotated;
        rotated[i] = w;
        rotated[(i + 1) % 3] = normalized(u * along.x + v * along.y);
        rotated[(i + 2) % 3] = cross(w, rotated[(i + 1) % 3]);
        const OrientedBox next = box_along(points, rotated);
        idle = next.volume() < best.volume() * (1 - 1e-7) ? 0 : idle + 1;
        if (idle == 0) best = next;
    }
    return best;
}

/// Starts from the coordinate axes, the principal directions of the points, all faces of their hull, and random axes.
inline OrientedBox min_volume_box(std::span<const Vec3> points, std::uint64_t seed) {
    const detail::Hull3 full = *detail::hull(points);
    std::vector<DVec<3>> corners;
    for (const Vec3& p : points) corners.push_back(DVec<3>(p) - DVec<3>(points[0]));
    std::vector<DVec<3>> normals{axis<3>(0)};
    for (const Vec3& normal : full.normals) normals.emplace_back(normal);
    // The normal of the plane through two points far apart and the point farthest from their line.
    const auto farthest = [&](auto measure) {
        return *std::max_element(corners.begin(), corners.end(),
                                 [&](const DVec<3>& a, const DVec<3>& b) { return measure(a) < measure(b); });
    };
    const DVec<3> a = farthest([&](const DVec<3>& p) { return length(p - corners[0]); });
    const DVec<3> b = farthest([&](const DVec<3>& p) { return length(p - a); });
    const DVec<3> u = normalized(b - a);
    const DVec<3> c = farthest([&](const DVec<3>& p) { return length(cross(p - a, u)); });
    normals.push_back(normalized(cross(u, c - a)));
    normals.push_back(u);
    Random random(seed);
    for (int i = 0; i < 20; ++i) normals.push_back(random.direction<3>());
    OrientedBox best = box_along(corners, {axis<3>(0), axis<3>(1), axis<3>(2)});
    for (const DVec<3>& normal : normals) {
        const DVec<3> side = perpendicular(normal);
        const OrientedBox found = refined(corners, {normal, side, cross(normal, side)});
        if (found.volume() < best.volume()) best = found;
    }
    return best;
}

}  // namespace abut::oracle
