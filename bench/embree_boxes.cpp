// Embree's rtcCollide, which tells of the boxes of two trees that overlap.

#include "embree_boxes.hpp"

#include "broad_peers.hpp"

namespace abut::bench {

namespace {

/// A tree of low quality, sorted along a space-filling curve, new in each frame: quicker here than a better one, or one
/// that is refitted (whose leaves hold several boxes, and all pairs of two such leaves are told).
struct Counter {
    explicit Counter(std::span<const Aabb3> first) : boxes(first) {}

    std::size_t count(std::span<const Aabb3>) {
        boxes.build(RTC_BUILD_QUALITY_LOW);
        std::size_t pairs = 0;
        rtcCollide(boxes.scene(), boxes.scene(), count_some, &pairs);
        return pairs;
    }

    /// Each pair is told both ways round.
    static void count_some(void* pairs, RTCCollision* collisions, unsigned count) {
        for (const RTCCollision& told : std::span(collisions, count))
            *static_cast<std::size_t*>(pairs) += told.primID0 < told.primID1 ? 1 : 0;
    }

    EmbreeBoxes boxes;
};

}  // namespace

Side embree_pairs(const MakeScene<3>& make, Upkeep) {
    return count_pairs<Counter>("embree", make);
}

}  // namespace abut::bench
