#pragma once

// Finds where a mesh is not watertight.

#include "tool/objects/level_view.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace abut::tool {

enum class LeakKind : std::uint8_t {
    hole,          ///< a connected set of boundary edges
    crack,         ///< boundaries that coincide without shared vertices: T-junctions, and seams with a tiny gap
    non_manifold,  ///< non-manifold edges: of three or more triangles, not paired by orientation
    flipped,       ///< triangles oriented against most of those they are connected with
};

struct Leak {
    LeakKind kind = LeakKind::hole;
    std::uint32_t triangle = 0;  ///< lowest index of a triangle at the leak
    std::size_t count = 0;       ///< count of edges; of triangles for `flipped`
    float length = 0;            ///< total length of the edges; 0 for `flipped`
    float extent = 0;            ///< diagonal of the bounding box; 0 for `flipped`
    Vec3 center{};               ///< of the edges or triangles
    double share =
        0;  ///< for a hole: its area as a fraction of the connected surface's area; 1 if it is not a closed loop
};

/// Finds the leaks of a surface, sorted by kind and triangle. Boundary vertices closer than `tolerance` are merged, and
/// a boundary vertex closer than that to a boundary edge splits it. Triangles with the same vertices count once, so
/// that a two-sided sheet is a sheet. Takes O(n log n) time.
std::vector<Leak> mesh_leaks(const Surface<3>& surface, float tolerance);

/// A leak of a mesh, reported for the first object that uses the mesh.
struct LevelLeak : Leak {
    std::size_t object = 0;
    std::size_t objects = 1;  ///< count of objects that use the mesh
};

/// Holes with a smaller fraction of the surface's area are faults in meshes that are not declared closed. A missing
/// face of a barrel with 24 faces is one, and a missing triangle of a box with twelve is not.
inline constexpr double small_hole = 0.05;

/// Finds the leaks of all meshes, or only of meshes of objects that `is_meant_closed` accepts, including large holes.
/// Without that function only small holes count: the outer boundary of a ground and the mouth of a bucket are none.
std::vector<LevelLeak> find_leaks(const std::vector<ViewedObject<3>>& objects,
                                  const std::function<bool(const ViewedObject<3>&)>& is_meant_closed);

}  // namespace abut::tool
