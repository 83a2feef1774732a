#pragma once

// What the peers' narrow phases are asked, each in the words of its own library: one file a peer.
// Their shapes are the same to the last bit of a float, and without Bullet's and Box2D's usual margins, which would
// round them.

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

// Narrow phase: one value a pair. Closest: the distance, signed where that is asked for. Overlaps: 1 or 0. Contact: the
// depth, or -1 without one. Coherent: each call is about the next frame, and what can be kept of the last one is.

enum class Frames { unlike, coherent };

/// GJK, and where they may overlap an expanding polytope.
Side bullet_closest(const scenes::ConvexPairs<3>& scene);
/// GJK alone, for what is apart; from the last axis where frames are coherent.
Side bullet_gap(const scenes::ConvexPairs<3>& scene, Frames frames = Frames::unlike);
Side bullet_closest_of_capsules(const scenes::ConvexPairs<3>& scene);
Side bullet_closest_of_sphere_and_box(const scenes::ConvexPairs<3>& scene);
/// By Minkowski portal refinement.
Side bullet_overlaps(const scenes::ConvexPairs<3>& scene);
Side bullet_overlaps_of_boxes(const scenes::ConvexPairs<3>& scene);
Side bullet_contact_of_boxes(const scenes::ConvexPairs<3>& scene);
Side bullet_contact_of_hulls(const scenes::ConvexPairs<3>& scene);
/// By the polytope search's own GJK in place of the usual one: quicker, and it misses some.
Side bullet_contact_of_hulls_by_epa(const scenes::ConvexPairs<3>& scene);
/// A capsule and a box.
Side bullet_contact(const scenes::ConvexPairs<3>& scene);

// FCL by the solver it takes by default. Its own one was slower nearly everywhere, and off in one pair of a few
// hundred, and has nothing to keep from frame to frame that made it quicker.

/// Of what is apart; of capsules and of spheres in any case.
Side fcl_closest(const scenes::ConvexPairs<3>& scene);
Side fcl_signed_closest(const scenes::ConvexPairs<3>& scene);
Side fcl_overlaps(const scenes::ConvexPairs<3>& scene);
Side fcl_contact_of_boxes(const scenes::ConvexPairs<3>& scene);
/// By its signed distance: no contact points, but the least depth, which collide() looks for in boxes alone.
Side fcl_depth(const scenes::ConvexPairs<3>& scene);
/// The same of pairs that seldom touch: collide() tells which.
Side fcl_depth_of_few(const scenes::ConvexPairs<3>& scene);

// libccd called directly.

/// By Minkowski portal refinement.
Side ccd_overlaps(const scenes::ConvexPairs<3>& scene);
/// The depth by its expanding polytope: one point.
Side ccd_depth(const scenes::ConvexPairs<3>& scene);

Side box2d_closest(const scenes::ConvexPairs<2>& scene, Frames frames = Frames::unlike);
Side box2d_overlaps(const scenes::ConvexPairs<2>& scene);
Side box2d_contact_of_polygons(const scenes::ConvexPairs<2>& scene);
/// A is the polygon.
Side box2d_contact_of_polygon_and_circle(const scenes::ConvexPairs<2>& scene);

/// Rays against one shape each.
template <int D>
struct RayScene {
    std::vector<scenes::AnyConvex<D>> shapes;
    std::vector<scenes::Placed<D>> targets;
    std::vector<Ray<D>> rays;
};
/// The distance along the ray, or -1 for a miss.
Side bullet_raycast(const RayScene<3>& scene);
/// By the other one of Bullet's two casts, which is slower, and for capsules the better one.
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
