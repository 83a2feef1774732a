#include <abut/convex/point_soa.hpp>
#include <abut/convex/ray/ball.hpp>
#include <abut/convex/ray/portal.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/detail/sweep/tolerances.hpp>

namespace abut::detail {
namespace {

/// A motion of at most this slope relative to a surface slides: rounding explains it.
constexpr double slide_slope = 1e-6;

/// A direction of at least this slope relative to a thin part's plane lies on one side of it.
constexpr double through_slope = 1e-7;

/// The gap between the two bounds of an impact, as a fraction of the tolerance of touching. At a cylinder as wide as
/// high, the normal is then right to 4e-4, and to 3e-3 with a gap twelve times as wide.
constexpr double bound_gap_fraction = 0.02;

/// The limit on iterations for the deepest point of a sliding motion; each halves the interval at least.
constexpr int max_iterations = 32;

/// Some point of a part, as the origin of coordinates.
template <int D>
DVec<D> some_point(const Convex<D>& part) {
    return part.core == Core::points ? part.place.point(DVec<D>(part.vertices()[0])) : reference_point(part);
}

/// Sets `part` to `from` translated by `by`.
template <int D>
void set_translated(const Convex<D>& from, const DVec<D>& by, Convex<D>& part) {
    part.place.offset = from.place.offset + by;
}
template <int D>
void set_translated(const HalfSpaceView<D>& from, const DVec<D>& by, HalfSpaceView<D>& part) {
    part.offset = from.offset + dot(from.normal, by);
}

/// The largest dot(normal, p) over the part; for a half-space along its own normal.
template <int D>
double extent(const Convex<D>& part, const DVec<D>& normal) {
    return dot(normal, core_support(part, normal).position) + part.radius;
}
template <int D>
double extent(const HalfSpaceView<D>& part, const DVec<D>&) {
    return part.offset;
}

/// A lower bound of the bounding radius, and not much less.
template <int D>
double min_size(const Convex<D>& part) {
    if (part.similar && part.inner_radius == 0) {
        if (part.core == Core::box) return part.radius + part.scale * length(DVec<D>(part.own[0]));
        if (part.core == Core::points) {
            // Half of the longest side of their bounding box, or of the largest distance from the first point.
            double longest = 0;
            if (part.lanes != nullptr) {
                for (int i = 0; i < 3; ++i) {
                    const double reach = static_cast<double>(part.lanes->reach[i]);
                    const double beside = std::abs(static_cast<double>(part.lanes->middle[i]));
                    longest = std::max(longest, reach - beside - 2.4e-7 * reach);
                }
            } else {
                const DVec<D> first(part.vertices()[0]);
                for (std::uint32_t i = 1; i < part.count; ++i)
                    longest = std::max(longest, length_squared(DVec<D>(part.vertices()[i]) - first));
                longest = 0.5 * square_root(longest);
            }
            return part.radius + part.scale * longest;
        }
    }
    // `size` is at most this factor above the radius of the least ball around the core.
    return part.radius + (size(part) - part.radius) / square_root(static_cast<double>(D));
}
template <int D>
PartExtent part_extent(const Convex<D>& part) {
    const double size_bound = min_size(part);
    return {size_bound, part.core == Core::function ? 6e-7 * size_bound : 0};
}
template <int D>
PartExtent part_extent(const HalfSpaceView<D>&) {
    return {std::numeric_limits<double>::infinity(), 0};
}

template <int D, class A, class B>
class LinearSweep {
public:
    LinearSweep(const A& a, const Path<D>& path, const B& b, const SweepOptions<D>& options)
        : a_(a), b_(b), path_(path), options_(options) {
        const PartExtent extent_a = part_extent(a), extent_b = part_extent(b);
        DVec<D> between(0.0);
        if constexpr (std::is_same_v<A, HalfSpaceView<D>>) {
            origin_ = some_point(b);
        } else {
            origin_ = some_point(a);
            if constexpr (std::is_same_v<B, Convex<D>>) between = some_point(b) - origin_;
        }
        // Beyond this length nothing can be hit: the other part lies behind.
        path_.length = std::min(path_.length, length(between) + 8 * (extent_a.size + extent_b.size));
        tolerances_ = SweepTolerances(extent_a, extent_b, path_.length);
        set_translated(a, -origin_, a_);
        set_translated(b, -origin_, b_);
    }

