#pragma once

// The shortest way through a strip, and then through those that lead round the other side of its corners. For .cpp
// files.

#include <abut/walk/walk_path_strip.hpp>

namespace abut {

/// Pulls the way tight. Where it turns at a corner and the surface on the other side of that corner is less than half a
/// turn wide, the strip is led round there, until there is no such corner: a geodesic (Xin & Wang 2007; Sharp & Crane
/// 2020, "You can find geodesic paths in triangle meshes by just flipping edges"). Then it is led round the other side
/// of each corner beside it, such as a peak, where what comes of that is shorter.
///
/// Where areas cost differently the way crosses from one to the next at the points that make it cheapest in its strip,
/// and is led round the corners that it touches wherever that is cheaper.
WalkTaut pulled_tight(const WalkPathRules& rules, WalkStrip strip);

}  // namespace abut
