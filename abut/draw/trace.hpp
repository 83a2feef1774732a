#pragma once

// What the engines did, step by step, as a picture.

#include <abut/convex/trace.hpp>
#include <abut/draw/canvas.hpp>

namespace abut {

/// Every step with its number in the trace, from 1, beside what it shows; later ones stronger.
///
/// - GJK: the simplex, and the line from the origin to its closest point. Penetration: the face with its normal, and
///   the line from the origin to its plane. A sweep: the ray as far as it has come, and from there to the plane
///   (dashed) that it may go on to. All lie in the difference A - B, whose origin is marked.
/// - An axis: what A (a line) and B (dashed) cover of it, side by side, off the middle of what is shown.
/// - A cut: the line or plane that cuts, dashed, and what it left, filled where the style says so.
///
/// The difference, axes and cuts seldom go well on one canvas: clear the trace between questions, or give each kind a
/// canvas of its own. Steps with numbers that are NaN or infinite are left out.
template <int D>
void draw(Canvas<D>& canvas, const Trace<D>& trace, const Style& style = {});

}  // namespace abut
