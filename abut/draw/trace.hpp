#pragma once

// Draws the steps that the engines traced.

#include <abut/convex/gjk/trace.hpp>
#include <abut/draw/canvas.hpp>

namespace abut {

/// Draws every step with its number in the trace, from 1; later ones are stronger.
///
/// - GJK: the simplex, and the line from the origin to its closest point. EPA: the face with its normal, and the line
///   from the origin to its plane. Conservative advancement: the ray so far, and from its end to the plane (dashed) up
///   to which it may advance. All lie in the Minkowski difference A - B, whose origin is marked.
/// - A separating axis: the projections of A (a line) and B (dashed), side by side, away from the center of the view.
/// - Clipping: the line or plane that clips, dashed, and the remaining part, filled if the style has a fill.
///
/// The Minkowski difference, axes and clips rarely fit on one canvas: clear the trace between queries, or use one
/// canvas per kind. Steps with NaN or infinite numbers are not drawn.
template <int D>
void draw(Canvas<D>& canvas, const Trace<D>& trace, const Style& style = {});

}  // namespace abut
