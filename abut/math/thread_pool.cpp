#include <abut/math/detail/mutex.hpp>
#include <abut/math/thread_pool.hpp>

#if ABUT_HAS_THREADS

#include <algorithm>
#include <atomic>
#include <condition_variable>
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
    std::uint32_t job = 0;  ///< the number of jobs so far
    bool is_closed = false;
    // By all workers at once.
    std::atomic<std::uint64_t> next = 0;  ///< the number of the job, and in the lower half of the part
    std::atomic<std::uint32_t> unfinished = 0;
    std::vector<std::thread> threads;

    std::uint32_t present_job() const { return static_cast<std::uint32_t>(next.load(std::memory_order_acquire) >> 32); }

    /// Runs parts of a job as long as there are any. A thread that wakes up too late runs none: by then `of_job` may be
    /// gone, and the next job begun.
    void run_parts(std::uint32_t its_job, const Part& of_job, std::uint32_t parts) {
        runs_a_part = true;
        std::uint32_t finished = 0;
        std::uint64_t ticket = next.load(std::memory_order_relaxed);
        while (ticket >> 32 == its_job && static_cast<std::uint32_t>(ticket) < parts) {
            if (!next.compare_exchange_weak(ticket, ticket + 1, std::memory_order_relaxed)) continue;
            of_job(static_cast<std::uint32_t>(ticket));
            ++finished;
            ticket = next.load(std::memory_order_relaxed);
        }
        runs_a_part = false;
        if (finished == 0 || unfinished.fetch_sub(finished, std::memory_order_acq_rel) > finished) return;
        const std::lock_guard lock(mutex);
        ended.notify_one();
    }
    void work() {
        std::uint32_t seen = 0;
        for (;;) {
            look_for([&] { return present_job() != seen; });
            std::unique_lock lock(mutex);
            started.wait(lock, [&] { return is_closed || job != seen; });
            if (is_closed) return;
            seen = job;
            const Part& of_job = *part;
            const std::uint32_t parts = count;
            lock.unlock();
            run_parts(seen, of_job, parts);
        }
    }

    /// Waits a while, about as long as it takes to wake a thread up: a call of the library has several jobs.
    template <class Condition>
    static void look_for(const Condition& condition) {
        constexpr int tries = 200;
        for (int i = 0; i < tries && !condition(); ++i) std::this_thread::yield();
    }
};

ThreadPool::ThreadPool(std::uint32_t workers) : state_(std::make_unique<State>()) {
    if (workers == 0) workers = std::max(1u, std::thread::hardware_concurrency());
    workers = std::min(workers, max_workers);
    state_->threads.reserve(workers - 1);
    const auto start = [&] {
        for (std::uint32_t i = 1; i < workers; ++i) state_->threads.emplace_back([this] { state_->work(); });
    };
#if defined(__cpp_exceptions)
    try {
        start();
    } catch (const std::system_error&) {
        // The system gives no more threads: those that started do all the work.
    }
#else
    start();
#endif
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
        state_->unfinished.store(count, std::memory_order_relaxed);
        state_->next.store(std::uint64_t{++state_->job} << 32, std::memory_order_release);
    }
    state_->started.notify_all();
    state_->run_parts(state_->job, part, count);
    const auto has_ended = [&] { return state_->unfinished.load(std::memory_order_acquire) == 0; };
    State::look_for(has_ended);
    std::unique_lock lock(state_->mutex);
    state_->ended.wait(lock, has_ended);
}

}  // namespace abut

#else

namespace abut {

struct ThreadPool::State {};

ThreadPool::ThreadPool(std::uint32_t) {}
ThreadPool::~ThreadPool() = default;

std::uint32_t ThreadPool::workers() const {
    return 1;
}

void ThreadPool::run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) {
    for (std::uint32_t i = 0; i < count; ++i) part(i);
}

}  // namespace abut

#endif
