#pragma once

// The questions about two plain shapes, answered from the shapes as they were given, without views of them: circles,
// capsules, segments, triangles, boxes and polygons of few sides in the plane; spheres, capsules and boxes in space.
// The answers are those of `convex_pair`, but for rounding. For .cpp files.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>

namespace abut {

enum class DirectAnswer : std::uint8_t { no, yes, unknown };

DirectAnswer direct_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache);
DirectAnswer direct_overlap(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache);

// False where they have no answer: `result` is as it was then.

bool direct_closest(const ShapeRef<3>& a, const ShapeRef<3>& b, Cache* cache, Closest<3>& result);

bool direct_contact(const ShapeRef<3>& a, const ShapeRef<3>& b, double margin, Cache* cache, Contact<3>& result);

}  // namespace abut
