#include "tool/shared/threads.hpp"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace abut::tool {

Threads::Threads() : count_(std::max(1u, std::thread::hardware_concurrency())) {}

void Threads::run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) {
    std::atomic<std::uint32_t> next = 0;
    const auto work = [&] {
        for (std::uint32_t i = next++; i < count; i = next++) part(i);
    };
    std::vector<std::thread> others;
    others.reserve(std::min(count_, count));
    try {
        for (std::uint32_t i = 1; i < std::min(count_, count); ++i) others.emplace_back(work);
    } catch (const std::system_error&) {
        // Thread creation failed: the threads that started do all the work.
    }
    work();
    for (std::thread& other : others) other.join();
}

}  // namespace abut::tool
