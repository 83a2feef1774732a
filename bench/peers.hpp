#pragma once

// The peers' narrow phases, each through its own library: one file per peer.
// Shapes are equal to the last bit of a float, without Bullet's and Box2D's default margins, which would round them.

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

// Narrow phase: one value per pair. Closest: the distance, signed if requested. Overlaps: 1 or 0. Contact: the depth,
// or -1 without one. Coherent: each call is about the next frame, with warm starts.

enum class Frames { unlike, coherent };

/// GJK, and EPA where they may overlap.
Side bullet_closest(const scenes::ConvexPairs<3>& scene);
/// GJK only, for separate shapes; warm started from the last axis for coherent frames.
Side bullet_gap(const scenes::ConvexPairs<3>& scene, Frames frames = Frames::unlike);
Side bullet_closest_of_capsules(const scenes::ConvexPairs<3>& scene);
Side bullet_closest_of_sphere_and_box(const scenes::ConvexPairs<3>& scene);
/// Minkowski portal refinement.
Side bullet_overlaps(const scenes::ConvexPairs<3>& scene);
Side bullet_overlaps_of_boxes(const scenes::ConvexPairs<3>& scene);
Side bullet_contact_of_boxes(const scenes::ConvexPairs<3>& scene);
Side bullet_contact_of_hulls(const scenes::ConvexPairs<3>& scene);
/// The GJK inside of EPA instead of the default one: faster, and it misses some.
Side bullet_contact_of_hulls_by_epa(const scenes::ConvexPairs<3>& scene);
/// A capsule and a box.
Side bullet_contact(const scenes::ConvexPairs<3>& scene);

// FCL with its default solver. Its native one was slower nearly everywhere, off in one pair of a few hundred, and gains
// nothing from coherence.

/// For separate shapes; for capsules and spheres in any case.
Side fcl_closest(const scenes::ConvexPairs<3>& scene);
Side fcl_signed_closest(const scenes::ConvexPairs<3>& scene);
Side fcl_overlaps(const scenes::ConvexPairs<3>& scene);
Side fcl_contact_of_boxes(const scenes::ConvexPairs<3>& scene);
/// The signed distance: no contact points, but the minimum depth, which collide() finds for boxes only.
Side fcl_depth(const scenes::ConvexPairs<3>& scene);
/// For pairs that seldom touch: collide() selects them first.
Side fcl_depth_of_few(const scenes::ConvexPairs<3>& scene);

// libccd called directly.

/// Minkowski portal refinement.
Side ccd_overlaps(const scenes::ConvexPairs<3>& scene);
/// The depth by EPA: one point.
Side ccd_depth(const scenes::ConvexPairs<3>& scene);

Side box2d_closest(const scenes::ConvexPairs<2>& scene, Frames frames = Frames::unlike);
Side box2d_overlaps(const scenes::ConvexPairs<2>& scene);
Side box2d_contact_of_polygons(const scenes::ConvexPairs<2>& scene);
/// A is the polygon.
Side box2d_contact_of_polygon_and_circle(const scenes::ConvexPairs<2>& scene);

/// Ray casts against single shapes.
template <int D>
struct RayScene {
    std::vector<scenes::AnyConvex<D>> shapes;
    std::vector<scenes::Placed<D>> targets;
    std::vector<Ray<D>> rays;
};
/// The distance along the ray, or -1 for a miss.
Side bullet_raycast(const RayScene<3>& scene);
/// Bullet's other cast, which is slower, and more accurate for capsules.
Side bullet_raycast_by_gjk(const RayScene<3>& scene);
Side box2d_raycast(const RayScene<2>& scene);

/// Convex shapes above a mesh.
struct MeshScene {
    scenes::Terrain terrain;
    std::vector<scenes::AnyConvex<3>> shapes;
    std::vector<scenes::Placed<3>> placed;
};
Side fcl_closest_to_mesh(const MeshScene& scene);

}  // namespace abut::bench
