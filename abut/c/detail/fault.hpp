#pragma once

// How an entry of the C API checks its arguments, and reports what is wrong with them. For .cpp files.

#include <abut/c/types.h>
#include <abut/math/result.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <new>
#include <optional>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// What is wrong with an argument: "points[3] is not finite".
struct Fault {
    static constexpr std::size_t no_index = ~std::size_t{0};

    abut_code code = ABUT_OK;
    const char* argument = "";
    const char* what = "";
    std::size_t index = no_index;
};

/// Stores it for abut_last_error and returns its code.
abut_code report(const Fault& fault);
abut_code report(const Problem& problem);

/// A pointer that must not be null; a handle has the tag of its type.
template <class T>
Fault present(const T* pointer, const char* name) {
    if (pointer == nullptr) return {ABUT_NULL_ARGUMENT, name, "is null"};
    if constexpr (requires { T::own_tag; }) {
        if (pointer->tag != T::own_tag)
            return {ABUT_WRONG_HANDLE, name, "is a handle of another type or dimension, or was released"};
    }
    return {};
}
/// A handle that may be null.
template <class T>
Fault present_or_null(const T* pointer, const char* name) {
    return pointer == nullptr ? Fault() : present(pointer, name);
}

/// A value with the same bytes: the values of the C API lie in memory as those of the library.
template <class To, class From>
To same_bytes(const From& from) {
    static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From));
    return std::bit_cast<To>(from);
}

/// Whether all numbers of a struct of floats are finite.
template <class T>
bool all_finite(const T& value) {
    const auto numbers = std::bit_cast<std::array<float, sizeof(T) / sizeof(float)>>(value);
    return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}
/// Its length may be infinite, and is not below 0.
template <class R>
requires requires(const R& ray) {
    ray.direction;
}
bool all_finite(const R& ray) {
    return all_finite(ray.origin) && all_finite(ray.direction) && ray.length >= 0;
}

/// Rotations are not all zeros.
template <class P>
requires requires(const P& pose) {
    pose.rotation;
}
bool all_finite(const P& pose) {
    constexpr std::size_t count = sizeof(P) / sizeof(float);
    const auto numbers = std::bit_cast<std::array<float, count>>(pose);
    constexpr std::size_t rotation = count == sizeof(abut_pose2) / sizeof(float) ? 2 : 4;
    const bool finite = std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
    return finite && std::any_of(numbers.end() - rotation, numbers.end(), [](float number) { return number != 0; });
}
template <class M>
requires requires(const M& motion) {
    motion.from;
}
bool all_finite(const M& motion) {
    return all_finite(motion.from) && all_finite(motion.move) && all_finite(motion.turn);
}

template <class T>
Fault finite(const T& value, const char* name) {
    return all_finite(value) ? Fault() : Fault{ABUT_NOT_FINITE, name, "is not finite"};
}
inline Fault not_below_zero(float value, const char* name) {
    return std::isfinite(value) && value >= 0 ? Fault()
                                              : Fault{ABUT_BAD_ARGUMENT, name, "is not a number of 0 or more"};
}

/// An array of the caller, with a stride.
template <class T>
class Strided {
public:
    Strided(const T* data, std::uint32_t stride, std::uint32_t count, const char* name)
        : data_(reinterpret_cast<const std::byte*>(data)),
          stride_(stride == 0 ? sizeof(T) : stride),
          count_(count),
          name_(name) {}

    std::uint32_t size() const { return count_; }
    T operator[](std::size_t i) const {
        T value;
        std::memcpy(&value, data_ + i * stride_, sizeof(T));
        return value;
    }
    /// The pointer and the stride.
    Fault fault() const {
        if (data_ == nullptr && count_ > 0) return {ABUT_NULL_ARGUMENT, name_, "is null"};
        return stride_ >= sizeof(T) ? Fault()
                                    : Fault{ABUT_BAD_ARGUMENT, name_, "has a stride below its element's size"};
    }
    /// The first element that isn't finite, if any.
    Fault fault_of_elements() const {
        if (const Fault own = fault(); own.code != ABUT_OK) return own;
        for (std::size_t i = 0; i < count_; ++i)
            if (!all_finite((*this)[i])) return {ABUT_NOT_FINITE, name_, "is not finite", i};
        return {};
    }
    /// The elements as the library's values.
    template <class To>
    std::vector<To> copied() const {
        std::vector<To> result;
        result.reserve(count_);
        for (std::size_t i = 0; i < count_; ++i) result.push_back(same_bytes<To>((*this)[i]));
        return result;
    }

private:
    const std::byte* data_;
    std::size_t stride_;
    std::uint32_t count_;
    const char* name_;
};

/// An array without a stride, of so many elements.
template <class T>
Fault array(const T* data, std::size_t count, const char* name) {
    return data == nullptr && count > 0 ? Fault{ABUT_NULL_ARGUMENT, name, "is null"} : Fault();
}

/// A list that an entry writes: up to `capacity` elements, and the full length.
template <class T>
class List {
public:
    List(T* out, std::uint32_t capacity, std::uint32_t* count) : out_(out), capacity_(capacity), count_(count) {}

    Fault fault() const {
        if (count_ == nullptr) return {ABUT_NULL_ARGUMENT, "count", "is null"};
        return array(out_, capacity_, "out");
    }
    void clear() { *count_ = 0; }
    void add(const T& element) {
        if (*count_ < capacity_) out_[*count_] = element;
        ++*count_;
    }
    /// All elements of a range, each converted.
    template <class Range, class Convert>
    void assign(const Range& range, const Convert& convert) {
        clear();
        for (const auto& element : range) add(convert(element));
    }

private:
    T* out_;
    std::uint32_t capacity_;
    std::uint32_t* count_;
};

/// Runs an entry: reports the first fault of its arguments, or calls `body`, which returns nothing or a code. No
/// exception leaves it.
template <class Body>
abut_code entry(std::initializer_list<Fault> faults, const Body& body) {
    for (const Fault& fault : faults)
        if (fault.code != ABUT_OK) return report(fault);
    const auto run = [&]() -> abut_code {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return ABUT_OK;
        } else {
            return body();
        }
    };
#if defined(__cpp_exceptions)
    try {
        return run();
    } catch (...) {
        // The library throws nothing; the standard library does if an allocation fails.
        return report(Fault{ABUT_OUT_OF_MEMORY, "an allocation", "failed"});
    }
#else
    return run();
#endif
}

/// Frees a handle of any type.
template <class T>
void release(T* handle) {
    if (handle == nullptr || handle->tag != T::own_tag) return;
    handle->tag = {};
    delete handle;
}

}  // namespace abut::detail
