#pragma once

// What every reader's scene goes through: the checks that don't depend on the format, names, the clock.

#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/zero_area.hpp>

namespace abut {

struct ReadOptions {
    /// Refuse the file for a triangle of zero area, in place of leaving it out.
    bool strict = false;
    /// Keep triangles of zero area, for who mends them; `strict` has no effect then.
    bool keep_degenerate = false;
    /// Read the normals of vertices too.
    bool normals = false;
    /// Read files that the scene refers to outside of its folder too, such as "../shared/a.bin".
    bool allow_outside = false;
};

/// Checks what a reader made of a file and makes it good to use: triangles of zero area are left out and counted,
/// geometry without triangles goes, paths become unique ("Crate", "Crate#2"), rotations get length 1, the animations
/// their start. A Problem, with the mesh, node or animation and the place in it, for: coordinates, transforms or keys
/// that aren't finite, keys out of order, indices out of range, a node tree over 1000 deep, no triangles left at all,
/// and if `strict` triangles of zero area (code `degenerate`). Normals that aren't finite, or not one a point, are left
/// out with a warning.
Result<Scene> finish_scene(Scene scene, const ReadOptions& options);

}  // namespace abut
