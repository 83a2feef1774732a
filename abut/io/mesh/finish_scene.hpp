#pragma once

// Post-processing shared by all scene readers: validation, unique names and the animation schedule.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/mesh/check_triangles.hpp>

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
};

}  // namespace abut

namespace abut::detail {

/// Validates a scene and completes it. Triangles of zero area are counted and left out, empty geometries are removed
/// from nodes, paths become unique ("Crate", "Crate#2"), rotations are normalized and animations scheduled. Normals
/// that aren't finite, or not one per point, are left out with a warning. Returns a Problem that names the mesh, node
/// or animation for: coordinates, transforms or keys that aren't finite, keys out of order, indices out of range, a
/// node tree more than 1000 levels deep, a scene without triangles, and, if `strict`, triangles of zero area
/// (`degenerate`).
Result<Scene> finish_scene(Scene scene, const ReadOptions& options);

}  // namespace abut::detail
