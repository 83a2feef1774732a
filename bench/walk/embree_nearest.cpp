// Embree's point queries, with the nearest point of a triangle by Ericson ("Real-time collision detection", 5.1.5).

#include "walk.hpp"

#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

namespace abut::bench {

namespace {

Vec3 nearest_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vec3 bp = p - b;
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const Vec3 cp = p - c;
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const float all = 1 / (va + vb + vc);
    return a + ab * (vb * all) + ac * (vc * all);
}

struct Question {
    const WalkScene* scene;
    float min_distance;
    unsigned int triangle = RTC_INVALID_GEOMETRY_ID;
    Vec3 nearest{};
};

bool add_triangle(RTCPointQueryFunctionArguments* arguments) {
    Question& question = *static_cast<Question*>(arguments->userPtr);
    const glm::uvec3 t = question.scene->triangles[arguments->primID];
    const std::vector<Vec3>& points = question.scene->points;
    const Vec3 point(arguments->query->x, arguments->query->y, arguments->query->z);
    const Vec3 nearest = nearest_of(points[t.x], points[t.y], points[t.z], point);
    const float distance = glm::distance(nearest, point);
    if (!(distance < question.min_distance)) return false;
    arguments->query->radius = question.min_distance = distance;
    question.triangle = arguments->primID;
    question.nearest = nearest;
    return true;
}

class Triangles {
public:
    explicit Triangles(const SharedWalkScene& scene) : scene_(scene) {
        rtcSetSceneBuildQuality(all_, RTC_BUILD_QUALITY_HIGH);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, scene->points.data(), 0,
                                   sizeof(Vec3), scene->points.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene->triangles.data(), 0,
                                   sizeof(glm::uvec3), scene->triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(all_, geometry);
        rtcReleaseGeometry(geometry);  // the scene owns it
        rtcCommitScene(all_);
    }
    Triangles(const Triangles&) = delete;
    Triangles& operator=(const Triangles&) = delete;
    ~Triangles() {
        rtcReleaseScene(all_);
        rtcReleaseDevice(device_);
    }

    double distance(const Vec3& point, float reach) const {
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        RTCPointQuery query{point.x, point.y, point.z, 0, reach};
        Question question{scene_.get(), reach};
        rtcPointQuery(all_, &query, &context, add_triangle, &question);
        return glm::distance(question.nearest, point);
    }

private:
    SharedWalkScene scene_;
    RTCDevice device_ = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene all_ = rtcNewScene(device_);
};

}  // namespace

Side embree_nearest(const SharedWalkPoints& points) {
    return {"embree", [points, triangles = std::make_shared<const Triangles>(points->scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = triangles->distance(points->points[i], points->reach);
            }};
}

}  // namespace abut::bench
