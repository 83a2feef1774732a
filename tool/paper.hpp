#pragma once

// Paper for pictures: SVG of a size that fits what is shown.

#include <abut/draw/projected.hpp>
#include <abut/draw/svg.hpp>
#include <abut/math/aabb.hpp>

namespace abut::tool {

/// The part of the plane on which a box of space is seen, y being up.
Aabb2 seen(const Aabb3& box, const Vec3& towards_eye);

/// 1200 pixels wide, or high where that is more.
SvgCanvas paper_for(const Aabb2& plane);

}  // namespace abut::tool
