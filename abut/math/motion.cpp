#include <abut/math/detail/rigid_path.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>

#include <glm/ext/quaternion_double.hpp>

namespace abut::detail {

namespace {

/// The angle of the shortest rotation from `from` to `to`.
double rotation_between(const Turn& from, const Turn& to) {
    const DVec<2> a = unit(from), b = unit(to);
    return angle_of(dot(a, b), cross(a, b));
}

/// The rotation vector of the quaternion q = to * conjugate(from), which is (cos(angle / 2), axis sin(angle / 2)) up to
/// the sign.
DVec<3> rotation_between(const glm::quat& from, const glm::quat& to) {
    const glm::dquat a(from), b(to);
    const double w = b.w * a.w + b.x * a.x + b.y * a.y + b.z * a.z;
    const DVec<3> v(b.x * a.w - b.w * a.x + b.z * a.y - b.y * a.z, b.y * a.w - b.w * a.y + b.x * a.z - b.z * a.x,
                    b.z * a.w - b.w * a.z + b.y * a.x - b.x * a.y);
    const double norm = length(v);
    if (!(norm > 0)) return DVec<3>(0.0);
    return v * ((w < 0 ? -2 : 2) * angle_of(std::abs(w), norm) / norm);
}

template <int D>
RigidPath<D> path_from(const Pose<D>& from, const DVec<D>& move, const AngularVelocity<D>& angular_velocity) {
    RigidPath<D> result;
    set_affine(result.start, from);
    result.move = move;
    result.angular_velocity = angular_velocity;
    return result;
}

}  // namespace

RigidPath<2> rigid_path(const Motion2& motion) {
    return path_from<2>(motion.from, DVec<2>(motion.move), static_cast<double>(motion.turn));
}
RigidPath<3> rigid_path(const Motion3& motion) {
    return path_from<3>(motion.from, DVec<3>(motion.move), DVec<3>(motion.turn));
}

RigidPath<2> rigid_path(const Pose2& from, const Pose2& to) {
    return path_from<2>(from, DVec<2>(to.position) - DVec<2>(from.position),
                        rotation_between(from.rotation, to.rotation));
}
RigidPath<3> rigid_path(const Pose3& from, const Pose3& to) {
    return path_from<3>(from, DVec<3>(to.position) - DVec<3>(from.position),
                        rotation_between(from.rotation, to.rotation));
}

template <int D>
Affine<D> place_at(const RigidPath<D>& path, double time) {
    const RotationAxis<D> axis(path.angular_velocity);
    const SinCos turned = sin_cos(axis.rate * time);
    Affine<D> result;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i)
        result.column[i] = axis.of(path.start.column[i]).at(turned);
    result.offset = path.pivot(time);
    return result;
}
template Affine<2> place_at(const RigidPath<2>&, double);
template Affine<3> place_at(const RigidPath<3>&, double);

}  // namespace abut::detail

namespace abut {

using namespace detail;

template <int D>
Motion<D> Motion<D>::between(const Pose<D>& from, const Pose<D>& to) {
    detail::enter_library();
    return {from, to.position - from.position, Angle<D>(rotation_between(from.rotation, to.rotation))};
}
template struct Motion<2>;
template struct Motion<3>;

Pose2 pose_at(const Motion2& motion, float fraction) {
    detail::enter_library();
    const RigidPath<2> path = rigid_path(motion);
    const double time = static_cast<double>(fraction);
    const DVec<2> x = place_at(path, time).column[0];
    return {to_float(path.pivot(time)), Turn{static_cast<float>(x.x), static_cast<float>(x.y)}};
}

Pose3 pose_at(const Motion3& motion, float fraction) {
    detail::enter_library();
    const RigidPath<3> path = rigid_path(motion);
    const double time = static_cast<double>(fraction), rate = length(path.angular_velocity);
    const SinCos half = sin_cos(0.5 * rate * time);
    const DVec<3> v = rate > 0 ? path.angular_velocity * (half.sin / rate) : DVec<3>(0.0);
    const glm::dquat q(motion.from.rotation);
    // (cos, v) * q, normalised.
    glm::dquat turned(
        half.cos * q.w - (v.x * q.x + v.y * q.y + v.z * q.z), half.cos * q.x + v.x * q.w + (v.y * q.z - v.z * q.y),
        half.cos * q.y + v.y * q.w + (v.z * q.x - v.x * q.z), half.cos * q.z + v.z * q.w + (v.x * q.y - v.y * q.x));
    const double norm =
        square_root(turned.w * turned.w + turned.x * turned.x + turned.y * turned.y + turned.z * turned.z);
    if (norm > 0) turned = {turned.w / norm, turned.x / norm, turned.y / norm, turned.z / norm};
    return {to_float(path.pivot(time)), glm::quat(turned)};
}

}  // namespace abut
