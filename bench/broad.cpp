// Many boxes: all pairs of those that move, regions and rays among those that rest, and a whole world's update.

#include "../scenes/convex_shapes.hpp"
#include "../scenes/moving_boxes.hpp"
#include "bench.hpp"
#include "peers.hpp"
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <utility>
#include <variant>

namespace abut::bench {

namespace {

using scenes::MovingBoxes;

constexpr std::uint64_t seed = 1;
constexpr std::size_t first_frames = 8;  // are verified
constexpr std::size_t frames = 10;       // a repetition
constexpr std::size_t query_count = 1024;

template <class Phase, int D>
Side abut_moving(std::string who, std::size_t count) {
    struct State {
        MovingBoxes<D> scene;
        Phase phase;
    };
    const auto state = std::make_shared<State>(State{MovingBoxes<D>(count, seed), {}});
    state->phase.build(state->scene.boxes());
    const auto ask = [state](std::span<double> values) {
        state->phase.update(state->scene.boxes());
        std::size_t pairs = 0;
        state->phase.each_pair([&](std::uint32_t, std::uint32_t) { ++pairs; });
        values[0] = static_cast<double>(pairs);
    };
    return {std::move(who), ask, [state] { state->scene.step(); }};
}

template <int D>
Job moving(std::size_t count) {
    Job job{.items = count, .values = 1, .rounds = first_frames, .frames = frames, .tolerance = 0, .sides = {}};
    job.sides.push_back(abut_moving<Bvh<D>, D>("abut", count));
    if (count <= 1000) job.sides.push_back(abut_moving<BruteForce<D>, D>("abut BruteForce", count));
    if constexpr (D == 3) {
        job.sides.push_back(bullet_moving(count, seed));
        job.sides.push_back(fcl_moving(count, seed));
    } else {
        job.sides.push_back(box2d_moving(count, seed));
    }
    return job;
}

/// Regions of edge 4 to 8 all over the world.
Job regions(std::size_t count) {
    const MovingBoxes<3> scene(count, seed);
    oracle::Random random(seed);
    std::vector<Aabb3> asked;
    while (asked.size() < query_count) {
        const Vec3 center{random.uniform_float(0, scene.side()), random.uniform_float(0, scene.side()),
                          random.uniform_float(0, scene.side())};
        const Vec3 half{random.uniform_float(2, 4), random.uniform_float(2, 4), random.uniform_float(2, 4)};
        asked.push_back({center - half, center + half});
    }
    const auto tree = std::make_shared<Bvh<3>>();
    tree->build(scene.boxes());
    const Side ours{"abut", [tree, asked](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            std::size_t found = 0;
                            tree->each_overlapping(asked[i], [&](std::uint32_t) { ++found; });
                            values[i] = static_cast<double>(found);
                        }
                    }};
    return {.items = query_count,
            .values = query_count,
            .tolerance = 0,
            .sides = {ours, bullet_regions(scene.boxes(), asked), fcl_regions(scene.boxes(), asked)}};
}

/// Rays of length 40 from everywhere to everywhere; each is told of all boxes on its way.
Job rays(std::size_t count) {
    const MovingBoxes<3> scene(count, seed);
    oracle::Random random(seed);
    std::vector<Ray3> asked;
    while (asked.size() < query_count) {
        const Vec3 origin{random.uniform_float(0, scene.side()), random.uniform_float(0, scene.side()),
                          random.uniform_float(0, scene.side())};
        asked.push_back({origin, to_float<3>(random.direction<3>()), 40});
    }
    const auto tree = std::make_shared<Bvh<3>>();
    tree->build(scene.boxes());
    const Side ours{"abut", [tree, asked](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            std::size_t found = 0;
                            tree->raycast(asked[i], [&](std::uint32_t) { ++found; });
                            values[i] = static_cast<double>(found);
                        }
                    }};
    return {.items = query_count,
            .values = query_count,
            .tolerance = 0,
            .sides = {ours, bullet_rays(scene.boxes(), asked)}};
}

