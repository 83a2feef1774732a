#pragma once

// A random game, played on a world and on the reference world alike.

#include "random_shapes.hpp"
#include "reference_world.hpp"
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/tile_map.hpp>

#include <array>
#include <set>

#include <gtest/gtest.h>

namespace abut::test {

using detail::to_float;

template <int D>
class Simulation {
public:
    /// On a lattice, all shapes have unit size and integer coordinates, so that many touch exactly and many answers
    /// tie.
    Simulation(std::uint64_t seed, int items, bool lattice = false, const WorldOptions& options = {},
               double continuous = 0)
        : world(options), random_(seed), lattice_(lattice), continuous_(continuous) {
        for (int i = 0; i < items; ++i) add();
    }

    /// Changes the world at random, as a frame of a game may.
    void change() {
        const std::vector<Id> ids = all_ids();
        for (const Id id : ids) {
            const typename ReferenceWorld<D>::Item& item = reference.items().at(id);
            if (item.options.fixed ? random_.chance(0.02) : random_.chance(0.5))
                move(id, step_from(item.options.pose));
            else if (random_.chance(0.02))
                move(id, any_pose());
            else if (random_.chance(0.05))
                move(id, item.options.pose);
            if (random_.chance(0.03)) set_shape(id);
            if (random_.chance(0.03)) set_filter(id);
            if (with_all && random_.chance(0.05)) set_an_option(id);
            if (random_.chance(0.02)) {
                remove(id);
                if (random_.chance(0.9)) add();
            }
        }
        if (reference.items().size() < ids.size() || random_.chance(0.1)) add();
        if (with_all && random_.chance(0.1)) set_pair_filter();
    }

    /// A random filter, most often the default one. Valid until the next call.
    Filter filter() {
        Filter result;
        if (random_.chance(0.3)) result.layers = random_bits();
        if (random_.chance(0.3)) result.mask = random_bits();
        result.sensors = random_.chance(0.5);
        if (random_.chance(0.3)) result.ignore = any_id();
        ignored_.clear();
        while (with_all && random_.chance(0.4)) ignored_.push_back(any_id());
        result.ignore_ids = ignored_;
        accepts_ = [salt = random_.below(4)](Id id) { return id.index % 4 != salt; };
        if (with_all && random_.chance(0.3)) result.accepts = accepts_;
        return result;
    }

    Id any_id() {
        return std::next(reference.items().begin(), random_.below(static_cast<std::uint32_t>(reference.items().size())))
            ->first;
    }

    std::vector<Id> all_ids() const {
        std::vector<Id> result;
        for (const auto& [id, item] : reference.items()) result.push_back(id);
        return result;
    }

    void add() {
        const ItemOptions<D> options = any_options();
        with_any_shape([&](const auto& shape) {
            Id id;
            if (reference.items().size() % 2 == 0)
                world.add(shape, std::span(&std::as_const(options), 1), std::span(&id, 1));
            else
                id = world.add(shape, options);
            note(id, shape, options);
        });
    }
    /// Several items with one shape, in one call.
    void add_several(std::size_t count) {
        std::vector<ItemOptions<D>> options;
        while (options.size() < count) options.push_back(any_options());
        with_any_shape([&](const auto& shape) {
            std::vector<Id> ids(count);
            world.add(shape, options, ids);
            for (std::size_t i = 0; i < count; ++i) note(ids[i], shape, options[i]);
        });
    }
    void remove_several(const std::vector<Id>& ids) {
        world.remove(ids);
        for (const Id id : ids) reference.remove(id);
    }
    void move_several(const std::vector<Id>& ids) {
        std::vector<Pose<D>> poses;
        for (const Id id : ids) poses.push_back(step_from(reference.items().at(id).options.pose));
        world.move(ids, poses);
        for (std::size_t i = 0; i < ids.size(); ++i) reference.move(ids[i], poses[i]);
    }
    /// Edits the shape in place if it is a ball, a box or a level. Returns whether the item has such a shape.
    bool edit_shape(Id id) {
        const float size = lattice_ ? 0.5f : random_.uniform_float(0.2, 0.6);
        const std::uint32_t index = random_.below(level_columns * level_rows);
        const auto edit = [&]<class S>(const auto& change) {
            const bool is_edited = world.template edit_shape<S>(id, change);
            EXPECT_EQ((reference.template edit_shape<S>(id, change)), is_edited);
            return is_edited;
        };
        bool result = edit.template operator()<Ball<D>>([&](Ball<D>& own) { own.radius = size; });
        result |= edit.template operator()<Box<D>>([&](Box<D>& own) { own.half[0] = size; });
        if constexpr (D == 2) {
            const auto tile = static_cast<Tile>(random_.below(14));
            result |= edit.template operator()<TileMap>([&](TileMap& own) { own.set(index, tile); });
        } else {
            const std::array height{lattice_ ? 0 : size};
            result |= edit.template operator()<HeightField>([&](HeightField& own) {
                EXPECT_FALSE(own.set(index % level_columns, index / level_columns, 1, height));
                own.set_hole(index % ((level_columns - 1) * (level_rows - 1)), size < 0.3f);
            });
        }
        return result;
    }

