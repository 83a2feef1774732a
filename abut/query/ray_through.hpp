#pragma once

// What of the world lies under a point of the screen: a ray for picking.

#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <glm/ext/matrix_float4x4.hpp>

namespace abut {

/// What a projection makes of the world. Graphics interfaces differ in it, and nothing in a matrix tells.
struct ClipSpace {
    float near_depth = -1;  ///< z / w of what is as near as can be seen
    float far_depth = 1;    ///< z / w of what is as far as can be seen
    bool y_down = false;    ///< y / w grows downwards on the screen
};
/// OpenGL's, and what glm makes without GLM_FORCE_DEPTH_ZERO_TO_ONE.
inline constexpr ClipSpace clip_one_to_one{-1, 1};
/// Direct3D's, Metal's, and Vulkan's where the projection turns y over.
inline constexpr ClipSpace clip_zero_to_one{0, 1};
/// The same with depth reversed, for more digits far away.
inline constexpr ClipSpace clip_reversed{1, 0};

/// The points of the world that are seen at `mouse`, from the near plane to the far plane. `viewport` is where on the
/// screen the picture is, in pixels or whatever the mouse is told in; y grows downwards, so that `min` is its upper
/// left corner. `view_projection` takes points of the world to clip space (projection * view). Perspective and
/// orthographic ones will do, mirrored ones too, and those without a far plane: then the ray has no end.
///
/// Where no ray is seen, as the matrix can't be inverted or holds a NaN, or the viewport has no size (a minimised
/// window): a ray of length 0 from the origin.
Ray<3> ray_through(const Vec2& mouse, const Aabb2& viewport, const glm::mat4& view_projection,
                   const ClipSpace& clip = {});

/// The same for a picture that fills its window, with the size of that.
inline Ray<3> ray_through(const Vec2& mouse, const Vec2& window, const glm::mat4& view_projection,
                          const ClipSpace& clip = {}) {
    return ray_through(mouse, Aabb2{Vec2(0), window}, view_projection, clip);
}

}  // namespace abut
