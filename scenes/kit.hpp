#pragma once

// A kit of modular pieces, and rooms built of them on a grid: the meshes that level designers place face to face. Every
// coordinate is a multiple of 2^-10, so that faces that should touch do.

#include "../test/oracle/random.hpp"
#include <abut/math/vec.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::scenes {

/// A convex part of a piece, with the directions of its faces and edges.
struct KitPart {
    std::vector<Vec3> points, normals, edges;
};

/// A closed mesh, and convex parts whose union it is.
struct KitPiece {
    std::string name;
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    std::vector<KitPart> parts;
};

/// Axes turned in a cycle: x becomes y, y becomes z, z becomes x; `times` times.
inline Vec3 cycled(Vec3 v, int times) {
    for (int i = 0; i < times; ++i) v = {v.z, v.x, v.y};
    return v;
}

using KitLoops = std::vector<std::vector<std::uint32_t>>;

/// An outline, counter-clockwise in x and y, extruded along z from 0. Its convex pieces are given as loops of corners.
inline KitPiece kit_prism(std::string name, const std::vector<Vec2>& outline, const KitLoops& loops, float height,
                          int turns = 0) {
    KitPiece piece;
    piece.name = std::move(name);
    const auto count = static_cast<std::uint32_t>(outline.size());
    const auto corner = [&](std::uint32_t i, float z) { return cycled({outline[i].x, outline[i].y, z}, turns); };
    for (const float z : {0.0f, height})
        for (std::uint32_t i = 0; i < count; ++i) piece.points.push_back(corner(i, z));
    for (const std::vector<std::uint32_t>& loop : loops) {
        KitPart part;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 from = outline[loop[i]], along = outline[loop[(i + 1) % loop.size()]] - from;
            part.points.push_back(corner(loop[i], 0));
            part.points.push_back(corner(loop[i], height));
            part.normals.push_back(cycled({along.y, -along.x, 0}, turns));
            part.edges.push_back(cycled({along.x, along.y, 0}, turns));
        }
        part.normals.push_back(cycled({0, 0, 1}, turns));
        part.edges.push_back(cycled({0, 0, 1}, turns));
        piece.parts.push_back(std::move(part));
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
            piece.triangles.emplace_back(count + loop[0], count + loop[i], count + loop[i + 1]);
            piece.triangles.emplace_back(loop[0], loop[i + 1], loop[i]);
        }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        piece.triangles.emplace_back(i, next, count + next);
        piece.triangles.emplace_back(i, count + next, count + i);
    }
    return piece;
}

inline KitPiece kit_box(std::string name, const Vec3& low, const Vec3& high) {
    const Vec3 size = high - low;
    KitPiece piece =
        kit_prism(std::move(name), {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}}, {{0, 1, 2, 3}}, size.z);
    for (Vec3& point : piece.points) point += low;
    for (Vec3& point : piece.parts[0].points) point += low;
    return piece;
}

/// Both as one mesh; they may overlap or touch.
inline KitPiece joined(KitPiece a, const KitPiece& b) {
    const auto first = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
    a.parts.insert(a.parts.end(), b.parts.begin(), b.parts.end());
    return a;
}

/// The corners of a regular polygon, rounded to the grid.
inline std::vector<Vec2> kit_circle(std::uint32_t count, float radius) {
    std::vector<Vec2> corners;
    const double angle = 6.283185307179586 / static_cast<double>(count);
    for (std::uint32_t i = 0; i < count; ++i)
        corners.emplace_back(std::round(64 * std::cos(angle * i)) * (radius / 64),
                             std::round(64 * std::sin(angle * i)) * (radius / 64));
    return corners;
}

inline KitPiece kit_wheel(int turns) {
    std::vector<std::uint32_t> loop(16);
    for (std::uint32_t i = 0; i < 16; ++i) loop[i] = i;
    return kit_prism("wheel", kit_circle(16, 1), {loop}, 0.5f, turns);
}

inline KitPiece kit_arch(int turns) {
    const std::vector<Vec2> outer = kit_circle(16, 2), inner = kit_circle(16, 1);
    std::vector<Vec2> outline(outer.begin(), outer.begin() + 9);
    for (std::size_t i = 9; i-- > 0;) outline.push_back(inner[i]);
    KitLoops loops;
    for (std::uint32_t i = 0; i < 8; ++i) loops.push_back({i, i + 1, 16 - i, 17 - i});
    return kit_prism("arch", outline, loops, 1, turns);
}

