#include <abut/convex/pairs/point2.hpp>

namespace abut::detail {

/// Inside, the second nearest edge is the right one. Outside, of collinear edges the wrong one may have been found.
void locate_past_edge(const PolygonSoa& sides, const DVec<2>& point, PointLocation& place) {
    const std::uint32_t side = place.first, after = sides.after(side);
    const bool before = dot(sides.along(side), point - sides.corner(side)) < 0;
    if (!(place.gap > 0) && sides.count > 2) {
        place.first = before ? sides.before(side) : after;
        place.second = sides.after(place.first);
        return;
    }
    std::uint32_t corner = before ? side : after;
    VertexRegion to = vertex_region_of(sides, corner, point - sides.corner(corner));
    for (std::uint32_t i = 0; i < sides.count && to.outside && !(to.along > 0 && to.along < to.length); ++i) {
        corner = to.along > 0 ? sides.after(to.side) : to.side;
        to = vertex_region_of(sides, corner, point - sides.corner(corner));
    }
    place.first = to.outside ? to.side : corner;
    place.second = to.outside ? sides.after(to.side) : corner;
    const DVec<2> from = point - sides.corner(corner);
    const double away = length(from);
    if (!to.outside && away > on_corner * (largest(point) + sides.size)) {
        place.gap = away;
        place.normal = lanes::double2(from.x / away, from.y / away);
    }
}

}  // namespace abut::detail
