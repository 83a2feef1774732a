#include "cast.hpp"

namespace abut::tool {
namespace {

/// The first hit on each thing, while the ray goes on to its end.
CastResult go_through(const World3& world, const Ray3& ray) {
    CastResult result;
    result.last = ray;
    float come = 0;
    for (WorldHit<3>& hit : world.raycast_all(ray)) {
        const float travelled = hit.hit.distance;
        result.last.length = hit.hit.distance = travelled - come;
        result.hits.push_back({world.user(hit.id), result.last, hit.hit, static_cast<double>(travelled)});
        come = travelled;
        result.last = {hit.hit.point, ray.direction, ray.length - come};
    }
    return result;
}

/// From hit to hit, thrown back by each.
CastResult bounce(const World3& world, const Ray3& ray, std::size_t bounces, ProgressCall progress) {
    CastResult result;
    double travelled = 0;
    result.last = follow_laser(world, ray, [&](const Ray3& piece, const WorldHit<3>& hit) {
        travelled += static_cast<double>(hit.hit.distance);
        result.hits.push_back({world.user(hit.id), piece, hit.hit, travelled});
        progress(result.hits.size(), bounces + 1);
        return result.hits.size() <= bounces;
    });
    return result;
}

}  // namespace

CastResult cast(const Objects& objects, const CastOptions& options, ProgressCall progress) {
    World3 world;
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (objects[i].present) world.add(objects[i].placed, {.user = i});

    Ray3 ray = Ray3::between(options.from, options.to);
    if (options.bounces > 0) ray.length = std::numeric_limits<float>::infinity();
    CastResult result = options.all ? go_through(world, ray) : bounce(world, ray, options.bounces, progress);
    if (!options.all && result.hits.size() > options.bounces)
        result.end = result.hits.back().hit.point;
    else if (options.bounces == 0)
        result.end = options.to;
    return result;
}

}  // namespace abut::tool
