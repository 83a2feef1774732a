#pragma once

// Contacts of two shapes with neighbours that continue their surfaces. For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>

namespace abut::detail {

/// Like each_contact, with the neighbours as parts of the surfaces. The flags are false where the contact replaces one
/// whose normal is no surface normal.
template <int D>
void each_contact_with_neighbours(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                                  const NeighbourSurfaces<D>& neighbours,
                                  FunctionRef<bool(const Contact<D>&, const detail::SurfaceNormalFlags&)> visit);

template <int D>
struct ContactWithNeighbours {
    Contact<D> contact;                          ///< empty if the surfaces don't touch
    bool touch = false;                          ///< whether the two shapes themselves touch
    detail::SurfaceNormalFlags surface_normals;  ///< false for a side whose surface doesn't have the pair's own normal
};

/// Like contact: the deepest contact of each_contact_with_neighbours.
template <int D>
ContactWithNeighbours<D> contact_with_neighbours(const View<D>& a, const View<D>& b,
                                                 const NeighbourSurfaces<D>& neighbours);

}  // namespace abut::detail
