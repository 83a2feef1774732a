#pragma once

// Meshes for tests, as points and triangles that tests can change.

#include "../oracle/random.hpp"
#include <abut/shape/mesh.hpp>

#include <array>
#include <functional>
#include <vector>

namespace abut::test {

using detail::axis;
using detail::to_float;

struct Surface {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;

    Mesh mesh() const { return *Mesh::build(points, triangles); }

    /// Adds a square: four corners, counter-clockwise seen from outside, cut along one diagonal or the other.
    void add_quad(const std::array<Vec3, 4>& corner, bool other_diagonal) {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), corner.begin(), corner.end());
        const std::uint32_t turn = other_diagonal ? 1 : 0;
        const auto index = [&](std::uint32_t i) { return first + (i + turn) % 4; };
        triangles.emplace_back(index(0), index(1), index(2));
        triangles.emplace_back(index(0), index(2), index(3));
    }
};

/// The union of two meshes.
inline Surface joined(Surface a, const Surface& b) {
    const auto first = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
    return a;
}

/// Reverses the winding of all triangles.
inline Surface reversed(Surface a) {
    for (glm::uvec3& t : a.triangles) std::swap(t.y, t.z);
    return a;
}

/// The eight corners of a box, shared by its twelve triangles.
inline Surface box_surface(const Vec3& min, const Vec3& max) {
    Surface result;
    for (int i = 0; i < 8; ++i)
        result.points.emplace_back((i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                                   (i & 4) != 0 ? max.z : min.z);
    result.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return result;
}

/// Whether the unit cell from (x, y, z) to (x + 1, y + 1, z + 1) is full.
using Cells = std::function<bool(int x, int y, int z)>;

/// The surface of a solid of unit cells in [0, size)^3, outwards; each square has points of its own.
inline Surface cell_surface(int size, const Cells& full) {
    const auto inside = [&](int x, int y, int z) {
        const bool in_range = x >= 0 && y >= 0 && z >= 0 && x < size && y < size && z < size;
        return in_range && full(x, y, z);
    };
    Surface result;
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z)
                for (int axis = 0; axis < 3; ++axis)
                    for (int up = 0; up < 2; ++up) {
                        std::array<int, 3> next{x, y, z};
                        next[static_cast<std::size_t>(axis)] += up == 1 ? 1 : -1;
                        if (!inside(x, y, z) || inside(next[0], next[1], next[2])) continue;
                        Vec3 u(0), v(0), corner(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                        u[(axis + 1) % 3] = 1;
                        v[(axis + 2) % 3] = 1;
                        if (up == 1)
                            corner[axis] += 1;
                        else
                            std::swap(u, v);
                        result.add_quad({corner, corner + u, corner + u + v, corner + v}, (x + y + z) % 2 == 0);
                    }
    return result;
}

/// Heights over the grid 0..cells in x and y.
struct Terrain {
    int cells = 0;
    std::vector<float> heights;

    float height(int x, int y) const { return heights[static_cast<std::size_t>(y * (cells + 1) + x)]; }
    Vec3 corner(int x, int y) const { return {static_cast<float>(x), static_cast<float>(y), height(x, y)}; }

    /// The height of the surface for x and y in [0, cells): each square is two triangles, cut from its lowest corner to
    /// its highest.
    double height_at(double x, double y) const {
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = x - i, v = y - j;
        const double low = static_cast<double>(height(i, j)), high = static_cast<double>(height(i + 1, j + 1));
        const double along_x = static_cast<double>(height(i + 1, j)), along_y = static_cast<double>(height(i, j + 1));
        return u > v ? low + u * (along_x - low) + v * (high - along_x)
                     : low + v * (along_y - low) + u * (high - along_y);
    }

    Surface surface() const {
        Surface result;
        for (int y = 0; y <= cells; ++y)
            for (int x = 0; x <= cells; ++x) result.points.push_back(corner(x, y));
        const auto index = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x) {
                result.triangles.emplace_back(index(x, y), index(x + 1, y), index(x + 1, y + 1));
                result.triangles.emplace_back(index(x, y), index(x + 1, y + 1), index(x, y + 1));
            }
        return result;
    }

    /// The terrain closed by walls, and by a floor of two triangles per square at the given height.
    Surface solid(float floor) const {
        Terrain flat = *this;
        for (float& height : flat.heights) height = floor;
        Surface result = joined(surface(), reversed(flat.surface()));
        const auto wall = [&](int x, int y, int to_x, int to_y) {
            result.add_quad({flat.corner(x, y), flat.corner(to_x, to_y), corner(to_x, to_y), corner(x, y)}, x % 2 == 0);
        };
        for (int i = 0; i < cells; ++i) {
            wall(i, 0, i + 1, 0);
            wall(i + 1, cells, i, cells);
            wall(0, i + 1, 0, i);
            wall(cells, i, cells, i + 1);
        }
        return result;
    }
};

inline Terrain random_terrain(oracle::Random& random, int cells, double roughness) {
    Terrain result{cells, {}};
    for (int i = 0; i < (cells + 1) * (cells + 1); ++i) result.heights.push_back(random.uniform_float(0, roughness));
    return result;
}

/// A scale of 0.5 to 2 along each axis, mirrored half of the time.
inline Vec3 random_scale(oracle::Random& random) {
    Vec3 result;
    for (int i = 0; i < 3; ++i) {
        const bool mirrored = random.chance(0.5);
        result[i] = random.uniform_float(0.5, 2) * (mirrored ? -1.0f : 1.0f);
    }
    return result;
}

/// Random triangles in a cube.
inline Surface random_soup(oracle::Random& random, int count, double extent, double size) {
    Surface result;
    for (int i = 0; i < count; ++i) {
        const detail::DVec<3> center = random.in_cube<3>() * extent;
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (int j = 0; j < 3; ++j) result.points.push_back(to_float(center + random.in_cube<3>() * size));
        result.triangles.emplace_back(first, first + 1, first + 2);
    }
    return result;
}

}  // namespace abut::test
