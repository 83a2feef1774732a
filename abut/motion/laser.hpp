#pragma once

// A ray from mirror to mirror.

#include <abut/query/reflect.hpp>
#include <abut/world/world.hpp>

#include <concepts>

namespace abut {

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
    Ray<D> piece = ray;
    for (;;) {
        const std::optional<WorldHit<D>> hit = world.raycast(piece, filter);
        if (!hit || !visit(std::as_const(piece), *hit)) return piece;
        piece = reflect(piece, hit->hit);
    }
}

}  // namespace abut
