#include "tool/shared/workers.hpp"

#include <algorithm>

namespace abut::tool {
namespace {

// Iterations that a thread takes at a time: a lock for each would cost more than a cheap iteration.
std::size_t batch_of(std::size_t left, std::size_t threads) {
    return std::max<std::size_t>(1, std::min<std::size_t>(left / (4 * threads), 64));
}

}  // namespace

Workers::Workers(std::size_t threads) {
    for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

Workers::~Workers() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        ends_ = true;
    }
    has_work_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Workers::each(std::size_t count, FunctionRef<void(std::size_t)> visit) {
    if (threads_.empty() || count < 2) {
        for (std::size_t i = 0; i < count; ++i) visit(i);
        return;
    }
    std::unique_lock<std::mutex> lock(mutex_);
    visit_ = &visit;
    next_ = done_ = 0;
    count_ = count;
    has_work_.notify_all();
    take_all(lock);
    is_done_.wait(lock, [&] { return done_ == count_; });
    visit_ = nullptr;
}

void Workers::work() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        has_work_.wait(lock, [&] { return ends_ || (visit_ != nullptr && next_ < count_); });
        if (ends_) return;
        take_all(lock);
    }
}

// Runs iterations until none is left to take.
void Workers::take_all(std::unique_lock<std::mutex>& lock) {
    while (next_ < count_) {
        const std::size_t first = next_, last = first + batch_of(count_ - first, threads_.size() + 1);
        next_ = last;
        const FunctionRef<void(std::size_t)>& visit = *visit_;
        lock.unlock();
        for (std::size_t i = first; i < last; ++i) visit(i);
        lock.lock();
        done_ += last - first;
    }
    if (done_ == count_) is_done_.notify_one();
}

}  // namespace abut::tool
