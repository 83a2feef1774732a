#pragma once

// Where a surface that is meant to be closed isn't.

#include "level_view.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace abut::tool {

enum class LeakKind : std::uint8_t {
    hole,     ///< a border: edges with nothing beyond them, connected
    crack,    ///< a border that lies on another one without having its corners: T-junctions, seams with a slight gap
    crowded,  ///< edges of three or more triangles that don't pair up
    flipped,  ///< triangles that turn the other way than most of those they are connected with
};

struct Leak {
    LeakKind kind = LeakKind::hole;
    std::uint32_t triangle = 0;  ///< the lowest one that is part of it
    std::size_t count = 0;       ///< of edges; of triangles where they are flipped
    float length = 0;            ///< of all edges; 0 where triangles are flipped
    float extent = 0;            ///< the diagonal of the box around it; 0 where triangles are flipped
    Vec3 center{};               ///< of the edges or triangles
    double share = 0;            ///< of a hole: its flat area beside that of the connected surface; 1: not round
};

/// What a surface has of these, sorted by kind and triangle. Corners closer than `tolerance` are taken as one where
/// they are at a border, and a border corner closer than that to a border edge is on it. Triangles with the same
/// corners count once: a sheet with two sides is a sheet. O(n log n).
std::vector<Leak> mesh_leaks(const Surface<3>& surface, float tolerance);

/// A leak of a mesh, shown in the first object that is made of it.
struct LevelLeak : Leak {
    std::size_t object = 0;
    std::size_t objects = 1;  ///< how many are made of the mesh
};

/// A hole with less than this share of its surface counts as a fault where nobody says which objects are meant to be
/// closed: a face that is missing in a barrel of 24, not one of the twelve triangles of a box.
inline constexpr double small_hole = 0.05;

/// The leaks of all meshes; of those with an object that `is_meant_closed`, also large holes. Without it, of all
/// meshes, and small holes only: the outer border of a ground and the mouth of a bucket are none.
std::vector<LevelLeak> find_leaks(const std::vector<StandingObject<3>>& objects,
                                  const std::function<bool(const StandingObject<3>&)>& is_meant_closed);

}  // namespace abut::tool
