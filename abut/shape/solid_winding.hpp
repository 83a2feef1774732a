#pragma once

// How often closed faces wind around a place: what is solid, whatever overlaps. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/solid_tree.hpp>

namespace abut {

/// Refers to the points and faces of the tree.
template <int D>
class SolidWinding {
public:
    SolidWinding(const SolidTree<D>& tree, double margin);

    /// Whether each corner in 2D, each edge in 3D is left as often as it is come to.
    bool closed() const { return closed_; }

    /// What is in front of a place on the plane and what is behind it. Nothing where other faces are within the margin
    /// of the place, and not in the plane.
    std::optional<SolidSides> beside(const DVec<D>& place, const SolidPlane<D>& plane) const;

private:
    const SolidTree<D>& tree_;
    double margin_;
    bool closed_;
    int turns_outside_ = 0;  ///< what is added to all: 1 where the solid goes on without end
    Bvh<D> faces_;
};

}  // namespace abut
