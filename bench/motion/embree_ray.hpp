#pragma once

// A ray in Embree's format.

#include <abut/math/ray.hpp>

#include <embree3/rtcore.h>

namespace abut::bench {

/// A ray without a hit.
inline RTCRayHit to_embree(const Ray3& ray) {
    RTCRayHit result;
    result.ray = {ray.origin.x,
                  ray.origin.y,
                  ray.origin.z,
                  0,
                  ray.direction.x,
                  ray.direction.y,
                  ray.direction.z,
                  0,
                  ray.length,
                  ~0u,
                  0,
                  0};
    result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return result;
}

}  // namespace abut::bench
