// Box2D's broad phase: b2BroadPhase, which reports new pairs of fattened boxes, and a pair list as b2ContactManager has
// one.

#include "../box2d.hpp"
#include "broad_peers.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include <box2d/b2_broad_phase.h>

namespace abut::bench {

namespace {

void* as_pointer(std::size_t number) {
    return reinterpret_cast<void*>(number);
}

class Counter {
public:
    explicit Counter(std::span<const Aabb2> boxes) : last_(boxes.begin(), boxes.end()) {
        for (const Aabb2& box : boxes)
            proxies_.push_back(broad_phase_.CreateProxy(to_box2d(box), as_pointer(proxies_.size())));
    }

    /// Tests the exact boxes.
    std::size_t count(std::span<const Aabb2> boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            broad_phase_.MoveProxy(proxies_[i], to_box2d(boxes[i]), to_box2d(boxes[i].min - last_[i].min));
            last_[i] = boxes[i];
        }
        broad_phase_.UpdatePairs(this);
        std::erase_if(pairs_, [this](const Pair& pair) {
            const bool over = !broad_phase_.TestOverlap(proxies_[pair.a], proxies_[pair.b]);
            if (over) known_.erase(key(pair));
            return over;
        });
        return static_cast<std::size_t>(
            std::ranges::count_if(pairs_, [&](const Pair& pair) { return overlaps(boxes[pair.a], boxes[pair.b]); }));
    }

    /// Called by UpdatePairs.
    void AddPair(void* a, void* b) {
        const Pair pair{reinterpret_cast<std::size_t>(a), reinterpret_cast<std::size_t>(b)};
        if (known_.insert(key(pair)).second) pairs_.push_back(pair);
    }

private:
    struct Pair {
        std::size_t a, b;
    };

    static std::uint64_t key(const Pair& pair) {
        const auto [low, high] = std::minmax(pair.a, pair.b);
        return (std::uint64_t{low} << 32) | high;
    }

    b2BroadPhase broad_phase_;
    std::vector<int32> proxies_;
    std::vector<Aabb2> last_;
    std::vector<Pair> pairs_;
    std::unordered_set<std::uint64_t> known_;
};

}  // namespace

Side box2d_pairs(const MakeScene<2>& make, Upkeep) {
    return count_pairs<Counter>("box2d", make);
}

}  // namespace abut::bench
