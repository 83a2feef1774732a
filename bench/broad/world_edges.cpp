// The cost of the filter of internal edges: an update of a World in which all loose items move, with the filter,
// without it, and the contacts of all pairs without a World. And the update on two threads.

#include "../../test/oracle/random.hpp"
#include "broad.hpp"
#include <abut/math/thread_pool.hpp>
#include <abut/query/contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/world/world.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace abut::bench {

using namespace detail;

namespace {

using oracle::Random;

/// Items at poses, some of which are fixed.
template <int D>
struct Crowd {
    struct Item {
        AnyShape<D> shape;
        Pose<D> pose;
        bool fixed = false;
    };

    template <class S>
    void add(const S& shape, const Vec<D>& position, const Rotation<D>& rotation = {}, bool fixed = false) {
        items.push_back({AnyShape<D>(shape), {position, rotation}, fixed});
    }

    std::vector<Item> items;
    double shake = 0.02;  ///< the maximum distance from the pose in a frame, along each axis
};

template <int D>
Vec<D> random_point(Random& random, double side) {
    Vec<D> result;
    for (int i = 0; i < D; ++i) result[i] = random.uniform_float(0, side);
    return result;
}

/// Boxes, balls and capsules at random, with this volume for each of them.
template <int D>
Crowd<D> scattered(std::size_t count, double volume) {
    Random random(broad_seed);
    Crowd<D> crowd;
    const double side = std::pow(static_cast<double>(count) * volume, 1.0 / D);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec<D> position = random_point<D>(random, side);
        const Rotation<D> rotation = random.rotation<D>();
        Vec<D> end(0.0f);
        end[1] = 0.3f;
        if (i % 3 == 0) crowd.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, position, rotation);
        if (i % 3 == 1) crowd.add(Capsule<D>{-end, end, 0.4f}, position, rotation);
        if (i % 3 == 2) crowd.add(Ball<D>{Vec<D>(0.0f), 0.5f}, position, rotation);
    }
    return crowd;
}

/// Equal turned boxes in a cube or square.
template <int D>
Crowd<D> packed(std::size_t count, double side) {
    Random random(broad_seed);
    Crowd<D> crowd;
    for (std::size_t i = 0; i < count; ++i)
        crowd.add(Box<D>{Vec<D>(0.0f), Vec<D>(D == 2 ? 0.5f : 0.6f)}, random_point<D>(random, side),
                  random.rotation<D>());
    return crowd;
}

/// A floor of fixed boxes with the top at height 0.
void add_floor(Crowd<3>& crowd, int side) {
    for (int x = 0; x < side; ++x)
        for (int z = 0; z < side; ++z)
            crowd.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, {static_cast<float>(x), -0.5f, static_cast<float>(z)}, {},
                      true);
}

/// Boxes that rest on such a floor, each on four boxes of it.
Crowd<3> on_a_floor() {
    Random random(broad_seed);
    Crowd<3> crowd;
    add_floor(crowd, 40);
    crowd.shake = 0.002;
    for (int i = 0; i < 400; ++i) {
        const Vec3 place(2.0f * static_cast<float>(i % 20), 0.49f, 2.0f * static_cast<float>(i / 20));
        crowd.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}},
                  place + Vec3(random.uniform_float(0, 0.5), 0, random.uniform_float(0, 0.5)));
    }
    return crowd;
}

/// Boxes and capsules thrown onto such a floor.
Crowd<3> thrown_onto_a_floor() {
    Random random(broad_seed);
    Crowd<3> crowd;
    add_floor(crowd, 40);
    for (int i = 0; i < 1700; ++i) {
        const Vec3 place(random.uniform_float(0, 39), random.uniform_float(0.3, 1.2), random.uniform_float(0, 39));
        const Rotation<3> rotation = random.rotation<3>();
        if (i % 2 == 0) crowd.add(Box3{{0, 0, 0}, {0.3f, 0.2f, 0.4f}}, place, rotation);
        if (i % 2 == 1) crowd.add(Capsule3{{0, -0.3f, 0}, {0, 0.3f, 0}, 0.25f}, place, rotation);
    }
    return crowd;
}

/// Moves the loose items of a crowd.
template <int D>
struct ShakenCrowd {
    explicit ShakenCrowd(Crowd<D> items) : crowd(std::move(items)), random(broad_seed) { shake(); }
    void shake() {
        poses.clear();
        for (const auto& item : crowd.items) {
            Pose<D>& pose = poses.emplace_back(item.pose);
            if (item.fixed) continue;
            for (int i = 0; i < D; ++i) pose.position[i] += random.uniform_float(-crowd.shake, crowd.shake);
        }
    }

    Crowd<D> crowd;
    Random random;
    std::vector<Pose<D>> poses;
};

