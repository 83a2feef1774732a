#include <abut/convex/gjk/sat.hpp>

namespace abut::detail {
namespace {

/// The best of the tested axes.
template <int D>
class AxisSearch {
public:
    AxisSearch(const CoreDifference<D>& difference, double max_distance, Trace<D>* trace)
        : difference_(difference), max_distance_(max_distance), trace_(trace) {}

    /// Tests an axis of any length in both directions; a zero axis is skipped. It must be better than the best one by
    /// more than `bias`, relative to the coordinates: rounding must not let an edge pair win over a face with the same
    /// normal.
    void test_axis(const DVec<D>& direction, double bias = 0) {
        const DVec<D> axis = normalized(direction, DVec<D>(0.0));
        if (axis == DVec<D>(0.0) || done()) return;
        const Interval a = interval(difference_.a(), axis), b = interval(difference_.b(), axis);
        record(axis, a, b);
        const double scale = std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
        update(axis, a.max - b.min, bias * scale);
        update(-axis, b.max - a.min, bias * scale);
    }

    bool done() const { return -best_.extent > max_distance_; }
    const SeparatingAxis<D>& best() const { return best_; }

private:
    void update(const DVec<D>& normal, double extent, double bias) {
        if (!(extent < best_.extent - bias)) return;
        best_.extent = extent;
        best_.normal = normal;
    }

    void record(const DVec<D>& axis, const Interval& a, const Interval& b) {
        if (trace_ == nullptr) return;
        const double origin = dot(axis, difference_.origin());
        const auto in_world = [origin](double x) { return static_cast<float>(x + origin); };
        const bool forward = a.max - b.min <= b.max - a.min;
        AxisStep<D> step{to_float(forward ? axis : -axis), in_world(a.min), in_world(a.max), in_world(b.min),
                         in_world(b.max)};
        if (!forward) step = {step.axis, -in_world(a.max), -in_world(a.min), -in_world(b.max), -in_world(b.min)};
        trace_->steps.push_back(step);
    }

    const CoreDifference<D>& difference_;
    double max_distance_;
    Trace<D>* trace_;
    SeparatingAxis<D> best_;
};

template <int D>
DVec<D> corner(const Convex<D>& core, std::uint32_t i) {
    return core.place.point(DVec<D>(core.vertices()[i]));
}

template <class Visit>
void each_face_normal(const Convex<3>& core, Visit&& visit) {
    if (core.core == Core::box) {
        for (int i = 0; i < 3; ++i) visit(mapped_normal(core.place, axis<3>(i)));
    } else if (core.facets != nullptr) {
        for (const Vec3& normal : core.facets->normals) visit(mapped_normal(core.place, DVec<3>(normal)));
    } else if (core.count == 3) {
        const DVec<3> a = corner(core, 0);
        visit(cross(corner(core, 1) - a, corner(core, 2) - a));
    }
}

/// An edge as an arc on the Gauss map, between the normals of its two faces. Without known faces it may be any arc.
struct Arc {
    DVec<3> edge;
    DVec<3> left{0.0}, right{0.0};
    bool known = false;
};

template <class Visit>
void each_edge(const Convex<3>& core, Visit&& visit) {
    if (core.core == Core::box) {
        for (std::size_t i = 0; i < 3; ++i) visit(Arc{core.place.column[i]});
    } else if (core.facets != nullptr) {
        const Facets& facets = *core.facets;
        const bool solid = facets.normals.size() > 2;
        for (const FacetEdge& edge : facets.edges) {
            Arc arc{corner(core, edge.to) - corner(core, edge.from)};
            if (solid) {
                arc.left = normalized(mapped_normal(core.place, DVec<3>(facets.normals[edge.left])));
                arc.right = normalized(mapped_normal(core.place, DVec<3>(facets.normals[edge.right])));
                arc.known = true;
            }
            visit(arc);
        }
    } else {
        for (std::uint32_t i = 1; i < core.count; ++i)
            for (std::uint32_t j = 0; j < i; ++j) visit(Arc{corner(core, i) - corner(core, j)});
    }
}

/// Whether an arc of A and a reversed arc of B may cross on the Gauss map. The normals are rounded to floats, so nearly
/// crossing arcs count too.
bool may_cross(const Arc& a, const Arc& b) {
    if (!a.known || !b.known) return true;
    const double tolerance = 1e-6;
    const DVec<3> across_a = normalized(cross(a.left, a.right), DVec<3>(0.0));
    const DVec<3> across_b = normalized(cross(b.left, b.right), DVec<3>(0.0));
    const double left_b = -dot(across_a, b.left), right_b = -dot(across_a, b.right);
    const double left_a = -dot(across_b, a.left), right_a = -dot(across_b, a.right);
    const auto same_side = [tolerance](double x, double y) {
        return (x > tolerance && y > tolerance) || (x < -tolerance && y < -tolerance);
    };
    return !same_side(left_b, right_b) && !same_side(left_a, right_a);
}

template <int D>
Interval interval_of_points(const Convex<D>& core, const DVec<D>& axis) {
    const DVec<D> local = core.place.transposed(axis);
    const Vec<D>* points = core.vertices();
    double min = dot(local, DVec<D>(points[0])), max = min;
    for (std::uint32_t i = 1; i < core.count; ++i) {
        const double along = dot(local, DVec<D>(points[i]));
        min = std::min(min, along);
        max = std::max(max, along);
    }
    const double offset = dot(axis, core.place.offset);
    return {offset + min, offset + max};
}

}  // namespace

template <int D>
Interval interval(const Convex<D>& core, const DVec<D>& axis) {
    if (core.core == Core::points && core.inner_radius == 0) return interval_of_points(core, axis);
    if (core.core == Core::box && core.inner_radius == 0) {
        const double middle = dot(axis, core.place.offset);
        double reach = 0;
        for (int i = 0; i < D; ++i)
            reach += std::abs(dot(axis, core.place.column[static_cast<std::size_t>(i)])) *
                     static_cast<double>(core.own[0][i]);
        return {middle - reach, middle + reach};
    }
    return {dot(axis, core_support(core, -axis).position), dot(axis, core_support(core, axis).position)};
}

SeparatingAxis<2> separating_axis(const CoreDifference<2>& difference, double max_distance, Trace<2>* trace) {
    AxisSearch<2> search(difference, max_distance, trace);
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

SeparatingAxis<3> separating_axis(const CoreDifference<3>& difference, double max_distance, Trace<3>* trace) {
    AxisSearch<3> search(difference, max_distance, trace);
    for (const Convex<3>* core : {&difference.a(), &difference.b()})
        each_face_normal(*core, [&](const DVec<3>& normal) { search.test_axis(normal); });
    each_edge(difference.a(), [&](const Arc& a) {
        if (search.done()) return;
        each_edge(difference.b(), [&](const Arc& b) {
            if (may_cross(a, b)) search.test_axis(cross(a.edge, b.edge), 1e-12);
        });
    });
    return search.best();
}

template Interval interval(const Convex<2>&, const DVec<2>&);
template Interval interval(const Convex<3>&, const DVec<3>&);

}  // namespace abut::detail