    /// change(world) for the world and for the reference world.
    template <class Change>
    void in_both(const Change& change) {
        change(world);
        change(reference);
    }
    // Half of these use the calls for many items.
    void remove(Id id) {
        if (id.index % 2 == 0)
            world.remove(std::span(&std::as_const(id), 1));
        else
            world.remove(id);
        reference.remove(id);
    }
    void move(Id id, const Pose<D>& pose) {
        if (id.index % 2 == 0)
            world.move(std::span(&std::as_const(id), 1), std::span(&pose, 1));
        else
            world.move(id, pose);
        reference.move(id, pose);
    }
    void set_shape(Id id) {
        with_any_shape([&](const auto& shape) { in_both([&](auto& each) { each.set_shape(id, shape); }); });
    }
    void set_filter(Id id) {
        const std::uint64_t layers = random_bits(), mask = random_bits();
        in_both([&](auto& each) { each.set_filter(id, layers, mask); });
    }

    void set_an_option(Id id) {
        switch (random_.below(6)) {
            case 0:
                return in_both([&, fixed = random_.chance(0.3)](auto& each) { each.set_fixed(id, fixed); });
            case 1:
                return in_both([&, sensor = random_.chance(0.15)](auto& each) { each.set_sensor(id, sensor); });
            case 2: {
                // A single continuous item makes the broad phases use all swept AABBs.
                const bool continuous = continuous_ > 0 && random_.chance(continuous_);
                return in_both([&](auto& each) { each.set_continuous(id, continuous); });
            }
            case 3:
                return in_both([&, group = any_group()](auto& each) { each.set_group(id, group); });
            case 4:
                return in_both([&, enabled = random_.chance(0.9)](auto& each) { each.set_enabled(id, enabled); });
            default:
                return in_both([&, user = random_.bits()](auto& each) { each.set_user(id, user); });
        }
    }

