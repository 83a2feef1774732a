#pragma once

// draw(canvas, thing, style) for walk meshes and paths over them.

#include <abut/draw/canvas.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstdint>
#include <span>

namespace abut {

/// Draws the walkable triangles, filled if the style has a fill, and each of their edges once: border edges in the
/// style, others paler and half as wide. Triangles outside the visible box are not drawn.
void draw(Canvas<3>& canvas, const WalkMesh& mesh, const Style& style = {});

/// As above, with a style for each triangle, such as one for each connected component or area. An edge between two
/// triangles has the style of the one with the lower number.
void draw(Canvas<3>& canvas, const WalkMesh& mesh, FunctionRef<Style(std::uint32_t triangle)> style);

/// Draws a point at the start, a line to the end with an arrow head, and a point at each corner between.
void draw(Canvas<3>& canvas, const WalkPath& path, const Style& style = {});
void draw_path(Canvas<3>& canvas, std::span<const Vec3> points, const Style& style = {});

/// Draws `mesh.walk(from, step)`: a line through the places after each of 64 equal parts of the step, without points
/// between.
void draw_walk(Canvas<3>& canvas, const WalkMesh& mesh, const WalkPoint& from, const Vec3& step,
               const Style& style = {});

}  // namespace abut
