#pragma once

// What the peers' broad phases are asked, each in the words of its own library. Those that keep fattened boxes are
// asked for the pairs of the boxes themselves, as abut is: one more comparison for each candidate, which a game would
// have to make as well.

#include "bench.hpp"
#include "box_scene.hpp"
#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <span>

namespace abut::bench {

/// How a frame begins: with the structure of the last one, or with none.
enum class Upkeep { update, scratch };

// How many pairs of boxes overlap in each frame.

Side bullet_tree_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Has no use for Upkeep::scratch.
Side bullet_sweep_pairs(const MakeScene<3>& make, Upkeep upkeep);
Side fcl_tree_pairs(const MakeScene<3>& make, Upkeep upkeep);
Side fcl_sweep_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Keeps nothing from frame to frame.
Side embree_pairs(const MakeScene<3>& make, Upkeep upkeep);
/// Keeps nothing from frame to frame.
template <int D>
Side cgal_pairs(const MakeScene<D>& make, Upkeep upkeep);
/// Has no use for Upkeep::scratch.
Side box2d_pairs(const MakeScene<2>& make, Upkeep upkeep);

// Among boxes that rest. One value a query.

/// How many boxes overlap each region.
Side bullet_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);
Side fcl_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);

/// How many boxes each ray touches.
Side bullet_rays(std::span<const Aabb3> boxes, std::span<const Ray3> rays);

/// How far along each ray the first box lies; the ray's length where there is none.
Side bullet_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays);
Side embree_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays);

/// How far each point is from the nearest `count` boxes: the sum of their distances.
Side fcl_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count);
Side embree_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count);

}  // namespace abut::bench
