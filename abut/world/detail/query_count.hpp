#pragma once

// The number of queries to a world, which its choice of a broad phase depends on.

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace abut::detail {

/// The weights of a ray or nearest query and of a region query: the cost of the former differs ten times as much
/// between broad phases.
inline constexpr std::uint32_t ray_weight = 10, region_weight = 1;

/// A counter with a limit, for many threads at once. Above the limit, `add` is a single shared read; below, it is an
/// atomic addition. The result doesn't depend on the order of the threads.
class QueryCount {
public:
    QueryCount() = default;
    QueryCount(const QueryCount& other) noexcept { *this = other; }
    QueryCount& operator=(const QueryCount& other) noexcept {
        count_.store(other.count_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        limit_ = other.limit_;
        return *this;
    }

    void add(std::uint32_t weight) {
        if (count_.load(std::memory_order_relaxed) < limit_) count_.fetch_add(weight, std::memory_order_relaxed);
    }
    void set_limit(std::uint32_t limit) { limit_ = limit; }
    /// The sum since the last call of `take`.
    std::uint32_t sum() const { return count_.load(std::memory_order_relaxed); }
    /// Returns the sum since the last call, clamped to that call's limit, and resets it with a new limit. No other
    /// thread may call `add` at the same time.
    std::uint32_t take(std::uint32_t limit) {
        const std::uint32_t result = std::min(count_.exchange(0, std::memory_order_relaxed), limit_);
        limit_ = limit;
        return result;
    }

private:
    std::atomic<std::uint32_t> count_ = 0;
    std::uint32_t limit_ = 0;
};

}  // namespace abut::detail
