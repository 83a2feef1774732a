#pragma once

// An allocator for large arrays: it requests large pages from the system. With random access to small pages a TLB miss
// costs as much as the memory access, and the first access to each of many small pages costs more than to few large
// ones.

#include <cstddef>
#include <new>

namespace abut::detail {

inline constexpr std::size_t large_page = std::size_t{1} << 21;

/// Smaller arrays have small pages: the TLB covers them, and large pages would be cleared for nothing but their
/// beginning.
inline constexpr std::size_t min_large_array = 4 * large_page;

/// Requests that the system back the memory, aligned to `large_page`, by large pages. Only a hint.
void prefer_large_pages(void* memory, std::size_t bytes);

template <class T>
struct LargePages {
    using value_type = T;

    LargePages() = default;
    template <class U>
    LargePages(const LargePages<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        void* memory = ::operator new(bytes, alignment(count));
        if (is_large(count)) prefer_large_pages(memory, bytes);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count)); }

    friend bool operator==(const LargePages&, const LargePages&) { return true; }

private:
    /// The remainder at the end has small pages.
    static bool is_large(std::size_t count) { return count * sizeof(T) >= min_large_array; }
    static std::align_val_t alignment(std::size_t count) {
        return std::align_val_t{is_large(count) ? large_page : alignof(T)};
    }
};

}  // namespace abut::detail
