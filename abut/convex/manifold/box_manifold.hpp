#pragma once

// The contact manifold of two boxes.

#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/box_closest.hpp>

namespace abut::detail {

/// As `manifold`, from the closest features of two boxes. Feature names are its own: they persist while the same
/// corners and edges touch and the same face is the reference. If the normal is that of a face, the closest point need
/// not be known: it is written to `on_a`, in the world, unless that is null. Returns false, with the points undefined,
/// if it isn't found.
bool manifold_of_boxes(const PlacedBox& a, const PlacedBox& b, const BoxFrame& frame, const BoxClosest& closest,
                       double margin, lanes::Double3* on_a, Manifold<3>& points);

}  // namespace abut::detail
