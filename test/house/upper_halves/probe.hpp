#pragma once

// Shapes of a user's whose functions look, each time they are called, whether the upper halves of the vector registers
// are in use, and leave them in use.

#include <abut/abut.hpp>

namespace probe {

/// Calls of the functions below, and those of them that found upper halves in use.
extern int calls, dirty_calls;

/// Puts something into the upper half of a register.
inline void use_upper_halves() {
    asm volatile("vpcmpeqd %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
}

/// The same in a call, after which a compiler takes them for cleared.
void return_with_upper_halves_in_use();
/// As the caller's registers are.
bool upper_halves_in_use();
/// False where the processor doesn't tell, or has no upper halves.
bool can_look();

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
/// Observes by its part, which is a BySupport.
template <class Visit>
void each_part(const ByParts& shape, const abut::Aabb3&, Visit visit) {
    const BySupport part{shape.ball};
    use_upper_halves();
    visit(part, 0u);
    use_upper_halves();
}

}  // namespace probe
