// A counting operator new, in a file of its own: inlined, the malloc in it causes a compiler warning.
#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::atomic<std::size_t> count = 0, bytes = 0;

std::size_t size_of(void* memory) {
#ifdef _WIN32
    return _msize(memory);
#else
    return malloc_usable_size(memory);
#endif
}

void* counted(void* memory) {
    ++count;
    if (memory != nullptr) bytes += size_of(memory);
    return memory;
}
void release(void* memory) {
    if (memory != nullptr) bytes -= size_of(memory);
    std::free(memory);
}

}  // namespace

std::size_t abut::test::allocations() {
    return count;
}
bool abut::test::counts_allocations() {
    const std::size_t before = count;
    ::operator delete(::operator new(1));
    return count > before;
}
std::size_t abut::test::allocated_bytes() {
    return bytes;
}

void* operator new(std::size_t size) {
    if (void* result = counted(std::malloc(size == 0 ? 1 : size))) return result;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted(std::malloc(size == 0 ? 1 : size));
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
