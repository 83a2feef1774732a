#pragma once

// Canvases for SVG pictures.

#include <abut/draw/projected.hpp>
#include <abut/draw/svg.hpp>
#include <abut/math/aabb.hpp>

#include <cstddef>

namespace abut::tool {

/// The bounds of the projection of a 3D box to the picture plane.
Aabb2 projected_bounds(const Aabb3& box, const Vec3& towards_eye, const Vec3& up = {0, 1, 0});

/// A canvas whose longer side has 1200 pixels.
SvgCanvas make_canvas(const Aabb2& plane);

/// A palette of twelve distinct colours, repeated.
Color color_of_part(std::size_t part);

}  // namespace abut::tool
