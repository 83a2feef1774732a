// FCL's broad phases: DynamicAABBTreeCollisionManager, its fastest, and SaPCollisionManager, sweep and prune.

#include "fcl_boxes.hpp"

#include "broad_peers.hpp"

#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

namespace abut::bench {

namespace {

/// The tree is only refitted, which degrades it: it is rebuilt every so many frames. The best interval of several
/// tried.
constexpr int frames_a_tree = 16;

struct Tree : FclBoxes<fcl::DynamicAABBTreeCollisionManagerd> {
    using FclBoxes::FclBoxes;
    void update() { ++frame % frames_a_tree == 0 ? build() : manager.update(); }

    int frame = 0;
};

struct Sweep : FclBoxes<fcl::SaPCollisionManagerd> {
    using FclBoxes::FclBoxes;
    void update() { manager.update(); }
};

template <class Boxes>
struct Counter {
    Counter(std::span<const Aabb3> first, Upkeep how) : boxes(first), upkeep(how) {}

    std::size_t count(std::span<const Aabb3> now) {
        for (std::size_t i = 0; i < now.size(); ++i) move(*boxes.objects[i], now[i]);
        upkeep == Upkeep::update ? boxes.update() : boxes.build();
        std::size_t pairs = 0;
        boxes.manager.collide(&pairs, count_one);
        return pairs;
    }

    Boxes boxes;
    Upkeep upkeep;
};

}  // namespace

Side fcl_tree_pairs(const MakeScene<3>& make, Upkeep upkeep) {
    return count_pairs<Counter<Tree>>("fcl", make, upkeep);
}

Side fcl_sweep_pairs(const MakeScene<3>& make, Upkeep upkeep) {
    Side side = count_pairs<Counter<Sweep>>("fcl sweep", make, upkeep);
    side.strays = 1;  // misses some pairs that barely touch: one in a thousand of these scenes
    return side;
}

}  // namespace abut::bench
