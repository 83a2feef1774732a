// Many changes of a World and questions to it in one call, on one thread and on two, beside one call for each, in
// wall-clock time.

#include "../../test/oracle/random.hpp"
#include "broad.hpp"
#include <abut/math/thread_pool.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/placed.hpp>
#include <abut/world/world.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

/// Boxes at random in a cube, and questions at random points of it.
struct Scene {
    explicit Scene(std::size_t count) : options(count), ids(count), hits(count), closest(count) {
        oracle::Random random(broad_seed);
        const double side = 3 * std::cbrt(static_cast<double>(count));
        const auto point = [&] { return Vec3(random.in_cube<3>() * (0.5 * side)); };
        for (ItemOptions<3>& each : options) each.pose = {point(), random.rotation<3>()};
        world.add(box, options, ids);
        world.update();
        for (std::size_t i = 0; i < count; ++i) {
            points.push_back(point());
            rays.push_back(Ray3::between(points[i], point()));
            poses.push_back({points[i], random.rotation<3>()});
            motions.push_back({.from = poses[i], .move = Vec3(random.in_cube<3>() * 5.0)});
        }
    }

    Box3 box{{0, 0, 0}, {0.5f, 0.5f, 0.5f}};
    World3 world;
    std::vector<ItemOptions<3>> options;
    std::vector<Id> ids;
    std::vector<Ray3> rays;
    std::vector<Vec3> points;
    std::vector<Pose3> poses;
    std::vector<Motion3> motions;
    std::vector<std::optional<WorldHit<3>>> hits;
    std::vector<std::optional<WorldClosest<3>>> closest;
    IdLists overlapping;
    std::vector<std::vector<Id>> overlapping_each;
};

double value_of(const std::optional<WorldHit<3>>& hit) {
    return hit ? static_cast<double>(hit->hit.fraction) : -1;
}
double value_of(const std::optional<WorldClosest<3>>& closest) {
    return closest ? static_cast<double>(closest->closest.distance) : -1;
}
template <class Ids>
double value_of(const Ids& ids) {
    double sum = 0;
    for (const Id id : ids) sum += id.index;
    return sum;
}

/// A side that does its work, whose results are `answers(scene)[i]`.
template <class Work, class Answers>
Side side(std::string who, const std::shared_ptr<Scene>& scene, Work work, Answers answers) {
    return {std::move(who), [scene, work, answers](std::span<double> values) {
                work(*scene);
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_of(answers(*scene)[i]);
            }};
}

/// `query_all(scene, executor...)` makes all queries at once, query_one(scene, i) makes one.
template <class QueryAll, class QueryOne, class Answers, class AnswersOfOne>
Job questions(std::size_t count, QueryAll query_all, QueryOne query_one, Answers answers, AnswersOfOne answers_of_one) {
    const auto scene = std::make_shared<Scene>(count);
    const auto pool = std::make_shared<ThreadPool>(2);
    return {.items = count,
            .values = count,
            .on_the_wall = true,
            .tolerance = 0,
            .sides = {side(
                          "abut, 2 threads", scene, [=](Scene& s) { query_all(s, *pool); }, answers),
                      side(
                          "abut", scene, [=](Scene& s) { query_all(s); }, answers),
                      side(
                          "abut, one by one", scene,
                          [=](Scene& s) {
                              for (std::size_t i = 0; i < s.points.size(); ++i) query_one(s, i);
                          },
                          answers_of_one)}};
}
constexpr auto hits_of = [](Scene & s) -> auto& {
    return s.hits;
};
constexpr auto closest_of = [](Scene & s) -> auto& {
    return s.closest;
};

