#pragma once

// The shortest way through a strip, and then through those that lead round the other side of its corners. For .cpp
// files.

#include <abut/walk/walk_path_strip.hpp>

#include <vector>

namespace abut {

/// Pulls the way tight. Where it turns at a corner and the surface on the other side of that corner is less than half a
/// turn wide, the strip is led round there, until there is no such corner: a geodesic (Xin & Wang 2007; Sharp & Crane
/// 2020, "You can find geodesic paths in triangle meshes by just flipping edges"). Where the cost of the areas changes,
/// the way crosses at the point that makes it cheapest, and the strip is led round corners wherever that is cheaper.
WalkTaut pulled_tight(const WalkPathRules& rules, WalkStrip strip);

}  // namespace abut
