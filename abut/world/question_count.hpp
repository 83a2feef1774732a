#pragma once

// How often a world is asked: what its choice of a broad phase rests on.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>

namespace abut {

/// What a ray, or a search for what is near, counts against a region: by so much more they differ from one broad phase
/// to another.
inline constexpr std::uint32_t ray_weight = 10, region_weight = 1;

/// Counts up to a limit, from many threads at once. Beyond it, a count is one read that all threads share; below, they
/// wait for one another some nanoseconds. What is read is the same whichever of them came first.
class QuestionCount {
public:
    QuestionCount() = default;
    QuestionCount(QuestionCount&& other) noexcept { *this = std::move(other); }
    QuestionCount& operator=(QuestionCount&& other) noexcept {
        count_.store(other.count_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        limit_ = other.limit_;
        return *this;
    }

    void add(std::uint32_t weight) {
        if (count_.load(std::memory_order_relaxed) < limit_) count_.fetch_add(weight, std::memory_order_relaxed);
    }
    /// Of what was added since the last call, no more than its limit; from now on it counts up to this one.
    /// Not while others add.
    std::uint32_t take(std::uint32_t limit) {
        const std::uint32_t result = std::min(count_.exchange(0, std::memory_order_relaxed), limit_);
        limit_ = limit;
        return result;
    }

private:
    std::atomic<std::uint32_t> count_ = 0;
    std::uint32_t limit_ = 0;
};

}  // namespace abut
