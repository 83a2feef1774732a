#include <abut/convex/ray/ball.hpp>
#include <abut/convex/ray/portal.hpp>
#include <abut/query/sweep_doubts.hpp>
#include <abut/query/sweep_part.hpp>

namespace abut {
namespace {

/// What slides goes in so slowly, if at all, that rounding explains it.
constexpr double slide_slope = 1e-6;

/// What is on one side of a thin part's plane is seen from it by more than this.
constexpr double through_slope = 1e-7;

/// The bound on looking for where what slides is deepest; each look halves what is left, or does better.
constexpr int most_looks = 32;

/// Some point of a part, so that it can be seen from there.
template <int D>
DVec<D> some_point(const Convex<D>& part) {
    return part.core == Core::points ? part.place.point(DVec<D>(part.vertices()[0])) : reference_point(part);
}

/// Moves what is at `from` by `by`.
template <int D>
void put(const Convex<D>& from, const DVec<D>& by, Convex<D>& part) {
    part.place.offset = from.place.offset + by;
}
template <int D>
void put(const HalfSpaceView<D>& from, const DVec<D>& by, HalfSpaceView<D>& part) {
    part.offset = from.offset + dot(from.normal, by);
}

/// The largest dot(normal, p) over the part; of a half-space along its own normal.
template <int D>
double extent(const Convex<D>& part, const DVec<D>& normal) {
    return dot(normal, core_support(part, normal).position) + part.radius;
}
template <int D>
double extent(const HalfSpaceView<D>& part, const DVec<D>&) {
    return part.offset;
}

/// No more than the bounding radius, and not much less.
template <int D>
double least_size(const Convex<D>& part) {
    if (part.similar && part.inner_radius == 0) {
        if (part.core == Core::box) return part.radius + part.scale * length(DVec<D>(part.own[0]));
        if (part.core == Core::points) {
            // Half of the longest side of a box around them, or of the way from one to the farthest.
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
                longest = 0.5 * std::sqrt(longest);
            }
            return part.radius + part.scale * longest;
        }
    }
    // `size` is up to so many times the radius of the least ball around the core.
    return part.radius + (size(part) - part.radius) / std::sqrt(static_cast<double>(D));
}
template <int D>
Reach reach_of(const Convex<D>& part) {
    const double least = least_size(part);
    return {least, part.core == Core::function ? 6e-7 * least : 0};
}
template <int D>
Reach reach_of(const HalfSpaceView<D>&) {
    return {std::numeric_limits<double>::infinity(), 0};
}

template <int D, class A, class B>
class Approach {
public:
    Approach(const A& a, const Path<D>& path, const B& b, const SweepOptions<D>& options)
        : a_(a), b_(b), path_(path), options_(options) {
        const Reach reach_a = reach_of(a), reach_b = reach_of(b);
        DVec<D> between(0.0);
        if constexpr (std::is_same_v<A, HalfSpaceView<D>>) {
            origin_ = some_point(b);
        } else {
            origin_ = some_point(a);
            if constexpr (std::is_same_v<B, Convex<D>>) between = some_point(b) - origin_;
        }
        // Behind the other there is nothing to come to.
        path_.length = std::min(path_.length, length(between) + 8 * (reach_a.size + reach_b.size));
        doubts_ = Doubts(reach_a, reach_b, path_.length);
        put(a, -origin_, a_);
        put(b, -origin_, b_);
    }

    bool run(std::uint32_t index, PartTouch<D>& touch) {
        if constexpr (std::is_same_v<A, Convex<D>> && std::is_same_v<B, Convex<D>>)
            if (options_.trace == nullptr) {
                const Quick quick = is_ball(a_)   ? ball_at_part(touch)
                                    : is_ball(b_) ? part_at_ball(touch)
                                                  : polytopes(touch);
                touch.feature.part = index;
                if (quick != Quick::undecided) return quick == Quick::touches;
            }
        return search(index, touch);
    }

private:
    // The quick ways. What starts in touch, or may slide, is left to the search.

