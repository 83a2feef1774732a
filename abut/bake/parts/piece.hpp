#pragma once

// A piece of a body during decomposition: what the cuts have left of its surface, and the flat caps of the cuts.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The plane of all p with dot(normal, p) == offset.
struct CutPlane {
    DVec<3> normal;  ///< unit length
    double offset;
};

/// An edge of a cap's outline, counter-clockwise around the cap seen from outside the body.
struct CapEdge {
    std::uint32_t from, to;
    std::uint32_t cap;
};

/// The surface and the caps of a closed body together have no boundary. The enclosed volume is therefore exact without
/// a triangulation of the caps: each edge of a cap and any point of its plane form a signed triangle.
struct Piece {
    std::vector<DVec<3>> points;
    std::vector<glm::uvec3> triangles;  ///< of the surface, oriented outwards
    std::vector<CapEdge> cap_edges;     ///< empty if the body is open
    std::vector<DVec<3>> cap_origins;   ///< one per cap: a point of its plane
    std::vector<DVec<3>> cap_normals;   ///< one per cap: outwards
    bool closed = true;

    /// An open body counts as a shell of this thickness, so that flat pieces can be compared; 0 if closed.
    double thickness = 0;

    double volume = 0;       ///< as computed by `measured_volume`
    double hull_volume = 0;  ///< volume of the convex hull, accurate to about 1e-4; thickened as the piece
    double excess_volume() const { return hull_volume - volume; }
};

struct SignedTriangle {
    DVec<3> a, b, c;
};

/// The surface and the caps as signed triangles, which enclose the piece.
std::vector<SignedTriangle> signed_triangles(const Piece& piece);

/// Cuts a piece and returns the connected components below and above the plane. A cavity belongs to the component
/// around it. Points within `tolerance` of the plane count as lying on it. A coplanar face belongs to the body behind
/// it; of an open piece it becomes a component of its own.
std::vector<Piece> cut(const Piece& piece, const CutPlane& plane, double tolerance);

/// The connected components of the surface and its caps, by union-find. Their volumes are computed, their hulls are
/// not.
std::vector<Piece> connected_components(const Piece& piece);

/// The enclosed volume, negative if the surface is oriented inwards. For an open piece, the volume of its shell.
double measured_volume(const Piece& piece);

/// Joins each component of negative volume with the smallest component around it, if there is one.
void join_cavities(std::vector<Piece>& pieces);

/// The connected components of a mesh in the order of their first triangles. One that is closed and oriented outwards
/// is solid, and the cavities in it belong to it. Any other is a shell of the given thickness. Points are welded.
std::vector<Piece> components_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, double thickness);

/// True if the piece has no caps and is the surface of a convex solid.
bool is_convex(const Piece& component);

}  // namespace abut::detail