    bool run(std::uint32_t index, LinearImpact<D>& impact) {
        if constexpr (std::is_same_v<A, Convex<D>> && std::is_same_v<B, Convex<D>>)
            if (options_.trace == nullptr) {
                const FastAnswer answer = moves_as_ray(a_, b_)   ? round_at_part(impact)
                                          : moves_as_ray(b_, a_) ? part_at_round(impact)
                                                                 : sharp_parts(impact);
                impact.feature.part = index;
                if (answer != FastAnswer::undecided) return answer == FastAnswer::touches;
            }
        return search(index, impact);
    }

private:
    // Fast paths. Parts that touch at the start, or may slide, are left to conservative advancement.

    enum class FastAnswer : std::uint8_t { undecided, misses, touches };

    static bool is_of_points(const Convex<D>& part, std::uint32_t min_count, std::uint32_t max_count) {
        return part.core == Core::points && part.count >= min_count && part.count <= max_count &&
               part.inner_radius == 0;
    }
    static bool is_ball(const Convex<D>& part) { return is_of_points(part, 1, 1) && part.radius > 0; }
    static DVec<D> corner(const Convex<D>& part, std::uint32_t i) {
        return part.place.point(DVec<D>(part.vertices()[i]));
    }

    /// Whether the impact of the first part is that of a ray with a set: a ball at all parts, in space a segment at a
    /// segment or triangle, if one of them is round.
    static bool moves_as_ray(const Convex<D>& moving, const Convex<D>& other) {
        if (is_ball(moving)) return true;
        return D == 3 && !is_ball(other) && is_of_points(moving, 2, 2) && is_of_points(other, 2, 3) &&
               moving.radius + other.radius > 0;
    }

    /// Whether two parts that approach this fast certainly penetrate: around each point of the difference of the cores
    /// the Minkowski difference contains a ball, and a line goes this deep into the ball.
    bool enters_balls(double closing) const {
        return 0.5 * closing * closing * (a_.radius + b_.radius) > tolerances_.slide;
    }

    /// The impact of a moving part on another at rest.
    struct RoundImpact {
        RayEntry<D> entry;
        DVec<D> out{0.0};     ///< the normal out of the other part
        DVec<D> center{0.0};  ///< the center of the moving part's ball that touches, at the start
        double part = 0;      ///< of its segment, from -1 to 1
    };

