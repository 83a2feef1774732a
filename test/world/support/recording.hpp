#pragma once

// Random sessions of a recorded world.

#include "random_shapes.hpp"
#include <abut/shape/height_field.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/world/recorded_world.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

/// The pieces of a recording: the state at the start, and then the entries.
using Pieces = std::vector<std::vector<std::byte>>;

inline std::vector<std::byte> joined(const Pieces& pieces) {
    std::vector<std::byte> result;
    for (const auto& piece : pieces) result.insert(result.end(), piece.begin(), piece.end());
    return result;
}

/// Calls take with a shape that a file can hold.
template <int D, class Take>
void with_saved_shape(oracle::Random& random, Take&& take) {
    for (;;) {
        const int kind = random_kind<D>(random);
        if (kind == 7 || kind == 8 || kind == 10) continue;
        return with_random_shape<D>(random, kind, take);
    }
}

/// A game of random changes and questions. It begins before the recording, with a snapshot to which it returns.
template <int D>
class Session {
public:
    Session(std::uint64_t seed, const WorldOptions& options = {}) : random_(seed) {
        World<D> world(options);
        for (int i = 0; i < 8; ++i)
            with_saved_shape<D>(random_, [&](const auto& shape) { ids_.push_back(world.add(shape, any_options())); });
        before_ = world.save();
        at_start_ = ids_;
        world.set_shape(ids_[0], Ball<D>{});
        world_ = std::make_unique<RecordedWorld<D>>(
            [this](std::span<const std::byte> bytes) { pieces.emplace_back(bytes.begin(), bytes.end()); },
            std::move(world), options);
        if constexpr (D == 2)
            ids_.push_back(world_->add(*TileMap::build(std::vector<Tile>(9, Tile::full), 3, 1.0f), {.fixed = true}));
        else
            ids_.push_back(world_->add(*HeightField::build(std::vector<float>(9, 0), 3, 1.0f), {.fixed = true}));
        level_ = ids_.back();
    }

    void step() {
        RecordedWorld<D>& world = *world_;
        const Id id = ids_[random_.below(static_cast<std::uint32_t>(ids_.size()))];
        const bool present = world.contains(id);
        switch (random_.below(present ? 16 : 4)) {
            case 0:
                with_saved_shape<D>(random_,
                                    [&](const auto& shape) { ids_.push_back(world.add(shape, any_options())); });
                return;
            case 1:
                world.update();
                return;
            case 2:
            case 3:
                return questions();
            case 4:
                if (id != level_) world.remove(id);
                return;
            case 5:
                with_saved_shape<D>(random_, [&](const auto& shape) {
                    if (id != level_) world.set_shape(id, shape);
                });
                return;
            case 6:
                return edit();
            case 7:
                return set_option(id);
            case 8:
                if (random_.chance(0.1)) {
                    // A Problem if the world has not enough of the shapes.
                    if (!world.restore(before_)) {
                        ids_ = at_start_;
                        level_ = {};
                        ++restored;
                    }
                } else {
                    (void)world.save();
                }
                return;
            case 9:
                if (random_.chance(0.5))
                    world.set_pair_filter([](Id a, Id b) { return (a.index + b.index) % 3 != 0; });
                else
                    world.set_pair_filter(nullptr);
                return;
            default:
                world.move(id, moved_a_little(random_, world.pose(id), 0.2));
                return;
        }
    }
    void questions() {
        const RecordedWorld<D>& world = *world_;
        const Vec<D> from = any_point(), to = any_point();
        const Pose<D> pose = random_pose<D>(random_, 3);
        const std::vector<Id> ignored{ids_.front(), ids_.back()};
        const auto accepts = [](Id id) { return id.index % 4 != 0; };
        Filter filter{.sensors = random_.chance(0.5), .ignore = ids_[1]};
        if (random_.chance(0.3)) filter.ignore_ids = ignored;
        if (random_.chance(0.3)) filter.accepts = accepts;
        (void)world.raycast(Ray<D>::between(from, to), filter);
        (void)world.raycast_any(Ray<D>::between(from, to), filter);
        (void)world.raycast_all(Ray<D>{from, Ray<D>::between(from, to).direction}, filter);
        (void)world.closest(from, filter);
        (void)world.k_nearest(from, 3, filter);
        (void)world.containing(from, filter);
        with_saved_shape<D>(random_, [&](const auto& shape) {
            (void)world.sweep(at(shape, pose), to - from, filter);
            (void)world.sweep(shape, Motion<D>::between(pose, {to}), filter);
            (void)world.sweep(shape, pose, Pose<D>{to}, filter);
            (void)world.closest(at(shape, pose), filter);
            (void)world.k_nearest(shape, 1000, filter);
            (void)world.overlapping(shape, filter);
            world.each_contact(at(shape, pose), [](Id, const Contact<D>&) {}, filter, {.margin = 0.1f});
            const std::vector<Pose<D>> poses{pose, Pose<D>{to}};
            std::vector<std::optional<WorldClosest<D>>> nearest(2);
            IdLists lists;
            world.closest(shape, poses, nearest, filter);
            world.overlapping(shape, poses, lists, filter);
        });
        std::vector<Id> present;
        for (const Id id : ids_)
            if (world.contains(id)) present.push_back(id);
        for (const Id id : present) (void)world.touching(id);
        if (present.size() < 2) return;
        (void)world.contact({present[0], present[1]});
        (void)world.impact({present[0], present[1]});
    }

    RecordedWorld<D>& world() { return *world_; }
    Pieces pieces;
    int restored = 0;

private:
    Vec<D> any_point() { return to_float(random_.in_cube<D>() * 3.0); }
    ItemOptions<D> any_options() {
        return {.pose = random_pose<D>(random_, 3),
                .user = random_.bits(),
                .layers = 1 + random_.below(3),
                .fixed = random_.chance(0.3),
                .sensor = random_.chance(0.2),
                .continuous = random_.chance(0.2),
                .group = random_.chance(0.2) ? -1 : 0};
    }
    void edit() {
        if (!world_->contains(level_)) return;
        if constexpr (D == 2)
            world_->template edit_shape<TileMap>(
                level_, [&](TileMap& map) { map.set(random_.below(9), static_cast<Tile>(random_.below(14))); });
        else
            world_->template edit_shape<HeightField>(level_, [&](HeightField& field) {
                const std::vector<float> height{random_.uniform_float(-1, 1)};
                EXPECT_FALSE(field.set(random_.below(3), random_.below(3), 1, height));
            });
    }
    void set_option(Id id) {
        RecordedWorld<D>& world = *world_;
        switch (random_.below(7)) {
            case 0:
                return world.set_filter(id, 1 + random_.below(3), 1 + random_.below(3));
            case 1:
                return world.set_user(id, random_.bits());
            case 2:
                return world.set_fixed(id, random_.chance(0.3));
            case 3:
                return world.set_sensor(id, random_.chance(0.2));
            case 4:
                return world.set_continuous(id, random_.chance(0.2));
            case 5:
                return world.set_group(id, -static_cast<std::int32_t>(random_.below(2)));
            default:
                return world.set_enabled(id, random_.chance(0.8));
        }
    }

    oracle::Random random_;
    std::vector<Id> ids_, at_start_;
    Id level_{};
    std::vector<std::byte> before_;
    std::unique_ptr<RecordedWorld<D>> world_;
};

}  // namespace abut::test
