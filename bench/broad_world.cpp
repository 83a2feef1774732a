// A whole World's frame, and the same by hand.

#include "../scenes/convex_shapes.hpp"
#include "../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <variant>

namespace abut::bench {

namespace {

/// Boxes, capsules and hulls that drift about.
struct MixedScene {
    struct Item {
        scenes::AnyConvex<3> shape;
        glm::quat rotation;
    };

    explicit MixedScene(std::size_t count) : boxes(count, broad_seed) {
        oracle::Random random(broad_seed);
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

    scenes::MovingBoxes<3> boxes;
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

/// Counts them without a World: a broad phase, and a yes or no for each pair of boxes.
Side overlaps_by_hand(std::size_t count) {
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
    const auto ask = [state](std::span<double> values) {
        state->place();
        state->phase.update(state->boxes);
        std::size_t touching = 0;
        state->phase.each_pair([&](std::uint32_t i, std::uint32_t j) {
            touching += overlaps(state->views[i], state->views[j]) ? 1u : 0u;
        });
        values[0] = static_cast<double>(touching);
    };
    return {"abut by hand", ask, [state] { state->scene.boxes.step(); }};
}

Job world(std::size_t count) {
    return {.items = count,
            .values = 1,
            .rounds = 8,
            .frames = 10,
            .tolerance = 1,  // a pair may touch to within the margin of doubt
            .sides = {world_update(count), overlaps_by_hand(count)}};
}

}  // namespace

std::vector<Bench> world_benches() {
    return {{"broad/world/3d/2000", [] { return world(2000); }}};
}

}  // namespace abut::bench