/// Boxes, capsules and hulls that drift about.
struct MixedScene {
    struct Item {
        scenes::AnyConvex<3> shape;
        glm::quat rotation;
    };

    explicit MixedScene(std::size_t count) : boxes(count, seed) {
        oracle::Random random(seed);
        for (std::size_t i = 0; i < count; ++i) {
            Item& item = items.emplace_back();
            item.rotation = random.rotation<3>();
            if (i % 3 == 0)
                item.shape = scenes::random_box<3>(random);
            else if (i % 3 == 1)
                item.shape = scenes::random_capsule(random);
            else
                item.shape = scenes::random_hull(random, 32);
        }
    }
    Pose3 pose(std::size_t i) const { return {center(boxes.boxes()[i]), items[i].rotation}; }

    MovingBoxes<3> boxes;
    std::vector<Item> items;
};

/// Counts the pairs that touch, with all their contacts.
Side world_update(std::size_t count) {
    struct State {
        explicit State(std::size_t n) : scene(n) {
            for (std::size_t i = 0; i < n; ++i)
                ids.push_back(std::visit([&](const auto& s) { return world.add(s, {.pose = scene.pose(i)}); },
                                         scene.items[i].shape));
        }
        MixedScene scene;
        World3 world;
        std::vector<Id> ids;
    };
    const auto state = std::make_shared<State>(count);
    const auto ask = [state](std::span<double> values) {
        for (std::size_t i = 0; i < state->ids.size(); ++i) state->world.move(state->ids[i], state->scene.pose(i));
        const Events events = state->world.update();
        values[0] = static_cast<double>(events.began.size() + events.stayed.size());
    };
    return {"abut", ask, [state] { state->scene.boxes.step(); }};
}

/// Counts them without a World: a tree, and a yes or no for each pair of boxes.
Side overlaps_by_hand(std::size_t count) {
    struct State {
        explicit State(std::size_t n) : scene(n), views(n), boxes(n) {
            place();
            tree.build(boxes);
        }
        void place() {
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                views[i] = std::visit([&](const auto& s) { return View<3>(view(at(s, scene.pose(i)))); },
                                      scene.items[i].shape);
                boxes[i] = bounds(views[i]);
            }
        }
        MixedScene scene;
        std::vector<View<3>> views;
        std::vector<Aabb3> boxes;
        Bvh<3> tree;
    };
    const auto state = std::make_shared<State>(count);
    const auto ask = [state](std::span<double> values) {
        state->place();
        state->tree.update(state->boxes);
        std::size_t touching = 0;
        state->tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
            touching += overlaps(state->views[i], state->views[j]) ? 1u : 0u;
        });
        values[0] = static_cast<double>(touching);
    };
    return {"abut by hand", ask, [state] { state->scene.boxes.step(); }};
}

Job world(std::size_t count) {
    return {.items = count,
            .values = 1,
            .rounds = first_frames,
            .frames = frames,
            .tolerance = 1,  // a pair may touch to within the margin of doubt
            .sides = {world_update(count), overlaps_by_hand(count)}};
}

}  // namespace

std::vector<Bench> broad_benches() {
    return {
        {"broad/moving/3d/1000", [] { return moving<3>(1000); }},
        {"broad/moving/3d/10000", [] { return moving<3>(10000); }},
        {"broad/moving/3d/100000", [] { return moving<3>(100000); }},
        {"broad/moving/2d/1000", [] { return moving<2>(1000); }},
        {"broad/moving/2d/10000", [] { return moving<2>(10000); }},
        {"broad/moving/2d/100000", [] { return moving<2>(100000); }},
        {"broad/region/3d/100000", [] { return regions(100000); }},
        {"broad/ray/3d/100000", [] { return rays(100000); }},
        {"broad/world/3d/2000", [] { return world(2000); }},
    };
}

}  // namespace abut::bench
