#pragma once

// Checks of convex hulls that come from a file. For .cpp files.

#include <abut/convex/facets.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/math/detail/blob.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

template <>
struct BlobScalar<FacetEdge> {
    using type = std::uint32_t;
};

/// What is wrong with the corners of a polygon; null if nothing is: they are finite, counter-clockwise from the
/// lexicographically least, and turn left at each, decided exactly. So they are the corners of their own hull.
const char* fault_of_outline(std::span<const Vec2> corners);

/// What is wrong with a polyhedron; null if nothing is. Its corners are finite and in lexicographical order, its faces
/// are loops of different corners that close a surface without holes, its edges are those of its loops, and at each
/// edge and each corner of a loop the planes of the faces are those of a convex polyhedron, to rounding. A flat one has
/// two faces; one of up to two corners has none.
const char* fault_of_hull(std::span<const Vec3> corners, const Facets& facets);

/// Files of a polygon and of a polyhedron.
std::vector<std::byte> saved_polygon(std::span<const Vec2> corners);
std::vector<std::byte> saved_polyhedron(const Hull3& hull);

/// 0 for a point to 3 for a solid.
int rank_of_hull(std::size_t corners, std::size_t faces);

}  // namespace abut::detail
