#pragma once

// An array on the stack without initial values. For .cpp files.

#include <cstddef>
#include <new>
#include <type_traits>

namespace abut::detail {

/// Elements are written before they are read. Constructing all elements would cost more than a query that needs few.
template <class T, std::size_t N>
class UninitializedArray {
public:
    static_assert(std::is_trivially_copyable_v<T>);

    T* data() { return std::launder(reinterpret_cast<T*>(storage_)); }
    const T* data() const { return std::launder(reinterpret_cast<const T*>(storage_)); }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& operator[](std::size_t i) const { return data()[i]; }
    static constexpr std::size_t size() { return N; }

private:
    alignas(T) std::byte storage_[N * sizeof(T)];
};

}  // namespace abut::detail
