#pragma once

// Boxes as an Embree user geometry with bounds.

#include <abut/math/aabb.hpp>

#include <span>

#include <embree3/rtcore.h>

namespace abut::bench {

/// Refers to the boxes. Single-threaded.
class EmbreeBoxes {
public:
    explicit EmbreeBoxes(std::span<const Aabb3> boxes) : boxes_(boxes) {}
    EmbreeBoxes(const EmbreeBoxes&) = delete;
    EmbreeBoxes& operator=(const EmbreeBoxes&) = delete;
    ~EmbreeBoxes() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// Builds from scratch.
    void build(RTCBuildQuality quality, RTCIntersectFunctionN intersect = nullptr) {
        rtcReleaseScene(scene_);
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, quality);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes_.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, get_bounds, nullptr);
        if (intersect != nullptr) rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcSetGeometryBuildQuality(geometry, quality);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);  // the scene owns it
        rtcCommitScene(scene_);
    }

    RTCScene scene() const { return scene_; }
    const Aabb3& box(unsigned item) const { return boxes_[item]; }

private:
    static void get_bounds(const RTCBoundsFunctionArguments* arguments) {
        const Aabb3& box = static_cast<const EmbreeBoxes*>(arguments->geometryUserPtr)->box(arguments->primID);
        RTCBounds& bounds = *arguments->bounds_o;
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
