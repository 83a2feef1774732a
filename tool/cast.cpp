#include "cast.hpp"

namespace abut::tool {

CastResult cast(const Objects& objects, const CastOptions& options, ProgressCall progress) {
    World3 world;
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (objects[i].present) world.add(objects[i].placed, {.user = i});

    Ray3 ray = Ray3::between(options.from, options.to);
    if (options.bounces > 0) ray.length = std::numeric_limits<float>::infinity();
    CastResult result;
    double travelled = 0;
    result.last = follow_laser(world, ray, [&](const Ray3& piece, const WorldHit<3>& hit) {
        travelled += static_cast<double>(hit.hit.distance);
        result.hits.push_back({world.user(hit.id), piece, hit.hit, travelled});
        progress(result.hits.size(), options.bounces + 1);
        return result.hits.size() <= options.bounces;
    });
    if (result.hits.size() > options.bounces)
        result.end = result.hits.back().hit.point;
    else if (options.bounces == 0)
        result.end = options.to;
    return result;
}

}  // namespace abut::tool
