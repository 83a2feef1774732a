#include <abut/math/detail/next_float.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/world/detail/bounding_ball.hpp>

#include <cmath>

namespace abut::detail {
namespace {

/// The relative margin of the radius, many times the rounding errors in double.
constexpr double radius_margin = 1e-4;
/// 16 ulp of float: the allowed disagreement between a user's bounds, supports and parts.
constexpr double user_margin = 2e-6;

template <int D>
BoundingBall<D> around(const Aabb<D>& box) {
    BoundingBall<D> result = ball_around(box);
    result.radius += user_margin * std::max(largest(DVec<D>(box.min)), largest(DVec<D>(box.max)));
    return result;
}

template <int D>
BoundingBall<D> around_discs(const Convex<D>& convex) {
    const DVec<D> a(convex.own[0]), b(convex.own[1]);
    const double widest = static_cast<double>(std::max(convex.disc_radius[0], convex.disc_radius[1]));
    return {(a + b) * 0.5, square_root(0.25 * length_squared(b - a) + widest * widest)};
}

/// The ball of a convex core, in its own frame.
template <int D>
BoundingBall<D> core_ball(const Convex<D>& convex) {
    switch (convex.core) {
        case Core::points:
            return ball_around<D>({convex.vertices(), convex.count});
        case Core::box:
            return {DVec<D>(0.0), length(DVec<D>(convex.own[0]))};
        case Core::discs:
            return around_discs(convex);
        case Core::function:
            break;
    }
    Convex<D> core = convex;
    static_cast<Placement<D>&>(core) = {};
    return around(bounds(core));
}
template <int D>
BoundingBall<D> core_ball(const Composite<D>& composite) {
    return around(composite.bounds);
}
template <int D>
BoundingBall<D> core_ball(const DistanceFunction<D>& function) {
    return around(function.bounds);
}

/// An upper bound of |M v| / |v|: |M v|^2 = v . M^T M v, and no eigenvalue of M^T M exceeds its largest row sum of
/// absolute values.
template <int D>
double max_stretch(const Affine<D>& map) {
    double max_sum = 0;
    for (const DVec<D>& row : map.column) {
        double sum = 0;
        for (const DVec<D>& column : map.column) sum += std::abs(dot(row, column));
        max_sum = std::max(max_sum, sum);
    }
    return square_root(max_sum);
}

template <int D, class Shape>
BoundingBall<D> placed_ball(const Shape& shape) {
    const Placement<D>& placement = shape;
    const BoundingBall<D> core = core_ball(shape);
    const double stretch = max_stretch(placement.place);
    const double radius = (core.radius + placement.inner_radius) * stretch + placement.radius;
    const double reach = largest(core.center) * stretch + largest(placement.place.offset);
    return {placement.place.point(core.center), radius * (1 + radius_margin) + reach * position_margin};
}

}  // namespace

template <int D>
BoundingBall<D> bounding_ball(const View<D>& view) {
    const BoundingBall<D> everywhere{DVec<D>(0.0), std::numeric_limits<double>::infinity()};
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
            if constexpr (std::is_same_v<Shape, HalfSpaceView<D>>) {
                return everywhere;
            } else {
                const BoundingBall<D> ball = placed_ball<D>(shape);
                return std::is_same_v<Shape, DistanceFunction<D>> && !std::isfinite(ball.radius) ? everywhere : ball;
            }
        },
        view);
}

/// The radius grows by the rounding error of the centre, and is rounded up.
template <int D>
SmallBall<D> SmallBall<D>::around(const BoundingBall<D>& ball) {
    SmallBall<D> result{to_float(ball.center), 0};
    const double reach = ball.radius + length(ball.center - DVec<D>(result.center));
    if (std::isfinite(static_cast<float>(reach)))
        result.radius = next_up(static_cast<float>(reach));
    else
        result = {Vec<D>(0.0f), std::numeric_limits<float>::infinity()};
    return result;
}

#define ABUT_INSTANTIATE(D)                                 \
    template BoundingBall<D> bounding_ball(const View<D>&); \
    template struct SmallBall<D>;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
