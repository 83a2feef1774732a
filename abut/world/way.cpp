#include <abut/broad_phase/reach.hpp>
#include <abut/world/way.hpp>

namespace abut {
namespace {

float radians(float turn) {
    return std::abs(turn);
}
float radians(const Vec3& turn) {
    return static_cast<float>(length(DVec<3>(turn)));
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

/// A sweep may tell a touch where the two are apart by the margin of doubt, which is less than this much of the smaller
/// one; what is in proportion to the larger one is in its box (see World::place).
template <int D>
Aabb<D> with_margin(const Aabb<D>& box) {
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
Way<D> straight_way(const Aabb<D>& box, const Vec<D>& move) {
    return {with_margin(box), move};
}

/// Three boxes hold it, of which the common part is taken: no point goes farther than the angle times its distance from
/// the pivot, so it stays near its first box; for the same reason it stays near its ball; and the ball around the pivot
/// holds it however far it turns.
template <int D>
Way<D> turning_way(const BoundingBall<D>& ball, const Aabb<D>& box, const Motion<D>& motion) {
    const double angle = static_cast<double>(radians(motion.turn));
    if (angle == 0 || is_empty(box)) return straight_way(box, motion.move);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (!std::isfinite(ball.radius) || !std::isfinite(angle))
        return {{Vec<D>(-infinity), Vec<D>(infinity)}, motion.move};
    const Affine<D> first = affine(motion.from);
    const double arm = length(ball.center), reach = arm + ball.radius;
    Aabb<D> held = common(box_around(first.offset, reach),
                          box_around(first.point(ball.center), ball.radius + std::min(angle, 2.0) * arm));
    if (angle < 2) held = common(held, grown(box, static_cast<float>(angle * reach)));
    return {with_margin(merged(held, box)), motion.move};
}

template <int D>
Aabb<D> bounds(const Way<D>& way) {
    if (is_empty(way.box)) return way.box;
    Aabb<D> moved;
    for (int i = 0; i < D; ++i) {
        moved.min[i] = next_down(way.box.min[i] + way.move[i]);
        moved.max[i] = next_up(way.box.max[i] + way.move[i]);
    }
    return merged(way.box, moved);
}

template <int D>
MovingBox<D> moving_box(const Way<D>& way, const Vec<D>& move_of_other) {
    const DVec<D> low(way.box.min), high(way.box.max);
    return {(low + high) * 0.5, (high - low) * 0.5, DVec<D>(way.move) - DVec<D>(move_of_other), 1};
}

template <int D>
bool may_meet(const Way<D>& a, const Way<D>& b) {
    if (is_empty(a.box) || is_empty(b.box)) return false;
    if (!has_bounds(a.box)) return has_bounds(b.box) ? may_meet(b, a) : true;
    double enters = 0;
    const RayReach<D> reach = RayReach<D>::of_box(moving_box(a, b.move));
    return reach.is_exhausted() || reach.measure(b.box, enters);
}

#define ABUT_INSTANTIATE(D)                                                                \
    template Way<D> straight_way(const Aabb<D>&, const Vec<D>&);                           \
    template Way<D> turning_way(const BoundingBall<D>&, const Aabb<D>&, const Motion<D>&); \
    template Aabb<D> bounds(const Way<D>&);                                                \
    template MovingBox<D> moving_box(const Way<D>&, const Vec<D>&);                        \
    template bool may_meet(const Way<D>&, const Way<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
