#pragma once

// Places on a walk mesh, and the results of walking.

#include <abut/math/function_ref.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/ext/quaternion_float.hpp>

namespace abut {

/// A point of the surface: a triangle and barycentric weights. Unlike a position in space it cannot slip onto a bridge
/// above or through a wall.
///
/// The weights are nonnegative with the sum 1. Weights that a WalkMesh returns are multiples of 2^-24 with exactly this
/// sum, after any number of steps, and a point on an edge has a weight of exactly 0. Any three nonnegative input
/// weights are accepted if they are not all 0; they are divided by their sum.
struct WalkPoint {
    std::uint32_t triangle = 0;
    Vec3 weights{1, 0, 0};

    friend bool operator==(const WalkPoint&, const WalkPoint&) = default;
};

/// No side, no triangle.
inline constexpr std::uint32_t no_walk_side = std::numeric_limits<std::uint32_t>::max();

/// A side of a triangle: side k goes from corner k to the next, so corner k + 2 is opposite.
struct WalkSide {
    std::uint32_t triangle = no_walk_side;
    std::uint32_t side = 0;

    friend bool operator==(const WalkSide&, const WalkSide&) = default;
};

}  // namespace abut

namespace abut::detail {

struct WalkTriangle;

}  // namespace abut::detail

namespace abut {

/// Parallel transport along a path over the surface, for the walker's frame, a velocity, or the rest of a step. Refers
/// to the mesh and must not outlive it.
class WalkTurn {
public:
    /// The identity.
    WalkTurn() = default;
    /// Between two triangles; made by the walk mesh.
    WalkTurn(const detail::WalkTriangle& from, const detail::WalkTriangle& to, const Turn& in_plane, bool mirrored)
        : from_(&from), to_(&to), in_plane_(in_plane), mirrored_(mirrored) {}

    /// Transports a vector of space: normals become normals, and tangents become tangents.
    Vec3 operator*(const Vec3& vector) const;
    /// Transports a vector from the first triangle's frame (see WalkMesh::to_plane) to that of the last.
    Vec2 operator*(const Vec2& vector) const {
        return rotate(in_plane_, mirrored_ ? Vec2{vector.x, -vector.y} : vector);
    }

    /// The transport as a rotation of space, a unit quaternion.
    glm::quat in_space() const;
    /// The transport as a rotation from frame to frame, applied after negating the second coordinate if mirrored.
    const Turn& in_plane() const { return in_plane_; }
    /// True if the path crossed an odd number of edges at which triangles disagree which side is up, as once around a
    /// Moebius strip. Left and right are then exchanged in the frames, and the walker stands on the side opposite to
    /// `normal`.
    bool mirrored() const { return mirrored_; }

private:
    const detail::WalkTriangle* from_ = nullptr;
    const detail::WalkTriangle* to_ = nullptr;
    Turn in_plane_{};
    bool mirrored_ = false;
};

enum class WalkMet : std::uint8_t {
    nothing,  ///< the whole step was walked straight
    border,   ///< slid along a border or a forbidden edge for a part of the step, and lost some of its length
    corner,   ///< stopped at a border head-on or in a corner; the rest of the step was lost
    limit,    ///< stopped after `WalkOptions::max_crossings` edges; the rest counts as lost
};

struct Walked {
    WalkPoint place;
    float length = 0;  ///< walked length; plus `lost` it is the length of the step along the surface
    float lost = 0;
    WalkMet met = WalkMet::nothing;
    WalkSide side;                ///< first border or forbidden edge; none if there was none
    WalkTurn turn;                ///< transports the walker's frame; `turn * step` is the final direction
    std::uint32_t crossings = 0;  ///< edges crossed
};

/// The result of a step within one triangle.
struct WalkedInTriangle {
    WalkPoint end;
    float fraction = 1;                 ///< fraction of the step that was walked; 1 if it ends within the triangle
    std::uint32_t side = no_walk_side;  ///< side at which it stopped, if the fraction is below 1
};

struct EdgeCrossing {
    WalkPoint place;    ///< the same point in the neighbour
    WalkTurn rotation;  ///< about the edge; transports the rest of the step
};

/// Decides whether an edge may be crossed in this direction: who may climb, which door is closed. It is called for
/// edges between two triangles, each time one is reached, and must return the same result within one call.
using WalkAllow = FunctionRef<bool(const WalkSide& from, const WalkSide& to)>;

struct WalkOptions {
    std::optional<WalkAllow> allow = std::nullopt;  ///< none: all edges may be crossed. Refers to the callable
    std::uint32_t max_crossings = 1u << 20;
};

}  // namespace abut
