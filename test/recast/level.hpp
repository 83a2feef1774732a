#pragma once

// Levels of boxes and slopes, and queries of the walk meshes that are baked from them.

#include <abut/math/dvec.hpp>
#include <abut/recast/bake_walk_mesh.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace abut::recast_test {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;

struct Level {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;

    /// A square that faces the side from which its corners are counter-clockwise.
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const std::uint32_t first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), {a, b, c, d});
        triangles.push_back({first, first + 1, first + 2});
        triangles.push_back({first, first + 2, first + 3});
    }
    /// A horizontal rectangle, facing up.
    void floor(float x0, float z0, float x1, float z1, float y = 0) {
        quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
    }
    void box(const Vec3& a, const Vec3& b) {
        quad({a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z});
        quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
        quad({a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z});
        quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
        quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
        quad({b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z});
    }
    /// A slope that rises along x, from z0 to z1.
    void slope(const Vec3& low, const Vec3& high) {
        quad({low.x, low.y, low.z}, {low.x, low.y, high.z}, {high.x, high.y, high.z}, {high.x, high.y, low.z});
    }

    Result<WalkMesh> bake(const WalkMeshBakeOptions& options = {}) const {
        return bake_walk_mesh(points, triangles, options);
    }
};

/// The triangle nearest above or below a point along the second axis, with its index and height, if there is one.
struct Above {
    bool found = false;
    std::uint32_t triangle = 0;
    double height = 0;
};
inline Above at(const WalkMesh& mesh, const Vec3& place) {
    Above result;
    const DVec<3> p(place);
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        const glm::uvec3 t = mesh.triangles()[i];
        const DVec<3> a(mesh.points()[t.x]), u = DVec<3>(mesh.points()[t.y]) - a, v = DVec<3>(mesh.points()[t.z]) - a;
        const DVec<3> w = p - a;
        const double area = u.x * v.z - u.z * v.x;
        const double second = (w.x * v.z - w.z * v.x) / area, third = (u.x * w.z - u.z * w.x) / area;
        if (!(second >= -1e-9) || !(third >= -1e-9) || !(second + third <= 1 + 1e-9)) continue;
        const double height = a.y + second * u.y + third * v.y;
        if (result.found && std::abs(height - p.y) >= std::abs(result.height - p.y)) continue;
        result = {true, i, height};
    }
    return result;
}

/// Whether there is floor at this height, to within `off`.
inline bool is_floor(const WalkMesh& mesh, const Vec3& place, double off = 0.05) {
    const Above found = at(mesh, place);
    return found.found && std::abs(found.height - static_cast<double>(place.y)) <= off;
}

/// Whether a path joins the two points.
inline bool joined(const WalkMesh& mesh, const Vec3& from, const Vec3& to) {
    const Above a = at(mesh, from), b = at(mesh, to);
    return a.found && b.found && mesh.component(a.triangle) == mesh.component(b.triangle);
}

/// The projection along the second axis.
inline double area_of(const WalkMesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles()) {
        const DVec<3> a(mesh.points()[t.x]);
        sum += 0.5 * cross(DVec<3>(mesh.points()[t.y]) - a, DVec<3>(mesh.points()[t.z]) - a).y;
    }
    return sum;
}

/// The number of corners on or near a border edge without being its ends: cracks of the mesh.
inline std::size_t cracks_of(const WalkMesh& mesh, double near) {
    std::vector<std::uint8_t> on_border(mesh.points().size(), 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (!mesh.is_walkable(i) || mesh.beyond({i, k})) continue;
            const glm::uvec3& t = mesh.triangles()[i];
            const auto a = static_cast<glm::length_t>(k), b = static_cast<glm::length_t>((k + 1) % 3);
            border.emplace_back(t[a], t[b]);
            on_border[t[a]] = on_border[t[b]] = 1;
        }
    std::size_t result = 0;
    for (const auto& [a, b] : border) {
        const DVec<3> start(mesh.points()[a]), side = DVec<3>(mesh.points()[b]) - start;
        for (std::uint32_t i = 0; i < mesh.points().size(); ++i) {
            if (on_border[i] == 0 || i == a || i == b) continue;
            const DVec<3> offset = DVec<3>(mesh.points()[i]) - start;
            const double along = std::min(1.0, std::max(0.0, dot(offset, side) / dot(side, side)));
            if (length(offset - side * along) < near) ++result;
        }
    }
    return result;
}

}  // namespace abut::recast_test
