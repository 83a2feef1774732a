#pragma once

// The peers' broad phases, each through its own library. Peers with fattened boxes must report the pairs of the exact
// boxes, as abut does: one more test per candidate, which a game would need too.

#include "../bench.hpp"
#include "box_scene.hpp"
#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <span>

namespace abut::bench {

/// The start of a frame: with the last frame's structure, or a new one.
enum class Upkeep { update, scratch };

// Counts overlapping pairs per frame.

Side bullet_tree_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Ignores Upkeep::scratch.
Side bullet_sweep_pairs(const MakeScene<3>& make, Upkeep upkeep);
Side fcl_tree_pairs(const MakeScene<3>& make, Upkeep upkeep);
Side fcl_sweep_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Has no state between frames.
Side embree_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Has no state between frames.
template <int D>
Side cgal_pairs(const MakeScene<D>& make, Upkeep upkeep);
/// Ignores Upkeep::scratch.
Side box2d_pairs(const MakeScene<2>& make, Upkeep upkeep);

// Queries of static boxes. One value per query.

/// The count of boxes that overlap each region.
Side bullet_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);
Side fcl_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);

/// The count of boxes that each ray hits.
Side bullet_rays(std::span<const Aabb3> boxes, std::span<const Ray3> rays);

/// The distance along each ray to the first box; the ray's length for a miss.
Side bullet_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays);
Side embree_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays);

/// The sum of the distances of each point to its `count` nearest boxes.
Side fcl_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count);
Side embree_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count);

}  // namespace abut::bench
