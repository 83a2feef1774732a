#pragma once

// From triangle to triangle: which strip of them a way leads through. For .cpp files.

#include <abut/walk/walk_path_strip.hpp>

#include <optional>

namespace abut {

/// A* over triangles (Hart, Nilsson & Raphael 1968). Each is entered once, over one side, by a way that is known as the
/// last corner it turned at and the cone that is seen from there, in the plane of its strip unfolded: as Polyanya's
/// (Cui, Harabor & Grastien 2017) on ground that is curved, but for one cone a triangle instead of all.
/// What is still to go is the straight line in space at the least cost. `reached` gets the triangles that the way may
/// lead to, where there is none to the end. O(n) in buckets, of the triangles opened.
std::optional<WalkStrip> find_strip(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to,
                                    std::vector<std::uint32_t>* reached = nullptr);

}  // namespace abut
