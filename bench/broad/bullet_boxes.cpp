// Bullet's broad phases: btDbvt, the tree of btDbvtBroadphase, which on its own is faster at all pairs of a frame; and
// bt32BitAxisSweep3, sweep and prune on three sorted axes.

#include "../bullet.hpp"
#include "broad_peers.hpp"

#include <memory>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <glm/common.hpp>

namespace abut::bench {

namespace {

constexpr btScalar margin = 0.2f;  // twice the longest step: faster here than btDbvtBroadphase's 0.05, or none

void* as_pointer(std::size_t number) {
    return reinterpret_cast<void*>(number);
}

std::uintptr_t number_of(const btDbvtNode* leaf) {
    return reinterpret_cast<std::uintptr_t>(leaf->data);
}
std::uintptr_t number_of(const btBroadphaseProxy* proxy) {
    return reinterpret_cast<std::uintptr_t>(proxy->m_clientObject);
}

struct Tree {
    explicit Tree(std::span<const Aabb3> boxes) {
        build(boxes);
        tree.optimizeTopDown();
    }

    /// Incremental insertion takes a tenth of the time of a well-built tree.
    void build(std::span<const Aabb3> boxes) {
        tree.clear();
        leaves.clear();
        for (const Aabb3& box : boxes) leaves.push_back(tree.insert(to_bullet(box), as_pointer(leaves.size())));
    }
    void update(std::span<const Aabb3> boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            btDbvtVolume volume = to_bullet(boxes[i]);
            tree.update(leaves[i], volume, margin);
        }
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

struct TreePairs {
    TreePairs(std::span<const Aabb3> boxes, Upkeep how) : tree(boxes), upkeep(how) {}

    std::size_t count(std::span<const Aabb3> boxes) {
        upkeep == Upkeep::update ? tree.update(boxes) : tree.build(boxes);
        CountPairs pairs(boxes);
        tree.tree.collideTTpersistentStack(tree.tree.m_root, tree.tree.m_root, pairs);
        return pairs.count;
    }

    Tree tree;
    Upkeep upkeep;
};

struct SweepPairs {
    explicit SweepPairs(std::span<const Aabb3> boxes) : sweep(world(boxes)) {
        for (const Aabb3& box : boxes)
            proxies.push_back(sweep->createProxy(to_bullet(box.min), to_bullet(box.max), 0, as_pointer(proxies.size()),
                                                 1, 1, nullptr));
    }

    /// Includes a margin for boxes that leave the first frame's bounds.
    static std::unique_ptr<bt32BitAxisSweep3> world(std::span<const Aabb3> boxes) {
        Aabb3 all = Aabb3::empty();
        for (const Aabb3& box : boxes) all = {glm::min(all.min, box.min), glm::max(all.max, box.max)};
        const bool without_tree = true;
        return std::make_unique<bt32BitAxisSweep3>(to_bullet(all.min - 16.0f), to_bullet(all.max + 16.0f),
                                                   static_cast<unsigned>(boxes.size() + 1), nullptr, without_tree);
    }

    std::size_t count(std::span<const Aabb3> boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i)
            sweep->setAabb(proxies[i], to_bullet(boxes[i].min), to_bullet(boxes[i].max), nullptr);
        const btBroadphasePairArray& pairs = sweep->getOverlappingPairCache()->getOverlappingPairArray();
        std::size_t result = 0;
        for (int i = 0; i < pairs.size(); ++i)
            result += overlaps(boxes[number_of(pairs[i].m_pProxy0)], boxes[number_of(pairs[i].m_pProxy1)]) ? 1 : 0;
        return result;
    }

    std::unique_ptr<bt32BitAxisSweep3> sweep;
    std::vector<btBroadphaseProxy*> proxies;
};

}  // namespace

Side bullet_tree_pairs(const MakeScene<3>& make, Upkeep upkeep) {
    return count_pairs<TreePairs>("bullet", make, upkeep);
}

Side bullet_sweep_pairs(const MakeScene<3>& make, Upkeep) {
    return count_pairs<SweepPairs>("bullet sweep", make);
}

}  // namespace abut::bench