    /// A ball is a ray of its center against the other part grown by its radius, a capsule a ray of its middle against
    /// the sum of the other part and the segment.
    FastAnswer find_round(const Convex<D>& moving, const Convex<D>& other, const DVec<D>& direction,
                          RoundImpact& round) const {
        round.center = corner(moving, 0);
        DVec<D> half(0.0);
        if (moving.count == 2) {
            half = (corner(moving, 1) - round.center) * 0.5;
            round.center += half;
        }
        const DRay<D> beam{round.center, direction, path_.length + tolerances_.touch};
        round.entry = round_entry(moving, other, beam, half, round.part);
        if (round.entry.answer == RayAnswer::undecided) return FastAnswer::undecided;
        if (round.entry.answer == RayAnswer::misses) return FastAnswer::misses;
        round.center += half * round.part;
        round.out = normalized(round.entry.normal);
        const double closing = -dot(direction, round.out);
        return round.entry.along * closing > tolerances_.touch && enters_balls(closing) ? FastAnswer::touches
                                                                                        : FastAnswer::undecided;
    }
    static RayEntry<D> round_entry(const Convex<D>& moving, const Convex<D>& other, const DRay<D>& beam,
                                   [[maybe_unused]] const DVec<D>& half, [[maybe_unused]] double& part) {
        const double radius = moving.radius + other.radius;
        if (is_ball(other)) return enter_ball(beam, corner(other, 0) - beam.origin, radius);
        if constexpr (D == 3) {
            if (moving.count == 2) {
                std::array<DVec<3>, 3> corners;
                for (std::uint32_t i = 0; i < other.count; ++i) corners[i] = corner(other, i) - beam.origin;
                return enter_rounded_sum(beam, corners, other.count, half, radius, part);
            }
        }
        return ray_entry(other, beam, moving.radius);
    }
    void set_along(const RoundImpact& round, LinearImpact<D>& impact) const {
        impact.along = std::min(round.entry.along, path_.length);
        impact.started_inside = false;
    }
    FastAnswer round_at_part(LinearImpact<D>& impact) const {
        RoundImpact round;
        const FastAnswer answer = find_round(a_, b_, path_.direction, round);
        if (answer != FastAnswer::touches) return answer;
        set_along(round, impact);
        impact.normal = -round.out;
        impact.point = origin_ + round.center + path_.direction * impact.along + impact.normal * a_.radius;
        impact.feature.kind = round.entry.kind;
        impact.feature.index = round.entry.index;
        return answer;
    }
    FastAnswer part_at_round(LinearImpact<D>& impact) const {
        RoundImpact round;
        const FastAnswer answer = find_round(b_, a_, -path_.direction, round);
        if (answer != FastAnswer::touches) return answer;
        set_along(round, impact);
        impact.normal = round.out;
        impact.point = origin_ + round.center - round.out * b_.radius;
        const bool at_end = b_.count == 1 || std::abs(round.part) > 1 - 1e-9;
        impact.feature.kind = at_end ? FeatureKind::vertex : FeatureKind::edge;
        impact.feature.index = !at_end ? edge_index(0, 1) : round.part > 0 ? 1 : 0;
        return answer;
    }

    /// Whether the Minkowski difference has no ball around it, and its support points are exact.
    static bool is_sharp(const Convex<D>& part) {
        return part.core != Core::function && part.radius == 0 && part.inner_radius == 0;
    }
    FastAnswer sharp_parts(LinearImpact<D>& impact) const {
        if (!is_sharp(a_) || !is_sharp(b_)) return FastAnswer::undecided;
        const PortalHit<D> hit = enter_difference(
            a_, b_, path_.direction,
            PortalTolerances{bound_gap_fraction * tolerances_.touch, beyond_sliding * tolerances_.slide});
        if (hit.answer == RayAnswer::undecided) return FastAnswer::undecided;
        if (hit.answer == RayAnswer::misses) return FastAnswer::misses;
        const double closing = dot(path_.direction, hit.normal);
        if (!(hit.along * closing > tolerances_.touch))
            return b_is_behind() ? FastAnswer::misses : FastAnswer::undecided;
        if ((hit.along - path_.length) * closing > tolerances_.touch) return FastAnswer::misses;
        // They almost touch at the end, where the closest points are not yet those of the impact.
        if (hit.along - path_.length > tolerances_.touch) return FastAnswer::undecided;
        impact.along = std::min(hit.along, path_.length);
        impact.normal = hit.normal;
        impact.started_inside = false;
        impact.point = origin_ + path_.direction * impact.along;
        CornerIndices<D> corners{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < D; ++i) {
            impact.point += hit.corners[i].on_a * hit.weights[i];
            if (hit.weights[i] > 1e-9) corners[count++] = hit.corners[i].index_b;
        }
        name_feature(b_, corners, count, -hit.normal, 0, impact.feature);
        return FastAnswer::touches;
    }
    /// Whether all of B lies behind all of A.
    bool b_is_behind() const { return extent(a_, -path_.direction) + extent(b_, path_.direction) < -tolerances_.touch; }

