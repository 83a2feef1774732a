// The cost of changes to a World: a move with its update, queries between a move and the update, compared with queries
// of an updated world, snapshots, and a level of which a tile changes.

#include "../../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <string>
#include <utility>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t items = 5000;

/// Moving balls or boxes, with a ray and a region at each position.
template <class S>
struct ChangingWorld {
    explicit ChangingWorld(bool doubled = false) : boxes(items, broad_seed) {
        oracle::Random random(broad_seed);
        for (std::size_t i = 0; i < items; ++i) {
            const Pose3 pose{center(boxes.boxes()[i]), random.rotation<3>()};
            rotations.push_back(pose.rotation);
            ids.push_back(world.add(shape(), {.pose = pose}));
            rays.push_back({center(boxes.boxes()[i]), to_float<3>(random.direction<3>()), 25});
            // Out of reach of all rays and regions, so that moves there change no answer.
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

/// Moves all items, then runs a query for each.
Job queries_after_moves(Query query) {
    const auto side = [query](std::string who, bool refresh) -> Side {
        const auto balls = std::make_shared<Balls>();
        const auto run = [=](std::span<double> values) {
            values[0] = 0;
            for (std::size_t i = 0; i < items; ++i) values[0] += answer(*balls, query, i);
        };
        const auto prepare = [=] {
            balls->boxes.step();
            balls->move_all();
            if (refresh) balls->world.refresh();
        };
        return {std::move(who), run, prepare};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", false), side("abut refreshed", true)}};
}

/// Moves an item before each query, where no query reaches it.
Job queries_between_moves(Query query) {
    const auto side = [query](std::string who, bool moves) -> Side {
        const auto balls = std::make_shared<Balls>(true);
        const auto run = [=](std::span<double> values) {
            values[0] = 0;
            for (std::size_t i = 0; i < items; ++i) {
                if (moves) balls->nudge_far(i);
                values[0] += answer(*balls, query, i);
            }
        };
        return {std::move(who), run, [=] { balls->world.update(); }};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", true), side("abut without moves", false)}};
}

/// Moves each item, then updates.
template <class S>
Job moves() {
    const auto side = [](std::string who, bool update) -> Side {
        const auto changing = std::make_shared<ChangingWorld<S>>();
        const auto change = [=] {
            if (!update) changing->world.update();
            changing->boxes.step();
            if (update) changing->move_all();
        };
        const auto run = [=](std::span<double> values) {
            if (update)
                changing->world.update();
            else
                changing->move_all();
            values[0] = static_cast<double>(changing->world.pose(changing->ids[items / 2]).position.x);
        };
        return {std::move(who), run, change};
    };
    return {.items = items,
            .values = 1,
            .rounds = 4,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", false), side("abut update", true)}};
}

/// Saves a world, or returns all its items to their places after they moved: by a snapshot, or by moves.
Job snapshots(bool saves) {
    using Boxes = ChangingWorld<Box3>;
    const auto side = [saves](std::string who, bool by_moves) -> Side {
        const auto changing = std::make_shared<Boxes>();
        const auto bytes = std::make_shared<std::vector<std::byte>>(changing->world.save());
        const auto poses = std::make_shared<std::vector<Pose3>>();
        for (const Id id : changing->ids) poses->push_back(changing->world.pose(id));
        const auto run = [=](std::span<double> values) {
            if (saves)
                changing->world.save(*bytes);
            else if (by_moves)
                for (std::size_t i = 0; i < items; ++i) changing->world.move(changing->ids[i], (*poses)[i]);
            else if (changing->world.restore(*bytes))
                return;
            values[0] = static_cast<double>(changing->world.pose(changing->ids[items / 2]).position.x);
        };
        const auto prepare = [=] {
            if (saves) return;
            changing->boxes.step();
            changing->move_all();
        };
        return {std::move(who), run, prepare};
    };
    Job job{.items = items, .values = 1, .rounds = 4, .frames = 10, .tolerance = 0, .sides = {side("abut", false)}};
    if (!saves) job.sides.push_back(side("abut moves", true));
    return job;
}

/// Changes a tile of a large map on which boxes rest, and updates: in place, and with a map that is built anew.
Job tile_changes() {
    constexpr std::uint32_t side_tiles = 512;
    struct State {
        State() {
            level = world.add(*TileMap::build(tiles, side_tiles, 1.0f), {.fixed = true});
            for (int i = 0; i < 100; ++i)
                world.add(Box2{{5.0f * static_cast<float>(i) + 2.3f, side_tiles + 0.49f}, {0.5f, 0.5f}});
        }
        World2 world;
        std::vector<Tile> tiles = std::vector<Tile>(side_tiles * side_tiles, Tile::full);
        Id level;
        std::uint32_t changed = 0;
    };
    const auto side = [](std::string who, bool in_place) -> Side {
        const auto state = std::make_shared<State>();
        const auto run = [state, in_place](std::span<double> values) {
            const std::uint32_t tile = state->changed;
            if (in_place)
                state->world.edit_shape<TileMap>(state->level,
                                                 [&](TileMap& map) { map.set(tile, state->tiles[tile]); });
            else
                state->world.set_shape(state->level, *TileMap::build(state->tiles, side_tiles, 1.0f));
            state->world.update();
            values[0] = static_cast<double>(state->world.contacts().size());
        };
        return {std::move(who), run, [state] {
                    state->changed = (state->changed + 7) % side_tiles + side_tiles * (side_tiles - 1);
                    Tile& tile = state->tiles[state->changed];
                    tile = tile == Tile::full ? Tile::empty : Tile::full;
                }};
    };
    return {.items = 1,
            .values = 1,
            .rounds = 8,
            .frames = 10,
            .tolerance = 0,
            .sides = {side("abut", true), side("abut built anew", false)}};
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
        {"broad/world/tile/2d/512", tile_changes},
        {"broad/world/save/3d/5000", [] { return snapshots(true); }},
        {"broad/world/restore/3d/5000", [] { return snapshots(false); }},
    };
}

}  // namespace abut::bench
