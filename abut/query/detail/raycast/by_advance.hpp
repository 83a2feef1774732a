#pragma once

// The triangles of a mesh that the closed form leaves open. For .cpp files.

#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/shape/triangle.hpp>

namespace abut::detail {

/// Decides the cases that the closed form leaves open; `part_of` places a triangle in the world.
template <class PartOf>
auto by_advance(const DRay<3>& beam, const PartOf& part_of, Trace<3>* trace) {
    return [&beam, part_of, trace](const Triangle3& triangle, double max_length, RayEntry<3>& entry) {
        PartHit<3> hit;
        if (!part_hit_by_advance({beam.origin, beam.direction, max_length}, part_of(triangle), 0, trace, hit))
            return false;
        entry = {RayAnswer::enters, hit.along, hit.normal, hit.feature.kind, hit.feature.index};
        return true;
    };
}

}  // namespace abut::detail
