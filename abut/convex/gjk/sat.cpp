#include <abut/convex/gjk/sat.hpp>

namespace abut::detail {
namespace {

/// The projection of a core onto an axis.
struct Interval {
    double min, max;
};

Interval interval_of_points(const Convex<2>& core, const DVec<2>& axis) {
    const DVec<2> local = core.place.transposed(axis);
    const Vec<2>* points = core.vertices();
    double min = dot(local, DVec<2>(points[0])), max = min;
    for (std::uint32_t i = 1; i < core.count; ++i) {
        const double along = dot(local, DVec<2>(points[i]));
        min = std::min(min, along);
        max = std::max(max, along);
    }
    const double offset = dot(axis, core.place.offset);
    return {offset + min, offset + max};
}

Interval interval(const Convex<2>& core, const DVec<2>& axis) {
    if (core.core == Core::points && core.inner_radius == 0) return interval_of_points(core, axis);
    if (core.core == Core::box && core.inner_radius == 0) {
        const double middle = dot(axis, core.place.offset);
        double reach = 0;
        for (int i = 0; i < 2; ++i)
            reach += std::abs(dot(axis, core.place.column[static_cast<std::size_t>(i)])) *
                     static_cast<double>(core.own[0][i]);
        return {middle - reach, middle + reach};
    }
    return {dot(axis, core_support(core, -axis).position), dot(axis, core_support(core, axis).position)};
}

/// The best of the tested axes.
class AxisSearch {
public:
    AxisSearch(const CoreDifference<2>& difference, double max_distance, Trace<2>* trace)
        : difference_(difference), max_distance_(max_distance), trace_(trace) {}

    /// Tests an axis of any length in both directions; a zero axis is skipped. It must be better than the best one by
    /// more than `bias`, relative to the coordinates: rounding must not let an edge pair win over a face with the same
    /// normal.
    void test_axis(const DVec<2>& direction, double bias = 0) {
        const DVec<2> axis = normalized(direction, DVec<2>(0.0));
        if (axis == DVec<2>(0.0) || done()) return;
        const Interval a = interval(difference_.a(), axis), b = interval(difference_.b(), axis);
        record(axis, a, b);
        const double scale = std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
        update(axis, a.max - b.min, bias * scale);
        update(-axis, b.max - a.min, bias * scale);
    }

    bool done() const { return -best_.extent > max_distance_; }
    const SeparatingAxis& best() const { return best_; }

private:
    void update(const DVec<2>& normal, double extent, double bias) {
        if (!(extent < best_.extent - bias)) return;
        best_.extent = extent;
        best_.normal = normal;
    }

    void record(const DVec<2>& axis, const Interval& a, const Interval& b) {
        if (trace_ == nullptr) return;
        const double origin = dot(axis, difference_.origin());
        const auto in_world = [origin](double x) { return static_cast<float>(x + origin); };
        const bool forward = a.max - b.min <= b.max - a.min;
        AxisStep<2> step{to_float(forward ? axis : -axis), in_world(a.min), in_world(a.max), in_world(b.min),
                         in_world(b.max)};
        if (!forward) step = {step.axis, -in_world(a.max), -in_world(a.min), -in_world(b.max), -in_world(b.min)};
        trace_->steps.push_back(step);
    }

    const CoreDifference<2>& difference_;
    double max_distance_;
    Trace<2>* trace_;
    SeparatingAxis best_;
};

DVec<2> corner(const Convex<2>& core, std::uint32_t i) {
    return core.place.point(DVec<2>(core.vertices()[i]));
}

}  // namespace

SeparatingAxis separating_axis(const CoreDifference<2>& difference, double max_distance, Trace<2>* trace) {
    AxisSearch search(difference, max_distance, trace);
    for (const Convex<2>* core : {&difference.a(), &difference.b()}) {
        if (core->core == Core::box) {
            for (int i = 0; i < 2; ++i) search.test_axis(mapped_normal(core->place, axis<2>(i)));
            continue;
        }
        for (std::uint32_t i = core->count > 2 ? 0 : 1; i < core->count; ++i) {
            const DVec<2> edge = corner(*core, i) - corner(*core, i == 0 ? core->count - 1 : i - 1);
            search.test_axis(DVec<2>(edge.y, -edge.x));
        }
    }
    return search.best();
}

}  // namespace abut::detail
