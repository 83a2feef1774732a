// All pairs of a million moving boxes with one thread and with two, in wall-clock time.

#include "../../scenes/moving_boxes.hpp"
#include "../tbb_executor.hpp"
#include "broad.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

/// A counter per part of a job.
class CountingExecutor final : public Executor {
public:
    explicit CountingExecutor(std::uint32_t threads) : inner_(threads) {}

    std::uint32_t workers() const override { return inner_.workers(); }
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override {
        if (counts_.size() < count) counts_.resize(count);
        inner_.run(count, [&](std::uint32_t i) {
            std::size_t* const before = std::exchange(current_, &counts_[i].value);
            part(i);
            current_ = before;
        });
    }

    /// Called by visitors on any thread.
    static void count_one() { ++*current_; }

    /// The sum of all counters.
    template <class Call>
    std::size_t counted(Call call) {
        counts_.assign(std::max<std::size_t>(counts_.size(), 1), {});
        current_ = &counts_[0].value;
        call();
        current_ = nullptr;
        return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0},
                               [](std::size_t sum, const Count& count) { return sum + count.value; });
    }

private:
    struct alignas(64) Count {  // a cache line each
        std::size_t value = 0;
    };
    static thread_local std::size_t* current_;
    TbbExecutor inner_;
    std::vector<Count> counts_;
};
thread_local std::size_t* CountingExecutor::current_ = nullptr;

template <class Phase>
struct ThreadedPairs {
    ThreadedPairs(std::span<const Aabb3> boxes, std::uint32_t threads)
        : counting(threads), executor(threads > 1 ? &counting : nullptr) {
        phase.build(boxes, executor);
    }

    std::size_t count(std::span<const Aabb3> boxes) {
        return counting.counted([&] {
            phase.update(boxes, executor);
            phase.each_pair([](std::uint32_t, std::uint32_t) { CountingExecutor::count_one(); }, executor);
        });
    }

    CountingExecutor counting;
    Executor* executor;  ///< null: a single thread
    Phase phase;
};

Job moving_on_threads(std::size_t count) {
    const MakeScene<3> scene = scene_of<3, scenes::MovingBoxes>(count, broad_seed);
    return {.items = count,
            .values = 1,
            .rounds = 2,
            .frames = 10,
            .on_the_wall = true,
            .tolerance = 0,
            .sides = {count_pairs<ThreadedPairs<ForPairs<3>>>("abut", scene, std::uint32_t{1}),
                      count_pairs<ThreadedPairs<ForPairs<3>>>("abut, 2 threads", scene, std::uint32_t{2}),
                      count_pairs<ThreadedPairs<Bvh<3>>>("abut Bvh", scene, std::uint32_t{1}),
                      count_pairs<ThreadedPairs<Bvh<3>>>("abut Bvh, 2 threads", scene, std::uint32_t{2})}};
}

}  // namespace

std::vector<Bench> thread_benches() {
    return {{"broad/threads/3d/1000000", [] { return moving_on_threads(1'000'000); }}};
}

}  // namespace abut::bench
