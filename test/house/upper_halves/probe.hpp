#pragma once

// User-defined shapes whose functions check at each call whether the upper halves of the vector registers are in use,
// and leave them in use.

#include <abut/abut.hpp>

#include <cstdio>

namespace probe {

/// The number of doors that failed.
extern int failures;

/// The number of calls of the functions below, and of those that found upper halves in use.
extern int calls, dirty_calls;

/// Writes to the upper half of a register.
inline void use_upper_halves() {
    asm volatile("vpcmpeqd %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
}

/// Writes to it in a call, after which a compiler assumes that the upper halves are clear.
void return_with_upper_halves_in_use();
/// Inherits the state of the caller's registers.
bool upper_halves_in_use();
/// False if the processor doesn't report the state, or has no upper halves.
bool can_check();

/// For public functions that call no user function: the library, which uses no upper halves, leaves them as they were
/// after the entry.
template <class F>
void expect_cleared_after(const char* door, const F& call) {
    return_with_upper_halves_in_use();
    call();
    if (!upper_halves_in_use()) return;
    ++failures;
    std::printf("%s: upper halves in use after the call\n", door);
}

/// Calls the public functions that are compiled in the library, from a caller compiled without AVX.
void call_compiled_functions();

/// A ball.
struct ByParts {
    abut::Sphere ball;
};
struct BySupport {
    abut::Sphere ball;
};
struct ByDistance {
    abut::Sphere ball;
};

abut::Aabb3 bounds(const ByParts& shape);
abut::Aabb3 bounds(const BySupport& shape);
abut::Aabb3 bounds(const ByDistance& shape);
abut::Vec3 support(const BySupport& shape, const abut::Vec3& direction);
float signed_distance(const ByDistance& shape, const abut::Vec3& point);
/// Checks in each_part, whose part is a BySupport.
template <class Visit>
void each_part(const ByParts& shape, const abut::Aabb3&, Visit visit) {
    const BySupport part{shape.ball};
    use_upper_halves();
    visit(part, 0u);
    use_upper_halves();
}

}  // namespace probe
