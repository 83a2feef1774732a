#pragma once

// Reflected rays: a laser from mirror to mirror.

#include <abut/query/reflect.hpp>
#include <abut/world/world.hpp>

#include <concepts>

namespace abut {

/// A ray that is reflected through a world, one straight piece at a time. Refers to the world, which must not change.
///
/// A plain raycast from a mirror without thickness (a segment or triangle) treats a start on the mirror as leaving it.
/// In a corner that fails after each bounce. A laser remembers the side it came from.
template <int D>
class Laser {
public:
    Laser(const World<D>& world, const Ray<D>& ray, const Filter& filter = {});

    /// The current straight piece, from the start or the last mirror.
    const Ray<D>& piece() const { return piece_; }
    /// The hit at the end of the piece, if any.
    const std::optional<WorldHit<D>>& hit() const { return hit_; }

    /// Reflects the ray at the current hit, which must exist.
    void bounce();

private:
    const World<D>* world_;
    Filter filter_;
    Ray<D> piece_;
    Vec<D> last_start_;  ///< start of the last piece longer than rounding
    std::optional<WorldHit<D>> hit_;
};

extern template class Laser<2>;
extern template class Laser<3>;

/// Follows a ray through a world and calls visit(ray, hit) for each hit, where `ray` is the straight piece that ends
/// there. The visitor returns true for a mirror and false to stop. Returns the last piece: the one without a hit, or
/// the one at whose hit the visitor stopped. Between two parallel mirrors only the visitor ends the loop.
///
/// A mirror that was just left isn't hit again unless it is hollow. In a corner each mirror is hit, however close the
/// hits are. Doesn't allocate.
template <int D, class F>
requires std::predicate < F&, const Ray<D>
&, const WorldHit<D>& >
       Ray<D> follow_laser(const World<D>& world, const Ray<D>& ray, F&& visit, const Filter& filter = {}) {
    Laser<D> laser(world, ray, filter);
    while (laser.hit() && visit(laser.piece(), *laser.hit())) laser.bounce();
    return laser.piece();
}

}  // namespace abut
