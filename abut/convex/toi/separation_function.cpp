#include <abut/convex/toi/separation_function.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// From this number of corners on their bounding box is used.
constexpr std::uint32_t min_box_count = 32;

/// An upper bound of the distance of a placed core from the pivot.
template <int D>
double reach_of(const Convex<D>& core) {
    double squared = 0;
    if (core.inner_radius == 0 && core.core == Core::points && core.count < min_box_count) {
        for (std::uint32_t i = 0; i < core.count; ++i)
            squared = std::max(squared, length_squared(core.place.point(local_corner(core, i))));
    } else {
        for (int i = 0; i < D; ++i) {
            const double low = core_support(core, axis<D>(i, -1)).position[i],
                         high = core_support(core, axis<D>(i, 1)).position[i];
            squared += std::max(low * low, high * high);
        }
    }
    return square_root(squared);
}

/// The distance of a point from the axis of rotation; in 2D from the pivot.
double distance_to_axis(const RotationAxis2&, const DVec<2>& point) {
    return length(point);
}
double distance_to_axis(const RotationAxis3& turning, const DVec<3>& point) {
    return length(cross(turning.axis, point));
}

/// An upper bound of the displacement of a set that rotates about nearly its own axis of symmetry; infinite for other
/// sets. The set is placed relative to the pivot.
template <int D>
double rotation_displacement(const Convex<D>& set, const RotationAxis<D>& turning) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!set.similar) return infinity;
    if (set.core == Core::points && set.count <= 2) {
        double farthest = 0;
        for (std::uint32_t i = 0; i < set.count; ++i)
            farthest = std::max(farthest, distance_to_axis(turning, set.place.point(local_corner(set, i))));
        return 2 * farthest;
    }
    if constexpr (D == 3)
        if (set.core == Core::discs) {
            const DVec<3> a(set.own[0]), b(set.own[1]);
            const DVec<3> own_axis = normalized(set.place.vector(a == b ? axis<3>(2) : b - a));
            const double rim = static_cast<double>(std::max(set.disc_radius[0], set.disc_radius[1])) * set.scale;
            return 2 * (distance_to_axis(turning, own_axis) * rim +
                        std::max(distance_to_axis(turning, set.place.point(a)),
                                 distance_to_axis(turning, set.place.point(b))));
        }
    return infinity;
}

}  // namespace

template <int D>
RotatingSet<D>::RotatingSet(const Convex<D>& set, const RigidPath<D>& path, double negligible_motion)
    : path_(path), here_(set), axis_(path.angular_velocity) {
    // From local values: reading a vector right after its halves were written stalls.
    const DVec<D> offset = path.start.vector(set.place.offset);
    std::array<DVec<D>, static_cast<std::size_t>(D)> columns;
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = path.start.vector(set.place.column[i]);
    here_.place.column = columns;
    if (is_plain_box(set)) {
        reach_ = length(offset) + length(DVec<D>(set.own[0])) * set.scale;
    } else {
        here_.place.offset = offset;
        reach_ = reach_of(here_);
        if (axis_.rate != 0 && rotation_displacement(here_, axis_) <= negligible_motion) {
            path_.angular_velocity = AngularVelocity<D>{};
            axis_ = RotationAxis<D>(path_.angular_velocity);
        }
    }
    for (std::size_t i = 0; i < columns.size(); ++i) columns_[i] = axis_.of(columns[i]);
    offset_ = axis_.of(offset);
    here_.place.offset = offset + path.start.offset;
}

template class RotatingSet<2>;
template class RotatingSet<3>;