    enum class Quick : std::uint8_t { undecided, misses, touches };

    static bool is_ball(const Convex<D>& part) {
        return part.core == Core::points && part.count == 1 && part.inner_radius == 0 && part.radius > 0;
    }
    static DVec<D> center_of(const Convex<D>& ball) { return ball.place.point(DVec<D>(ball.vertices()[0])); }

    /// Whether two that come together so fast get in for sure: around each point of the difference of the cores there
    /// is a ball in the difference, and this is how deep a line comes into that.
    bool enters_balls(double closing) const {
        return 0.5 * closing * closing * (a_.radius + b_.radius) > doubts_.slide;
    }

    static Convex<D> grown(const Convex<D>& part, double radius) {
        Convex<D> result = part;
        result.radius += radius;
        return result;
    }

    /// A ball is the ray of its center at the other part, grown by its radius. `out` is turned to where the ray comes
    /// from; `from` is the center.
    Quick ray(const Convex<D>& ball, const Convex<D>& other, const DVec<D>& direction, PartTouch<D>& touch,
              DVec<D>& out) {
        const DRay<D> beam{center_of(ball), direction, path_.length + doubts_.touch};
        const RayEntry<D> entry = is_ball(other)
                                      ? enter_ball(beam, center_of(other) - beam.origin, other.radius + ball.radius)
                                      : ray_entry(grown(other, ball.radius), beam);
        if (entry.answer == RayAnswer::undecided) return Quick::undecided;
        if (entry.answer == RayAnswer::misses) return Quick::misses;
        out = normalized(entry.normal);
        const double closing = -dot(direction, out);
        if (!(entry.along * closing > doubts_.touch && enters_balls(closing))) return Quick::undecided;
        touch.along = std::min(entry.along, path_.length);
        touch.started_inside = false;
        touch.feature.kind = entry.kind;
        touch.feature.index = entry.index;
        return Quick::touches;
    }
    Quick ball_at_part(PartTouch<D>& touch) {
        DVec<D> out;
        const Quick quick = ray(a_, b_, path_.direction, touch, out);
        if (quick != Quick::touches) return quick;
        touch.normal = -out;
        touch.point = origin_ + center_of(a_) + path_.direction * touch.along + touch.normal * a_.radius;
        return quick;
    }
    Quick part_at_ball(PartTouch<D>& touch) {
        DVec<D> out;
        const Quick quick = ray(b_, a_, -path_.direction, touch, out);
        if (quick != Quick::touches) return quick;
        touch.normal = out;
        touch.point = origin_ + center_of(b_) - out * b_.radius;
        touch.feature.kind = FeatureKind::vertex;
        touch.feature.index = 0;
        return quick;
    }

    static bool is_polytope(const Convex<D>& part) {
        return (part.core == Core::points || part.core == Core::box) && part.radius == 0 && part.inner_radius == 0;
    }
    Quick polytopes(PartTouch<D>& touch) {
        if (!is_polytope(a_) || !is_polytope(b_)) return Quick::undecided;
        const PortalHit<D> hit = enter_difference(
            a_, b_, path_.direction, PortalTolerances{0.25 * doubts_.touch, beyond_sliding * doubts_.slide});
        if (hit.answer == PortalAnswer::undecided) return Quick::undecided;
        if (hit.answer == PortalAnswer::misses) return Quick::misses;
        const double closing = dot(path_.direction, hit.normal);
        if (!(hit.along * closing > doubts_.touch)) return is_behind() ? Quick::misses : Quick::undecided;
        if ((hit.along - path_.length) * closing > doubts_.touch) return Quick::misses;
        // All but there at the end, they are nearest elsewhere than where they would touch.
        if (hit.along - path_.length > doubts_.touch) return Quick::undecided;
        touch.along = std::min(hit.along, path_.length);
        touch.normal = hit.normal;
        touch.started_inside = false;
        touch.point = origin_ + path_.direction * touch.along;
        CornerIndices<D> corners{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < D; ++i) {
            touch.point += hit.corners[i].on_a * hit.weights[i];
            if (hit.weights[i] > 1e-9) corners[count++] = hit.corners[i].index_b;
        }
        name_feature(b_, corners, count, -hit.normal, 0, touch.feature);
        return Quick::touches;
    }
    /// Whether all of B lies behind all of A.
    bool is_behind() const { return extent(a_, -path_.direction) + extent(b_, path_.direction) < -doubts_.touch; }

