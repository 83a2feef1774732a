#include <abut/math/detail/large_pages.hpp>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace abut::detail {

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    // If the call fails, small pages work as well, but slower.
    [[maybe_unused]] const int failed = madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace abut::detail
