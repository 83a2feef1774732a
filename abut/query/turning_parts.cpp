#include <abut/math/assert.hpp>
#include <abut/query/function_motion.hpp>
#include <abut/query/turning_parts.hpp>

#include <optional>
#include <tuple>

namespace abut {
namespace {

/// The motion is cut into so many pieces. In one after the other all parts are searched that are near then, and the
/// earliest meeting of the first piece in which there is any is the earliest of all. Each part is searched by itself,
/// so that no bit of it is up to the order of the parts.
constexpr int pieces = 16;

/// Of the motion, as times.
struct Piece {
    double from = 0, to = 1;
};

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

/// Where a moving ball comes to, as the frame of another path sees it. Between two times h apart its center x is within
/// |x''| h^2 / 8 of the straight line.
template <int D>
class SeenMoving {
public:
    SeenMoving(const Around<D>& ball, const RigidPath<D>& path, const RigidPath<D>& frame)
        : ball_(ball),
          path_(path),
          frame_(frame),
          bend_(relative_motion_bounds(path, frame, length(ball.center)).acceleration) {}

    /// A box around it and a margin, rounded outwards.
    Aabb<D> box(const Piece& piece, double margin) const {
        const DVec<D> first = center(piece.from), last = center(piece.to);
        const double time = piece.to - piece.from, wide = ball_.radius + margin + bend_ * time * time / 8;
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

/// Which parts of a composite come near to another shape.
template <int D, class Other>
class PartsNear {
public:
    PartsNear(const Composite<D>& composite, const RigidPath<D>& path, const Other& other,
              const RigidPath<D>& path_of_other)
        : composite_(composite) {
        if constexpr (!is_solid) {
            const Aabb<D> box = bounds(other);
            is_empty_ = !(box.min[0] <= box.max[0]);
            if (is_empty_ || !(is_finite(box.min) && is_finite(box.max))) return;
            const Around<D> ball = around(box);
            seen_.emplace(ball, path_of_other, path);
            // No less than what two that have met may be apart: half of the margin of doubt.
            margin_ = 1e-5 * ball.radius + 1e-6 * around(bounds(composite)).radius;
        }
    }

    /// Calls visit(part, index) for at least all parts that may meet it in that piece.
    template <class Visit>
    void each(const Piece& piece, Visit&& visit) const {
        if (is_empty_) return;
        each_part<D>(composite_, seen_ ? seen_->box(piece, margin_) : everywhere<D>(),
                     [&](const Convex<D>& part, std::uint32_t index) -> bool {
                         visit(part, index);
                         return true;
                     });
    }

private:
    static constexpr bool is_solid = std::is_same_v<Other, HalfSpaceView<D>>;

    const Composite<D>& composite_;
    bool is_empty_ = false;
    std::optional<SeenMoving<D>> seen_;
    double margin_ = 0;
};

template <int D>
class EarliestMeeting {
public:
    EarliestMeeting(const RigidPath<D>& path_a, const RigidPath<D>& path_b, const SearchOptions<D>& options)
        : path_a_(path_a), path_b_(path_b), options_(options) {}

    template <class PartA, class PartB>
    void look_at(const PartA& a, const PartB& b) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        if constexpr (std::is_same_v<PartA, HalfSpaceView<D>> && std::is_same_v<PartB, HalfSpaceView<D>>) {
            ABUT_ASSERT(two_half_spaces_pair);
        } else if constexpr (std::is_same_v<PartB, Composite<D>>) {
            const PartsNear<D, PartA> near(b, path_b_, a, path_a_);
            each_piece<PartA>([&](const Piece& piece) {
                near.each(piece,
                          [&](const Convex<D>& part, std::uint32_t index) { look_at_part(a, part, index, piece); });
            });
        } else if constexpr (std::is_same_v<PartA, Composite<D>>) {
            const PartsNear<D, PartB> near(a, path_a_, b, path_b_);
            each_piece<PartB>([&](const Piece& piece) {
                near.each(piece,
                          [&](const Convex<D>& part, std::uint32_t index) { look_at_pair(part, index, b, 0, piece); });
            });
        } else {
            look_at_pair(a, 0, b, 0, {});
        }
    }

    bool any = false;
    Meeting<D> first;

private:
    /// What has no end is near to all parts all the time, and a distance function is asked for all of the motion at
    /// once.
    template <class Other, class Visit>
    void each_piece(Visit&& visit) {
        constexpr int count = std::is_same_v<Other, Convex<D>> || std::is_same_v<Other, Composite<D>> ? pieces : 1;
        for (int i = 0; i < count && !any; ++i)
            visit(Piece{static_cast<double>(i) / count, static_cast<double>(i + 1) / count});
    }

    /// A whole shape A at one part of B.
    template <class PartA>
    void look_at_part(const PartA& a, const Convex<D>& b, std::uint32_t index, const Piece& piece) {
        if constexpr (std::is_same_v<PartA, Composite<D>>)
            PartsNear<D, Convex<D>>(a, path_a_, b, path_b_)
                .each(piece, [&](const Convex<D>& part, std::uint32_t index_a) {
                    look_at_pair(part, index_a, b, index, piece);
                });
        else
            look_at_pair(a, 0, b, index, piece);
    }

    template <class PartA, class PartB>
    void look_at_pair(const PartA& a, std::uint32_t index_a, const PartB& b, std::uint32_t index_b,
                      const Piece& piece) {
        Meeting<D> found;
        const TurningLimits limits{.from = piece.from, .until = piece.to, .reach = any ? first.time : piece.to};
        if (!first_meeting(a, path_a_, b, path_b_, limits, options_, found)) return;
        // The lowest of several at one time, so that it isn't up to the order of the visits.
        if (any && std::tuple(found.time, index_b, index_a) >= std::tuple(first.time, first.feature.part, index_a_))
            return;
        any = true;
        first = found;
        first.feature.part = index_b;
        index_a_ = index_a;
    }

    const RigidPath<D>&path_a_, &path_b_;
    SearchOptions<D> options_;
    std::uint32_t index_a_ = 0;  ///< of the part of A that meets first
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
