#pragma once

// A mutex also for standard libraries without threads, such as that of WASI.

#include <cstddef>  // any header of the standard library defines its configuration

#if (defined(_LIBCPP_HAS_THREADS) && !_LIBCPP_HAS_THREADS) || defined(_LIBCPP_HAS_NO_THREADS)
#define ABUT_HAS_THREADS 0
#else
#define ABUT_HAS_THREADS 1
#include <mutex>
#endif

namespace abut::detail {

#if ABUT_HAS_THREADS
using Mutex = std::mutex;
using Lock = std::lock_guard<Mutex>;
#else
struct Mutex {};
struct Lock {
    explicit Lock(Mutex&) {}
};
#endif

}  // namespace abut::detail
