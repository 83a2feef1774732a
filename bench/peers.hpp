#pragma once

// What the peers are asked, each in the words of its own library: one file a peer and phase.
// Their shapes are the same to the last bit of a float, and without Bullet's usual margin, which would round them.

#include "../scenes/convex_pairs.hpp"
#include "../scenes/terrain.hpp"
#include "bench.hpp"
#include <abut/math/aabb.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::bench {

// Narrow phase: one value a pair. Closest: the distance. Overlaps: 1 or 0. Contact: the depth, or -1 without one.

Side bullet_closest(const scenes::ConvexPairs& scene);
Side bullet_overlaps_of_boxes(const scenes::ConvexPairs& scene);
Side bullet_contact_of_boxes(const scenes::ConvexPairs& scene);
Side bullet_contact_of_hulls(const scenes::ConvexPairs& scene);

Side fcl_closest(const scenes::ConvexPairs& scene);
Side fcl_overlaps(const scenes::ConvexPairs& scene);
Side fcl_contact_of_boxes(const scenes::ConvexPairs& scene);
/// By its signed distance: no contact points, but the least depth, which collide() of hulls doesn't look for.
Side fcl_depth(const scenes::ConvexPairs& scene);

/// Rays against one shape each.
struct RayScene {
    std::vector<scenes::AnyConvex> shapes;
    std::vector<scenes::Placed> targets;
    std::vector<Ray3> rays;
};
/// The distance along the ray, or -1 for a miss.
Side bullet_raycast(const RayScene& scene);

/// Convex shapes above a mesh.
struct MeshScene {
    scenes::Terrain terrain;
    std::vector<scenes::AnyConvex> shapes;
    std::vector<scenes::Placed> placed;
};
Side fcl_closest_to_mesh(const MeshScene& scene);

// Broad phase. Trees that keep fattened boxes are asked for the pairs of the boxes themselves, as abut is: one more
// comparison for each candidate, which a game would have to make as well.

/// All frames take the boxes of the scene a step further, update the tree, and count the overlapping pairs.
Side bullet_moving(std::size_t count, std::uint64_t seed);
Side fcl_moving(std::size_t count, std::uint64_t seed);
Side box2d_moving(std::size_t count, std::uint64_t seed);

/// How many boxes overlap each region.
Side bullet_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);
Side fcl_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions);

/// How many boxes each ray touches.
Side bullet_rays(std::span<const Aabb3> boxes, std::span<const Ray3> rays);

}  // namespace abut::bench
