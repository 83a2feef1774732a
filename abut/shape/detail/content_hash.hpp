#pragma once

// A hash of a shape's content, by which a snapshot names the shapes that it doesn't contain.

#include <abut/shape/view/view.hpp>

#include <cstdint>

namespace abut::detail {

/// The same on every machine, and never 0. It includes the points and radii of a convex shape and of all parts of a
/// composite, and, because functions can't be compared, samples of a user's support or distance function.
template <int D>
std::uint64_t content_hash(const View<D>& view);

}  // namespace abut::detail
