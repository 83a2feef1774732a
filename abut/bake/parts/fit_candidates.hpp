#pragma once

// Shapes fitted to a convex part, before their error is known. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polyhedron.hpp>

#include <array>
#include <optional>

#include <glm/ext/quaternion_double.hpp>

namespace abut::detail {

using Axes = std::array<DVec<3>, 3>;

/// q normalised, with the same bits on every machine, as glm::normalize takes the root of the C library.
glm::dquat normalized(const glm::dquat& q);

/// The principal axes of inertia of the part's surface, right-handed, unit length, longest first.
Axes principal_axes(const Polyhedron& part);

/// A locally smallest oriented bounding box of the part. For a part that is nearly a box it is the smallest one.
Box<3> oriented_box_around(const Polyhedron& part, const Axes& principal);

/// The exact depth of a point below the faces; outside, minus its distance.
double depth_in(const Polyhedron& part, const DVec<3>& point);

/// The capsule or ball halfway between the largest inscribed and the smallest circumscribed one with the same core. The
/// core of a ball is a point. Returns nothing if no ball around the ends of the core is inscribed.
std::optional<Capsule<3>> fit_ball(const Polyhedron& part);
std::optional<Capsule<3>> fit_capsule(const Polyhedron& part, const DVec<3>& axis);

/// The distance of a point from a capsule's core segment.
double distance_to_axis(const Capsule<3>& capsule, const DVec<3>& point);

}  // namespace abut::detail
