// The cost of changes to a World: a move with its update, queries between a move and the update, compared with queries
// of an updated world, snapshots, and a level of which a tile, a voxel or a child changes.

#include "../../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

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

/// A large tile map on which boxes rest, one tile of which changes.
struct ChangingTiles {
    using Level = TileMap;
    static constexpr int D = 2;
    static constexpr std::uint32_t side = 512;

    Level build() const { return *TileMap::build(tiles, side, 1.0f); }
    void add_boxes(World2& world) const {
        for (int i = 0; i < 100; ++i)
            world.add(Box2{{5.0f * static_cast<float>(i) + 2.3f, side + 0.49f}, {0.5f, 0.5f}});
    }
    void step() {
        changed = (changed + 7) % side + side * (side - 1);
        tiles[changed] = tiles[changed] == Tile::full ? Tile::empty : Tile::full;
    }
    void edit(Level& map) const { map.set(changed, tiles[changed]); }

    std::vector<Tile> tiles = std::vector<Tile>(side * side, Tile::full);
    std::uint32_t changed = 0;
};

/// The same with a voxel map, in its uppermost layer.
struct ChangingVoxels {
    using Level = VoxelMap;
    static constexpr int D = 3;
    static constexpr std::uint32_t side = 128, layer = side * side;

    Level build() const { return *VoxelMap::build(bits, {side, side, side}, 1.0f); }
    void add_boxes(World3& world) const {
        for (int i = 0; i < 100; ++i)
            world.add(Box3{
                {5.0f * static_cast<float>(i % 25) + 2.3f, 30.0f * static_cast<float>(i / 25) + 4.3f, side + 0.49f},
                Vec3(0.5f)});
    }
    void step() {
        changed = (changed + 7) % layer + layer * (side - 1);
        bits[changed / 64] ^= std::uint64_t{1} << changed % 64;
    }
    void edit(Level& map) const { map.set(changed, (bits[changed / 64] >> changed % 64 & 1) != 0); }

    std::vector<std::uint64_t> bits = std::vector<std::uint64_t>(layer * side / 64, ~std::uint64_t{0});
    std::uint32_t changed = 0;
};

/// A compound of boxes, such as doors, of which one is moved by half its width.
struct ChangingChildren {
    using Level = Compound3;
    static constexpr int D = 3;
    static constexpr std::uint32_t side = 32;

    ChangingChildren() {
        for (std::uint32_t i = 0; i < poses.size(); ++i) poses[i] = pose_of(i, false);
    }
    static Pose3 pose_of(std::uint32_t i, bool moved) {
        return {.position = {static_cast<float>(i % side) + (moved ? 0.5f : 0.0f), static_cast<float>(i / side), 0}};
    }
    Level build() const {
        std::vector<AnyShape<3>> children;
        for (const Pose3& pose : poses) children.emplace_back(at(door, pose));
        return *Compound3::build(children);
    }
    void add_boxes(World3& world) const {
        for (int i = 0; i < 100; ++i)
            world.add(Box3{{3.0f * static_cast<float>(i % 10) + 0.3f, 3.0f * static_cast<float>(i / 10) + 0.3f, 0.95f},
                           Vec3(0.5f)});
    }
    void step() {
        changed = (changed + 7) % side + side * ((changed / side + 1) % side);
        const Pose3 pose = pose_of(changed, false);
        poses[changed] = poses[changed] == pose ? pose_of(changed, true) : pose;
    }
    void edit(Level& compound) const { compound.set(changed, door, poses[changed]); }

    Box3 door{{0, 0, 0}, Vec3(0.5f)};
    std::vector<Pose3> poses = std::vector<Pose3>(side * side);
    std::uint32_t changed = 0;
};

/// Changes a level, in place and by building it anew, and updates the world. The update counts or not.
template <class Changing>
Job level_changes(bool with_update) {
    using Level = typename Changing::Level;
    struct State {
        State() {
            level = world.add(changing.build(), {.fixed = true});
            changing.add_boxes(world);
        }
        World<Changing::D> world;
        Changing changing;
        Id level;
    };
    const auto side = [with_update](std::string who, bool in_place) -> Side {
        const auto state = std::make_shared<State>();
        const auto run = [=](std::span<double> values) {
            if (in_place)
                state->world.template edit_shape<Level>(state->level,
                                                        [&](Level& level) { state->changing.edit(level); });
            else
                state->world.set_shape(state->level, state->changing.build());
            if (with_update) state->world.update();
            // Without an update these are the contacts after the change before.
            values[0] = static_cast<double>(state->world.contacts().size());
            values[1] = 0;
            for (const auto& touch : state->world.contacts())
                for (const auto& point : touch.contact.points)
                    values[1] += static_cast<double>(point.depth) + static_cast<double>(point.position.x);
        };
        const auto prepare = [=] {
            if (!with_update) state->world.update();
            state->changing.step();
        };
        return {std::move(who), run, prepare};
    };
    return {.items = 1,
            .values = 2,
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
        {"broad/world/tile/2d/512", [] { return level_changes<ChangingTiles>(true); }},
        {"broad/world/voxel/3d/128", [] { return level_changes<ChangingVoxels>(true); }},
        {"broad/world/child/3d/1024", [] { return level_changes<ChangingChildren>(true); }},
        {"broad/world/edit/tile/2d/512", [] { return level_changes<ChangingTiles>(false); }},
        {"broad/world/edit/voxel/3d/128", [] { return level_changes<ChangingVoxels>(false); }},
        {"broad/world/edit/child/3d/1024", [] { return level_changes<ChangingChildren>(false); }},
        {"broad/world/save/3d/5000", [] { return snapshots(true); }},
        {"broad/world/restore/3d/5000", [] { return snapshots(false); }},
    };
}

}  // namespace abut::bench