    bool search(std::uint32_t index, LinearImpact<D>& impact) {
        Moment now = moment_at(0);
        const bool starts_in_contact = now.distance.distance <= tolerances_.touch;
        if (starts_in_contact ? !deepens_from_start(now) : !advance(now)) return false;
        impact.along = now.along;
        impact.normal = now.distance.normal;
        impact.point = origin_ + now.distance.on_a;
        impact.started_inside = starts_in_contact && now.distance.distance < -tolerances_.total;
        const ClosestCorners<D>& corners = now.distance.corners;
        name_feature(b_, corners.b, corners.count, -now.distance.normal, index, impact.feature);
        return true;
    }

    /// The state when A has moved this far.
    struct Moment {
        double along = 0;
        SignedDistance<D> distance;
        double closing = 0;  ///< the rate at which the distance falls
    };

    Moment moment_at(double along) {
        Moment result;
        result.along = along;
        A moved = a_;
        set_translated(a_, path_.direction * along, moved);
        result.distance = part_distance(moved, b_, SearchOptions<D>{cache_, nullptr});
        result.closing = dot(path_.direction, result.distance.normal);
        return result;
    }

    /// The gap between the two planes across the normal, a lower bound of the distance.
    double gap_lower_bound(const Moment& now) const {
        const DVec<D>& normal = now.distance.normal;
        if constexpr (std::is_same_v<A, HalfSpaceView<D>> || std::is_same_v<B, HalfSpaceView<D>>)
            return now.distance.distance;
        else
            return -extent(b_, -normal) - extent(a_, normal) - now.along * now.closing -
                   1e-15 * (largest(a_.place.offset) + largest(b_.place.offset) + now.along);
    }

    /// Conservative advancement to the first touch. Returns false if there is none on the path.
    bool advance(Moment& now) {
        for (int step = 1;; ++step) {
            record(now);
            if (!(now.closing > 0)) return false;
            const double gap = gap_lower_bound(now), along = now.along + std::max(gap, 0.0) / now.closing;
            if ((along - path_.length) * now.closing > tolerances_.touch) return false;
            // Without a proof it can't go on, and stays where it has passed nothing.
            if (step >= options_.max_iterations || !(along > now.along)) return true;
            const Moment before = now;
            now = moment_at(std::min(along, path_.length));
            if (now.distance.distance > tolerances_.touch) continue;
            record(now);
            if (!may_enter_certainly(now.closing) && slides_after(now, before.distance.normal)) return false;
            // An edge has several normals, and the one found may lie across the motion. The last separating plane gives
            // another one.
            if (now.closing < 0.5 * before.closing) now.distance.normal = before.distance.normal;
            return true;
        }
    }

    /// Whether parts that touch or overlap at the start go further in.
    bool deepens_from_start(const Moment& start) {
        record(start);
        if (start.distance.distance < -tolerances_.slide) {
            if (start.closing > slide_slope) return true;
            // A slower motion counts if it leads from within the tolerance, or a few times that, to beyond it.
            if (!(start.closing > 0) || start.distance.distance < -4 * tolerances_.total) return false;
            const double margin_left = std::max(start.distance.distance + tolerances_.total, 0.02 * tolerances_.total);
            return deepens_beyond(start, moment_at(tolerances_.stride),
                                  {-start.distance.distance + 0.5 * margin_left, 0.5 * margin_left});
        }
        return start.closing > 0 && deepens_beyond(start, moment_at(tolerances_.stride), sliding());
    }

    bool may_enter_certainly([[maybe_unused]] double closing) const {
        if constexpr (std::is_same_v<A, Convex<D>> && std::is_same_v<B, Convex<D>>)
            return closing > 0 && enters_balls(closing);
        return false;
    }

