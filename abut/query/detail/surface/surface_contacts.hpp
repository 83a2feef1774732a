#pragma once

// The contacts of two shapes as manifolds of their whole surfaces: contacts of parts that are on one plane are joined,
// and internal edges are filtered (ghost collisions). For .cpp files.

#include <abut/query/detail/surface/pair_edge_filter.hpp>
#include <abut/query/detail/surface/surface_manifold.hpp>

namespace abut::detail {

/// A manifold of the surfaces of two shapes.
template <int D>
struct SurfaceContact {
    Contact<D> contact;
    /// Of a contact whose normal is a substitute for one of an internal edge: the points on faces of the two shapes
    /// themselves. It may be empty, where another shape has the surface.
    Contact<D> own_area;
    /// False for a side whose surface doesn't have the normal of the parts' contact, which was replaced.
    SurfaceNormalFlags surface_normals;
    double size = 0;  ///< of the smaller shape, of a contact whose normal was replaced
};

/// Visits one contact for each plane on which two shapes touch, of which at least one is composite or has neighbours;
/// the visitor returns false to stop. The surfaces go on in the neighbours. Returns whether the shapes touch, even if
/// none of their surfaces do.
template <int D>
bool each_surface_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                          const NeighbourSurfaces<D>& neighbours, FunctionRef<bool(const SurfaceContact<D>&)> visit);

/// Filters the contact of two shapes of one part each that touch. `own` and `contact` are that contact without
/// neighbours.
template <int D>
SurfaceContact<D> filtered_contact(const View<D>& a, const View<D>& b, const PartContact<D>& own,
                                   const Contact<D>& contact, const NeighbourSurfaces<D>& neighbours,
                                   double margin = 0);

/// The deepest contact of two parts of two shapes.
template <int D>
struct DeepestParts {
    std::uint32_t index_a = 0, index_b = 0;
    PartContact<D> contact;

    /// Written out: clearing all of it first is slow.
    DeepestParts() {}
};

/// Finds the deepest parts; of composite shapes without the manifold. For two convex shapes it writes their contact
/// too. Returns false, and leaves `contact`, if the shapes don't touch. All numbers of the shapes are finite.
template <int D>
bool find_deepest_parts(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, DeepestParts<D>& deepest,
                        Contact<D>& contact);

/// Writes the contact on the plane of two parts that touch, the deepest such pair. Returns false, and writes nothing,
/// if that contact is on an internal edge, unless it `keeps_edges`.
template <int D>
bool whole_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const DeepestParts<D>& deepest,
                   bool keeps_edges, Contact<D>& result);

}  // namespace abut::detail