/// T, L and U prisms and stairs in three directions each, wheels, arches, floors, walls, fences and blocks.
inline std::vector<KitPiece> kit() {
    std::vector<KitPiece> pieces;
    for (int turns = 0; turns < 3; ++turns) {
        pieces.push_back(kit_prism("T", {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 3}, {1, 3}, {1, 1}, {0, 1}},
                                   {{0, 1, 2, 3, 6, 7}, {3, 4, 5, 6}}, 1, turns));
        pieces.push_back(
            kit_prism("L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {{0, 1, 2, 3}, {0, 3, 4, 5}}, 1, turns));
        pieces.push_back(kit_prism("U", {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                   {{0, 1, 4, 5}, {1, 2, 3, 4}, {5, 6, 7, 0}}, 1, turns));
        pieces.push_back(kit_prism("stairs",
                                   {{0, 0}, {3, 0}, {3, 1.5f}, {2, 1.5f}, {2, 1}, {1, 1}, {1, 0.5f}, {0, 0.5f}},
                                   {{1, 2, 3, 4}, {1, 4, 5, 6}, {0, 1, 6, 7}}, 2, turns));
    }
    pieces.push_back(kit_wheel(0));
    pieces.push_back(kit_wheel(1));
    pieces.push_back(kit_arch(0));
    pieces.push_back(kit_arch(1));
    pieces.push_back(kit_box("floor", {0, 0, 0}, {4, 4, 0.25f}));
    pieces.push_back(kit_box("wall", {0, 0, 0}, {4, 0.25f, 3}));
    pieces.push_back(kit_box("box", {0, 0, 0}, {1, 1, 1}));
    pieces.push_back(
        joined(joined(kit_box("fence", {0, 0, 0}, {0.25f, 0.25f, 1}), kit_box("", {2, 0, 0}, {2.25f, 0.25f, 1})),
               kit_box("", {-0.25f, 0.0625f, 0.5f}, {2.5f, 0.1875f, 0.75f})));
    pieces.push_back(joined(joined(kit_box("blocks", {0, 0, 0}, {1, 1, 1}), kit_box("", {1, 0, 0}, {2, 1, 0.5f})),
                            kit_box("", {0, 0, 1}, {1, 0.5f, 2})));
    pieces.push_back(kit_prism("wedge", {{0, 0}, {2, 0}, {0, 1}}, {{0, 1, 2}}, 1, 0));
    pieces.push_back(kit_prism("wedge", {{0, 0}, {2, 0}, {0, 1}}, {{0, 1, 2}}, 1, 1));
    return pieces;
}

struct KitPlacement {
    std::size_t piece;  ///< index into kit()
    Vec3 position;
};

/// A small number by which a piece is off the grid: mostly 0, else 1e-4 to 0.5, in either direction.
inline float kit_offset(oracle::Random& random) {
    constexpr std::array<float, 8> sizes{0x1p-13f, 1e-4f, 1e-3f, 0.01f, 0.1f, 0.25f, 0.3f, 0.5f};
    if (random.chance(0.6)) return 0;
    const float size = sizes[random.below(sizes.size())];
    return random.chance(0.5) ? size : -size;
}

/// A place near another one: on the grid, or off it along one axis or along all.
inline Vec3 kit_position(oracle::Random& random, const Vec3& near, int reach) {
    Vec3 position = near;
    const std::uint32_t axes = random.below(3);
    for (int i = 0; i < 3; ++i) {
        position[i] +=
            static_cast<float>(random.below(static_cast<std::uint32_t>(2 * reach + 1))) - static_cast<float>(reach);
        if (axes == 2 || (axes == 1 && i == 0)) position[i] += kit_offset(random);
    }
    return position;
}

/// A room: a floor of tiles, walls around it, and pieces that stand on the floor, lean on walls and on one another, or
/// are off by a little.
inline std::vector<KitPlacement> kit_room(std::uint64_t seed, const std::vector<KitPiece>& pieces) {
    oracle::Random random(seed);
    const auto named = [&](const char* name) {
        std::size_t i = 0;
        while (pieces[i].name != name) ++i;
        return i;
    };
    const std::size_t floor = named("floor"), wall = named("wall");
    std::vector<KitPlacement> room;
    for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 2; ++y) {
            const Vec3 corner(static_cast<float>(4 * x), static_cast<float>(4 * y), -0.25f);
            room.push_back({floor, corner + Vec3(0, 0, kit_offset(random) < 0 ? 0x1p-13f : 0.0f)});
        }
        for (const float y : {-0.25f, 8.0f})
            room.push_back({wall, {static_cast<float>(4 * x), y, random.chance(0.3) ? kit_offset(random) : 0.0f}});
    }
    for (int i = 0; i < 14; ++i) {
        const Vec3 corner(static_cast<float>(random.below(10)), static_cast<float>(random.below(6)),
                          static_cast<float>(random.below(2)));
        const auto piece = static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(pieces.size())));
        room.push_back({piece, random.chance(0.5) ? corner : kit_position(random, corner, 0)});
    }
    return room;
}

}  // namespace abut::scenes
