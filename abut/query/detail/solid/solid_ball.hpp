#pragma once

// The depth of a ball, or a point, in a solid. For .cpp files.

#include <abut/query/closest.hpp>

namespace abut::detail {

bool is_ball(const View<3>& shape);

/// If the ball is deeper in the solid than touching it: a move that parts the two, and mostly the least one. `on_a` is
/// on the solid. Otherwise false.
bool find_ball_depth(const View<3>& solid, const View<3>& ball, Closest<3>& closest);

}  // namespace abut::detail
