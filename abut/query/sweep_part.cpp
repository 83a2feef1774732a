#include <abut/query/sweep_part.hpp>

namespace abut {
namespace {

/// What part of the margin of doubt may be lost where they are said to touch, and how deep in what slides may be.
constexpr double touch_part = 1.0 / 16, slide_part = 0.45;

/// How far ahead is looked to tell sliding from going in, in parts of the size of the smaller part.
constexpr double stride_part = 0.05;

/// What slides goes in so slowly, if at all, that rounding explains it.
constexpr double slide_slope = 1e-6;

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
void put(const Solid<D>& from, const DVec<D>& by, Solid<D>& part) {
    part.offset = from.offset + dot(from.normal, by);
}

/// The largest dot(normal, p) over the part; of a half-space along its own normal.
template <int D>
double extent(const Convex<D>& part, const DVec<D>& normal) {
    return dot(normal, core_support(part, normal).position) + part.radius;
}
template <int D>
double extent(const Solid<D>& part, const DVec<D>&) {
    return part.offset;
}

/// What a part brings to the doubts about a pair.
struct Reach {
    double size;
    double noise;  ///< by how much its support may be short of the farthest
};
template <int D>
Reach reach_of(const Convex<D>& part) {
    const double whole = size(part);
    return {whole, part.core == Core::function ? 3e-7 * whole : 0};
}
template <int D>
Reach reach_of(const Solid<D>&) {
    return {std::numeric_limits<double>::infinity(), 0};
}

/// What may be rounding, of a pair as it is where the two touch.
struct Doubts {
    double margin = 0, touch = 0, slide = 0, stride = 0;

    Doubts() = default;
    Doubts(const Reach& a, const Reach& b, double length) {
        const double smaller = std::min(a.size, b.size);
        const double larger = std::isfinite(a.size) && std::isfinite(b.size) ? std::max(a.size, b.size) : smaller;
        // 16 units in the last place of a float are 9e-7 of it at least; some coordinate is half as large as the size.
        margin = 1e-5 * smaller + 4.5e-7 * larger;
        touch = touch_part * margin + a.noise + b.noise + 1e-15 * length;
        slide = slide_part * margin;
        stride = std::max(stride_part * smaller, 16 * (slide + touch));
    }
};

template <int D, class A, class B>
class Approach {
public:
    Approach(const A& a, const Path<D>& path, const B& b, const SweepOptions<D>& options)
        : a_(a), b_(b), path_(path), options_(options) {
        const Reach reach_a = reach_of(a), reach_b = reach_of(b);
        DVec<D> between(0.0);
        if constexpr (std::is_same_v<A, Solid<D>>) {
            origin_ = some_point(b);
        } else {
            origin_ = some_point(a);
            if constexpr (std::is_same_v<B, Convex<D>>) between = some_point(b) - origin_;
        }
        // Behind the other there is nothing to come to.
        path_.length = std::min(path_.length, length(between) + 2 * (reach_a.size + reach_b.size));
        doubts_ = Doubts(reach_a, reach_b, path_.length);
        put(a, -origin_, a_);
        put(b, -origin_, b_);
        moving_ = a_;
    }

    bool run(std::uint32_t index, PartTouch<D>& touch) {
        Moment now = moment_at(0);
        const bool starts_there = now.distance.distance <= doubts_.touch;
        if (starts_there ? !begins_to_go_in(now) : !approach(now)) return false;
        touch.along = now.along;
        touch.normal = now.distance.normal;
        touch.point = origin_ + now.distance.on_a;
        touch.started_inside = starts_there && now.distance.distance < -doubts_.margin;
        const MeetingCorners<D>& corners = now.distance.corners;
        name_feature(b_, corners.b, corners.count, -now.distance.normal, index, touch.feature);
        return true;
    }

private:
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
        if constexpr (std::is_same_v<A, Solid<D>> || std::is_same_v<B, Solid<D>>)
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
            if (slides_from(now)) return false;
            // At an edge there are several normals, and the one found may lie across the motion; the plane that was
            // come to is another.
            if (now.closing < 0.5 * before.closing) now.distance.normal = before.distance.normal;
            return true;
        }
    }

    /// Whether what touches or overlaps at the start goes further in.
    bool begins_to_go_in(const Moment& start) {
        tell(start);
        if (start.distance.distance < -doubts_.slide) return start.closing > slide_slope;
        if (!(start.closing > 0)) return false;
        const Moment ahead = moment_at(doubts_.stride);
        return ahead.distance.distance > doubts_.slide ? dips(start, ahead) : goes_in(start, ahead);
    }

    /// Whether two that have come to touch go on in touch, and never deeper than doubt allows: along a face, or from
    /// seam to seam of what is made of parts.
    bool slides_from(const Moment& touch) {
        const Moment ahead = moment_at(touch.along + doubts_.stride);
        return ahead.distance.distance <= doubts_.slide && !goes_in(touch, ahead);
    }

    /// Whether they get deeper in than what slides may be, from `here` on, where they touch, by way of `ahead`, where
    /// they still do. A tangent of a convex function is nowhere above it, so where tangents aren't deep, nothing is.
    bool goes_in(const Moment& here, Moment ahead) {
        Moment before = here;
        const double end = std::max(path_.length, ahead.along);
        for (int look = 0; look < most_looks; ++look) {
            if (ahead.distance.distance < -doubts_.slide) return true;
            if (!(ahead.closing > 0)) return dips(before, ahead);
            const double along = ahead.along + (ahead.distance.distance + 2 * doubts_.slide) / ahead.closing;
            if (along >= end) return false;
            before = ahead;
            ahead = moment_at(along);
        }
        return true;
    }

    /// The same between a moment at which the distance falls, and one at which it does no longer.
    bool dips(Moment falling, Moment rising) {
        for (int look = 0; look < most_looks; ++look) {
            if (!(falling.closing > 0) || rising.closing > 0) return false;
            const double height = falling.distance.distance - rising.distance.distance;
            const double way = rising.along - falling.along;
            const double along =
                std::clamp((height - rising.closing * way) / (falling.closing - rising.closing), 0.0, way);
            if (falling.distance.distance - along * falling.closing >= -2 * doubts_.slide) return false;
            const Moment between = moment_at(falling.along + along);
            if (between.distance.distance < -doubts_.slide) return true;
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

#define ABUT_INSTANTIATE(D)                                                                                            \
    template bool part_touch(const Convex<D>&, const Path<D>&, const Convex<D>&, std::uint32_t,                        \
                             const SweepOptions<D>&, PartTouch<D>&);                                                   \
    template bool part_touch(const Convex<D>&, const Path<D>&, const Solid<D>&, std::uint32_t, const SweepOptions<D>&, \
                             PartTouch<D>&);                                                                           \
    template bool part_touch(const Solid<D>&, const Path<D>&, const Convex<D>&, std::uint32_t, const SweepOptions<D>&, \
                             PartTouch<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
