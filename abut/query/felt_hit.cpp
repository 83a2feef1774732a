#include <abut/query/felt_hit.hpp>

namespace abut {

template <int D>
void feel_hit(const View<D>& mover, const DVec<D>& came, const View<D>& shape, EachFoot<D> each_foot, Hit<D>& hit) {
    const double own_size = size(mover);
    if (!std::isfinite(own_size)) return;
    const DVec<D> middle = DVec<D>(center(bounds(mover))) + came;
    const FeltPlace<D> place{DVec<D>(hit.point), DVec<D>(hit.normal), middle, felt_scale * own_size};
    each_part_near(shape, round_points<D>({hit.point}, 0), static_cast<float>(place.scale),
                   [&](const auto& part, std::uint32_t index) {
                       if (index != hit.feature.part) return true;
                       if (is_felt<D>(part, place, each_foot)) return false;
                       SeenFromMiddle<D> seen;
                       const std::optional<FeltPlane<D>> plane = felt_plane<D>(part, place, each_foot, seen);
                       if (plane && dot(plane->normal, came) < 0) hit.normal = to_float(plane->normal);
                       return false;
                   });
}

template void feel_hit(const View<2>&, const DVec<2>&, const View<2>&, EachFoot<2>, Hit<2>&);
template void feel_hit(const View<3>&, const DVec<3>&, const View<3>&, EachFoot<3>, Hit<3>&);

}  // namespace abut
