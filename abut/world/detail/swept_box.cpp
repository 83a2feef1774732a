#include <abut/broad_phase/reach.hpp>
#include <abut/world/detail/swept_box.hpp>

namespace abut::detail {
namespace {

float radians(float rotation) {
    return std::abs(rotation);
}
float radians(const Vec3& rotation) {
    return static_cast<float>(length(DVec<3>(rotation)));
}

template <int D>
double largest_side(const Aabb<D>& box) {
    double result = 0;
    for (int i = 0; i < D; ++i)
        result = std::max(result, static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]));
    return result;
}

template <int D>
bool has_bounds(const Aabb<D>& box) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && std::isfinite(box.min[i]) && std::isfinite(box.max[i]);
    return result;
}

/// Grows a box by more than the tolerance of a sweep's time of impact. The part that is proportional to the larger
/// shape is in that shape's box already (see box_for_queries in world.cpp).
template <int D>
Aabb<D> with_tolerance(const Aabb<D>& box) {
    if (is_empty(box) || !has_bounds(box)) return box;
    float farthest = 0;
    for (int i = 0; i < D; ++i) farthest = std::max({farthest, std::abs(box.min[i]), std::abs(box.max[i])});
    return grown(box, 2e-5f * static_cast<float>(largest_side(box)) + 2e-7f * farthest);
}

template <int D>
Aabb<D> box_around(const DVec<D>& center, double radius) {
    const Aabb<D> point{to_float(center), to_float(center)};
    return grown(point, static_cast<float>(radius));
}

template <int D>
Aabb<D> common(const Aabb<D>& a, const Aabb<D>& b) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = std::max(a.min[i], b.min[i]);
        result.max[i] = std::min(a.max[i], b.max[i]);
    }
    return result;
}

}  // namespace

template <int D>
SweptBox<D> swept_box(const Aabb<D>& box, const Vec<D>& move) {
    return {with_tolerance(box), move};
}

/// The intersection of three boxes, each of which contains the shape at every rotation. No point moves farther than the
/// angle times its distance from the pivot, which bounds the shape around its first box and around its ball. The third
/// box contains the ball around the pivot that no rotation leaves.
template <int D>
SweptBox<D> swept_box(const BoundingBall<D>& ball, const Aabb<D>& box, const Motion<D>& motion) {
    const double angle = static_cast<double>(radians(motion.turn));
    if (angle == 0 || is_empty(box)) return swept_box(box, motion.move);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (!std::isfinite(ball.radius) || !std::isfinite(angle))
        return {{Vec<D>(-infinity), Vec<D>(infinity)}, motion.move};
    const Affine<D> first = affine(motion.from);
    const double offset = length(ball.center), reach = offset + ball.radius;
    Aabb<D> rotated = common(box_around(first.offset, reach),
                             box_around(first.point(ball.center), ball.radius + std::min(angle, 2.0) * offset));
    if (angle < 2) rotated = common(rotated, grown(box, static_cast<float>(angle * reach)));
    return {with_tolerance(merged(rotated, box)), motion.move};
}

template <int D>
Aabb<D> bounds(const SweptBox<D>& path) {
    if (is_empty(path.box)) return path.box;
    Aabb<D> moved;
    for (int i = 0; i < D; ++i) {
        moved.min[i] = next_down(path.box.min[i] + path.move[i]);
        moved.max[i] = next_up(path.box.max[i] + path.move[i]);
    }
    return merged(path.box, moved);
}

template <int D>
MovingBox<D> moving_box(const SweptBox<D>& path, const Vec<D>& move_of_other) {
    const DVec<D> low(path.box.min), high(path.box.max);
    return {(low + high) * 0.5, (high - low) * 0.5, DVec<D>(path.move) - DVec<D>(move_of_other), 1};
}

template <int D>
bool may_overlap(const SweptBox<D>& a, const SweptBox<D>& b) {
    if (is_empty(a.box) || is_empty(b.box)) return false;
    if (!has_bounds(a.box)) return has_bounds(b.box) ? may_overlap(b, a) : true;
    double enters = 0;
    const RayReach<D> reach = RayReach<D>::of_box(moving_box(a, b.move));
    return reach.is_exhausted() || reach.measure(b.box, enters);
}

#define ABUT_INSTANTIATE(D)                                                                   \
    template SweptBox<D> swept_box(const Aabb<D>&, const Vec<D>&);                            \
    template SweptBox<D> swept_box(const BoundingBall<D>&, const Aabb<D>&, const Motion<D>&); \
    template Aabb<D> bounds(const SweptBox<D>&);                                              \
    template MovingBox<D> moving_box(const SweptBox<D>&, const Vec<D>&);                      \
    template bool may_overlap(const SweptBox<D>&, const SweptBox<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
