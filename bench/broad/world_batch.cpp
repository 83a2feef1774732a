// Many rays into a World in one call, on one thread and on two, beside one call for each ray, in wall-clock time.

#include "../../test/oracle/random.hpp"
#include "broad.hpp"
#include <abut/math/thread_pool.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

/// Boxes at random in a cube, and rays between random points of it.
struct Scene {
    explicit Scene(std::size_t count) {
        oracle::Random random(broad_seed);
        const double side = 3 * std::cbrt(static_cast<double>(count));
        const auto point = [&] { return Vec3(random.in_cube<3>() * (0.5 * side)); };
        for (std::size_t i = 0; i < count; ++i)
            world.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, {.pose = {point(), random.rotation<3>()}});
        for (std::size_t i = 0; i < count; ++i) rays.push_back(Ray3::between(point(), point()));
        hits.resize(rays.size());
        world.update();
    }

    World3 world;
    std::vector<Ray3> rays;
    std::vector<std::optional<WorldHit<3>>> hits;
};

template <class CastAll>
Side cast(std::string who, const std::shared_ptr<Scene>& scene, CastAll cast_all) {
    return {std::move(who), [scene, cast_all](std::span<double> values) {
                cast_all(*scene);
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = scene->hits[i] ? static_cast<double>(scene->hits[i]->hit.distance) : -1;
            }};
}

Job rays_of(std::size_t count) {
    const auto scene = std::make_shared<Scene>(count);
    const auto pool = std::make_shared<ThreadPool>(2);
    return {.items = count,
            .values = count,
            .on_the_wall = true,
            .tolerance = 0,
            .sides = {cast("abut, 2 threads", scene, [pool](Scene& s) { s.world.raycast(s.rays, s.hits, *pool); }),
                      cast("abut", scene, [](Scene& s) { s.world.raycast(s.rays, s.hits); }),
                      cast("abut, one by one", scene, [](Scene& s) {
                          for (std::size_t i = 0; i < s.rays.size(); ++i) s.hits[i] = s.world.raycast(s.rays[i]);
                      })}};
}

}  // namespace

std::vector<Bench> world_batch_benches() {
    return {{"broad/world/batch/rays/10000", [] { return rays_of(10'000); }}};
}

}  // namespace abut::bench
