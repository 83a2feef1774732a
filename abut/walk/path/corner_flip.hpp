#pragma once

// Flips a path around a corner to its other side. For .cpp files.

#include <abut/walk/path/strip.hpp>

#include <vector>

namespace abut::detail {

/// The sides to cross instead of portals `corner.first` to `corner.last`, so that the path passes the corner on its
/// other side. Returns false if there is a border or a forbidden edge. If directions from the corner to the path before
/// and after it are given, it also returns false if their angle on the other side is 180 degrees or more. `product`
/// receives the scalar product of these directions on the other side.
bool sides_around_corner(const WalkPathRules& rules, const WalkTautPath& path, const WalkCorner& corner,
                         std::vector<WalkSide>& result, const DVec<2>* before = nullptr, const DVec<2>* after = nullptr,
                         double* product = nullptr);

}  // namespace abut::detail
