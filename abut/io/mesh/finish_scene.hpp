#pragma once

// Post-processing shared by all scene readers: validation, unique names and the animation schedule.

#include <abut/io/mesh/pose.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/mesh/check_triangles.hpp>

#include <vector>

namespace abut {

struct ReadOptions {
    /// Reject a file with a triangle of zero area instead of leaving the triangle out.
    bool strict = false;
    /// Keep triangles of zero area, for callers that repair them; `strict` has no effect then.
    bool keep_degenerate = false;
    /// Read vertex normals.
    bool normals = false;
    /// Allow references to files outside of the scene's folder, such as "../shared/a.bin".
    bool allow_outside = false;
    /// Take the meshes that are drawn even where the file says what collides instead.
    bool ignore_colliders = false;
};

}  // namespace abut

namespace abut::detail {

/// What a reader of a format makes.
struct ReadScene {
    Scene scene;
    std::vector<Skin> skins;
    bool has_colliders = false;  ///< the geometry of nodes is what they collide by, and not what is drawn
};

/// Validates a scene and completes it. Triangles of zero area are counted and left out, empty geometries are removed
/// from nodes, paths become unique ("Crate", "Crate#2"), rotations are normalized, animations scheduled and skins
/// posed. Where names of nodes mean colliders (see `select_colliders`), other nodes lose their geometry. Normals that
/// aren't finite, or not one per point, are left out with a warning. Returns a Problem that names the mesh, node or
/// animation for: coordinates, transforms or keys that aren't finite, keys out of order, indices out of range, a node
/// tree more than 1000 levels deep, a scene without triangles, and, if `strict`, triangles of zero area
/// (`degenerate`).
Result<Scene> finish_scene(ReadScene read, const ReadOptions& options);

}  // namespace abut::detail
