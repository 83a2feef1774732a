#pragma once

// What there is to know of a walk mesh before anybody walks on it: its parts, its borders, and the places where it
// isn't what it seems.

#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>
#include <abut/walk/walk_mesh.hpp>
#include <abut/walk/walk_point.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A part of the surface from which no way leads to another.
struct WalkIsland {
    std::size_t triangles = 0;
    double area = 0;
    WalkPoint place;  ///< the middle of its largest triangle
    Aabb3 box = Aabb3::empty();
};

/// A closed line of edges with nothing beyond.
struct WalkBorder {
    std::uint32_t island = 0;
    /// In order, the last is joined to the first. The surface is to the left, seen from the side to which the normal of
    /// the triangle at the first edge points. A pinched point may be there more than once.
    std::vector<Vec3> points;
    double length = 0;
    /// It goes round the island, others round holes in it. What is around what can't be told on a surface in space (of
    /// a tube both ends are alike): the longest border of each island is its rim.
    bool is_rim = false;
};

struct WalkEdge {
    Vec3 from{}, to{};

    friend bool operator==(const WalkEdge&, const WalkEdge&) = default;
};

struct WalkSurvey {
    std::vector<WalkIsland> islands;  ///< by their numbers, see WalkMesh::island
    std::vector<WalkBorder> borders;  ///< by islands, then by the lowest triangle at each
    std::vector<Vec3> pinched;        ///< points where parts of the surface meet that no edge joins
    std::vector<WalkEdge> crowded;    ///< of more than two triangles
    std::vector<WalkEdge> mirrored;   ///< where triangles don't agree which side is up
};

/// The same for the same mesh on every machine. O(n log n).
WalkSurvey survey(const WalkMesh& mesh);

}  // namespace abut
