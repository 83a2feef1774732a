#pragma once

// A place on a walk mesh, and what came of walking there.

#include <abut/math/function_ref.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/ext/quaternion_float.hpp>

namespace abut {

/// A point of the surface: it can't slip onto a bridge above, nor through a wall, as a position in space can. The
/// weights are of the triangle's corners: none below 0, sum 1. Those that a WalkMesh returns are whole multiples of
/// 2^-24 whose sum is exactly 1, after any number of steps; a point on an edge has a weight of exactly 0. Any three
/// numbers of 0 and above that are not all 0 are taken as given, as shares of their sum.
struct WalkPoint {
    std::uint32_t triangle = 0;
    Vec3 weights{1, 0, 0};

    friend bool operator==(const WalkPoint&, const WalkPoint&) = default;
};

/// No side, no triangle.
inline constexpr std::uint32_t no_walk_side = std::numeric_limits<std::uint32_t>::max();

/// A side of a triangle: side k goes from corner k to the next, so that corner k + 2 is opposite.
struct WalkSide {
    std::uint32_t triangle = no_walk_side;
    std::uint32_t side = 0;

    friend bool operator==(const WalkSide&, const WalkSide&) = default;
};

struct WalkTriangle;

/// How far the surface has turned what was carried along a way over it, without turning it within the surface: the
/// walker's frame, a velocity, what is left of a step. Refers to the mesh, and must not outlive it.
class WalkTurn {
public:
    /// Turns nothing.
    WalkTurn() = default;
    /// Between two triangles, for the walk mesh itself.
    WalkTurn(const WalkTriangle& from, const WalkTriangle& to, const Turn& in_plane, bool mirrored)
        : from_(&from), to_(&to), in_plane_(in_plane), mirrored_(mirrored) {}

    /// A vector of space as it is where the way ended: normals become normals, tangents tangents.
    Vec3 operator*(const Vec3& vector) const;
    /// The same of a vector in the first triangle's own frame (see WalkMesh::to_plane): in the last one's.
    Vec2 operator*(const Vec2& vector) const {
        return rotate(in_plane_, mirrored_ ? Vec2{vector.x, -vector.y} : vector);
    }

    /// As a rotation of space, of length 1.
    glm::quat in_space() const;
    /// In the frames of the triangles, after the second coordinate is turned over where it is mirrored.
    const Turn& in_plane() const { return in_plane_; }
    /// The way led over an odd number of edges at which triangles don't agree which side is up, as once round a Moebius
    /// strip: what was to the left of a vector in the frames is to its right, and the walker stands on the other side
    /// of the triangle than `normal` says.
    bool mirrored() const { return mirrored_; }

private:
    const WalkTriangle* from_ = nullptr;
    const WalkTriangle* to_ = nullptr;
    Turn in_plane_{};
    bool mirrored_ = false;
};

enum class WalkMet : std::uint8_t {
    nothing,  ///< all of the step was walked, straight on
    border,   ///< it slid along a border or a forbidden edge for a part of its way, and lost a part of its length
    corner,   ///< it met a border head on, or came into a corner, and stopped: the rest of its length was lost
    limit,    ///< it had crossed `WalkOptions::max_crossings` edges, and stopped: the rest counts as lost
};

struct Walked {
    WalkPoint place;
    float length = 0;  ///< of the way that was walked; with `lost` it is the length of the step along the surface
    float lost = 0;
    WalkMet met = WalkMet::nothing;
    WalkSide side;                ///< of the first border or forbidden edge that was met; none where none was
    WalkTurn turn;                ///< of the walker; `turn * step` points where the step has led
    std::uint32_t crossings = 0;  ///< edges walked over
};

/// As far as a step leads within its triangle.
struct WalkedInTriangle {
    WalkPoint end;
    float fraction = 1;                 ///< of the step that was walked; 1 where it ends within the triangle
    std::uint32_t side = no_walk_side;  ///< that it stopped at, where its fraction is less than 1
};

struct EdgeCrossing {
    WalkPoint place;    ///< the same point, as one of the triangle beyond
    WalkTurn rotation;  ///< about the edge; turns what is left of the step
};

/// Whether an edge may be crossed this way: who may climb, which door is closed. Asked of edges between two triangles
/// only, each time one is come to; must give the same answer each time within one call.
using WalkAllow = FunctionRef<bool(const WalkSide& from, const WalkSide& to)>;

struct WalkOptions {
    std::optional<WalkAllow> allow = std::nullopt;  ///< none: all may be crossed. Refers to the callable
    std::uint32_t max_crossings = 1u << 20;
};

}  // namespace abut
