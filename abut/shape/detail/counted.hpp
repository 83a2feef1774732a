#pragma once

// A shared pointer of one word to an object that counts its owners.

#include <atomic>
#include <cstdint>
#include <utility>

namespace abut::detail {

/// The base of what a CountedPointer owns.
class Counted {
public:
    Counted() = default;
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

    void add_owner() const { owners_.fetch_add(1, std::memory_order_relaxed); }
    /// Whether it has several owners.
    bool is_shared() const { return owners_.load(std::memory_order_acquire) > 1; }
    /// Whether it was the last one.
    bool remove_owner() const { return owners_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

private:
    mutable std::atomic<std::uint32_t> owners_ = 0;
};

/// Half the size of a std::shared_ptr, and the object needs no block beside it. Up to 2^32 - 1 owners.
template <class T>
class CountedPointer {
public:
    /// Of an object made by `new`.
    explicit CountedPointer(T* object) : object_(object) { add_owner(); }
    CountedPointer(const CountedPointer& other) noexcept : object_(other.object_) { add_owner(); }
    CountedPointer(CountedPointer&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    CountedPointer& operator=(CountedPointer other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~CountedPointer() {
        if (object_ != nullptr && object_->remove_owner()) delete object_;
    }

    T& operator*() const { return *object_; }
    T* operator->() const { return object_; }
    /// Whether both own the same object.
    bool operator==(const CountedPointer&) const = default;

private:
    void add_owner() const {
        if (object_ != nullptr) object_->add_owner();
    }

    T* object_;  // null only where it was moved from
};

}  // namespace abut::detail
