#include <abut/convex/toi/rotating_set.hpp>

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
    return std::sqrt(squared);
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

}  // namespace abut::detail
