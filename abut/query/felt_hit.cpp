#include <abut/query/felt_hit.hpp>

namespace abut {

template <int D>
Arrival<D> straight_arrival(const View<D>& mover, const DVec<D>& came) {
    return {DVec<D>(center(bounds(mover))) + came, size(mover), came};
}
template <int D>
Arrival<D> turning_arrival(const View<D>& mover, const RigidPath<D>& path, double time, const DVec<D>& point) {
    return {DVec<D>(center(bounds(moved(mover, place_at(path, time))))), size(mover), path.velocity(time, point)};
}

template <int D>
void feel_hit(const Arrival<D>& mover, const View<D>& shape, EachFoot<D> each_foot, Hit<D>& hit) {
    if (!std::isfinite(mover.size)) return;
    const FeltPlace<D> place{DVec<D>(hit.point), DVec<D>(hit.normal), mover.middle, felt_scale * mover.size};
    each_part_near(shape, round_points<D>({hit.point}, 0), static_cast<float>(place.scale),
                   [&](const auto& part, std::uint32_t index) {
                       if (index != hit.feature.part) return true;
                       if (is_felt<D>(part, place, each_foot)) return false;
                       SeenFromMiddle<D> seen;
                       const std::optional<FeltPlane<D>> plane = felt_plane<D>(part, place, each_foot, seen);
                       if (plane && dot(plane->normal, mover.way) < 0) hit.normal = to_float(plane->normal);
                       return false;
                   });
}

#define ABUT_INSTANTIATE(D)                                                                           \
    template Arrival<D> straight_arrival(const View<D>&, const DVec<D>&);                             \
    template Arrival<D> turning_arrival(const View<D>&, const RigidPath<D>&, double, const DVec<D>&); \
    template void feel_hit(const Arrival<D>&, const View<D>&, EachFoot<D>, Hit<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
