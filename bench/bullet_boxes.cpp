// Bullet's broad phase: btDbvt, the tree of btDbvtBroadphase, which alone is the quicker of the two at all pairs of a
// frame.

#include "../scenes/moving_boxes.hpp"
#include "bullet.hpp"
#include "peers.hpp"

#include <memory>

namespace abut::bench {

namespace {

constexpr btScalar margin = 0.2f;  // twice the longest step: quicker here than btDbvtBroadphase's own 0.05, or none

std::uintptr_t number_of(const btDbvtNode* leaf) {
    return reinterpret_cast<std::uintptr_t>(leaf->data);
}

struct Tree {
    explicit Tree(std::span<const Aabb3> boxes) {
        for (const Aabb3& box : boxes)
            leaves.push_back(tree.insert(to_bullet(box), reinterpret_cast<void*>(std::uintptr_t{leaves.size()})));
        tree.optimizeTopDown();
    }

    btDbvt tree;
    std::vector<btDbvtNode*> leaves;
};

struct CountPairs : btDbvt::ICollide {
    explicit CountPairs(std::span<const Aabb3> all) : boxes(all) {}
    void Process(const btDbvtNode* a, const btDbvtNode* b) override {
        count += overlaps(boxes[number_of(a)], boxes[number_of(b)]) ? 1 : 0;
    }

    std::span<const Aabb3> boxes;
    std::size_t count = 0;
};

struct CountLeaves : btDbvt::ICollide {
    void Process(const btDbvtNode*) override { ++count; }
    std::size_t count = 0;
};

}  // namespace

Side bullet_moving(std::size_t count, std::uint64_t seed) {
    struct State {
        State(std::size_t n, std::uint64_t number) : scene(n, number), tree(scene.boxes()) {}
        scenes::MovingBoxes<3> scene;
        Tree tree;
    };
    const auto state = std::make_shared<State>(count, seed);
    const auto ask = [state](std::span<double> values) {
        const std::span<const Aabb3> boxes = state->scene.boxes();
        btDbvt& tree = state->tree.tree;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            btDbvtVolume volume = to_bullet(boxes[i]);
            tree.update(state->tree.leaves[i], volume, margin);
        }
        CountPairs pairs(boxes);
        tree.collideTTpersistentStack(tree.m_root, tree.m_root, pairs);
        values[0] = static_cast<double>(pairs.count);
    };
    return {"bullet", ask, [state] { state->scene.step(); }};
}

Side bullet_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return {"bullet", [tree, regions = std::vector(regions.begin(), regions.end())](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    CountLeaves leaves;
                    tree->tree.collideTV(tree->tree.m_root, to_bullet(regions[i]), leaves);
                    values[i] = static_cast<double>(leaves.count);
                }
            }};
}

Side bullet_rays(std::span<const Aabb3> boxes, std::span<const Ray3> rays) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return {"bullet", [tree, rays = std::vector(rays.begin(), rays.end())](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    CountLeaves leaves;
                    const Vec3 end = rays[i].origin + rays[i].length * rays[i].direction;
                    btDbvt::rayTest(tree->tree.m_root, to_bullet(rays[i].origin), to_bullet(end), leaves);
                    values[i] = static_cast<double>(leaves.count);
                }
            }};
}

}  // namespace abut::bench
