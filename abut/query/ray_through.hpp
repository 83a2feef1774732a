#pragma once

// A picking ray: the points of the world under a position on the screen.

#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <glm/ext/matrix_float4x4.hpp>

namespace abut {

/// The conventions of a projection's clip space. Graphics APIs differ in them, and a matrix doesn't tell them.
struct ClipSpace {
    float near_depth = -1;  ///< z / w on the near plane
    float far_depth = 1;    ///< z / w on the far plane
    bool y_down = false;    ///< y / w grows downwards on the screen
};
/// OpenGL, and the matrices of glm without GLM_FORCE_DEPTH_ZERO_TO_ONE.
inline constexpr ClipSpace clip_one_to_one{-1, 1};
/// Direct3D and Metal, and Vulkan if the projection flips y.
inline constexpr ClipSpace clip_zero_to_one{0, 1};
/// Depth from 0 to 1, reversed for more precision far away.
inline constexpr ClipSpace clip_reversed{1, 0};

/// The ray of all points seen at `mouse`, from the near plane to the far plane. `viewport` is the rectangle of the
/// picture on the screen, in pixels or the unit of the mouse; y grows downwards, so that `min` is its upper left
/// corner. `view_projection` transforms world to clip space (projection * view). Perspective and orthographic
/// projections work, also mirrored ones, and those without a far plane: then the ray is infinite.
///
/// If there is no such ray, because the matrix can't be inverted or holds a NaN, or the viewport has no size (a
/// minimised window), the result is a ray of length 0 from the origin.
Ray<3> ray_through(const Vec2& mouse, const Aabb2& viewport, const glm::mat4& view_projection,
                   const ClipSpace& clip = {});

/// The ray for a picture that fills a window of this size.
inline Ray<3> ray_through(const Vec2& mouse, const Vec2& window, const glm::mat4& view_projection,
                          const ClipSpace& clip = {}) {
    return ray_through(mouse, Aabb2{Vec2(0), window}, view_projection, clip);
}

}  // namespace abut
