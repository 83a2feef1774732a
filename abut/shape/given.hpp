#pragma once

// A shape as the front doors hand it on: where it is stored, and at which pose. The questions turn it into numbers
// where they want them; most pairs of plain shapes never become a view.

#include <abut/convex/support.hpp>
#include <abut/math/pose.hpp>

#include <cstdint>

namespace abut {

enum class ShapeKind : std::uint8_t {
    ball,
    capsule,
    segment,
    triangle,
    box,
    polytope,  ///< Polygon, Polyhedron
};

/// Refers to the shape, and must not outlive it.
template <int D>
struct Given {
    ShapeKind kind;
    const void* shape;              ///< of the type that `kind` tells
    const Pose<D>* pose = nullptr;  ///< on top of the place that it carries itself; null: none

    template <class S>
    const S& as() const {
        return *static_cast<const S*>(shape);
    }
};

/// The pose, or the one that moves nothing.
template <int D>
const Pose<D>& pose_or_none(const Pose<D>* pose) {
    static const Pose<D> none{};
    return pose != nullptr ? *pose : none;
}

/// The same as a view.
template <int D>
Convex<D> convex_of(const Given<D>& given);

}  // namespace abut
