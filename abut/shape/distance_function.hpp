#pragma once

// A shape known by how far it is from every point: what the questions see of a field, or of a distance function of a
// user's own.

#include <abut/convex/support.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <limits>

namespace abut {

/// A signed distance, and the direction in which it grows most.
template <int D>
struct FieldSample {
    float distance = std::numeric_limits<float>::infinity();  ///< below zero inside
    Vec<D> normal{};                                          ///< of length 1, out of the shape
};

/// All places where a signed distance is at most 0, placed. Refers to the shape and must not outlive it.
template <int D>
struct DistanceFunction : Placement<D> {
    Aabb<D> bounds;  ///< in the shape's own frame: around all places where the distance is at most 0
    const void* object = nullptr;
    /// Of a point of the shape's own frame; of two points it differs by no more than they are apart.
    float (*distance)(const void* object, const Vec<D>& point) = nullptr;
    /// The same with the direction; null: told by differences.
    FieldSample<D> (*sample)(const void* object, const Vec<D>& point) = nullptr;
    /// How small details are that a search need not look for, in the shape's own frame: a field's cell. 0: unknown.
    float resolution = 0;
};

}  // namespace abut
