// FCL's broad phase: DynamicAABBTreeCollisionManager, in double as Debian builds it.

#include "../scenes/moving_boxes.hpp"
#include "fcl.hpp"
#include "peers.hpp"

#include <memory>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace abut::bench {

namespace {

struct Manager {
    explicit Manager(std::span<const Aabb3> boxes) {
        for (const Aabb3& box : boxes) {
            objects.push_back(object(box));
            pointers.push_back(objects.back().get());
        }
        manager.registerObjects(pointers);
        manager.setup();
    }

    static std::unique_ptr<fcl::CollisionObjectd> object(const Aabb3& box) {
        auto result =
            std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Boxd>(to_fcl(box.max) - to_fcl(box.min)));
        move(*result, box);
        return result;
    }
    static void move(fcl::CollisionObjectd& object, const Aabb3& box) {
        object.setTranslation(0.5 * (to_fcl(box.min) + to_fcl(box.max)));
        object.computeAABB();
    }

    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    std::vector<fcl::CollisionObjectd*> pointers;
    fcl::DynamicAABBTreeCollisionManagerd manager;
};

/// The manager's trees hold the boxes themselves: what it tells of, overlaps.
bool count_one(fcl::CollisionObjectd*, fcl::CollisionObjectd*, void* count) {
    ++*static_cast<std::size_t*>(count);
    return false;
}

}  // namespace

Side fcl_moving(std::size_t count, std::uint64_t seed) {
    struct State {
        State(std::size_t n, std::uint64_t number) : scene(n, number), tree(scene.boxes()) {}
        scenes::MovingBoxes<3> scene;
        Manager tree;
    };
    const auto state = std::make_shared<State>(count, seed);
    const auto ask = [state](std::span<double> values) {
        const std::span<const Aabb3> boxes = state->scene.boxes();
        for (std::size_t i = 0; i < boxes.size(); ++i) Manager::move(*state->tree.objects[i], boxes[i]);
        state->tree.manager.update();
        std::size_t pairs = 0;
        state->tree.manager.collide(&pairs, count_one);
        values[0] = static_cast<double>(pairs);
    };
    return {"fcl", ask, [state] { state->scene.step(); }};
}

Side fcl_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions) {
    const auto tree = std::make_shared<const Manager>(boxes);
    const auto asked = std::make_shared<std::vector<std::unique_ptr<fcl::CollisionObjectd>>>();
    for (const Aabb3& region : regions) asked->push_back(Manager::object(region));
    return {"fcl", [tree, asked](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    std::size_t count = 0;
                    tree->manager.collide((*asked)[i].get(), &count, count_one);
                    values[i] = static_cast<double>(count);
                }
            }};
}

}  // namespace abut::bench
