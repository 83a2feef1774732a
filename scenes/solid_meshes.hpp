#pragma once

// Closed non-convex meshes: a knotted tube, and buildings of cubes.

#include "bumpy_ball.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::scenes {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::normalized;
using detail::to_float;

struct SolidMesh {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

inline void add(SolidMesh& mesh, const SolidMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
}

inline SolidMesh together(SolidMesh a, const SolidMesh& b) {
    add(a, b);
    return a;
}

inline SolidMesh inside_out(SolidMesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

inline SolidMesh moved(SolidMesh mesh, float scale, const Vec3& by) {
    for (Vec3& p : mesh.points) p = p * scale + by;
    return mesh;
}

/// A trefoil knot as a tube: `rings` of `sides` vertices each, and twice as many triangles. About 6 across, with radius
/// 0.5.
inline SolidMesh knotted_tube(std::uint32_t rings, std::uint32_t sides) {
    const auto along = [&](std::uint32_t ring) {
        const double at = 4.0 * ring / rings;  // in quarter turns
        const DVec<2> once = on_circle(at), twice = on_circle(2 * at), thrice = on_circle(3 * at);
        return DVec<3>(once.y + 2 * twice.y, once.x - 2 * twice.x, -thrice.y);
    };
    SolidMesh result;
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        const DVec<3> here = along(ring);
        const DVec<3> forwards = normalized(along((ring + 1) % rings) - along((ring + rings - 1) % rings));
        // The component of the radial direction that is perpendicular to the tube.
        const DVec<3> out =
            normalized(DVec<3>(here.x, here.y, 0) - forwards * (dot(forwards, DVec<3>(here.x, here.y, 0))));
        const DVec<3> up = cross(forwards, out);
        for (std::uint32_t side = 0; side < sides; ++side) {
            const DVec<2> around = on_circle(4.0 * side / sides);
            result.points.push_back(to_float(here + (out * around.x + up * around.y) * 0.5));
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t next_ring = (ring + 1) % rings, next_side = (side + 1) % sides;
            const std::uint32_t a = ring * sides + side, b = ring * sides + next_side;
            const std::uint32_t c = next_ring * sides + next_side, d = next_ring * sides + side;
            result.triangles.emplace_back(a, b, c);
            result.triangles.emplace_back(a, c, d);
        }
    return result;
}

/// The surface of unit cubes: storeys from the lowest up, each of rows, where '#' is a cube. Two triangles per exposed
/// side.
inline SolidMesh of_cubes(const std::vector<std::vector<std::string_view>>& storeys) {
    const auto filled = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        if (x < 0 || y < 0 || z < 0 || z >= static_cast<std::int64_t>(storeys.size())) return false;
        const std::vector<std::string_view>& rows = storeys[static_cast<std::size_t>(z)];
        if (y >= static_cast<std::int64_t>(rows.size())) return false;
        const std::string_view row = rows[static_cast<std::size_t>(y)];
        return x < static_cast<std::int64_t>(row.size()) && row[static_cast<std::size_t>(x)] == '#';
    };
    SolidMesh result;
    const auto add_side = [&](const DVec<3>& cube, int axis, bool far) {
        DVec<3> corner = cube;
        if (far) corner[axis] += 1;
        DVec<3> u(0.0), v(0.0);
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (const DVec<3>& p : {corner, corner + u, corner + u + v, corner + v}) result.points.push_back(to_float(p));
        const glm::uvec3 quad(far ? 1 : 3, 2, far ? 3 : 1);
        result.triangles.emplace_back(first, first + quad.x, first + quad.y);
        result.triangles.emplace_back(first, first + quad.y, first + quad.z);
    };
    for (std::size_t z = 0; z < storeys.size(); ++z)
        for (std::size_t y = 0; y < storeys[z].size(); ++y)
            for (std::size_t x = 0; x < storeys[z][y].size(); ++x) {
                const auto at = std::array{static_cast<std::int64_t>(x), static_cast<std::int64_t>(y),
                                           static_cast<std::int64_t>(z)};
                if (!filled(at[0], at[1], at[2])) continue;
                for (int axis = 0; axis < 3; ++axis)
                    for (const int sign : {-1, 1}) {
                        std::array<std::int64_t, 3> beside = at;
                        beside[static_cast<std::size_t>(axis)] += sign;
                        if (!filled(beside[0], beside[1], beside[2]))
                            add_side(DVec<3>(at[0], at[1], at[2]), axis, sign > 0);
                    }
            }
    return result;
}

/// Four walls with a door and two windows, and a floor: walls 1 thick, 10 by 8 by 6.
inline SolidMesh house() {
    const std::vector<std::string_view> floor(8, "##########"),
        walls = {"##########", "#        #", "#        #", "#        #",
                 "#        #", "#        #", "#        #", "##########"};
    std::vector<std::string_view> door = walls, door_and_windows = walls;
    door[0] = door_and_windows[0] = "####  ####";
    door_and_windows[3] = door_and_windows[4] = "          ";
    return of_cubes({floor, door, door_and_windows, door_and_windows, walls, walls});
}

}  // namespace abut::scenes
