#pragma once

// Shapes that a convex part may be, before it is known how well they fit. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <array>
#include <optional>

namespace abut {

using Axes = std::array<DVec<3>, 3>;

/// Right-handed and of length 1: those of a part's inertia, as its surface has it, the longest first.
Axes principal_axes(const Polyhedron& part);

/// A tight box about the part, no smaller one near it: of what is nearly a box, the smallest.
Box<3> box_about(const Polyhedron& part, const Axes& principal);

/// How deep a point is under the faces, exactly; where it is outside, minus its distance.
double depth_in(const Polyhedron& part, const DVec<3>& point);

/// The segment and the radius in the middle between what the part holds and what holds the part. For a ball the segment
/// is a point. Nothing where no ball about the segment's ends fits in.
std::optional<Capsule<3>> ball_near(const Polyhedron& part);
std::optional<Capsule<3>> capsule_near(const Polyhedron& part, const DVec<3>& axis);

/// How far a point is from a capsule's segment.
double distance_to_axis(const Capsule<3>& capsule, const DVec<3>& point);

}  // namespace abut
