#pragma once

// Threads that share out the iterations of a loop.

#include <abut/math/function_ref.hpp>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace abut::tool {

class Workers {
public:
    /// The caller of `each` is one of the threads.
    explicit Workers(std::size_t threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Calls visit(i) for each i below count, on any thread and in any order, and returns when all are done.
    void each(std::size_t count, FunctionRef<void(std::size_t)> visit);

private:
    void work();
    void take_all(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable has_work_, is_done_;
    const FunctionRef<void(std::size_t)>* visit_ = nullptr;
    std::size_t next_ = 0, count_ = 0, done_ = 0;
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace abut::tool
