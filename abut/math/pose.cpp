#include <abut/math/affine.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>

#include <glm/ext/quaternion_double.hpp>

namespace abut::detail {

Affine<2> affine(const Pose2& pose) {
    Affine<2> result;
    set_affine(result, pose);
    return result;
}

Affine<3> affine(const Pose3& pose) {
    Affine<3> result;
    set_affine(result, pose);
    return result;
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

glm::dquat unit(const glm::quat& q) {
    const glm::dquat d(q);
    const double norm = square_root(d.w * d.w + d.x * d.x + d.y * d.y + d.z * d.z);
    if (norm == 0) return {1, 0, 0, 0};
    return {d.w / norm, d.x / norm, d.y / norm, d.z / norm};
}

glm::dquat multiply(const glm::dquat& a, const glm::dquat& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

}  // namespace

Turn Turn::by(float radians) {
    detail::enter_library();
    const SinCos s = sin_cos(radians);
    return {static_cast<float>(s.cos), static_cast<float>(s.sin)};
}

glm::quat turn_about(const Vec3& axis, float radians) {
    detail::enter_library();
    const SinCos s = sin_cos(0.5 * static_cast<double>(radians));
    const DVec<3> v = normalized(DVec<3>(axis), DVec<3>(0.0)) * s.sin;
    return glm::quat(glm::dquat(s.cos, v.x, v.y, v.z));
}

Vec2 rotate(const Turn& rotation, const Vec2& v) {
    detail::enter_library();
    return Pose2{Vec2(0), rotation} * v;
}
Vec3 rotate(const glm::quat& rotation, const Vec3& v) {
    detail::enter_library();
    return Pose3{Vec3(0), rotation} * v;
}

Vec2 operator*(const Pose2& pose, const Vec2& point) {
    detail::enter_library();
    return to_float(affine(pose).point(DVec<2>(point)));
}
Vec3 operator*(const Pose3& pose, const Vec3& point) {
    detail::enter_library();
    return to_float(affine(pose).point(DVec<3>(point)));
}

Pose2 operator*(const Pose2& outer, const Pose2& inner) {
    detail::enter_library();
    const DVec<2> a = unit(outer.rotation), b = unit(inner.rotation);
    const Turn turn{static_cast<float>(a.x * b.x - a.y * b.y), static_cast<float>(a.y * b.x + a.x * b.y)};
    return {outer * inner.position, turn};
}

Pose3 operator*(const Pose3& outer, const Pose3& inner) {
    detail::enter_library();
    return {outer * inner.position, glm::quat(multiply(unit(outer.rotation), unit(inner.rotation)))};
}

Pose2 inverse(const Pose2& pose) {
    detail::enter_library();
    const DVec<2> u = unit(pose.rotation);
    const Affine<2> map = affine(pose);
    return {to_float(-map.transposed(map.offset)), Turn{static_cast<float>(u.x), static_cast<float>(-u.y)}};
}

Pose3 inverse(const Pose3& pose) {
    detail::enter_library();
    const glm::dquat q = unit(pose.rotation);
    const Affine<3> map = affine(pose);
    return {to_float(-map.transposed(map.offset)), glm::quat(glm::dquat(q.w, -q.x, -q.y, -q.z))};
}

}  // namespace abut
