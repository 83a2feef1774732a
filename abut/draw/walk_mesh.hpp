#pragma once

// draw(canvas, thing, style) for walk meshes, and for the ways over them.

#include <abut/draw/canvas.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cstdint>
#include <span>

namespace abut {

/// The triangles that are walked on, filled where the style says so, and their edges, each once: those with nothing
/// beyond as the style says, the others paler and half as wide. What lies outside of what the canvas shows is left out.
void draw(Canvas<3>& canvas, const WalkMesh& mesh, const Style& style = {});

/// The same in a style for each triangle, such as one for each island or area. An edge between two is drawn as the one
/// with the lower number has it.
void draw(Canvas<3>& canvas, const WalkMesh& mesh, FunctionRef<Style(std::uint32_t triangle)> style);

/// A point at the start, a line to the end with an arrow's head there, and a point at each corner between.
void draw(Canvas<3>& canvas, const WalkPath& path, const Style& style = {});
void draw_way(Canvas<3>& canvas, std::span<const Vec3> points, const Style& style = {});

/// The way of `mesh.walk(from, step)`: the places after each of 64 equal parts of the step, with a line through them as
/// through a path's, the points between left out.
void draw_walk(Canvas<3>& canvas, const WalkMesh& mesh, const WalkPoint& from, const Vec3& step,
               const Style& style = {});

}  // namespace abut
