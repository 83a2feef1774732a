#include <abut/convex/bounding_ball.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/shape/view/mapped_box.hpp>

#include <optional>
#include <tuple>

namespace abut::detail {
namespace {

/// The motion is split into this many spans. One after the other, all parts near during a span are searched; the
/// earliest impact of the first span that has any is the earliest of all. Each part is searched by itself, so that the
/// order of the parts has no influence.
constexpr int time_spans = 16;

/// A moving ball in the frame of another path. Between two times h apart its centre x is within |x''| h^2 / 8 of the
/// chord.
template <int D>
class MovingBall {
public:
    MovingBall(const BoundingBall<D>& ball, const RigidPath<D>& path, const RigidPath<D>& frame)
        : ball_(ball),
          path_(path),
          frame_(frame),
          acceleration_(relative_motion_bounds(path, frame, length(ball.center)).acceleration) {}

    /// The swept AABB of the ball and a margin, rounded outwards.
    Aabb<D> box(const TimeSpan& span, double margin) const {
        const DVec<D> first = center(span.from), last = center(span.to);
        const double time = span.to - span.from, radius = ball_.radius + margin + acceleration_ * time * time / 8;
        const double outwards = 1e-6 * (radius + std::max(largest(first), largest(last)));
        Aabb<D> result;
        for (int i = 0; i < D; ++i) {
            result.min[i] = static_cast<float>(std::min(first[i], last[i]) - radius - outwards);
            result.max[i] = static_cast<float>(std::max(first[i], last[i]) + radius + outwards);
        }
        return result;
    }

private:
    DVec<D> center(double time) const {
        const Affine<D> frame = place_at(frame_, time);
        return frame.transposed(place_at(path_, time).point(ball_.center) - frame.offset);
    }

    BoundingBall<D> ball_;
    RigidPath<D> path_, frame_;
    double acceleration_;
};

/// The parts of a composite shape near another moving shape, by its local box.
template <int D>
class PartsNear {
public:
    PartsNear(const Composite<D>& composite, const RigidPath<D>& path, const Aabb<D>& box_of_other,
              const RigidPath<D>& path_of_other)
        : composite_(composite), is_empty_(!(box_of_other.min[0] <= box_of_other.max[0])) {
        if (is_empty_ || !(is_finite(box_of_other.min) && is_finite(box_of_other.max))) return;
        const BoundingBall<D> ball = ball_around(box_of_other);
        moving_.emplace(ball, path_of_other, path);
        // At least the largest gap at an impact: half of the tolerance.
        margin_ = 1e-5 * ball.radius + 1e-6 * ball_around(bounds(composite)).radius;
    }

    /// Calls visit(part, index) for at least all parts that may be hit in this span.
    template <class Visit>
    void each(const TimeSpan& span, Visit&& visit) const {
        if (is_empty_) return;
        each_part<D>(composite_, moving_ ? moving_->box(span, margin_) : everywhere<D>(),
                     [&](const Convex<D>& part, std::uint32_t index) -> bool {
                         visit(part, index);
                         return true;
                     });
    }

private:
    const Composite<D>& composite_;
    bool is_empty_;
    std::optional<MovingBall<D>> moving_;
    double margin_ = 0;
};

template <int D>
class EarliestImpact {
public:
    EarliestImpact(const RigidPath<D>& path_a, const RigidPath<D>& path_b, const SearchOptions<D>& options)
        : path_a_(path_a), path_b_(path_b), options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        detail::with_part(
            b, [&](const Part<D>& part_b) { search_from(a, part_b); },
            [&](const Composite<D>& composite_b) {
                const PartsNear<D> near(composite_b, path_b_, bounds(a), path_a_);
                each_span(std::holds_alternative<Convex<D>>(a) || std::holds_alternative<Composite<D>>(a),
                          [&](const TimeSpan& span) {
                              near.each(span, [&](const Part<D>& part_b, std::uint32_t index_b) {
                                  search_part(a, part_b, index_b, span);
                              });
                          });
            });
    }

    bool any = false;
    RotatingImpact<D> first;

private:
    /// An infinite shape is near all parts all the time, and a distance function is searched over the whole motion at
    /// once.
    template <class Visit>
    void each_span(bool other_is_convex, Visit&& visit) {
        const int count = other_is_convex ? time_spans : 1;
        for (int i = 0; i < count && !any; ++i)
            visit(TimeSpan{static_cast<double>(i) / count, static_cast<double>(i + 1) / count});
    }

    /// Searches a whole shape A against a shape B that is one part.
    void search_from(const View<D>& a, const Part<D>& part_b) {
        detail::with_part(
            a, [&](const Part<D>& part_a) { test_pair(part_a, 0, part_b, 0, {}); },
            [&](const Composite<D>& composite_a) {
                const PartsNear<D> near(composite_a, path_a_, bounds(part_b), path_b_);
                each_span(part_b.is_convex(), [&](const TimeSpan& span) {
                    near.each(span, [&](const Part<D>& part_a, std::uint32_t index_a) {
                        test_pair(part_a, index_a, part_b, 0, span);
                    });
                });
            });
    }

    /// Searches a whole shape A against one part of a composite shape B, during a span.
    void search_part(const View<D>& a, const Part<D>& part_b, std::uint32_t index_b, const TimeSpan& span) {
        detail::with_part(
            a, [&](const Part<D>& part_a) { test_pair(part_a, 0, part_b, index_b, span); },
            [&](const Composite<D>& composite_a) {
                const PartsNear<D> near(composite_a, path_a_, bounds(part_b), path_b_);
                near.each(span, [&](const Part<D>& part_a, std::uint32_t index_a) {
                    test_pair(part_a, index_a, part_b, index_b, span);
                });
            });
    }

    void test_pair(const Part<D>& a, std::uint32_t index_a, const Part<D>& b, std::uint32_t index_b,
                   const TimeSpan& span) {
        RotatingImpact<D> found;
        const RotatingSweepLimits limits{.from = span.from, .until = span.to, .reach = any ? first.time : span.to};
        if (a.is_function() || b.is_function() ? !function_time_of_impact(a, path_a_, b, path_b_, limits, found)
                                               : !time_of_impact(a, path_a_, b, path_b_, limits, options_, found))
            return;
        // Of several parts hit at one time the lowest wins, whatever the order of the visits.
        if (any && std::tuple(found.time, index_b, index_a) >= std::tuple(first.time, first.feature.part, index_a_))
            return;
        any = true;
        first = found;
        first.feature.part = index_b;
        index_a_ = index_a;
    }

    const RigidPath<D>&path_a_, &path_b_;
    SearchOptions<D> options_;
    std::uint32_t index_a_ = 0;  ///< of the part of A that hits first
};

}  // namespace

template <int D>
bool time_of_impact(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
                    const SearchOptions<D>& options, RotatingImpact<D>& impact) {
    EarliestImpact<D> earliest(path_a, path_b, options);
    earliest.search(a, b);
    if (earliest.any) impact = earliest.first;
    return earliest.any;
}

#define ABUT_INSTANTIATE(D)                                                                                \
    template bool time_of_impact(const View<D>&, const RigidPath<D>&, const View<D>&, const RigidPath<D>&, \
                                 const SearchOptions<D>&, RotatingImpact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
