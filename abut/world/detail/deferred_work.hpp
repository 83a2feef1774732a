#pragma once

// Deferred work: it runs when a const call needs its result.

#include <atomic>
#include <cstdint>

namespace abut::detail {

/// Runs deferred work once, on the first thread that needs it, while other threads wait. `defer`, `cancel` and copies
/// must not run at the same time as `run`.
class DeferredWork {
public:
    DeferredWork() = default;
    DeferredWork(const DeferredWork& other) noexcept : state_(other.state_.load(std::memory_order_relaxed)) {}
    DeferredWork& operator=(const DeferredWork& other) noexcept {
        state_.store(other.state_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }

    void defer() { state_.store(pending, std::memory_order_relaxed); }
    void cancel() { state_.store(done, std::memory_order_relaxed); }

    template <class Work>
    void run(Work&& work) {
        std::uint32_t state = state_.load(std::memory_order_acquire);
        while (state != done) {
            if (state == pending && state_.compare_exchange_weak(state, running, std::memory_order_acquire)) {
                work();
                state_.store(done, std::memory_order_release);
                state_.notify_all();
                return;
            }
            if (state == running) state_.wait(running, std::memory_order_acquire);
            state = state_.load(std::memory_order_acquire);
        }
    }

private:
    static constexpr std::uint32_t done = 0, pending = 1, running = 2;

    /// Not a byte: RISC-V compares and exchanges bytes by calls into another library, which a program would have to
    /// link.
    std::atomic<std::uint32_t> state_ = done;
};

}  // namespace abut::detail
