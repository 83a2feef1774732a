#include <abut/query/detail/surface/hit_normal.hpp>

namespace abut::detail {

template <int D>
MoverAtHit<D> linear_mover_at_hit(const View<D>& mover, const DVec<D>& travelled) {
    return {DVec<D>(center(bounds(mover))) + travelled, size(mover), travelled};
}
template <int D>
MoverAtHit<D> rotating_mover_at_hit(const View<D>& mover, const RigidPath<D>& path, double time, const DVec<D>& point) {
    return {DVec<D>(center(bounds(moved(mover, place_at(path, time))))), size(mover), path.velocity(time, point)};
}

template <int D>
void filter_hit_normal(const MoverAtHit<D>& mover, const View<D>& shape, EachClosestPoint<D> each_closest_point,
                       Hit<D>& hit) {
    if (!std::isfinite(mover.size)) return;
    const EdgeFilter<D> filter(each_closest_point, mover.size);
    const SurfacePlace<D> place{DVec<D>(hit.point), DVec<D>(hit.normal), mover.center};
    for_each_part(shape, box_around(place.point, filter.scale()), [&](const Part<D>& part, std::uint32_t index) {
        if (index != hit.feature.part) return true;
        if (filter.is_surface_normal(part, place)) return false;
        NearestToCenter<D> nearest;
        const std::optional<SurfacePlane<D>> plane = filter.plane_near(part, place, nearest);
        if (plane && dot(plane->normal, mover.direction) < 0) hit.normal = to_float(plane->normal);
        return false;
    });
}

#define ABUT_INSTANTIATE(D)                                                                                    \
    template MoverAtHit<D> linear_mover_at_hit(const View<D>&, const DVec<D>&);                                \
    template MoverAtHit<D> rotating_mover_at_hit(const View<D>&, const RigidPath<D>&, double, const DVec<D>&); \
    template void filter_hit_normal(const MoverAtHit<D>&, const View<D>&, EachClosestPoint<D>, Hit<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
