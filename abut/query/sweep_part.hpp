#pragma once

// When two convex parts first touch, the first moving straight. For .cpp files.

#include <abut/query/hit.hpp>
#include <abut/query/part_pairs.hpp>

namespace abut {

/// How A moves, as B sees it.
template <int D>
struct Path {
    DVec<D> direction{0.0};  ///< of length 1
    double length = 0;
};

template <int D>
struct PartTouch {
    double along = 0;     ///< how far A has come
    DVec<D> normal{0.0};  ///< of length 1, from A to B
    DVec<D> point{0.0};   ///< where they touch, with A there and B where it began
    bool started_inside = false;
    Feature feature;  ///< of B
};

/// Bounds on the steps of the search; each comes nearer by all of the known gap, so a handful is usual.
inline constexpr int sweep_most_steps = 64;

/// What the search is told beside the two parts.
template <int D>
struct SweepOptions {
    Cache* cache = nullptr;             ///< where to begin; null: begins from nothing
    Trace<D>* trace = nullptr;          ///< told every step
    int most_steps = sweep_most_steps;  ///< at which it gives up, and takes the parts for touching where they are
};

/// The first touch of A, moving along the path, and B; `index` is the number of B's part. False, and `touch` is of no
/// use, where there is none.
///
/// The signed distance of convex sets is a convex function of how far the one has moved along a straight line. So the
/// plane that parts them now still parts them until the motion has crossed the gap before it, and going there is a step
/// of Newton's method on a convex function: it never goes too far, and comes to the root as quickly (conservative
/// advancement; Mirtich, "Impulse-based dynamic simulation", 1996; as a ray into the difference: van den Bergen, "Ray
/// casting against general convex objects with application to continuous collision detection", 2004). The touch has
/// both proofs: a point that both nearly have, and planes crossed no earlier.
template <int D, class A, class B>
bool part_touch(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>& options,
                PartTouch<D>& touch);

}  // namespace abut