    bool search(std::uint32_t index, PartTouch<D>& touch) {
        moving_ = a_;
        Moment now = moment_at(0);
        const bool starts_there = now.distance.distance <= doubts_.touch;
        if (starts_there ? !begins_to_go_in(now) : !approach(now)) return false;
        touch.along = now.along;
        touch.normal = now.distance.normal;
        touch.point = origin_ + now.distance.on_a;
        touch.started_inside = starts_there && now.distance.distance < -doubts_.margin;
        const ClosestCorners<D>& corners = now.distance.corners;
        name_feature(b_, corners.b, corners.count, -now.distance.normal, index, touch.feature);
        return true;
    }

    /// The two as they are when A has come so far.
    struct Moment {
        double along = 0;
        SignedDistance<D> distance;
        double closing = 0;  ///< how fast the distance falls
    };

    Moment moment_at(double along) {
        Moment result;
        result.along = along;
        put(a_, path_.direction * along, moving_);
        result.distance = part_distance(moving_, b_, SearchOptions<D>{cache_, nullptr});
        result.closing = dot(path_.direction, result.distance.normal);
        return result;
    }

    /// How far the plane across the normal parts them; the distance of their points is no less.
    double proven_gap(const Moment& now) const {
        const DVec<D>& normal = now.distance.normal;
        if constexpr (std::is_same_v<A, HalfSpaceView<D>> || std::is_same_v<B, HalfSpaceView<D>>)
            return now.distance.distance;
        else
            return -extent(b_, -normal) - extent(a_, normal) - now.along * now.closing -
                   1e-15 * (largest(a_.place.offset) + largest(b_.place.offset) + now.along);
    }

    /// Advances to the first touch. False where there is none on the path.
    bool approach(Moment& now) {
        for (int step = 1;; ++step) {
            tell(now);
            if (!(now.closing > 0)) return false;
            const double gap = proven_gap(now), along = now.along + std::max(gap, 0.0) / now.closing;
            if ((along - path_.length) * now.closing > doubts_.touch) return false;
            // Without a proof there is no way on but to stay where nothing was passed.
            if (step >= options_.most_steps || !(along > now.along)) return true;
            const Moment before = now;
            now = moment_at(std::min(along, path_.length));
            if (now.distance.distance > doubts_.touch) continue;
            tell(now);
            if (!may_be_sure(now.closing) && slides_from(now, before.distance.normal)) return false;
            // At an edge there are several normals, and the one found may lie across the motion; the plane that was
            // come to is another.
            if (now.closing < 0.5 * before.closing) now.distance.normal = before.distance.normal;
            return true;
        }
    }

    /// Whether what touches or overlaps at the start goes further in.
    bool begins_to_go_in(const Moment& start) {
        tell(start);
        if (start.distance.distance < -doubts_.slide) {
            if (start.closing > slide_slope) return true;
            // What is slower matters where it leads from within the margin, which may be some times as much, to beyond
            // it.
            if (!(start.closing > 0) || start.distance.distance < -4 * doubts_.margin) return false;
            const double room = std::max(start.distance.distance + doubts_.margin, 0.02 * doubts_.margin);
            return goes_in(start, moment_at(doubts_.stride), {-start.distance.distance + 0.5 * room, 0.5 * room});
        }
        return start.closing > 0 && goes_in(start, moment_at(doubts_.stride), sliding());
    }

    bool may_be_sure([[maybe_unused]] double closing) const {
        if constexpr (std::is_same_v<A, Convex<D>> && std::is_same_v<B, Convex<D>>)
            return closing > 0 && enters_balls(closing);
        return false;
    }

