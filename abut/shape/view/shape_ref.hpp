#pragma once

// A reference to a primitive shape or a polytope, with an optional pose. Queries on pairs of these run closed forms
// without making views.

#include <abut/convex/support.hpp>
#include <abut/math/pose.hpp>

#include <cstdint>

namespace abut::detail {

enum class ShapeKind : std::uint8_t {
    ball,
    capsule,
    segment,
    triangle,
    box,
    polytope,  ///< Polygon, Polyhedron
};

/// Refers to the shape and to the pose, and must not outlive them.
template <int D>
struct ShapeRef {
    ShapeKind kind;
    const void* shape;              ///< its type is given by `kind`
    const Pose<D>* pose = nullptr;  ///< applied after the shape's own position; null: none

    template <class S>
    const S& as() const {
        return *static_cast<const S*>(shape);
    }
};

/// The pose, or the identity if it is null.
template <int D>
const Pose<D>& pose_or_none(const Pose<D>* pose) {
    static const Pose<D> none{};
    return pose != nullptr ? *pose : none;
}

/// The shape as a view.
template <int D>
Convex<D> convex_of(const ShapeRef<D>& ref);

}  // namespace abut::detail
