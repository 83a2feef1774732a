// Embree's triangles: rtcIntersect1 and rtcOccluded1.

#include "embree_ray.hpp"
#include "rays.hpp"

#include <string>

#include <embree3/rtcore.h>

namespace abut::bench {

namespace {

class Triangles {
public:
    Triangles(const SharedRayMesh& mesh, Quality quality, Edges edges) : mesh_(mesh) {
        const RTCBuildQuality wanted = quality == Quality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
        rtcSetSceneBuildQuality(scene_, wanted);
        if (edges == Edges::robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->points.data(), 0,
                                   sizeof(Vec3), mesh->points.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->triangles.data(), 0,
                                   sizeof(glm::uvec3), mesh->triangles.size());
        rtcSetGeometryBuildQuality(geometry, wanted);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);  // the scene owns it
        rtcCommitScene(scene_);
    }
    Triangles(const Triangles&) = delete;
    Triangles& operator=(const Triangles&) = delete;
    ~Triangles() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    double distance(const Ray3& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit = to_embree(ray);
        rtcIntersect1(scene_, &context, &hit);
        return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0 : static_cast<double>(hit.ray.tfar);
    }

    bool any_hit(const Ray3& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay beam = to_embree(ray).ray;
        rtcOccluded1(scene_, &context, &beam);
        return beam.tfar < 0;
    }

private:
    SharedRayMesh mesh_;
    RTCDevice device_ = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene scene_ = rtcNewScene(device_);
};

std::string name(Quality quality, Edges edges) {
    std::string result = "embree";
    if (quality == Quality::high) result += " high";
    if (edges == Edges::robust) result += " robust";
    return result;
}

}  // namespace

Side embree_rays(const SharedRayMesh& scene, Quality quality, Edges edges) {
    return {name(quality, edges),
            [scene, triangles = std::make_shared<const Triangles>(scene, quality, edges)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = triangles->distance(scene->rays[i]);
            }};
}

Side embree_any_hits(const SharedRayMesh& scene, Edges edges) {
    return {name(Quality::usual, edges), [scene, triangles = std::make_shared<const Triangles>(
                                                     scene, Quality::usual, edges)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = triangles->any_hit(scene->rays[i]) ? 1.0 : 0.0;
            }};
}

Side embree_mesh_build(const SharedRayMesh& scene, Quality quality) {
    return {name(quality, Edges::fast), [scene, quality](std::span<double> values) {
                values[0] = Triangles(scene, quality, Edges::fast).distance(scene->rays[0]);
            }};
}

}  // namespace abut::bench