    /// Whether two that have come to touch go on in touch, and never deeper than doubt allows: along a face, or from
    /// seam to seam of what is made of parts. What has no inside is gone through without ever being deep in: of the
    /// plane along which they seem to slide, it comes from one side (`came` was the normal) and goes to the other.
    bool slides_from(const Moment& touch, const DVec<D>& came) {
        const Moment ahead = moment_at(touch.along + doubts_.stride);
        if (ahead.distance.distance > doubts_.slide || goes_in(touch, ahead, sliding())) return false;
        const Moment last = moment_at(path_.length);
        if (last.distance.distance <= doubts_.slide) return true;
        const double before = dot(came, ahead.distance.normal),
                     after = dot(last.distance.normal, ahead.distance.normal);
        return std::min(std::abs(before), std::abs(after)) < through_slope || before * after > 0;
    }

    /// Deeper than `deep` is sure to be in; what stays less than `slack` beyond it needn't be looked at.
    struct Depth {
        double deep, slack;
    };
    Depth sliding() const { return {doubts_.slide, doubts_.slide}; }

    /// Whether they get so deep in, from `here` on, where they touch, by way of `ahead`. A tangent of a convex function
    /// is nowhere above it, so where tangents aren't deep, nothing is.
    bool goes_in(const Moment& here, Moment ahead, const Depth& depth) {
        Moment before = here;
        const double end = std::max(path_.length, ahead.along);
        for (int look = 0; look < most_looks; ++look) {
            if (ahead.distance.distance < -depth.deep) return true;
            if (!(ahead.closing > 0)) return dips(before, ahead, depth);
            const double along = ahead.along + (ahead.distance.distance + depth.deep + depth.slack) / ahead.closing;
            if (along >= end) return false;
            before = ahead;
            ahead = moment_at(along);
        }
        return true;
    }

    /// The same between a moment at which the distance falls, and one at which it does no longer.
    bool dips(Moment falling, Moment rising, const Depth& depth) {
        for (int look = 0; look < most_looks; ++look) {
            if (!(falling.closing > 0)) return false;
            const double height = falling.distance.distance - rising.distance.distance;
            const double way = rising.along - falling.along;
            const double along =
                std::clamp((height - rising.closing * way) / (falling.closing - rising.closing), 0.0, way);
            if (falling.distance.distance - along * falling.closing >= -depth.deep - depth.slack) return false;
            const Moment between = moment_at(falling.along + along);
            if (between.distance.distance < -depth.deep) return true;
            (between.closing > 0 ? falling : rising) = between;
        }
        return true;
    }

    void tell(const Moment& now) {
        if (options_.trace == nullptr) return;
        SweepStep<D> step;
        step.position = to_float(path_.direction * -now.along);
        step.normal = to_float(now.distance.normal);
        step.distance = static_cast<float>(now.distance.distance);
        options_.trace->steps.push_back(step);
    }

    A a_, moving_;  ///< as it begins, and as it is
    B b_;
    DVec<D> origin_;  ///< from which all is seen
    Path<D> path_;
    const SweepOptions<D>& options_;
    Doubts doubts_;
    Cache own_cache_;
    Cache* cache_ = options_.cache != nullptr ? options_.cache : &own_cache_;
};

}  // namespace

template <int D, class A, class B>
bool part_touch(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>& options,
                PartTouch<D>& touch) {
    return Approach<D, A, B>(a, path, b, options).run(index, touch);
}

#define ABUT_INSTANTIATE(D)                                                                            \
    template bool part_touch(const Convex<D>&, const Path<D>&, const Convex<D>&, std::uint32_t,        \
                             const SweepOptions<D>&, PartTouch<D>&);                                   \
    template bool part_touch(const Convex<D>&, const Path<D>&, const HalfSpaceView<D>&, std::uint32_t, \
                             const SweepOptions<D>&, PartTouch<D>&);                                   \
    template bool part_touch(const HalfSpaceView<D>&, const Path<D>&, const Convex<D>&, std::uint32_t, \
                             const SweepOptions<D>&, PartTouch<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
