// Queries of Embree: rtcIntersect1 and rtcPointQuery. The box tests are abut's code.

#include "../motion/embree_ray.hpp"
#include "box_queries.hpp"
#include "broad_peers.hpp"
#include "embree_boxes.hpp"

#include <cmath>
#include <memory>

namespace abut::bench {

namespace {

/// A static scene, with the data it refers to.
struct Tree {
    explicit Tree(std::span<const Aabb3> all) : items(all.begin(), all.end()), boxes(items) {
        boxes.build(RTC_BUILD_QUALITY_HIGH, intersect);
    }

    static void intersect(const RTCIntersectFunctionNArguments* arguments);

    std::vector<Aabb3> items;
    EmbreeBoxes boxes;
};

struct Cast {
    RTCIntersectContext context;  // Embree passes it to the boxes' callbacks
    RayToBox ray;
};

void Tree::intersect(const RTCIntersectFunctionNArguments* arguments) {
    const auto& cast = *reinterpret_cast<const Cast*>(arguments->context);
    const Aabb3& box = static_cast<const EmbreeBoxes*>(arguments->geometryUserPtr)->box(arguments->primID);
    const float distance = entry(cast.ray, box);
    auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    if (arguments->valid[0] == 0 || !(distance < hit.ray.tfar)) return;
    hit.ray.tfar = distance;
    hit.hit.primID = arguments->primID;
    hit.hit.geomID = arguments->geomID;
}

struct Search {
    const EmbreeBoxes& boxes;
    Vec3 point;
    Nearest nearest;
};

/// Returns true if it has shortened the reach.
bool add_distance(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    search.nearest.add(squared_distance(search.point, search.boxes.box(arguments->primID)));
    const float reach = std::sqrt(search.nearest.farthest());
    if (!(reach < arguments->query->radius)) return false;
    arguments->query->radius = reach;
    return true;
}

}  // namespace

Side embree_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("embree", rays, [tree](const Ray3& ray) {
        Cast cast{{}, RayToBox(ray)};
        rtcInitIntersectContext(&cast.context);
        RTCRayHit hit = to_embree(ray);
        rtcIntersect1(tree->boxes.scene(), &cast.context, &hit);
        return static_cast<double>(hit.ray.tfar);
    });
}

Side embree_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("embree", points, [tree, count](const Vec3& point) {
        RTCPointQuery query{point.x, point.y, point.z, 0, std::numeric_limits<float>::infinity()};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        Search search{tree->boxes, point, Nearest(count)};
        rtcPointQuery(tree->boxes.scene(), &query, &context, add_distance, &search);
        return search.nearest.sum_of_distances();
    });
}

}  // namespace abut::bench
