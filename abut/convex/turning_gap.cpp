#include <abut/convex/turning_gap.hpp>

namespace abut {
namespace {

/// The bound on the steps of one axis; a handful is usual.
constexpr int most_steps = 32;

/// The most of |(d x (d x n) + (d x w) x n) . y| for y of length 1 and any n that W turns; d = W - w. In the plane, and
/// where all turn about one axis, n keeps its part along that axis.
double bend_of(double spin, double own, const DVec<2>&) {
    return (spin - own) * (spin - own);
}
double bend_of(const DVec<3>& spin, const DVec<3>& own, const DVec<3>& normal) {
    const DVec<3> d = spin - own;
    const double rate = length(d);
    if (cross(d, spin) == DVec<3>(0.0)) return rate * length(cross(d, normal));
    return rate * rate + length(cross(d, own));
}

/// Of an axis of length 1 that turns.
double speed_of(double spin, const DVec<2>&) {
    return std::abs(spin);
}
double speed_of(const DVec<3>& spin, const DVec<3>& normal) {
    return length(cross(spin, normal));
}

}  // namespace

template <int D>
TurningGap<D>::TurningGap(TurningSet<D>& a, TurningSet<D>& b, const DVec<D>& normal, const Spin<D>& spin, double from)
    : a_(a), b_(b), axis_(spin), alike_(nullptr), normal_(axis_.of(normal)), spin_(spin), from_(from) {
    a.go_to(from);
    b.go_to(from);
    const RigidPath<D>&path_a = a.path(), &path_b = b.path();
    bend_ = bend_of(spin, path_a.spin, normal) * a.reach() + bend_of(spin, path_b.spin, normal) * b.reach();
    if (axis_.rate == 0) return;
    if (spin == path_a.spin || spin == path_b.spin) {
        alike_ = spin == path_a.spin ? &a : &b;
        const SinCos& turned = alike_->turned();
        normal_ = axis_.of(normal_.at({-turned.sin, turned.cos}));
    }
    // A straight way is farthest from a point at one of its ends.
    const double farthest = std::sqrt(std::max(length_squared(path_b.pivot(from) - path_a.pivot(from)),
                                               length_squared(path_b.pivot(1) - path_a.pivot(1))));
    const double speed = speed_of(spin, normal);
    bend_ += speed * (rate_of(spin) * farthest + 2 * length(path_b.move - path_a.move));
}

template <int D>
Gap TurningGap<D>::measured(double time, const DVec<D>& n, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const {
    const RigidPath<D>&path_a = a_.path(), &path_b = b_.path();
    const DVec<D> swing_a = turned_by(path_a.spin, on_a - path_a.pivot(time)),
                  swing_b = turned_by(path_b.spin, on_b - path_b.pivot(time));
    const DVec<D> across = on_b - on_a, speed = (path_b.move + swing_b) - (path_a.move + swing_a);
    const DVec<D> turn = turned_by(spin_, n);
    return {gap, dot(n, speed) + dot(turn, across),
            dot(turned_by(spin_, turn), across) + 2 * dot(turn, speed) +
                dot(n, turned_by(path_b.spin, swing_b) - turned_by(path_a.spin, swing_a))};
}

namespace {

/// The farthest point of a core. Of a box it is told without a guess at any sign, each of which is another each time.
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
Gap TurningGap<D>::at(double time) {
    a_.go_to(time);
    b_.go_to(time);
    const DVec<D> n = axis_.rate == 0     ? normal_.at({0, 1})
                      : alike_ != nullptr ? normal_.at(alike_->turned())
                                          : normal_.at(sin_cos(axis_.rate * (time - from_)));
    const Convex<D>&a = a_.here(), &b = b_.here();
    const DVec<D> on_a = farthest(a, n), on_b = farthest(b, -n);
    return measured(time, n, dot(n, on_b - on_a) - a.radius - b.radius, on_a, on_b);
}

template <int D>
Gap TurningGap<D>::at_first(const DVec<D>& normal, double gap, const DVec<D>& on_a, const DVec<D>& on_b) const {
    return measured(from_, normal, gap, on_a, on_b);
}

namespace {

/// Whether a gap that is `g1` and then `g2`, a time h apart, is nowhere closed between: (sqrt(g1) + sqrt(g2))^2 is at
/// least K h^2 / 2.
bool stays_open(double g1, double g2, double bend, double h) {
    const double excess = 0.5 * bend * h * h - g1 - g2;
    return excess <= 0 || excess * excess <= 4 * g1 * g2;
}

/// How far to go from a time at which the gap is `now`: to where it seems to close to the level, or as far as the bend
/// allows to prove if it does.
double stride(const Gap& now, double level, double bend, double most) {
    const double open = now.gap - level;
    const double discriminant = now.rate * now.rate - 2 * open * now.acceleration;
    const double speed = discriminant > 0 ? std::sqrt(discriminant) - now.rate : 0;
    const double wanted = speed * most > 2 * open ? 2 * open / speed : most;
    // Not more than it opens evenly: what bends it open now may not last.
    const double curve = 0.5 * std::min(now.acceleration, 0.0);
    const auto expected = [&](double h) { return std::max(open + h * (now.rate + h * curve), 0.0); };
    if (stays_open(open, expected(wanted), bend, wanted)) return wanted;
    const double root = std::sqrt(open), per_root = std::sqrt(2 / bend);
    const double farthest = std::min(wanted, 2 * root * per_root);
    return std::min(farthest, (root + std::sqrt(expected(farthest))) * per_root);
}

/// The first x at which g1 + (g2 - g1) x / h - K/2 x (h - x) is zero; h where it is nowhere below.
double first_closed(double g1, double g2, double bend, double h) {
    if (g2 >= 0 && stays_open(g1, g2, bend, h)) return h;
    const double slope = (g2 - g1) / h - 0.5 * bend * h;
    const double discriminant = slope * slope - 2 * bend * g1;
    if (!(slope < 0) || !(discriminant >= 0)) return h;
    return std::min(h, 2 * g1 / (std::sqrt(discriminant) - slope));
}

}  // namespace

template <int D>
OpenUntil open_until(TurningGap<D>& gap, double from, double until, const Gap& first, double level, double slack) {
    double time = from, closed = until, closed_by = 0, longest = until;
    Gap now = first;
    const double bend = gap.bend();
    for (int step = 0; step < most_steps; ++step) {
        const double open = now.gap - level;
        if (open <= slack || time >= until) break;
        // Into the middle of the slack; short of where it is known to be closed.
        const double rest = closed - time, aim = open - 0.5 * slack;
        double h = std::min(stride(now, level + 0.5 * slack, bend, rest), longest);
        if (closed_by > 0 && h >= rest) h = rest * aim / (open + closed_by);
        const double then = time + h >= until ? until : time + h;
        const Gap next = gap.at(then);
        const double known = first_closed(open, next.gap - level, bend, then - time);
        if (time + known >= then) {
            if (then <= time) break;
            time = then;
            now = next;
            longest = until;
            continue;
        }
        // It went otherwise than it seemed.
        longest = std::max(4 * known, 0.25 * h);
        if (next.gap < level) {
            closed = then;
            closed_by = level - next.gap;
        }
        if (time + known <= time) break;
        time += known;
        now = gap.at(time);
    }
    return {time, now.gap};
}

namespace {

/// Up to three different corners of a core at which it is met.
struct Met {
    std::array<std::uint32_t, 3> corner{};
    int count = 0;
    const Convex<3>& core;

    Met(const Convex<3>& set, const CornerNumbers<3>& corners, std::size_t corner_count) : core(set) {
        if (!has_corner(set, 0)) return;
        for (std::size_t i = 0; i < corner_count && count < 3; ++i) {
            bool seen = false;
            for (int k = 0; k < count; ++k) seen = seen || corner[static_cast<std::size_t>(k)] == corners[i];
            if (!seen && has_corner(set, corners[i])) corner[static_cast<std::size_t>(count++)] = corners[i];
        }
    }
    DVec<3> edge() const { return core.place.vector(own_corner(core, corner[1]) - own_corner(core, corner[0])); }
};

/// What turns n at the rate n' = x e + y f, and about itself as fast as both sets do in the mean, which bends least.
DVec<3> spin_of_axis(const DVec<3>& n, const DVec<3>& rate, const DVec<3>& spin_a, const DVec<3>& spin_b) {
    return cross(n, rate) + n * (0.5 * dot(n, spin_a + spin_b));
}

/// The least n' that stays across an edge e: n' . e = (w x n) . e.
DVec<3> rate_across(const DVec<3>& e, const DVec<3>& spin, const DVec<3>& n) {
    return e * (dot(cross(spin, n), e) / dot(e, e));
}

/// Whether a core of the plane is met along a side.
bool met_along_side(const Convex<2>& set, const CornerNumbers<2>& corners, std::size_t count) {
    if (!has_corner(set, 0)) return false;
    bool differ = false;
    for (std::size_t i = 1; i < count; ++i) differ = differ || corners[i] != corners[0];
    return differ;
}

}  // namespace

template <>
Spin<2> spin_across(const TurningSet<2>& a, const TurningSet<2>& b, const DVec<2>&, const MeetingCorners<2>& corners) {
    if (met_along_side(a.here(), corners.a, corners.count)) return a.path().spin;
    return met_along_side(b.here(), corners.b, corners.count) ? b.path().spin : 0;
}

template <>
Spin<3> spin_across(const TurningSet<3>& a, const TurningSet<3>& b, const DVec<3>& normal,
                    const MeetingCorners<3>& corners) {
    const DVec<3>&spin_a = a.path().spin, &spin_b = b.path().spin;
    const Met on_a(a.here(), corners.a, corners.count), on_b(b.here(), corners.b, corners.count);
    if (on_a.count > 2) return spin_a;
    if (on_b.count > 2) return spin_b;
    if (on_a.count == 2 && on_b.count == 2) {
        const DVec<3> e = on_a.edge(), f = on_b.edge();
        const double ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), area = ee * ff - ef * ef;
        if (area > 1e-4 * ee * ff) {
            const double along_e = dot(cross(spin_a, normal), e), along_f = dot(cross(spin_b, normal), f);
            const DVec<3> rate =
                e * ((along_e * ff - along_f * ef) / area) + f * ((along_f * ee - along_e * ef) / area);
            return spin_of_axis(normal, rate, spin_a, spin_b);
        }
    }
    if (on_a.count == 2) return spin_of_axis(normal, rate_across(on_a.edge(), spin_a, normal), spin_a, spin_b);
    if (on_b.count == 2) return spin_of_axis(normal, rate_across(on_b.edge(), spin_b, normal), spin_a, spin_b);
    return DVec<3>(0.0);
}

#define ABUT_INSTANTIATE(D)       \
    template class TurningGap<D>; \
    template OpenUntil open_until(TurningGap<D>&, double, double, const Gap&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
