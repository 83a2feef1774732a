// What changes to a World cost: a move, and the queries between moves and the next update beside the same queries of a
// world that is up to date.

#include "../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <string>
#include <utility>

namespace abut::bench {
namespace {

constexpr std::size_t items = 5000;

/// Balls or boxes that drift about, with a ray and a region at the place of each.
template <class S>
struct ChangingWorld {
    explicit ChangingWorld(bool doubled = false) : boxes(items, broad_seed) {
        oracle::Random random(broad_seed);
        for (std::size_t i = 0; i < items; ++i) {
            const Pose3 pose{center(boxes.boxes()[i]), random.rotation<3>()};
            rotations.push_back(pose.rotation);
            ids.push_back(world.add(shape(), {.pose = pose}));
            rays.push_back({center(boxes.boxes()[i]), to_float<3>(random.direction<3>()), 25});
            // Beyond the reach of all rays and regions, so that what is moved there changes no answer.
            if (doubled) far.push_back(world.add(shape(), {.pose = {pose.position + Vec3(beyond, 0, 0)}}));
        }
        world.update();
    }
    static S shape() {
        if constexpr (std::is_same_v<S, Sphere>)
            return {{0, 0, 0}, 0.6f};
        else
            return {{0, 0, 0}, {0.4f, 0.5f, 0.6f}};
    }
    void move_all() {
        for (std::size_t i = 0; i < items; ++i) world.move(ids[i], {center(boxes.boxes()[i]), rotations[i]});
    }
    void nudge_far(std::size_t i) {
        const Pose3 pose = world.pose(far[i]);
        world.move(far[i], {pose.position + Vec3(0, i % 2 == 0 ? 0.01f : -0.01f, 0)});
    }
    double ray(std::size_t i) const { return world.raycast(rays[i], {.ignore = ids[i]}) ? 1 : 0; }
    double overlap(std::size_t i) const {
        double count = 0;
        world.each_overlapping(Sphere{rays[i].origin, 1.5f}, [&](Id) { ++count; });
        return count;
    }

    static constexpr float beyond = 1000;
    scenes::MovingBoxes<3> boxes;
    std::vector<Rotation<3>> rotations;
    std::vector<Ray3> rays;
    std::vector<Id> ids, far;
    World3 world;
};

using Balls = ChangingWorld<Sphere>;

enum class Query { ray, overlap };

double answer(const Balls& balls, Query query, std::size_t i) {
    return query == Query::ray ? balls.ray(i) : balls.overlap(i);
}

/// All items have moved; then there is a query for each.
Job queries_after_moves(Query query) {
    const auto side = [query](std::string who, bool refresh) -> Side {
        const auto balls = std::make_shared<Balls>();
        const auto ask = [=](std::span<double> values) {
            values[0] = 0;
            for (std::size_t i = 0; i < items; ++i) values[0] += answer(*balls, query, i);
        };
        const auto prepare = [=] {
            balls->boxes.step();
            balls->move_all();
            if (refresh) balls->world.refresh();
        };
        return {std::move(who), ask, prepare};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", false), side("abut refreshed", true)}};
}

/// Before each query an item has moved, where no query reaches it.
Job queries_between_moves(Query query) {
    const auto side = [query](std::string who, bool moves) -> Side {
        const auto balls = std::make_shared<Balls>(true);
        const auto ask = [=](std::span<double> values) {
            values[0] = 0;
            for (std::size_t i = 0; i < items; ++i) {
                if (moves) balls->nudge_far(i);
                values[0] += answer(*balls, query, i);
            }
        };
        return {std::move(who), ask, [=] { balls->world.update(); }};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", true), side("abut without moves", false)}};
}

/// A move of each item, and the update after it.
template <class S>
Job moves() {
    const auto side = [](std::string who, bool update) -> Side {
        const auto changing = std::make_shared<ChangingWorld<S>>();
        const auto change = [=] {
            if (!update) changing->world.update();
            changing->boxes.step();
            if (update) changing->move_all();
        };
        const auto ask = [=](std::span<double> values) {
            if (update)
                changing->world.update();
            else
                changing->move_all();
            values[0] = static_cast<double>(changing->world.pose(changing->ids[items / 2]).position.x);
        };
        return {std::move(who), ask, change};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", false), side("abut update", true)}};
}

}  // namespace

std::vector<Bench> world_change_benches() {
    return {
        {"broad/world/moved/ray/3d/5000", [] { return queries_after_moves(Query::ray); }},
        {"broad/world/moved/overlap/3d/5000", [] { return queries_after_moves(Query::overlap); }},
        {"broad/world/between/ray/3d/5000", [] { return queries_between_moves(Query::ray); }},
        {"broad/world/between/overlap/3d/5000", [] { return queries_between_moves(Query::overlap); }},
        {"broad/world/move/balls/3d/5000", [] { return moves<Sphere>(); }},
        {"broad/world/move/boxes/3d/5000", [] { return moves<Box3>(); }},
    };
}

}  // namespace abut::bench
