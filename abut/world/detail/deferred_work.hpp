#pragma once

// Deferred work: it runs when a const call needs its result.

#include <abut/math/detail/mutex.hpp>

#include <atomic>

namespace abut::detail {

/// Runs deferred work once, on the first thread that needs it, while other threads wait. `defer`, `cancel` and copies
/// must not run at the same time as `run`.
class DeferredWork {
public:
    DeferredWork() = default;
    DeferredWork(const DeferredWork& other) noexcept : is_pending_(other.is_pending_.load(std::memory_order_relaxed)) {}
    DeferredWork& operator=(const DeferredWork& other) noexcept {
        is_pending_.store(other.is_pending_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }

    void defer() { is_pending_.store(true, std::memory_order_relaxed); }
    void cancel() { is_pending_.store(false, std::memory_order_relaxed); }

    template <class Work>
    void run(Work&& work) {
        if (!is_pending_.load(std::memory_order_acquire)) return;
        const Lock lock(mutex_);
        if (!is_pending_.load(std::memory_order_relaxed)) return;
        work();
        is_pending_.store(false, std::memory_order_release);
    }

private:
    std::atomic<bool> is_pending_ = false;
    /// std::atomic::wait of libstdc++ 12 loses wake-ups where the system has no futex: on Windows a thread waited
    /// forever.
    Mutex mutex_;
};

}  // namespace abut::detail
