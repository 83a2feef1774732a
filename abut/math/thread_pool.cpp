#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace abut {
namespace {

/// Of the thread: whether it runs a part of a job of any pool.
thread_local bool runs_a_part = false;

}  // namespace

struct ThreadPool::State {
    using Part = FunctionRef<void(std::uint32_t)>;

    std::mutex turn;  ///< of the callers of `run`
    std::mutex mutex;
    std::condition_variable started, ended;
    // By the mutex.
    const Part* part = nullptr;
    std::uint32_t count = 0;
    std::uint64_t job = 0;    ///< the number of jobs so far
    std::size_t running = 0;  ///< threads that have not ended the present job
    bool is_closed = false;
    // By all workers at once.
    std::atomic<std::uint32_t> next = 0;
    std::vector<std::thread> threads;

    void run_parts(const Part& of_job, std::uint32_t parts) {
        runs_a_part = true;
        for (std::uint32_t i = next.fetch_add(1, std::memory_order_relaxed); i < parts;
             i = next.fetch_add(1, std::memory_order_relaxed))
            of_job(i);
        runs_a_part = false;
    }
    void work() {
        std::uint64_t seen = 0;
        std::unique_lock lock(mutex);
        for (;;) {
            started.wait(lock, [&] { return is_closed || job != seen; });
            if (is_closed) return;
            seen = job;
            const Part& of_job = *part;
            const std::uint32_t parts = count;
            lock.unlock();
            run_parts(of_job, parts);
            lock.lock();
            if (--running == 0) ended.notify_one();
        }
    }
};

ThreadPool::ThreadPool(std::uint32_t workers) : state_(std::make_unique<State>()) {
    if (workers == 0) workers = std::max(1u, std::thread::hardware_concurrency());
    state_->threads.reserve(workers - 1);
    try {
        for (std::uint32_t i = 1; i < workers; ++i) state_->threads.emplace_back([this] { state_->work(); });
    } catch (const std::system_error&) {
        // The system gives no more threads: those that started do all the work.
    }
}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_closed = true;
    }
    state_->started.notify_all();
    for (std::thread& thread : state_->threads) thread.join();
}

std::uint32_t ThreadPool::workers() const {
    return static_cast<std::uint32_t>(state_->threads.size()) + 1;
}

void ThreadPool::run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) {
    if (runs_a_part || count < 2 || state_->threads.empty()) {
        for (std::uint32_t i = 0; i < count; ++i) part(i);
        return;
    }
    const std::lock_guard turn(state_->turn);
    {
        const std::lock_guard lock(state_->mutex);
        state_->part = &part;
        state_->count = count;
        state_->next.store(0, std::memory_order_relaxed);
        state_->running = state_->threads.size();
        ++state_->job;
    }
    state_->started.notify_all();
    state_->run_parts(part, count);
    std::unique_lock lock(state_->mutex);
    state_->ended.wait(lock, [&] { return state_->running == 0; });
}

}  // namespace abut
