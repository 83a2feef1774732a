#pragma once

// A* over triangles: finds the strip of triangles that a path crosses. For .cpp files.

#include <abut/walk/path/strip.hpp>

#include <optional>

namespace abut::detail {

/// A* over triangles (Hart, Nilsson & Raphael 1968). Each triangle is entered once, over one side. Its path is
/// represented by the last bend and the cone visible from there, in the unfolded plane of its strip. This is Polyanya
/// (Cui, Harabor & Grastien 2017) on a curved surface, with one cone per triangle instead of all.
///
/// The heuristic is the straight line in space at the minimum cost. If there is no path, `reached` receives the
/// triangles that can be reached. O(n) for n opened triangles, by a bucket queue.
std::optional<WalkStrip> find_strip(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to,
                                    std::vector<std::uint32_t>* reached = nullptr);

}  // namespace abut::detail
