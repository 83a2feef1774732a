#pragma once

// Boxes as Embree holds them: a geometry of the user's, of which it knows the bounds.

#include <abut/math/aabb.hpp>

#include <span>

#include <embree3/rtcore.h>

namespace abut::bench {

/// Refers to the boxes. On one thread.
class EmbreeBoxes {
public:
    explicit EmbreeBoxes(std::span<const Aabb3> boxes) : boxes_(boxes) {}
    EmbreeBoxes(const EmbreeBoxes&) = delete;
    EmbreeBoxes& operator=(const EmbreeBoxes&) = delete;
    ~EmbreeBoxes() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// From nothing.
    void build(RTCBuildQuality quality, RTCIntersectFunctionN intersect = nullptr) {
        rtcReleaseScene(scene_);
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, quality);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes_.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, tell_bounds, nullptr);
        if (intersect != nullptr) rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcSetGeometryBuildQuality(geometry, quality);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);  // the scene keeps it
        rtcCommitScene(scene_);
    }

    RTCScene scene() const { return scene_; }
    const Aabb3& box(unsigned item) const { return boxes_[item]; }

private:
    static void tell_bounds(const RTCBoundsFunctionArguments* asked) {
        const Aabb3& box = static_cast<const EmbreeBoxes*>(asked->geometryUserPtr)->box(asked->primID);
        RTCBounds& bounds = *asked->bounds_o;
        bounds.lower_x = box.min.x;
        bounds.lower_y = box.min.y;
        bounds.lower_z = box.min.z;
        bounds.upper_x = box.max.x;
        bounds.upper_y = box.max.y;
        bounds.upper_z = box.max.z;
    }

    std::span<const Aabb3> boxes_;
    RTCDevice device_ = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene scene_ = rtcNewScene(device_);
};

}  // namespace abut::bench
