#pragma once

// Round the other side of a corner. For .cpp files.

#include <abut/walk/walk_path_strip.hpp>

#include <vector>

namespace abut {

/// The sides to cross instead of portals `corner.first` to `corner.last`, so as to have the corner on the other hand.
/// False where there is a border, or an edge that may not be crossed; and, where the directions from the corner to
/// what comes before it and after it are given, where the surface is half a turn wide or more between them. `product`
/// gets the scalar product of these two as they lie on the other side.
bool find_other_side(const WalkPathRules& rules, const WalkTaut& way, const WalkCorner& corner,
                     std::vector<WalkSide>& result, const DVec<2>* before = nullptr, const DVec<2>* after = nullptr,
                     double* product = nullptr);

}  // namespace abut