/// A world of a crowd.
template <int D>
struct CrowdedWorld {
    explicit CrowdedWorld(const Crowd<D>& items, bool filter_edges = true)
        : shaken(items), world({.filter_edges = filter_edges}) {
        for (const auto& item : items.items)
            ids.push_back(world.add(item.shape, {.pose = item.pose, .fixed = item.fixed}));
    }
    void move_all() {
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (!shaken.crowd.items[i].fixed) world.move(ids[i], shaken.poses[i]);
    }
    static double touching(const Events& events) {
        return static_cast<double>(events.began.size() + events.stayed.size());
    }

    ShakenCrowd<D> shaken;
    World<D> world;
    std::vector<Id> ids;
};

/// An update in which all loose items have moved, measured with or without the moves.
template <int D>
Side update(std::string who, const Crowd<D>& crowd, bool filter_edges, bool with_moves = true,
            const std::shared_ptr<Executor>& executor = nullptr) {
    const auto state = std::make_shared<CrowdedWorld<D>>(crowd, filter_edges);
    const auto run = [state, with_moves, executor](std::span<double> values) {
        if (with_moves) state->move_all();
        values[0] = state->touching(executor != nullptr ? state->world.update(*executor) : state->world.update());
    };
    return {std::move(who), run, [state, with_moves] {
                state->shaken.shake();
                if (!with_moves) state->move_all();
            }};
}

template <int D>
Side contacts_without_world(const Crowd<D>& crowd) {
    struct State {
        explicit State(const Crowd<D>& items) : shaken(items), views(items.items.size()), boxes(items.items.size()) {
            place();
            phase.build(boxes);
        }
        void place() {
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                views[i] = shaken.crowd.items[i].shape.moved(affine(shaken.poses[i]));
                boxes[i] = bounds(views[i]);
            }
        }
        ShakenCrowd<D> shaken;
        std::vector<View<D>> views;
        std::vector<Aabb<D>> boxes;
        ChosenBroadPhase<D> phase;
    };
    const auto state = std::make_shared<State>(crowd);
    const auto run = [state](std::span<double> values) {
        state->place();
        state->phase.update(state->boxes);
        std::size_t touching = 0;
        const auto& items = state->shaken.crowd.items;
        state->phase.each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (items[i].fixed && items[j].fixed) return;
            touching += contact(state->views[i], state->views[j]) ? 1u : 0u;
        });
        values[0] = static_cast<double>(touching);
    };
    return {"abut without World", run, [state] { state->shaken.shake(); }};
}

/// job_of(crowd) is the job, without its sizes.
template <int D, class JobOf>
Bench of_crowd(std::string name, std::function<Crowd<D>()> make, const JobOf& job_of) {
    return {std::move(name), [make = std::move(make), job_of] {
                const Crowd<D> crowd = make();
                Job job = job_of(crowd);
                job.items = crowd.items.size();
                job.values = 1;
                job.rounds = 4;
                job.frames = 10;
                return job;
            }};
}

template <int D>
Bench edges(const std::string& scene, std::function<Crowd<D>()> make) {
    return of_crowd<D>("broad/world/edges/" + scene, std::move(make), [](const Crowd<D>& crowd) -> Job {
        return {.tolerance = 1,  // touching is decided to within the tolerance
                .sides = {update("abut", crowd, true), update("abut without filter", crowd, false),
                          contacts_without_world(crowd)}};
    });
}

template <int D>
Bench threads(const std::string& scene, std::function<Crowd<D>()> make) {
    return of_crowd<D>("broad/world/threads/" + scene, std::move(make), [](const Crowd<D>& crowd) -> Job {
        return {.on_the_wall = true,
                .tolerance = 0,
                .sides = {update("abut, 2 threads", crowd, true, false, std::make_shared<ThreadPool>(2)),
                          update("abut", crowd, true, false)}};
    });
}

}  // namespace

std::vector<Bench> world_edge_benches() {
    return {
        threads<2>("sparse/2d", [] { return scattered<2>(10'000, 8); }),
        threads<3>("sparse/3d", [] { return scattered<3>(10'000, 20); }),
        threads<3>("pile/3d", thrown_onto_a_floor),
        threads<3>("packed/3d/1700", [] { return packed<3>(1700, 12); }),
        edges<2>("sparse/2d", [] { return scattered<2>(10'000, 8); }),
        edges<3>("sparse/3d", [] { return scattered<3>(10'000, 20); }),
        edges<3>("floor/3d", on_a_floor),
        edges<3>("pile/3d", thrown_onto_a_floor),
        edges<2>("packed/2d/400", [] { return packed<2>(400, 12); }),
        edges<2>("packed/2d/1600", [] { return packed<2>(1600, 12); }),
        edges<3>("packed/3d/1700", [] { return packed<3>(1700, 12); }),
    };
}

}  // namespace abut::bench
