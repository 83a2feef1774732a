#pragma once

// Shortens a path within its strip, and by flipping the strip around corners. For .cpp files.

#include <abut/walk/path/strip.hpp>

namespace abut::detail {

/// Pulls the path tight and flips it around each corner at which it bends and whose other side has an angle below 180
/// degrees. Without such corners it is a geodesic (Xin & Wang 2007; Sharp & Crane 2020, "You can find geodesic paths in
/// triangle meshes by just flipping edges"). Then it tries the other side of each adjacent corner, such as a peak, if
/// the result is shorter.
///
/// If the costs of areas differ, the path crosses between areas at the points that are cheapest within its strip, and
/// flips are tried at the corners that it touches.
WalkTautPath shorten_path(const WalkPathRules& rules, WalkStrip strip);

}  // namespace abut::detail
