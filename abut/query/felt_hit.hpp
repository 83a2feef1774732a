#pragma once

// Hits with the normals of surfaces as they are felt. For .cpp files.

#include <abut/math/rigid_path.hpp>
#include <abut/query/felt_normal.hpp>
#include <abut/query/hit.hpp>

namespace abut {

/// What has come to a surface.
template <int D>
struct Arrival {
    DVec<D> middle;   ///< of it, where it hits
    double size = 0;  ///< its bounding radius
    DVec<D> way;      ///< the way it goes there, of any length
};

/// Of what has come straight by `came` from where it is.
template <int D>
Arrival<D> straight_arrival(const View<D>& mover, const DVec<D>& came);
/// Of what has come along a path, from the frame that it moves, at a time and to a point.
template <int D>
Arrival<D> turning_arrival(const View<D>& mover, const RigidPath<D>& path, double time, const DVec<D>& point);

/// Where the normal of a hit is that of an edge inside a surface of parts, puts the surface's own in its place, if that
/// faces the way of the mover. The hit is on a part of `shape`; of the surface, all parts are told by `each_foot`, with
/// `shape` where `hit.point` lies on it.
template <int D>
void feel_hit(const Arrival<D>& mover, const View<D>& shape, EachFoot<D> each_foot, Hit<D>& hit);

}  // namespace abut
