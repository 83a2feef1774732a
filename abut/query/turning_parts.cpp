#include <abut/math/assert.hpp>
#include <abut/query/turning_parts.hpp>

namespace abut {
namespace {

/// A composite's parts are asked for by boxes around so many pieces of the motion, the first first.
constexpr int pieces = 16;

/// A ball around a shape, in the frame that its path moves.
template <int D>
struct Around {
    DVec<D> center{0.0};
    double radius = 0;
};
template <int D>
Around<D> around(const Aabb<D>& box) {
    const DVec<D> low(box.min), high(box.max);
    return {(low + high) * 0.5, 0.5 * length(high - low)};
}

/// Where a moving ball comes to, as the frame of another path sees it. Its center x there, R^T (p + y) with p from that
/// frame's pivot to its own and y from its own pivot, bends by
///
///     |x''| <= w^2 |p| + 2 w |p'| + (v + w)^2 |y|,    w, v the rates of the frame and of the ball's path,
///
/// so between two times h apart it is within |x''| h^2 / 8 of the straight line.
template <int D>
class SeenMoving {
public:
    SeenMoving(const Around<D>& ball, const RigidPath<D>& path, const RigidPath<D>& frame)
        : ball_(ball), path_(path), frame_(frame) {
        const double w = rate_of(frame.spin), both = w + rate_of(path.spin);
        const double farthest =
            std::max(length(path.pivot(0) - frame.pivot(0)), length(path.pivot(1) - frame.pivot(1)));
        bend_ = w * w * farthest + 2 * w * length(path.move - frame.move) + both * both * length(ball.center);
    }

    /// A box around it from one time to another, rounded outwards.
    Aabb<D> box(double from, double to) const {
        const DVec<D> first = center(from), last = center(to);
        const double wide = ball_.radius + bend_ * (to - from) * (to - from) / 8;
        const double rounding = 1e-6 * (wide + std::max(largest(first), largest(last)));
        Aabb<D> result;
        for (int i = 0; i < D; ++i) {
            result.min[i] = static_cast<float>(std::min(first[i], last[i]) - wide - rounding);
            result.max[i] = static_cast<float>(std::max(first[i], last[i]) + wide + rounding);
        }
        return result;
    }

private:
    DVec<D> center(double time) const {
        const Affine<D> frame = place_at(frame_, time);
        return frame.transposed(place_at(path_, time).point(ball_.center) - frame.offset);
    }

    Around<D> ball_;
    RigidPath<D> path_, frame_;
    double bend_;
};

template <int D>
Aabb<D> everywhere() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Vec<D>(-infinity), Vec<D>(infinity)};
}

/// Calls visit(part, index, until) for at least all parts of `composite` that `other` may meet before the time that
/// `visit` returned last.
template <int D, class Other, class Visit>
void each_part_on_the_way(const Composite<D>& composite, const RigidPath<D>& path, const Other& other,
                          const RigidPath<D>& path_of_other, double until, Visit&& visit) {
    const auto look = [&](const Aabb<D>& box, double end) {
        each_part<D>(composite, box, [&](const Convex<D>& part, std::uint32_t index) -> bool {
            until = std::min(until, visit(part, index, std::min(until, end)));
            return true;
        });
    };
    if constexpr (std::is_same_v<Other, Solid<D>>) {
        look(everywhere<D>(), 1);
    } else {
        const Aabb<D> box = bounds(other);
        if (!(box.min[0] <= box.max[0])) return;
        const SeenMoving<D> seen(around(box), path_of_other, path);
        for (int i = 0; i < pieces && static_cast<double>(i) / pieces <= until; ++i) {
            const double from = static_cast<double>(i) / pieces, to = static_cast<double>(i + 1) / pieces;
            look(seen.box(from, to), to);
        }
    }
}

template <int D>
class EarliestMeeting {
public:
    EarliestMeeting(const RigidPath<D>& path_a, const RigidPath<D>& path_b, const SearchOptions<D>& options)
        : path_a_(path_a), path_b_(path_b), options_(options) {}

    template <class PartA, class PartB>
    void look_at(const PartA& a, const PartB& b) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        if constexpr (std::is_same_v<PartA, Solid<D>> && std::is_same_v<PartB, Solid<D>>)
            ABUT_ASSERT(two_half_spaces_pair);
        else if constexpr (std::is_same_v<PartB, Composite<D>>)
            each_part_on_the_way(b, path_b_, a, path_a_, until(),
                                 [&](const Convex<D>& part, std::uint32_t index, double end) {
                                     look_at_part(a, part, index, end);
                                     return until();
                                 });
        else if constexpr (std::is_same_v<PartA, Composite<D>>)
            each_part_on_the_way(a, path_a_, b, path_b_, until(),
                                 [&](const Convex<D>& part, std::uint32_t, double end) {
                                     look_at_pair(part, b, 0, end);
                                     return until();
                                 });
        else
            look_at_pair(a, b, 0, 1);
    }

    bool any = false;
    Meeting<D> first;

private:
    double until() const { return any ? first.time : 1; }

    /// A whole shape A at one part of B.
    template <class PartA>
    void look_at_part(const PartA& a, const Convex<D>& b, std::uint32_t index, double end) {
        if constexpr (std::is_same_v<PartA, Composite<D>>)
            each_part_on_the_way(a, path_a_, b, path_b_, end,
                                 [&](const Convex<D>& part, std::uint32_t, double until_then) {
                                     look_at_pair(part, b, index, until_then);
                                     return until();
                                 });
        else
            look_at_pair(a, b, index, end);
    }

    template <class PartA, class PartB>
    void look_at_pair(const PartA& a, const PartB& b, std::uint32_t index, double end) {
        Meeting<D> found;
        if (!first_meeting<D>(a, path_a_, b, path_b_, {.until = end}, options_, found)) return;
        // The lowest of several at one time, so that it isn't up to the order of the visits.
        if (any && (found.time > first.time || (found.time == first.time && index >= first.feature.part))) return;
        any = true;
        first = found;
        first.feature.part = index;
    }

    const RigidPath<D>&path_a_, &path_b_;
    SearchOptions<D> options_;
};

}  // namespace

template <int D>
bool first_meeting(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
                   const SearchOptions<D>& options, Meeting<D>& meeting) {
    EarliestMeeting<D> earliest(path_a, path_b, options);
    std::visit([&](const auto& part_a, const auto& part_b) { earliest.look_at(part_a, part_b); }, a, b);
    if (earliest.any) meeting = earliest.first;
    return earliest.any;
}

#define ABUT_INSTANTIATE(D)                                                                               \
    template bool first_meeting(const View<D>&, const RigidPath<D>&, const View<D>&, const RigidPath<D>&, \
                                const SearchOptions<D>&, Meeting<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
