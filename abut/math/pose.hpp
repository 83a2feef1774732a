#pragma once

// Poses: position and rotation.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <type_traits>

#include <glm/ext/quaternion_float.hpp>

namespace abut {

/// A rotation in the plane, counter-clockwise, as a unit vector (cos, sin).
struct Turn {
    float cos = 1;
    float sin = 0;

    constexpr Turn() = default;
    constexpr Turn(float cosine, float sine) : cos(cosine), sin(sine) {}
    /// Deleted, since a single number would be an angle to the reader and a cosine to the compiler, also in
    /// Pose2{position, 0.785f}.
    Turn(float angle) = delete;  // write Turn::by(angle) for an angle

    /// The rotation by an angle in radians; the same bits on every machine, without trigonometry of the C library. NaN
    /// and infinity trip ABUT_ASSERT and give the identity.
    static Turn by(float radians);

    friend bool operator==(const Turn&, const Turn&) = default;
};

/// A rotation: a Turn in 2D, a unit quaternion in 3D. Queries normalise it, so a rotation that has drifted from length
/// 1 never scales.
template <int D>
using Rotation = std::conditional_t<D == 2, Turn, glm::quat>;

namespace detail {

/// The identity. It is a constant expression unless GLM_FORCE_INTRINSICS changes glm's quaternions.
template <int D>
constexpr Rotation<D> identity_rotation() {
    if constexpr (D == 2)
        return {1, 0};
    else
        return Rotation<D>(1, 0, 0, 0);
}

}  // namespace detail

template <int D>
inline const Rotation<D> no_rotation = detail::identity_rotation<D>();
template <>
inline constexpr Turn no_rotation<2> = detail::identity_rotation<2>();

/// A rigid transform: rotates by `rotation` about the origin, then translates by `position`.
template <int D>
struct Pose {
    Vec<D> position{};
    Rotation<D> rotation = detail::identity_rotation<D>();

    friend bool operator==(const Pose&, const Pose&) = default;
};
using Pose2 = Pose<2>;
using Pose3 = Pose<3>;

/// A pose with its position in double, for a LargeWorld.
template <int D>
struct PoseD {
    detail::DVec<D> position{0.0};
    Rotation<D> rotation = detail::identity_rotation<D>();

    friend bool operator==(const PoseD&, const PoseD&) = default;
};
using PoseD2 = PoseD<2>;
using PoseD3 = PoseD<3>;

/// The rotation by an angle in radians about an axis of length 1; the same bits on every machine.
glm::quat turn_about(const Vec3& axis, float radians);

Vec2 rotate(const Turn& rotation, const Vec2& v);
Vec3 rotate(const glm::quat& rotation, const Vec3& v);

/// Maps a local point to world space.
Vec2 operator*(const Pose2& pose, const Vec2& point);
Vec3 operator*(const Pose3& pose, const Vec3& point);

/// Composition: applies `inner` first, then `outer`.
Pose2 operator*(const Pose2& outer, const Pose2& inner);
Pose3 operator*(const Pose3& outer, const Pose3& inner);

Pose2 inverse(const Pose2& pose);
Pose3 inverse(const Pose3& pose);

#ifdef GLM_FORCE_QUAT_CTOR_XYZW
#error "abut needs glm's quaternions made of w x y z: build without GLM_FORCE_QUAT_CTOR_XYZW"
#endif
static_assert(sizeof(glm::quat) == 4 * sizeof(float) && offsetof(glm::quat, x) == 0,
              "abut needs glm's quaternions stored x y z w: build without GLM_FORCE_QUAT_DATA_WXYZ");

}  // namespace abut