Job rays(std::size_t count) {
    return questions(
        count, [](Scene& s, auto&... pool) { s.world.raycast(s.rays, s.hits, pool...); },
        [](Scene& s, std::size_t i) { s.hits[i] = s.world.raycast(s.rays[i]); }, hits_of, hits_of);
}
Job sweeps(std::size_t count) {
    return questions(
        count, [](Scene& s, auto&... pool) { s.world.sweep(s.box, s.motions, s.hits, pool...); },
        [](Scene& s, std::size_t i) { s.hits[i] = s.world.sweep(s.box, s.motions[i]); }, hits_of, hits_of);
}
Job closest_points(std::size_t count) {
    return questions(
        count, [](Scene& s, auto&... pool) { s.world.closest(s.points, s.closest, pool...); },
        [](Scene& s, std::size_t i) { s.closest[i] = s.world.closest(s.points[i]); }, closest_of, closest_of);
}
Job closest_boxes(std::size_t count) {
    return questions(
        count, [](Scene& s, auto&... pool) { s.world.closest(s.box, s.poses, s.closest, pool...); },
        [](Scene& s, std::size_t i) { s.closest[i] = s.world.closest(at(s.box, s.poses[i])); }, closest_of, closest_of);
}
Job overlaps_of_balls(std::size_t count) {
    constexpr Sphere ball{{0, 0, 0}, 3};
    return questions(
        count, [=](Scene& s, auto&... pool) { s.world.overlapping(ball, s.poses, s.overlapping, pool...); },
        [=](Scene& s, std::size_t i) {
            s.overlapping_each.resize(s.poses.size());
            s.overlapping_each[i] = s.world.overlapping(at(ball, s.poses[i]));
        },
        [](Scene & s) -> auto& { return s.overlapping; }, [](Scene & s) -> auto& { return s.overlapping_each; });
}

/// Fills an empty world, and brings its broad phase up to date.
Job adds(std::size_t count) {
    const auto scene = std::make_shared<Scene>(count);
    const auto world = std::make_shared<World3>();
    const auto added = [=](std::string who, auto add_all) {
        return Side{std::move(who),
                    [=](std::span<double> values) {
                        add_all(*scene, *world);
                        world->refresh();
                        for (std::size_t i = 0; i < values.size(); ++i) values[i] = scene->ids[i].index;
                    },
                    [world] { *world = World3(); }};
    };
    return {.items = count,
            .values = count,
            .on_the_wall = true,
            .tolerance = 0,
            .sides = {added("abut", [](Scene& s, World3& w) { w.add(s.box, s.options, s.ids); }),
                      added("abut, one by one", [](Scene& s, World3& w) {
                          for (std::size_t i = 0; i < s.options.size(); ++i) s.ids[i] = w.add(s.box, s.options[i]);
                      })}};
}

/// Empties a world, in random order.
Job removals(std::size_t count) {
    const auto scene = std::make_shared<Scene>(count);
    const auto world = std::make_shared<World3>();
    oracle::Random random(broad_seed);
    for (std::size_t i = count; i > 1; --i)
        std::swap(scene->ids[i - 1], scene->ids[random.below(static_cast<std::uint32_t>(i))]);
    const auto removed = [=](std::string who, auto remove_all) {
        return Side{std::move(who),
                    [=](std::span<double> values) {
                        remove_all(*scene, *world);
                        values[0] = static_cast<double>(world->size());
                    },
                    [=] { *world = scene->world; }};
    };
    return {.items = count,
            .values = 1,
            .on_the_wall = true,
            .tolerance = 0,
            .sides = {removed("abut", [](Scene& s, World3& w) { w.remove(s.ids); }),
                      removed("abut, one by one", [](Scene& s, World3& w) {
                          for (const Id id : s.ids) w.remove(id);
                      })}};
}

}  // namespace

std::vector<Bench> world_batch_benches() {
    std::vector<Bench> result;
    for (const std::size_t count : {10'000, 100'000}) {
        const auto row = [&](const std::string& what, Job (*make)(std::size_t)) {
            result.push_back({"broad/world/batch/" + what + "/" + std::to_string(count), [=] { return make(count); }});
        };
        row("rays", rays);
        row("sweeps", sweeps);
        row("closest_points", closest_points);
        row("closest_boxes", closest_boxes);
        row("overlaps", overlaps_of_balls);
        row("adds", adds);
        row("removals", removals);
    }
    return result;
}

}  // namespace abut::bench
