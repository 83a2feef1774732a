#pragma once

// Winding numbers of closed faces, which define the solid also under self-overlap. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

namespace abut::detail {

/// Refers to the points and faces of the tree.
template <int D>
class SolidWinding {
public:
    SolidWinding(const SolidTree<D>& tree, double margin);

    /// True if each vertex (2D) or edge (3D) has equally many incoming and outgoing faces.
    bool closed() const { return closed_; }

    /// Whether the space in front of a plane and behind it is solid, at a point of the plane. Nothing if a face that
    /// isn't coplanar is within the margin of the point.
    std::optional<SolidSides> beside(const DVec<D>& place, const SolidPlane<D>& plane) const;

private:
    const SolidTree<D>& tree_;
    double margin_;
    bool closed_;
    int outer_winding_ = 0;  ///< added to all winding numbers: 1 if the solid is unbounded
    Bvh<D> faces_;
};

}  // namespace abut::detail