namespace {

/// The bound on the steps along one axis; a handful is usual.
constexpr int max_steps = 32;

/// The maximum of |(d x (d x n) + (d x w) x n) . y| for y of length 1 and any n that W rotates; d = W - w. In 2D, and
/// if all rotate about one axis, n has a constant component along that axis.
double max_acceleration(double angular_velocity, double own, const DVec<2>&) {
    return (angular_velocity - own) * (angular_velocity - own);
}
double max_acceleration(const DVec<3>& angular_velocity, const DVec<3>& own, const DVec<3>& normal) {
    const DVec<3> d = angular_velocity - own;
    const double rate = length(d);
    if (cross(d, angular_velocity) == DVec<3>(0.0)) return rate * length(cross(d, normal));
    return rate * rate + length(cross(d, own));
}

/// The speed of a rotating axis of length 1.
double axis_speed(double angular_velocity, const DVec<2>&) {
    return std::abs(angular_velocity);
}
double axis_speed(const DVec<3>& angular_velocity, const DVec<3>& normal) {
    return length(cross(angular_velocity, normal));
}

}  // namespace

template <int D>
SeparationFunction<D>::SeparationFunction(RotatingSet<D>& a, RotatingSet<D>& b, const DVec<D>& normal,
                                          const AngularVelocity<D>& angular_velocity, double from)
    : a_(a),
      b_(b),
      axis_(angular_velocity),
      co_rotating_(nullptr),
      normal_(axis_.of(normal)),
      spin_(angular_velocity),
      from_(from) {
    a.go_to(from);
    b.go_to(from);
    const RigidPath<D>&path_a = a.path(), &path_b = b.path();
    acceleration_bound_ = max_acceleration(angular_velocity, path_a.angular_velocity, normal) * a.reach() +
                          max_acceleration(angular_velocity, path_b.angular_velocity, normal) * b.reach();
    if (axis_.rate == 0) return;
    if (angular_velocity == path_a.angular_velocity || angular_velocity == path_b.angular_velocity) {
        co_rotating_ = angular_velocity == path_a.angular_velocity ? &a : &b;
        const SinCos& rotated = co_rotating_->rotation();
        normal_ = axis_.of(normal_.at({-rotated.sin, rotated.cos}));
    }
    // A straight path is farthest from a point at one of its ends.
    const double farthest = square_root(std::max(length_squared(path_b.pivot(from) - path_a.pivot(from)),
                                                 length_squared(path_b.pivot(1) - path_a.pivot(1))));
    const double speed = axis_speed(angular_velocity, normal);
    acceleration_bound_ += speed * (angular_speed(angular_velocity) * farthest + 2 * length(path_b.move - path_a.move));
}

template <int D>
Gap SeparationFunction<D>::measured(double time, const DVec<D>& n, double gap, const DVec<D>& on_a,
                                    const DVec<D>& on_b) const {
    const RigidPath<D>&path_a = a_.path(), &path_b = b_.path();
    const DVec<D> swing_a = rotational_velocity(path_a.angular_velocity, on_a - path_a.pivot(time)),
                  swing_b = rotational_velocity(path_b.angular_velocity, on_b - path_b.pivot(time));
    const DVec<D> across = on_b - on_a, speed = (path_b.move + swing_b) - (path_a.move + swing_a);
    const DVec<D> turn = rotational_velocity(spin_, n);
    return {gap, dot(n, speed) + dot(turn, across),
            dot(rotational_velocity(spin_, turn), across) + 2 * dot(turn, speed) +
                dot(n, rotational_velocity(path_b.angular_velocity, swing_b) -
                           rotational_velocity(path_a.angular_velocity, swing_a))};
}

namespace {

/// The support point of a core. For a box it has no branches, because the signs can't be predicted.
template <int D>
DVec<D> farthest(const Convex<D>& set, const DVec<D>& direction) {
    if (set.core != Core::box || set.inner_radius > 0) return core_support(set, direction).position;
    DVec<D> result = set.place.offset;
    for (int i = 0; i < D; ++i) {
        const DVec<D>& column = set.place.column[static_cast<std::size_t>(i)];
        result += column * std::copysign(static_cast<double>(set.own[0][i]), dot(direction, column));
    }
    return result;
}

}  // namespace

