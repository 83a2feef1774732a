#include <abut/convex/turning_set.hpp>

namespace abut {
namespace {

/// From as many corners on, a box around them is asked in their place.
constexpr std::uint32_t many = 32;

/// The farthest that a core placed relative to the pivot reaches from it, or a little more.
template <int D>
double reach_of(const Convex<D>& core) {
    double squared = 0;
    if (core.inner_radius == 0 && core.core == Core::points && core.count < many) {
        for (std::uint32_t i = 0; i < core.count; ++i)
            squared = std::max(squared, length_squared(core.place.point(own_corner(core, i))));
    } else {
        for (int i = 0; i < D; ++i) {
            const double low = core_support(core, axis<D>(i, -1)).position[i],
                         high = core_support(core, axis<D>(i, 1)).position[i];
            squared += std::max(low * low, high * high);
        }
    }
    return std::sqrt(squared);
}

/// How far off its axis a point turns; in the plane that is off the pivot.
double off_axis(const TurningAxis2&, const DVec<2>& point) {
    return length(point);
}
double off_axis(const TurningAxis3& turning, const DVec<3>& point) {
    return length(cross(turning.axis, point));
}

/// The most by which turning moves the farthest point of a set that turns into itself but for a tilt or a shift of its
/// own axis; infinite for others. The set is placed relative to the pivot.
template <int D>
double moved_by_turning(const Convex<D>& set, const TurningAxis<D>& turning) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!set.similar) return infinity;
    if (set.core == Core::points && set.count <= 2) {
        double most = 0;
        for (std::uint32_t i = 0; i < set.count; ++i)
            most = std::max(most, off_axis(turning, set.place.point(own_corner(set, i))));
        return 2 * most;
    }
    if constexpr (D == 3)
        if (set.core == Core::discs) {
            const DVec<3> a(set.own[0]), b(set.own[1]);
            const DVec<3> own_axis = normalized(set.place.vector(a == b ? axis<3>(2) : b - a));
            const double rim = static_cast<double>(std::max(set.disc_radius[0], set.disc_radius[1])) * set.scale;
            return 2 * (off_axis(turning, own_axis) * rim +
                        std::max(off_axis(turning, set.place.point(a)), off_axis(turning, set.place.point(b))));
        }
    return infinity;
}

}  // namespace

template <int D>
TurningSet<D>::TurningSet(const Convex<D>& set, const RigidPath<D>& path, double unseen)
    : path_(path), here_(set), axis_(path.spin) {
    // By values at hand: what was just written in halves is slow to be read as a whole.
    const DVec<D> offset = path.start.vector(set.place.offset);
    std::array<DVec<D>, static_cast<std::size_t>(D)> columns;
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = path.start.vector(set.place.column[i]);
    here_.place.column = columns;
    if (is_plain_box(set)) {
        reach_ = length(offset) + length(DVec<D>(set.own[0])) * set.scale;
    } else {
        here_.place.offset = offset;
        reach_ = reach_of(here_);
        if (axis_.rate != 0 && moved_by_turning(here_, axis_) <= unseen) {
            path_.spin = Spin<D>{};
            axis_ = TurningAxis<D>(path_.spin);
        }
    }
    for (std::size_t i = 0; i < columns.size(); ++i) columns_[i] = axis_.of(columns[i]);
    offset_ = axis_.of(offset);
    here_.place.offset = offset + path.start.offset;
}

template class TurningSet<2>;
template class TurningSet<3>;

}  // namespace abut
