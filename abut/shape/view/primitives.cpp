// Views of the primitive shapes: core points with a radius, boxes, discs.

#include <abut/math/detail/set_affine.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D, class... Points>
Convex<D> points_with_ball(float radius, const Points&... points) {
    Convex<D> result;
    result.count = 0;
    ((result.own[result.count++] = points), ...);
    result.radius = static_cast<double>(radius);
    return result;
}

template <int D, class... Points>
Convex<D> round_points_at(const Pose<D>& pose, float radius, const Points&... points) {
    Convex<D> result = points_with_ball<D>(radius, points...);
    set_affine(result.place, pose);
    return result;
}

template <int D>
Convex<D> box_at(const Pose<D>& pose, const Vec<D>& half) {
    Convex<D> result;
    set_affine(result.place, pose);
    result.core = Core::box;
    result.own[0] = half;
    return result;
}

Convex<3> discs(const Vec3& a, const Vec3& b, float radius_a, float radius_b) {
    Convex<3> result;
    result.core = Core::discs;
    result.own = {a, b, Vec3(0)};
    result.disc_radius = {radius_a, radius_b};
    return result;
}

}  // namespace

template <int D>
Convex<D> convex(const Ball<D>& ball) {
    return points_with_ball<D>(ball.radius, ball.center);
}
template <int D>
Convex<D> convex(const Ball<D>& ball, const Pose<D>& pose) {
    return round_points_at<D>(pose, ball.radius, ball.center);
}

template <int D>
Convex<D> convex(const Capsule<D>& capsule) {
    return points_with_ball<D>(capsule.radius, capsule.a, capsule.b);
}
template <int D>
Convex<D> convex(const Capsule<D>& capsule, const Pose<D>& pose) {
    return round_points_at<D>(pose, capsule.radius, capsule.a, capsule.b);
}

template <int D>
Convex<D> convex(const Segment<D>& segment) {
    return points_with_ball<D>(0, segment.a, segment.b);
}
template <int D>
Convex<D> convex(const Segment<D>& segment, const Pose<D>& pose) {
    return round_points_at<D>(pose, 0, segment.a, segment.b);
}

template <int D>
Convex<D> convex(const Triangle<D>& triangle) {
    return points_with_ball<D>(0, triangle.a, triangle.b, triangle.c);
}
template <int D>
Convex<D> convex(const Triangle<D>& triangle, const Pose<D>& pose) {
    return round_points_at<D>(pose, 0, triangle.a, triangle.b, triangle.c);
}

template <int D>
Convex<D> convex(const Box<D>& box) {
    return box_at(Pose<D>{box.center, box.rotation}, box.half);
}
template <int D>
Convex<D> convex(const Box<D>& box, const Pose<D>& pose) {
    Convex<D> result = box_at(pose, box.half);
    if (box.rotation == no_rotation<D>)
        result.place.offset = result.place.point(DVec<D>(box.center));
    else
        result.place = result.place * affine(Pose<D>{box.center, box.rotation});
    return result;
}

template <int D>
Convex<D> convex(const Aabb<D>& box) {
    Convex<D> result;
    result.core = Core::box;
    for (int i = 0; i < D; ++i) {
        const double low = static_cast<double>(box.min[i]), high = static_cast<double>(box.max[i]);
        result.place.offset[i] = 0.5 * (low + high);
        result.own[0][i] = static_cast<float>(0.5 * (high - low));
    }
    return result;
}

Convex<3> convex(const Cylinder& cylinder) {
    return discs(cylinder.a, cylinder.b, cylinder.radius, cylinder.radius);
}
Convex<3> convex(const Cone& cone) {
    return discs(cone.a, cone.b, cone.radius, 0);
}

#define ABUT_INSTANTIATE(D)                                        \
    template Convex<D> convex(const Ball<D>&);                     \
    template Convex<D> convex(const Ball<D>&, const Pose<D>&);     \
    template Convex<D> convex(const Capsule<D>&);                  \
    template Convex<D> convex(const Capsule<D>&, const Pose<D>&);  \
    template Convex<D> convex(const Segment<D>&);                  \
    template Convex<D> convex(const Segment<D>&, const Pose<D>&);  \
    template Convex<D> convex(const Triangle<D>&);                 \
    template Convex<D> convex(const Triangle<D>&, const Pose<D>&); \
    template Convex<D> convex(const Box<D>&);                      \
    template Convex<D> convex(const Box<D>&, const Pose<D>&);      \
    template Convex<D> convex(const Aabb<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
