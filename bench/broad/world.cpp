// A World's frame, and the equivalent without a World.

#include "../../scenes/convex_shapes.hpp"
#include "../../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace abut::bench {

using namespace detail;

namespace {

enum class Shapes { mixed, balls };

/// Boxes, capsules and hulls that move, or balls, which have a cheap narrow phase.
struct MixedScene {
    struct Item {
        scenes::AnyConvex<3> shape;
        glm::quat rotation;
    };

    explicit MixedScene(std::size_t count, Shapes shapes = Shapes::mixed) : boxes(count, broad_seed) {
        oracle::Random random(broad_seed);
        for (std::size_t i = 0; i < count; ++i) {
            Item& item = items.emplace_back();
            item.rotation = random.rotation<3>();
            if (shapes == Shapes::balls)
                item.shape = Sphere{{0, 0, 0}, random.uniform_float(0.25, 1)};
            else if (i % 3 == 0)
                item.shape = scenes::random_box<3>(random);
            else if (i % 3 == 1)
                item.shape = scenes::random_capsule(random);
            else
                item.shape = scenes::random_hull(random, 32);
        }
    }
    Pose3 pose(std::size_t i) const { return {center(boxes.boxes()[i]), items[i].rotation}; }

    scenes::MovingBoxes<3> boxes;
    std::vector<Item> items;
};

/// The queries of each frame.
struct WorldFrames {
    std::size_t count = 0;
    Shapes shapes = Shapes::mixed;
    std::size_t rays = 0;  ///< each 20 mean edges long
    bool filter_edges = true;
};

/// Counts touching pairs, with all contacts, and ray hits.
Side world_update(std::string who, const WorldFrames& frames, std::optional<BroadPhaseKind> broad_phase = {}) {
    struct State {
        State(const WorldFrames& f, std::optional<BroadPhaseKind> kind)
            : scene(f.count, f.shapes), world({.broad_phase = kind, .filter_edges = f.filter_edges}) {
            for (std::size_t i = 0; i < f.count; ++i)
                ids.push_back(std::visit([&](const auto& s) { return world.add(s, {.pose = scene.pose(i)}); },
                                         scene.items[i].shape));
            oracle::Random random(broad_seed);
            const float side = scene.boxes.side();
            while (rays.size() < f.rays) {
                Vec3 origin;
                for (int i = 0; i < 3; ++i) origin[i] = random.uniform_float(0, side);
                rays.push_back({origin, to_float<3>(random.direction<3>()), 25});
            }
        }
        MixedScene scene;
        World3 world;
        std::vector<Id> ids;
        std::vector<Ray3> rays;
    };
    const auto state = std::make_shared<State>(frames, broad_phase);
    const auto run = [state](std::span<double> values) {
        for (std::size_t i = 0; i < state->ids.size(); ++i) state->world.move(state->ids[i], state->scene.pose(i));
        const Events events = state->world.update();
        std::size_t found = events.began.size() + events.stayed.size();
        for (const Ray3& ray : state->rays) found += state->world.raycast(ray) ? 1u : 0u;
        values[0] = static_cast<double>(found);
    };
    return {std::move(who), run, [state] { state->scene.boxes.step(); }};
}

/// Counts them without a World: a broad phase, and an overlap test per pair.
Side overlaps_without_world(std::size_t count) {
    struct State {
        explicit State(std::size_t n) : scene(n), views(n), boxes(n) {
            place();
            phase.build(boxes);
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
        ForQueries<3> phase;
    };
    const auto state = std::make_shared<State>(count);
    const auto run = [state](std::span<double> values) {
        state->place();
        state->phase.update(state->boxes);
        std::size_t touching = 0;
        state->phase.each_pair([&](std::uint32_t i, std::uint32_t j) {
            touching += overlaps(state->views[i], state->views[j]) ? 1u : 0u;
        });
        values[0] = static_cast<double>(touching);
    };
    return {"abut without World", run, [state] { state->scene.boxes.step(); }};
}

Job world(std::size_t count) {
    return {.items = count,
            .values = 1,
            .rounds = 8,
            .frames = 10,
            .tolerance = 1,  // touching is decided to within the tolerance
            .sides = {world_update("abut", {.count = count}),
                      world_update("abut without filter", {.count = count, .filter_edges = false}),
                      overlaps_without_world(count)}};
}

/// With the broad phase that the World chooses, and with each alternative.
Job world_that_chooses(const WorldFrames& frames) {
    return {.items = frames.count,
            .values = 1,
            .rounds = 80,  // until its adaptive choice has settled
            .frames = 10,
            .tolerance = 0,
            .sides = {world_update(chosen_side, frames), world_update("abut by Grid", frames, BroadPhaseKind::grid),
                      world_update("abut by Bvh", frames, BroadPhaseKind::bvh)}};
}

}  // namespace

std::vector<Bench> world_benches() {
    return {
        {"broad/world/3d/2000", [] { return world(2000); }},
        {"broad/world/balls/3d/10000", [] { return world_that_chooses({.count = 10'000, .shapes = Shapes::balls}); }},
        {"broad/world/rays/3d/10000",
         [] { return world_that_chooses({.count = 10'000, .shapes = Shapes::balls, .rays = 2000}); }},
    };
}

}  // namespace abut::bench
