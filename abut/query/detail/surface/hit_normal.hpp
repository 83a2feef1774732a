#pragma once

// Filters internal edges out of the normals of hits. For .cpp files.

#include <abut/math/detail/rigid_path.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/hit.hpp>
#include <abut/shape/view/view.hpp>

#include <optional>

namespace abut::detail {

/// Like abut::sweep against a shape at rest. The normal is that of the part that was hit, which may be one of an
/// internal edge, except between solids.
template <int D>
std::optional<Hit<D>> sweep_unfiltered(const View<D>& a, const Vec<D>& motion, const View<D>& b);

/// A moving shape at the moment of its hit.
template <int D>
struct MoverAtHit {
    DVec<D> center;     ///< of its bounding box
    double size = 0;    ///< bounding radius
    DVec<D> direction;  ///< of its motion there, of any length
};

/// A shape that has moved by `travelled`, without rotation.
template <int D>
MoverAtHit<D> linear_mover_at_hit(const View<D>& mover, const DVec<D>& travelled);
/// A shape that follows a path, at a time and a point of contact. The shape is in the frame that the path moves.
template <int D>
MoverAtHit<D> rotating_mover_at_hit(const View<D>& mover, const RigidPath<D>& path, double time, const DVec<D>& point);

/// Replaces the normal of a hit on an internal edge by the normal of the surface, if that faces the mover. The hit is
/// on a part of `shape`, which is placed so that `hit.point` lies on its surface. `neighbours` visits the closest
/// points of the shapes that continue the surface; null: there are none.
template <int D>
void filter_hit_normal(const MoverAtHit<D>& mover, const View<D>& shape, const EachClosestPoint<D>* neighbours,
                       Hit<D>& hit);

}  // namespace abut::detail
