#include <abut/convex/plane_point.hpp>

namespace abut {

/// Inside, it is beside the next side that it lies nearest to; outside, of sides that lie on one line, to rounding, not
/// the right one may have been found.
void look_past_side(const Sides& sides, const DVec<2>& point, PlaceOfPoint& place) {
    const std::uint32_t side = place.first, after = sides.after(side);
    const bool before = dot(sides.along(side), point - sides.corner(side)) < 0;
    if (!(place.gap > 0) && sides.count > 2) {
        place.first = before ? sides.before(side) : after;
        place.second = sides.after(place.first);
        return;
    }
    std::uint32_t corner = before ? side : after;
    Lean to = lean(sides, corner, point - sides.corner(corner));
    for (std::uint32_t i = 0; i < sides.count && to.leans && !(to.along > 0 && to.along < to.length); ++i) {
        corner = to.along > 0 ? sides.after(to.side) : to.side;
        to = lean(sides, corner, point - sides.corner(corner));
    }
    place.first = to.leans ? to.side : corner;
    place.second = to.leans ? sides.after(to.side) : corner;
    const DVec<2> from = point - sides.corner(corner);
    const double away = length(from);
    if (!to.leans && away > on_corner * (largest(point) + sides.size)) {
        place.gap = away;
        place.normal = lanes::both(from.x / away, from.y / away);
    }
}

}  // namespace abut
