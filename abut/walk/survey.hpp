#pragma once

// Inspects a walk mesh: its connected components, its borders and its non-manifold parts.

#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>
#include <abut/walk/point.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A connected component of the surface: no path leads to another one.
struct WalkComponent {
    std::size_t triangles = 0;
    double area = 0;
    WalkPoint place;  ///< the centroid of its largest triangle
    Aabb3 box = Aabb3::empty();
};

/// A closed loop of border edges.
struct WalkBorder {
    std::uint32_t component = 0;
    /// The corners in order; the last is joined to the first. The surface is to the left, seen from the side to which
    /// the normal of the first edge's triangle points. A non-manifold vertex may occur more than once.
    std::vector<Vec3> points;
    double length = 0;
    /// The outer border of the component; the others are holes. On a surface in space the outer border isn't defined
    /// (the two ends of a tube are equal), so it is the longest one.
    bool is_rim = false;
};

struct WalkEdge {
    Vec3 from{}, to{};

    friend bool operator==(const WalkEdge&, const WalkEdge&) = default;
};

struct WalkSurvey {
    std::vector<WalkComponent> components;     ///< by number, see WalkMesh::component
    std::vector<WalkBorder> borders;           ///< sorted by component, then by the lowest adjacent triangle
    std::vector<Vec3> non_manifold_vertices;   ///< vertices at which triangles touch that no edge connects
    std::vector<WalkEdge> non_manifold_edges;  ///< edges of more than two triangles
    std::vector<WalkEdge> mirrored;            ///< edges at which triangles disagree which side is up
};

/// The result is the same on every machine. O(n log n).
WalkSurvey survey(const WalkMesh& mesh);

}  // namespace abut
