// Embree's rtcCollide, which tells of the boxes of two trees that may overlap.

#include "embree_boxes.hpp"

#include "broad_peers.hpp"

namespace abut::bench {

namespace {

/// It only ever refits a tree, which grows worse by it: every so many frames there is a new one. The best of a few.
constexpr int frames_a_tree = 16;

struct Counter {
    Counter(std::span<const Aabb3> first, Upkeep how) : boxes(first), upkeep(how) {}

    std::size_t count(std::span<const Aabb3> now) {
        if (upkeep == Upkeep::scratch)
            boxes.build(RTC_BUILD_QUALITY_LOW);
        else if (frame++ % frames_a_tree == 0)
            boxes.build(RTC_BUILD_QUALITY_REFIT);
        else
            boxes.refit();
        Found found{now, 0};
        rtcCollide(boxes.scene(), boxes.scene(), count_some, &found);
        return found.pairs;
    }

    struct Found {
        std::span<const Aabb3> boxes;
        std::size_t pairs;
    };
    /// Each pair is told both ways round, and so are others of the same leaves.
    static void count_some(void* data, RTCCollision* collisions, unsigned count) {
        Found& found = *static_cast<Found*>(data);
        for (const RTCCollision& told : std::span(collisions, count)) {
            if (told.primID0 >= told.primID1) continue;
            found.pairs += overlaps(found.boxes[told.primID0], found.boxes[told.primID1]) ? 1 : 0;
        }
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
