// Compiled without AVX, so that only the caller decides the state of the registers at a call.

#include "probe.hpp"

#include <cmath>

namespace probe {

int failures = 0, calls = 0, dirty_calls = 0;

void return_with_upper_halves_in_use() {
    use_upper_halves();
}

bool upper_halves_in_use() {
    unsigned low = 0, high = 0;
    asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));  // the register state that differs from its initial one
    return (low & 4u) != 0;
}

namespace {

void check() {
    ++calls;
    dirty_calls += upper_halves_in_use() ? 1 : 0;
}

abut::Aabb3 box_of(const abut::Sphere& ball) {
    return {ball.center - abut::Vec3(ball.radius), ball.center + abut::Vec3(ball.radius)};
}

float length(const abut::Vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

}  // namespace

bool can_check() {
    if (!__builtin_cpu_supports("avx2")) return false;
    unsigned a = 13, b = 0, c = 1, d = 0;
    asm volatile("cpuid" : "+a"(a), "=b"(b), "+c"(c), "=d"(d));
    if ((a & 4u) == 0) return false;
    asm volatile("vzeroupper");
    const bool before = upper_halves_in_use();
    use_upper_halves();
    const bool after = upper_halves_in_use();
    return !before && after;
}

abut::Aabb3 bounds(const ByParts& shape) {
    return box_of(shape.ball);
}
abut::Aabb3 bounds(const BySupport& shape) {
    return box_of(shape.ball);
}
abut::Aabb3 bounds(const ByDistance& shape) {
    return box_of(shape.ball);
}

abut::Vec3 support(const BySupport& shape, const abut::Vec3& direction) {
    check();
    const abut::Vec3 result = shape.ball.center + direction * (shape.ball.radius / length(direction));
    use_upper_halves();
    return result;
}

float signed_distance(const ByDistance& shape, const abut::Vec3& point) {
    check();
    const float result = length(point - shape.ball.center) - shape.ball.radius;
    use_upper_halves();
    return result;
}

}  // namespace probe