    /// Whether two touching parts stay in touch and never deeper than the tolerance: along a face, or from seam to seam
    /// of a composite shape. A part without an interior can be passed without any depth; then the motion comes from one
    /// side of the plane of sliding (`came` was the normal) and leaves by the other.
    bool slides_after(const Moment& impact, const DVec<D>& came) {
        const Moment ahead = moment_at(impact.along + tolerances_.stride);
        if (ahead.distance.distance > tolerances_.slide || deepens_beyond(impact, ahead, sliding())) return false;
        const Moment last = moment_at(path_.length);
        if (last.distance.distance <= tolerances_.slide) return true;
        const double before = dot(came, ahead.distance.normal),
                     after = dot(last.distance.normal, ahead.distance.normal);
        return std::min(std::abs(before), std::abs(after)) < through_slope || before * after > 0;
    }

    /// Beyond `depth` the parts certainly penetrate; within `tolerance` beyond it the exact depth doesn't matter.
    struct DepthLimit {
        double depth, tolerance;
    };
    DepthLimit sliding() const { return {tolerances_.slide, tolerances_.slide}; }

    /// Whether the parts go deeper than the limit after `here`, where they touch, searching on from `ahead`. A tangent
    /// of a convex function is nowhere above the function, so if no tangent is deep, no depth is.
    bool deepens_beyond(const Moment& here, Moment ahead, const DepthLimit& limit) {
        Moment before = here;
        const double end = std::max(path_.length, ahead.along);
        for (int iteration = 0; iteration < max_iterations; ++iteration) {
            if (ahead.distance.distance < -limit.depth) return true;
            if (!(ahead.closing > 0)) return dips_beyond(before, ahead, limit);
            const double along =
                ahead.along + (ahead.distance.distance + limit.depth + limit.tolerance) / ahead.closing;
            if (along >= end) return false;
            before = ahead;
            ahead = moment_at(along);
        }
        return true;
    }

    /// The search between a moment at which the distance falls and one at which it no longer does.
    bool dips_beyond(Moment falling, Moment rising, const DepthLimit& limit) {
        for (int iteration = 0; iteration < max_iterations; ++iteration) {
            if (!(falling.closing > 0)) return false;
            const double height = falling.distance.distance - rising.distance.distance;
            const double span = rising.along - falling.along;
            const double along =
                std::clamp((height - rising.closing * span) / (falling.closing - rising.closing), 0.0, span);
            if (falling.distance.distance - along * falling.closing >= -limit.depth - limit.tolerance) return false;
            const Moment between = moment_at(falling.along + along);
            if (between.distance.distance < -limit.depth) return true;
            (between.closing > 0 ? falling : rising) = between;
        }
        return true;
    }

    void record(const Moment& now) {
        if (options_.trace == nullptr) return;
        SweepStep<D> step;
        step.position = to_float(path_.direction * -now.along);
        step.normal = to_float(now.distance.normal);
        step.distance = static_cast<float>(now.distance.distance);
        options_.trace->steps.push_back(step);
    }

    A a_;  ///< at the start
    B b_;
    DVec<D> origin_;  ///< of all coordinates
    Path<D> path_;
    const SweepOptions<D>& options_;
    SweepTolerances tolerances_;
    Cache own_cache_;
    Cache* cache_ = options_.cache != nullptr ? options_.cache : &own_cache_;
};

}  // namespace

template <int D, class A, class B>
bool time_of_impact(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>& options,
                    LinearImpact<D>& impact) {
    return LinearSweep<D, A, B>(a, path, b, options).run(index, impact);
}

#define ABUT_INSTANTIATE(D)                                                                                \
    template bool time_of_impact(const Convex<D>&, const Path<D>&, const Convex<D>&, std::uint32_t,        \
                                 const SweepOptions<D>&, LinearImpact<D>&);                                \
    template bool time_of_impact(const Convex<D>&, const Path<D>&, const HalfSpaceView<D>&, std::uint32_t, \
                                 const SweepOptions<D>&, LinearImpact<D>&);                                \
    template bool time_of_impact(const HalfSpaceView<D>&, const Path<D>&, const Convex<D>&, std::uint32_t, \
                                 const SweepOptions<D>&, LinearImpact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
