#pragma once

// A ray from mirror to mirror.

#include <abut/query/reflect.hpp>
#include <abut/world/world.hpp>

#include <concepts>

namespace abut {

/// A ray on its way through a world, one straight piece at a time. Refers to the world, which must not change.
///
/// A raycast says of mirrors without thickness, segments and triangles, that a ray which starts about on them leaves
/// them. In a corner the ray does so after each bounce; a laser knows from which side it came.
template <int D>
class Laser {
public:
    Laser(const World<D>& world, const Ray<D>& ray, const Filter& filter = {});

    /// From the last mirror on, or from the start.
    const Ray<D>& piece() const { return piece_; }
    /// What it hits, if anything.
    const std::optional<WorldHit<D>>& hit() const { return hit_; }

    /// Is thrown back by what it hits. Only where it hits something.
    void bounce();

private:
    const World<D>* world_;
    Filter filter_;
    Ray<D> piece_;
    Vec<D> seen_from_;  ///< where the last piece began that was longer than rounding
    std::optional<WorldHit<D>> hit_;
};

extern template class Laser<2>;
extern template class Laser<3>;

/// Follows a ray through a world: visit(ray, hit) for each hit in turn, where `ray` is the straight piece that ends in
/// it. It returns true where that is a mirror, and false to stop. Returns the last piece: the one that hits nothing, or
/// the one whose hit the visitor stopped at. A ray between two mirrors goes on for as long as the visitor wants.
///
/// A mirror that was just left isn't hit again unless it is hollow; in a corner each of the mirrors is hit, however
/// near to one another the hits are. Doesn't allocate.
template <int D, class F>
requires std::predicate < F&, const Ray<D>
&, const WorldHit<D>& >
       Ray<D> follow_laser(const World<D>& world, const Ray<D>& ray, F&& visit, const Filter& filter = {}) {
    Laser<D> laser(world, ray, filter);
    while (laser.hit() && visit(laser.piece(), *laser.hit())) laser.bounce();
    return laser.piece();
}

}  // namespace abut
