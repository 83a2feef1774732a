// Embree's rtcCollide, which reports overlapping boxes of two trees.

#include "embree_boxes.hpp"

#include "broad_peers.hpp"

namespace abut::bench {

namespace {

/// Builds a low quality Morton tree per frame: faster here than a better one or refitting, whose leaves hold several
/// boxes, all pairs of which are reported.
struct Counter {
    explicit Counter(std::span<const Aabb3> first) : boxes(first) {}

    std::size_t count(std::span<const Aabb3>) {
        boxes.build(RTC_BUILD_QUALITY_LOW);
        std::size_t pairs = 0;
        rtcCollide(boxes.scene(), boxes.scene(), count_some, &pairs);
        return pairs;
    }

    /// Each pair is reported in both orders.
    static void count_some(void* pairs, RTCCollision* collisions, unsigned count) {
        for (const RTCCollision& collision : std::span(collisions, count))
            *static_cast<std::size_t*>(pairs) += collision.primID0 < collision.primID1 ? 1 : 0;
    }

    EmbreeBoxes boxes;
};

}  // namespace

Side embree_pairs(const MakeScene<3>& make, Upkeep) {
    return count_pairs<Counter>("embree", make);
}

}  // namespace abut::bench
