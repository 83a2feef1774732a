// Embree's rtcCollide, which tells of the boxes of two trees that overlap.

#include "embree_boxes.hpp"

#include "broad_peers.hpp"

namespace abut::bench {

namespace {

/// It only ever refits a tree, which grows worse by it: every so many frames there is a new one. The best of a few.
constexpr int frames_a_tree = 8;

struct Counter {
    Counter(std::span<const Aabb3> first, Upkeep how) : boxes(first), upkeep(how) {}

    std::size_t count(std::span<const Aabb3>) {
        if (upkeep == Upkeep::scratch)
            boxes.build(RTC_BUILD_QUALITY_LOW);
        else if (frame++ % frames_a_tree == 0)
            boxes.build(RTC_BUILD_QUALITY_REFIT);
        else
            boxes.refit();
        std::size_t pairs = 0;
        rtcCollide(boxes.scene(), boxes.scene(), count_some, &pairs);
        return pairs;
    }

    /// Each pair is told both ways round.
    static void count_some(void* pairs, RTCCollision* collisions, unsigned count) {
        for (unsigned i = 0; i < count; ++i)
            *static_cast<std::size_t*>(pairs) += collisions[i].primID0 < collisions[i].primID1 ? 1 : 0;
    }

    EmbreeBoxes boxes;
    Upkeep upkeep;
    int frame = 0;
};

}  // namespace

Side embree_pairs(const MakeScene<3>& make, Upkeep upkeep) {
    return count_pairs<Counter>("embree", make, upkeep);
}

}  // namespace abut::bench
