#pragma once

// Hits with the normals of surfaces as they are felt. For .cpp files.

#include <abut/query/felt_normal.hpp>
#include <abut/query/hit.hpp>

namespace abut {

/// Where the normal of a hit is that of an edge inside a surface of parts, puts the surface's own in its place, if that
/// faces the mover. The hit is on a part of `shape`; `mover` is as it was at first, and has come by `came`; of the
/// surface, all parts are told by `each_foot`, with `shape` where `hit.point` lies on it.
template <int D>
void feel_hit(const View<D>& mover, const DVec<D>& came, const View<D>& shape, EachFoot<D> each_foot, Hit<D>& hit);

}  // namespace abut
