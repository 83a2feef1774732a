#pragma once

// Work that is put off until a const call needs its result.

#include <atomic>
#include <cstdint>

namespace abut {

/// Runs the work once, in whichever thread needs it first; the others wait for it. `put_off` and copies are not for
/// use while other threads call `run`.
class PutOff {
public:
    PutOff() = default;
    PutOff(const PutOff& other) noexcept : state_(other.state_.load(std::memory_order_relaxed)) {}
    PutOff& operator=(const PutOff& other) noexcept {
        state_.store(other.state_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }

    void put_off() { state_.store(due, std::memory_order_relaxed); }
    void cancel() { state_.store(done, std::memory_order_relaxed); }

    template <class Work>
    void run(Work&& work) {
        std::uint8_t state = state_.load(std::memory_order_acquire);
        while (state != done) {
            if (state == due && state_.compare_exchange_weak(state, running, std::memory_order_acquire)) {
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
    static constexpr std::uint8_t done = 0, due = 1, running = 2;

    std::atomic<std::uint8_t> state_ = done;
};

}  // namespace abut