template <int D>
Gap SeparationFunction<D>::at(double time) {
    a_.go_to(time);
    b_.go_to(time);
    const DVec<D> n = axis_.rate == 0           ? normal_.at({0, 1})
                      : co_rotating_ != nullptr ? normal_.at(co_rotating_->rotation())
                                                : normal_.at(sin_cos(axis_.rate * (time - from_)));
    const Convex<D>&a = a_.here(), &b = b_.here();
    const DVec<D> on_a = farthest(a, n), on_b = farthest(b, -n);
    return measured(time, n, dot(n, on_b - on_a) - a.radius - b.radius, on_a, on_b);
}

template <int D>
Gap SeparationFunction<D>::at_first(const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const {
    return measured(from_, normal, gap, on_a, on_b);
}

namespace {

/// Whether a gap of `g1`, and of `g2` a time h later, stays open between: (sqrt(g1) + sqrt(g2))^2 is at least K h^2 /
/// 2.
bool stays_separated(double g1, double g2, double acceleration_bound, double h) {
    const double excess = 0.5 * acceleration_bound * h * h - g1 - g2;
    return excess <= 0 || excess * excess <= 4 * g1 * g2;
}

/// The next step from a time with gap `now`: to the expected time at which the gap reaches the level, but no farther
/// than the acceleration bound can prove.
double stride(const Gap& now, double level, double acceleration_bound, double max_step) {
    const double open = now.gap - level;
    const double discriminant = now.rate * now.rate - 2 * open * now.acceleration;
    const double speed = discriminant > 0 ? square_root(discriminant) - now.rate : 0;
    const double wanted = speed * max_step > 2 * open ? 2 * open / speed : max_step;
    // At most the linear extrapolation: an opening acceleration may not last.
    const double curve = 0.5 * std::min(now.acceleration, 0.0);
    const auto expected = [&](double h) { return std::max(open + h * (now.rate + h * curve), 0.0); };
    if (stays_separated(open, expected(wanted), acceleration_bound, wanted)) return wanted;
    const double root = square_root(open), per_root = square_root(2 / acceleration_bound);
    const double farthest = std::min(wanted, 2 * root * per_root);
    return std::min(farthest, (root + square_root(expected(farthest))) * per_root);
}

/// The first x at which g1 + (g2 - g1) x / h - K/2 x (h - x) is zero; h if it is nowhere below.
double first_contact(double g1, double g2, double acceleration_bound, double h) {
    if (g2 >= 0 && stays_separated(g1, g2, acceleration_bound, h)) return h;
    const double slope = (g2 - g1) / h - 0.5 * acceleration_bound * h;
    const double discriminant = slope * slope - 2 * acceleration_bound * g1;
    if (!(slope < 0) || !(discriminant >= 0)) return h;
    return std::min(h, 2 * g1 / (square_root(discriminant) - slope));
}

}  // namespace

template <int D>
SeparatedUntil separated_until(SeparationFunction<D>& gap, double from, double until, const Gap& first, double level,
                               double tolerance) {
    double time = from, closed = until, closed_by = 0, longest = until;
    Gap now = first;
    const double acceleration_bound = gap.acceleration_bound();
    for (int step = 0; step < max_steps; ++step) {
        const double open = now.gap - level;
        if (open <= tolerance || time >= until) break;
        // Towards the middle of the tolerance, but short of a time at which the gap is known to be closed.
        const double rest = closed - time, aim = open - 0.5 * tolerance;
        double h = std::min(stride(now, level + 0.5 * tolerance, acceleration_bound, rest), longest);
        if (closed_by > 0 && h >= rest) h = rest * aim / (open + closed_by);
        const double then = time + h >= until ? until : time + h;
        const Gap next = gap.at(then);
        const double proven_step = first_contact(open, next.gap - level, acceleration_bound, then - time);
        if (time + proven_step >= then) {
            if (then <= time) break;
            time = then;
            now = next;
            longest = until;
            continue;
        }
        // The gap closed earlier than expected.
        longest = std::max(4 * proven_step, 0.25 * h);
        if (next.gap < level) {
            closed = then;
            closed_by = level - next.gap;
        }
        if (time + proven_step <= time) break;
        time += proven_step;
        now = gap.at(time);
    }
    return {time, now.gap};
}

namespace {

/// Up to three distinct corners of a core at the closest points.
struct ContactFeature {
    std::array<std::uint32_t, 3> corner{};
    int count = 0;
    const Convex<3>& core;

    ContactFeature(const Convex<3>& set, const CornerIndices<3>& corners, std::size_t corner_count) : core(set) {
        if (!has_corner(set, 0)) return;
        for (std::size_t i = 0; i < corner_count && count < 3; ++i) {
            bool seen = false;
            for (int k = 0; k < count; ++k) seen = seen || corner[static_cast<std::size_t>(k)] == corners[i];
            if (!seen && has_corner(set, corners[i])) corner[static_cast<std::size_t>(count++)] = corners[i];
        }
    }
    DVec<3> edge() const { return core.place.vector(local_corner(core, corner[1]) - local_corner(core, corner[0])); }
};

/// The angular velocity with n' = rate and, about n itself, the mean of both sets, which gives the smallest
/// acceleration.
DVec<3> angular_velocity_of_axis(const DVec<3>& n, const DVec<3>& rate, const DVec<3>& spin_a, const DVec<3>& spin_b) {
    return cross(n, rate) + n * (0.5 * dot(n, spin_a + spin_b));
}

/// The smallest n' that leaves n orthogonal to an edge e: n' . e = (w x n) . e. An edge of a flat box may have no
/// length.
DVec<3> rate_orthogonal_to(const DVec<3>& e, const DVec<3>& angular_velocity, const DVec<3>& n) {
    const double square = dot(e, e);
    return square > 0 ? e * (dot(cross(angular_velocity, n), e) / square) : DVec<3>(0.0);
}

/// Whether a core in 2D touches along an edge.
bool touches_along_edge(const Convex<2>& set, const CornerIndices<2>& corners, std::size_t count) {
    if (!has_corner(set, 0)) return false;
    bool differ = false;
    for (std::size_t i = 1; i < count; ++i) differ = differ || corners[i] != corners[0];
    return differ;
}

}  // namespace

template <>
AngularVelocity<2> axis_angular_velocity(const RotatingSet<2>& a, const RotatingSet<2>& b, const DVec<2>&,
                                         const ClosestCorners<2>& corners) {
    if (touches_along_edge(a.here(), corners.a, corners.count)) return a.path().angular_velocity;
    return touches_along_edge(b.here(), corners.b, corners.count) ? b.path().angular_velocity : 0;
}

template <>
AngularVelocity<3> axis_angular_velocity(const RotatingSet<3>& a, const RotatingSet<3>& b, const DVec<3>& normal,
                                         const ClosestCorners<3>& corners) {
    const DVec<3>&spin_a = a.path().angular_velocity, &spin_b = b.path().angular_velocity;
    const ContactFeature on_a(a.here(), corners.a, corners.count), on_b(b.here(), corners.b, corners.count);
    if (on_a.count > 2) return spin_a;
    if (on_b.count > 2) return spin_b;
    if (on_a.count == 2 && on_b.count == 2) {
        const DVec<3> e = on_a.edge(), f = on_b.edge();
        const double ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), area = ee * ff - ef * ef;
        if (area > 1e-4 * ee * ff) {
            const double along_e = dot(cross(spin_a, normal), e), along_f = dot(cross(spin_b, normal), f);
            const DVec<3> rate =
                e * ((along_e * ff - along_f * ef) / area) + f * ((along_f * ee - along_e * ef) / area);
            return angular_velocity_of_axis(normal, rate, spin_a, spin_b);
        }
    }
    if (on_a.count == 2)
        return angular_velocity_of_axis(normal, rate_orthogonal_to(on_a.edge(), spin_a, normal), spin_a, spin_b);
    if (on_b.count == 2)
        return angular_velocity_of_axis(normal, rate_orthogonal_to(on_b.edge(), spin_b, normal), spin_a, spin_b);
    return DVec<3>(0.0);
}

#define ABUT_INSTANTIATE(D)               \
    template class SeparationFunction<D>; \
    template SeparatedUntil separated_until(SeparationFunction<D>&, double, double, const Gap&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
