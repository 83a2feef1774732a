#include <abut/math/detail/set_affine.hpp>
#include <abut/math/simd/lanes-inl.h>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/view/view.hpp>

#include <bit>
#include <cmath>

namespace abut::detail {
namespace {

constexpr double query_margin = 1e-6;

/// The box from `low` to `high` with a ball around it, rounded outwards.
template <int D>
[[gnu::always_inline]] inline Aabb<D> rounded_box(const DVec<D>& low, const DVec<D>& high, double radius, bool grow) {
    double size = 0;
    for (int i = 0; i < D; ++i) size += high[i] - low[i] + 2 * radius;
    const double margin = grow ? query_margin * size : 0;
    const auto down = [&](int i) { return -(low[i] - radius - margin); };
    const auto up = [&](int i) { return high[i] + radius + margin; };
    using lanes::Double2;
    if constexpr (D == 2) {
        const lanes::Floats4 sides = lanes::floats_at_least(Double2(down(0), down(1)), Double2(up(0), up(1)));
        return std::bit_cast<Aabb<D>>(lanes::flipped_by(sides, {-0.0f, -0.0f, 0.0f, 0.0f}));
    } else {
        const lanes::Floats4 sides = lanes::floats_at_least(Double2(down(0), down(1)), Double2(down(2), up(0)));
        const lanes::Floats4 last = lanes::floats_at_least(Double2(up(1), up(2)), Double2(0.0));
        return {{-sides[0], -sides[1], -sides[2]}, {sides[3], last[0], last[1]}};
    }
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
[[gnu::noinline]] Aabb<D> bounds_of_view(const S& shape, const Pose<D>& pose, bool grow) {
    return bounds_at(View<D>(moved(convex(shape), affine(pose))), grow);
}

}  // namespace

template <int D>
Aabb<D> bounds_at(const View<D>& placed, bool grow) {
    if (!is_finite(placed)) return Aabb<D>::empty();
    const Aabb<D> box = bounds(placed);
    double size = 0;
    for (int i = 0; i < D; ++i) size += static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
    // Not if it is empty or unbounded.
    return grow && size > 0 && std::isfinite(size) ? grown(box, static_cast<float>(query_margin * size)) : box;
}

template <int D>
Aabb<D> bounds_at(const Ball<D>& ball, const Pose<D>& pose, bool grow) {
    detail::enter_library();
    if (ball.center != Vec<D>(0.0f) || !all_finite(ball.center, Vec<D>(ball.radius), pose))
        return bounds_of_view(ball, pose, grow);
    const DVec<D> center(pose.position);
    return rounded_box(center, center, static_cast<double>(ball.radius), grow);
}

template <int D>
Aabb<D> bounds_at(const Box<D>& box, const Pose<D>& pose, bool grow) {
    detail::enter_library();
    if (box.rotation != no_rotation<D> || !all_finite(box.center, box.half, pose))
        return bounds_of_view(box, pose, grow);
    Affine<D> place;
    set_affine(place, pose);
    DVec<D> reach(0.0);
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            reach[i] += std::abs(place.column[static_cast<std::size_t>(j)][i]) * static_cast<double>(box.half[j]);
    const DVec<D> center = place.point(DVec<D>(box.center));
    return rounded_box(center - reach, center + reach, 0, grow);
}

template <int D>
Aabb<D> bounds_at(const Capsule<D>& capsule, const Pose<D>& pose, bool grow) {
    detail::enter_library();
    if (!all_finite(capsule.a, capsule.b, pose) || !std::isfinite(capsule.radius))
        return bounds_of_view(capsule, pose, grow);
    Affine<D> place;
    set_affine(place, pose);
    const DVec<D> a = place.point(DVec<D>(capsule.a)), b = place.point(DVec<D>(capsule.b));
    DVec<D> low, high;
    for (int i = 0; i < D; ++i) {
        low[i] = std::min(a[i], b[i]);
        high[i] = std::max(a[i], b[i]);
    }
    return rounded_box(low, high, static_cast<double>(capsule.radius), grow);
}

#define ABUT_INSTANTIATE(D)                                              \
    template Aabb<D> bounds_at(const Ball<D>&, const Pose<D>&, bool);    \
    template Aabb<D> bounds_at(const Box<D>&, const Pose<D>&, bool);     \
    template Aabb<D> bounds_at(const Capsule<D>&, const Pose<D>&, bool); \
    template Aabb<D> bounds_at(const View<D>&, bool);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
