#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/surface/part_cache.hpp>

namespace abut::detail {
namespace {

/// Most searches around a hit stay this near to it, in units of s.
constexpr double cached_reach = 4;

}  // namespace

template <int D>
MoverAtHit<D> linear_mover_at_hit(const View<D>& mover, const DVec<D>& travelled) {
    return {DVec<D>(center(bounds(mover))) + travelled, size(mover), travelled};
}
template <int D>
MoverAtHit<D> rotating_mover_at_hit(const View<D>& mover, const RigidPath<D>& path, double time, const DVec<D>& point) {
    return {DVec<D>(center(bounds(moved(mover, place_at(path, time))))), size(mover), path.velocity(time, point)};
}

template <int D>
void filter_hit_normal(const MoverAtHit<D>& mover, const View<D>& shape, const EachClosestPoint<D>* neighbours,
                       Hit<D>& hit) {
    if (!std::isfinite(mover.size)) return;
    Surface<D> surface{shape, neighbours};
    const EdgeFilter<D> filter(surface, mover.size);
    const SurfacePlace<D> place{DVec<D>(hit.point), DVec<D>(hit.normal), mover.center};
    const auto filter_of = [&](const Part<D>& part, std::uint32_t index) {
        if (index != hit.feature.part) return true;
        if (filter.is_surface_normal(part, place)) return false;
        NearestToCenter<D> nearest;
        const std::optional<SurfacePlane<D>> plane = filter.plane_near(part, place, nearest);
        if (plane && dot(plane->normal, mover.direction) < 0) hit.normal = to_float(plane->normal);
        return false;
    };
    const Aabb<D> near = box_around(place.point, cached_reach * filter.scale());
    PartCache<D> cache;
    if (!surface.is_composite() || !cache.fill(std::get<Composite<D>>(shape), near)) {
        for_each_part(shape, near, filter_of);
        return;
    }
    if (cache.size() == 1 && neighbours == nullptr) return;  // the part itself
    surface.cache = &cache;
    for (std::uint32_t i = 0; i < cache.size(); ++i)
        if (!filter_of(cache.part(i), cache.index(i))) return;
}

#define ABUT_INSTANTIATE(D)                                                                                    \
    template MoverAtHit<D> linear_mover_at_hit(const View<D>&, const DVec<D>&);                                \
    template MoverAtHit<D> rotating_mover_at_hit(const View<D>&, const RigidPath<D>&, double, const DVec<D>&); \
    template void filter_hit_normal(const MoverAtHit<D>&, const View<D>&, const EachClosestPoint<D>*, Hit<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
