#include "tool/cast/cast.hpp"

namespace abut::tool {
namespace {

/// Reports the first hit on each object along the ray.
template <int D>
CastResult<D> cast_through(const World<D>& world, const Ray<D>& ray) {
    CastResult<D> result;
    result.last = ray;
    float last_distance = 0;
    for (WorldHit<D>& hit : world.raycast_all(ray)) {
        const float travelled = hit.hit.distance;
        result.last.length = hit.hit.distance = travelled - last_distance;
        result.hits.push_back({world.user(hit.id), result.last, hit.hit, static_cast<double>(travelled)});
        last_distance = travelled;
        result.last = {hit.hit.point, ray.direction, ray.length - last_distance};
    }
    return result;
}

/// Follows a ray from reflection to reflection.
template <int D>
CastResult<D> bounce(const World<D>& world, const Ray<D>& ray, std::size_t bounces, ProgressCall progress) {
    CastResult<D> result;
    double travelled = 0;
    result.last = follow_laser(world, ray, [&](const Ray<D>& segment, const WorldHit<D>& hit) {
        travelled += static_cast<double>(hit.hit.distance);
        result.hits.push_back({world.user(hit.id), segment, hit.hit, travelled});
        progress(result.hits.size(), bounces + 1);
        return result.hits.size() <= bounces;
    });
    return result;
}

}  // namespace

template <int D>
CastResult<D> cast(const Objects<D>& objects, const CastOptions<D>& options, ProgressCall progress) {
    World<D> world;
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (objects[i].present) world.add(Unowned<D>{objects[i].placed}, {.user = i});

    Ray<D> ray = Ray<D>::between(options.from, options.to);
    if (options.bounces > 0) ray.length = std::numeric_limits<float>::infinity();
    CastResult<D> result = options.all ? cast_through(world, ray) : bounce(world, ray, options.bounces, progress);
    if (!options.all && result.hits.size() > options.bounces)
        result.end = result.hits.back().hit.point;
    else if (options.bounces == 0)
        result.end = options.to;
    return result;
}
template CastResult<2> cast(const Objects<2>& objects, const CastOptions<2>& options, ProgressCall progress);
template CastResult<3> cast(const Objects<3>& objects, const CastOptions<3>& options, ProgressCall progress);

}  // namespace abut::tool
