#pragma once

// Two plain shapes of the plane of which one moves straight, answered from the shapes as they were given, without views
// of them. For .cpp files.

#include <abut/query/direct.hpp>
#include <abut/query/hit.hpp>

#include <optional>

namespace abut {

/// Unknown where the answer isn't plain, as of what starts in touch, slides or grazes. Unless they touch, `result` is
/// as it was.
DirectAnswer direct_sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                          std::optional<Hit<2>>& result);

}  // namespace abut
