#include <abut/math/detail/round_outwards.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/view/view.hpp>

#include <cmath>

namespace abut::detail {
namespace {

/// The box of half extents `reach` + `radius` around the middle, rounded outwards.
template <int D>
Aabb<D> box_around(const DVec<D>& middle, const DVec<D>& reach, double radius) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = float_at_most(middle[i] - reach[i] - radius);
        result.max[i] = float_at_least(middle[i] + reach[i] + radius);
    }
    return result;
}

float sum_of(const Turn& turn) {
    return turn.cos + turn.sin;
}
float sum_of(const glm::quat& rotation) {
    return rotation.w + rotation.x + rotation.y + rotation.z;
}

/// Also false if the numbers are so large that their sum is infinite.
template <int D>
bool all_finite(const Vec<D>& a, const Vec<D>& b, const Pose<D>& pose) {
    float sum = sum_of(pose.rotation);
    for (int i = 0; i < D; ++i) sum += a[i] + b[i] + pose.position[i];
    return std::isfinite(sum);
}

template <int D, class S>
[[gnu::noinline]] Aabb<D> bounds_of_view(const S& shape, const Pose<D>& pose) {
    const Convex<D> placed = moved(convex(shape), affine(pose));
    return is_finite(placed) ? bounds(placed) : Aabb<D>::empty();
}

}  // namespace

template <int D>
Aabb<D> bounds_at(const Ball<D>& ball, const Pose<D>& pose) {
    detail::enter_library();
    if (ball.center != Vec<D>(0.0f) || !all_finite(ball.center, Vec<D>(ball.radius), pose))
        return bounds_of_view(ball, pose);
    return box_around(DVec<D>(pose.position), DVec<D>(0.0), static_cast<double>(ball.radius));
}

template <int D>
Aabb<D> bounds_at(const Box<D>& box, const Pose<D>& pose) {
    detail::enter_library();
    if (box.rotation != no_rotation<D> || !all_finite(box.center, box.half, pose)) return bounds_of_view(box, pose);
    Affine<D> place;
    set_affine(place, pose);
    DVec<D> reach(0.0);
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            reach[i] += std::abs(place.column[static_cast<std::size_t>(j)][i]) * static_cast<double>(box.half[j]);
    return box_around(place.point(DVec<D>(box.center)), reach, 0);
}

template Aabb<2> bounds_at(const Ball<2>&, const Pose<2>&);
template Aabb<3> bounds_at(const Ball<3>&, const Pose<3>&);
template Aabb<2> bounds_at(const Box<2>&, const Pose<2>&);
template Aabb<3> bounds_at(const Box<3>&, const Pose<3>&);

}  // namespace abut::detail
