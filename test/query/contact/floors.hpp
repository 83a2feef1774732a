#pragma once

// Level floors made of pieces of every kind, whose internal edges should give no ghost collisions.

#include "../../oracle/random.hpp"
#include <abut/shape/box.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/segment.hpp>

#include <cmath>
#include <vector>

namespace abut::test {

using oracle::Random;

/// A composite of several shapes.
template <class S>
struct Pieces {
    std::vector<S> pieces;
};
template <class S>
auto bounds(const Pieces<S>& shape) {
    using Box = decltype(bounds(convex(shape.pieces[0])));
    Box box = Box::empty();
    for (const S& piece : shape.pieces) box = merged(box, bounds(convex(piece)));
    return box;
}
template <class S, class Box, class Visit>
void each_part(const Pieces<S>& shape, const Box& box, Visit&& visit) {
    for (std::uint32_t i = 0; i < shape.pieces.size(); ++i)
        if (overlaps(bounds(convex(shape.pieces[i])), box) && !visit(shape.pieces[i], i)) return;
}

/// The number of pieces along each axis, each 1 wide, from 0 on; the surface is at height 0.
inline constexpr int tiles = 8;

/// A perturbation like the rounding of heights and seams in float.
inline float about(float number, Random* random) {
    return random != nullptr ? number + random->uniform_float(-1e-6, 1e-6) : number;
}

inline Mesh level_mesh(Random* random) {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (int z = 0; z <= tiles; ++z)
        for (int x = 0; x <= tiles; ++x) points.push_back({x, about(0, random), z});
    const auto at = [&](int x, int z) { return static_cast<std::uint32_t>(z * (tiles + 1) + x); };
    for (int z = 0; z < tiles; ++z)
        for (int x = 0; x < tiles; ++x) {
            triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
            triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
        }
    return *Mesh::build(points, triangles);
}

/// Triangles without shared vertices: T-junctions, gaps and doubled triangles.
inline Mesh broken_mesh(Random* random) {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        for (int twice = 0; twice < 2; ++twice) {
            const auto first = static_cast<std::uint32_t>(points.size());
            for (const Vec3& p : {a, b, c})
                points.push_back({about(p.x, random), about(p.y, random), about(p.z, random)});
            triangles.push_back({first, first + 1, first + 2});
        }
    };
    for (int z = 0; z < tiles; ++z) {
        const float shift = z % 2 == 0 ? 0 : -0.37f, low = static_cast<float>(z);
        for (int i = 0; i <= tiles; ++i) {
            const float x = static_cast<float>(i) + shift;
            add({x, 0, low}, {x, 0, low + 1}, {x + 1, 0, low});
            add({x + 1, 0, low}, {x, 0, low + 1}, {x + 1, 0, low + 1});
        }
    }
    return *Mesh::build(points, triangles);
}

inline Pieces<Box3> boxes_in_space(Random* random) {
    Pieces<Box3> result;
    for (int z = 0; z < tiles; ++z)
        for (int x = 0; x < tiles; ++x)
            result.pieces.push_back(
                {{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random), static_cast<float>(z) + 0.5f},
                 {0.5f, 0.5f, 0.5f}});
    return result;
}
inline Pieces<Box2> boxes_of_the_plane(Random* random) {
    Pieces<Box2> result;
    for (int x = 0; x < tiles; ++x)
        result.pieces.push_back({{about(static_cast<float>(x) + 0.5f, random), about(-0.5f, random)}, {0.5f, 0.5f}});
    return result;
}
inline Pieces<Segment2> segments(Random* random) {
    Pieces<Segment2> result;
    std::vector<Vec2> points;
    for (int x = 0; x <= tiles; ++x) points.push_back({x, about(0, random)});
    for (std::size_t x = 0; x < tiles; ++x) result.pieces.push_back({points[x], points[x + 1]});
    return result;
}

}  // namespace abut::test
