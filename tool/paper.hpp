#pragma once

// Paper for pictures: SVG of a size that fits what is shown.

#include <abut/draw/projected.hpp>
#include <abut/draw/svg.hpp>
#include <abut/math/aabb.hpp>

#include <cstddef>

namespace abut::tool {

/// The part of the plane on which a box of space is seen.
Aabb2 seen(const Aabb3& box, const Vec3& towards_eye, const Vec3& up = {0, 1, 0});

/// 1200 pixels wide, or high where that is more.
SvgCanvas paper_for(const Aabb2& plane);

/// Twelve that are told apart, again and again.
Color color_of_part(std::size_t part);

}  // namespace abut::tool
