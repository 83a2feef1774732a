#pragma once

// Many items that move a little in each frame, for the benches of a World and of its peers.

#include "../../test/oracle/random.hpp"
#include "broad.hpp"
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
#include <variant>
#include <vector>

namespace abut::bench {

/// Items at poses, some of which are fixed.
template <int D>
struct Crowd {
    struct Item {
        std::variant<Ball<D>, Box<D>, Capsule<D>> shape;
        Pose<D> pose;
        bool fixed = false;
    };

    template <class S>
    void add(const S& shape, const Vec<D>& position, const Rotation<D>& rotation = Pose<D>{}.rotation,
             bool fixed = false) {
        items.push_back({shape, {position, rotation}, fixed});
    }

    std::vector<Item> items;
    double shake = 0.02;  ///< the maximum distance from the pose in a frame, along each axis
};

template <int D>
Vec<D> random_point(oracle::Random& random, double side) {
    Vec<D> result;
    for (int i = 0; i < D; ++i) result[i] = random.uniform_float(0, side);
    return result;
}

/// Which shapes a crowd has beside boxes.
enum class Kinds { all, no_capsules };

/// Boxes, balls and capsules at random, with this volume for each of them.
template <int D>
Crowd<D> scattered(std::size_t count, double volume, Kinds kinds = Kinds::all) {
    oracle::Random random(broad_seed);
    Crowd<D> crowd;
    const double side = std::pow(static_cast<double>(count) * volume, 1.0 / D);
    Vec<D> end(0.0f);
    end[1] = 0.3f;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec<D> position = random_point<D>(random, side);
        const Rotation<D> rotation = random.rotation<D>();
        if (i % 3 == 2)
            crowd.add(Ball<D>{Vec<D>(0.0f), 0.5f}, position, rotation);
        else if (i % 3 == 1 && kinds == Kinds::all)
            crowd.add(Capsule<D>{-end, end, 0.4f}, position, rotation);
        else
            crowd.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, position, rotation);
    }
    return crowd;
}

/// Equal turned boxes in a cube or square.
template <int D>
Crowd<D> packed(std::size_t count, double side) {
    oracle::Random random(broad_seed);
    Crowd<D> crowd;
    for (std::size_t i = 0; i < count; ++i)
        crowd.add(Box<D>{Vec<D>(0.0f), Vec<D>(D == 2 ? 0.5f : 0.6f)}, random_point<D>(random, side),
                  random.rotation<D>());
    return crowd;
}

/// Fixed boxes in a row of this length, or in a square, with the top at height 0.
template <int D>
void add_floor(Crowd<D>& crowd, int side) {
    for (int x = 0; x < side; ++x)
        for (int z = 0; z < (D == 2 ? 1 : side); ++z) {
            Vec<D> center(static_cast<float>(x));
            center[1] = -0.5f;
            if constexpr (D == 3) center[2] = static_cast<float>(z);
            crowd.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.5f)}, center, Pose<D>{}.rotation, true);
        }
}

/// Boxes thrown onto such a floor, and as many capsules in 3D, and balls in 2D.
template <int D>
Crowd<D> thrown_onto_a_floor(int side) {
    oracle::Random random(broad_seed);
    Crowd<D> crowd;
    add_floor(crowd, side);
    Vec<D> half(0.3f), end(0.0f);
    half[1] = 0.2f;
    half[D - 1] = 0.4f;
    end[1] = 0.3f;
    const int loose = D == 2 ? 5 * side : side * side * 17 / 16;
    for (int i = 0; i < loose; ++i) {
        Vec<D> place;
        for (int axis = 0; axis < D; ++axis)
            place[axis] = axis == 1 ? random.uniform_float(0.3, D == 2 ? 2.3 : 1.2) : random.uniform_float(0, side - 1);
        const Rotation<D> rotation = random.rotation<D>();
        if (i % 2 == 0)
            crowd.add(Box<D>{Vec<D>(0.0f), half}, place, rotation);
        else if (D == 2)
            crowd.add(Ball<D>{Vec<D>(0.0f), 0.3f}, place, rotation);
        else
            crowd.add(Capsule<D>{-end, end, 0.25f}, place, rotation);
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
    oracle::Random random;
    std::vector<Pose<D>> poses;
};

/// A world of a crowd.
template <int D>
struct CrowdedWorld {
    explicit CrowdedWorld(const Crowd<D>& items, bool filter_edges = true)
        : shaken(items), world({.filter_edges = filter_edges}) {
        for (const auto& item : items.items)
            ids.push_back(std::visit(
                [&](const auto& shape) { return world.add(shape, {.pose = item.pose, .fixed = item.fixed}); },
                item.shape));
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

/// Lists the contacts of all pairs, by a broad phase and `contact`, without a World.
template <int D>
Side contacts_without_world(const Crowd<D>& crowd) {
    struct State {
        explicit State(const Crowd<D>& items) : shaken(items), views(items.items.size()), boxes(items.items.size()) {
            for (std::size_t i = 0; i < boxes.size(); ++i) place(i);
            phase.build(boxes);
        }
        void place_loose() {
            for (std::size_t i = 0; i < boxes.size(); ++i)
                if (!shaken.crowd.items[i].fixed) place(i);
        }
        void place(std::size_t i) {
            const auto placed = [&](const auto& shape) { return View<D>(view(at(shape, shaken.poses[i]))); };
            views[i] = std::visit(placed, shaken.crowd.items[i].shape);
            boxes[i] = detail::bounds(views[i]);
        }
        ShakenCrowd<D> shaken;
        std::vector<View<D>> views;
        std::vector<Aabb<D>> boxes;
        ChosenBroadPhase<D> phase;
        std::vector<WorldContact<D>> contacts;
    };
    const auto state = std::make_shared<State>(crowd);
    const auto run = [state](std::span<double> values) {
        state->place_loose();
        state->phase.update(state->boxes);
        state->contacts.clear();
        const auto& items = state->shaken.crowd.items;
        state->phase.each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (items[i].fixed && items[j].fixed) return;
            if (const Contact<D> found = contact(state->views[i], state->views[j]))
                state->contacts.push_back({{i, 1}, {j, 1}, found});
        });
        values[0] = static_cast<double>(state->contacts.size());
    };
    return {"abut without World", run, [state] { state->shaken.shake(); }};
}

// The same by a peer's world, without its solver.

/// Without capsules.
Side box2d_world(const Crowd<2>& crowd);
Side bullet_world(const Crowd<3>& crowd);

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

}  // namespace abut::bench