    template <class Take>
    void with_any_shape(Take&& take) {
        if (with_levels && random_.chance(0.15)) return with_level(take);
        if (!lattice_) return with_random_shape<D>(random_, random_kind<D>(random_), take);
        switch (random_.below(4)) {
            case 0:
                return take(Ball<D>{Vec<D>(0.5f), 0.5f});
            case 1:
                return take(Segment<D>{Vec<D>(0.0f), Vec<D>(1.0f)});
            case 2:
                return take(Aabb<D>{Vec<D>(0.0f), Vec<D>(1.0f)});
            default:
                return take(stairs<D>(2, 1));
        }
    }
    template <class Take>
    void with_level(Take&& take) {
        if (random_.chance(0.4))
            return take(*Compound<D>::build(
                {Ball<D>{Vec<D>(0.5f), 0.5f}, rounded(Segment<D>{Vec<D>(0.0f), Vec<D>(1.0f)}, 0.25f)}));
        if constexpr (D == 2) {
            if (random_.chance(0.3)) return take(*Chain::build({{-1, 0}, {0, 0}, {0.5f, 0.5f}, {1, 0}}, false));
            std::vector<Tile> tiles;
            while (tiles.size() < level_columns * level_rows) tiles.push_back(static_cast<Tile>(random_.below(14)));
            take(*TileMap::build(tiles, level_columns, 0.5f));
        } else {
            std::vector<float> heights;
            while (heights.size() < level_columns * level_rows)
                heights.push_back(lattice_ ? 0 : random_.uniform_float(0, 0.5));
            take(*HeightField::build(heights, level_columns, 0.5f));
        }
    }
    Vec<D> any_point() {
        const Vec<D> point = to_float(random_.in_cube<D>() * extent);
        return lattice_ ? 0.5f * snapped(2.0f * point) : point;
    }
    Pose<D> any_pose() { return lattice_ ? Pose<D>{snapped(any_point())} : random_pose<D>(random_, extent); }

    Pose<D> step_from(const Pose<D>& pose) {
        if (!lattice_) return moved_a_little(random_, pose, 0.15);
        return {pose.position + snapped(to_float(random_.in_cube<D>() + detail::DVec<D>(0.5)))};
    }
    /// Most often one that refuses one pair in 16.
    void set_pair_filter() {
        reference.pair_filter_changed = true;
        reference.pair_filter = nullptr;
        if (random_.chance(0.8))
            reference.pair_filter = [salt = random_.bits()](Id a, Id b) {
                return ((a.index * std::uint64_t{1000003} + b.index) * 0x9E3779B97F4A7C15 ^ salt) >> 60 != 0;
            };
        world.set_pair_filter(reference.pair_filter);
    }

    oracle::Random& random() { return random_; }

    static constexpr double extent = D == 2 ? 5 : 2.5;  ///< half the side of the square or cube of the game

    World<D> world;
    ReferenceWorld<D> reference;
    std::set<Id> given;        ///< the ids of all items so far
    bool with_all = false;     ///< whether the game also sets options and ignores several ids
    bool with_levels = false;  ///< whether there are also tile maps, height fields, chains and compounds
    int reused = 0;            ///< the number of items that reused a slot
    bool fresh_ids = true;     ///< whether no id was given twice

private:
    static constexpr std::uint32_t level_columns = 4, level_rows = 3;

    template <class S>
    void note(Id id, const S& shape, const ItemOptions<D>& options) {
        reused += id.generation > 1 ? 1 : 0;
        fresh_ids = given.insert(id).second && fresh_ids;
        reference.add(id, shape, options);
    }
    ItemOptions<D> any_options() {
        ItemOptions<D> options;
        options.pose = any_pose();
        options.user = random_.bits();
        if (random_.chance(0.3)) options.layers = random_bits();
        if (random_.chance(0.3)) options.mask = random_bits();
        options.fixed = random_.chance(0.3);
        options.sensor = random_.chance(0.15);
        options.continuous = continuous_ > 0 && random_.chance(continuous_);
        if (with_all) options.group = any_group();
        options.enabled = !with_all || random_.chance(0.95);
        return options;
    }
    static Vec<D> snapped(const Vec<D>& v) {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = std::floor(v[i]);
        return result;
    }
    /// A random non-empty set of three layers.
    std::uint64_t random_bits() {
        const std::uint64_t bits = 1 + random_.below(7);
        return (bits & 3) | (bits & 4) << 40;
    }
    std::int32_t any_group() { return random_.chance(0.8) ? 0 : static_cast<std::int32_t>(random_.below(5)) - 2; }
    oracle::Random random_;
    bool lattice_;
    double continuous_;  ///< the share of continuous items
    std::vector<Id> ignored_;
    std::function<bool(Id)> accepts_;
};

}  // namespace abut::test
