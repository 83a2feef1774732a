#pragma once

// A part of a body in the making: what planes have left of its surface, and the flat caps where they cut.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// All p where dot(normal, p) == offset.
struct CutPlane {
    DVec<3> normal;  ///< of length 1
    double offset;
};

/// A piece of a directed outline, counter-clockwise around its cap seen from outside of the body.
struct CapEdge {
    std::uint32_t from, to;
    std::uint32_t cap;
};

/// The surface and the caps together have no boundary where the body was closed, so that their volume is exact without
/// triangles for the caps: each edge of a cap with any one point of its plane makes a triangle, signed.
struct Piece {
    std::vector<DVec<3>> points;
    std::vector<glm::uvec3> triangles;  ///< of the surface, wound outwards
    std::vector<CapEdge> cap_edges;     ///< empty where the body is open
    std::vector<DVec<3>> cap_origins;   ///< one a cap: a point of its plane
    std::vector<DVec<3>> cap_normals;   ///< one a cap: outwards
    bool closed = true;

    /// What is open is taken as a shell so thick, or what is flat would be as good as any other part of its plane; 0
    /// where closed.
    double thickness = 0;

    double volume = 0;       ///< as `measure` finds it
    double hull_volume = 0;  ///< that of the convex hull, to about 1e-4, as thick
    double extra() const { return hull_volume - volume; }
};

struct SignedTriangle {
    DVec<3> a, b, c;
};

/// The surface and the caps as triangles, which enclose the piece.
std::vector<SignedTriangle> signed_triangles(const Piece& piece);

/// What lies below the plane and what lies above, in connected pieces: a hollow belongs to the piece around it. Points
/// within `margin` of the plane are taken to lie on it. A face in the plane stays with the body behind it; of what is
/// open it becomes a piece.
std::vector<Piece> cut(const Piece& piece, const CutPlane& plane, double margin);

/// The connected pieces of the surface and its caps, each with its volume; their hulls are yet to be measured.
std::vector<Piece> connected(const Piece& piece);

/// The volume it encloses, below zero where it is seen from inside; of what is open that of the shell.
double measured_volume(const Piece& piece);

/// Joins what has a volume below zero with the smallest body around it, where there is one.
void give_hollows(std::vector<Piece>& pieces);

}  // namespace abut
