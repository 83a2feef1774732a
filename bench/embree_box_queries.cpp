// Queries of Embree: rtcIntersect1 and rtcPointQuery. The boxes are asked by the same code as abut's.

#include "box_queries.hpp"
#include "broad_peers.hpp"
#include "embree_boxes.hpp"
#include "embree_ray.hpp"

#include <cmath>
#include <memory>

namespace abut::bench {

namespace {

/// A scene that rests, with what it refers to.
struct Tree {
    explicit Tree(std::span<const Aabb3> all) : items(all.begin(), all.end()), boxes(items) {
        boxes.build(RTC_BUILD_QUALITY_HIGH, intersect);
    }

    static void intersect(const RTCIntersectFunctionNArguments* asked);

    std::vector<Aabb3> items;
    EmbreeBoxes boxes;
};

struct Cast {
    RTCIntersectContext context;  // Embree hands it on to the boxes
    RayToBox ray;
};

void Tree::intersect(const RTCIntersectFunctionNArguments* asked) {
    const auto& cast = *reinterpret_cast<const Cast*>(asked->context);
    const Aabb3& box = static_cast<const EmbreeBoxes*>(asked->geometryUserPtr)->box(asked->primID);
    const float distance = entry(cast.ray, box);
    auto& hit = *reinterpret_cast<RTCRayHit*>(asked->rayhit);
    if (asked->valid[0] == 0 || !(distance < hit.ray.tfar)) return;
    hit.ray.tfar = distance;
    hit.hit.primID = asked->primID;
    hit.hit.geomID = asked->geomID;
}

struct Search {
    const EmbreeBoxes& boxes;
    Vec3 point;
    Nearest nearest;
};

/// Whether it has lessened the reach.
bool add_distance(RTCPointQueryFunctionArguments* asked) {
    auto& search = *static_cast<Search*>(asked->userPtr);
    search.nearest.add(squared_distance(search.point, search.boxes.box(asked->primID)));
    const float reach = std::sqrt(search.nearest.farthest());
    if (!(reach < asked->query->radius)) return false;
    asked->query->radius = reach;
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
