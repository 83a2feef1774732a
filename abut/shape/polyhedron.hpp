#pragma once

// The convex polyhedron: the hull of any points of space with its faces, as a value.

#include <abut/convex/bounding_ball.hpp>
#include <abut/convex/hull_options.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/given.hpp>

#include <initializer_list>
#include <memory>
#include <span>

namespace abut {

/// Convex, solid, of any number of corners; without build() the single point 0. Points that lie in a plane, on a line
/// or all in one place make a valid polyhedron of no volume. Copies are cheap and share what was built, which never
/// changes: spans and views of it stay valid as long as any copy lives.
class Polyhedron {
public:
    Polyhedron() = default;

    /// The hull of the points, in any order, copies allowed, n log n for n points of any usual shape. A Problem only
    /// where there are none (`empty_input`) or one is NaN or infinite (`not_finite`, with its index). A point
    /// within 1.2e-7 of the extent (the longest side of the bounding box) of the hull of the others may be left out of
    /// it.
    static Result<Polyhedron> build(std::span<const Vec3> points);
    static Result<Polyhedron> build(std::initializer_list<Vec3> points);

    /// The same with no more corners than `options.max_vertices`. Where the hull has more, this is a larger polyhedron
    /// with corners of its own, by as little volume as is found: it has every point of the input within the convex hull
    /// of its corners, exactly. Points that lie in a plane stay in it, and are held as seen along the axis nearest to
    /// its normal. Otherwise it is the hull, bit by bit. A Problem as well where the limit is below 4 (`bad_argument`),
    /// or such corners are beyond the range of floats (`too_large`). See docs/limited_hulls.md.
    static Result<Polyhedron> build(std::span<const Vec3> points, const HullOptions& options);

    /// The corners, in lexicographical order. They are points of the input, unless a limit made others, and don't
    /// depend on its order.
    std::span<const Vec3> points() const;

    /// The faces, in lexicographical order of their loops, each from its lowest point number. Every edge belongs to two
    /// faces, one each way. Neighbours whose corners lie in a slab 1e-6 of the extent thick, with a convex outline, are
    /// one face. A flat polygon has two faces back to back; a segment or a point has none.
    const Facets& facets() const;

    /// One a face: the face's plane is dot(normal, p) == offset. No point of the input is above it, whether it became a
    /// corner or not: dot(normal, p) <= offset as double has it. Across an axis, and where the shape is flat, the plane
    /// touches the farthest of them; elsewhere it is pushed out farther by no more than 1.6e-7 of the extent, and by
    /// 4e-8 where no point was left out. The corners of a face lie below its plane by no more than 1.3e-6 of the
    /// extent. In double, as the planes of distant shapes need it.
    std::span<const double> offsets() const;

    /// 0: a point, 1: a segment, 2: a flat polygon, 3: a solid. No thicker than 1.2e-7 of the extent counts as flat.
    int rank() const;

    /// In double: a volume leaves the range of float long before its corners do.
    double volume() const;

    /// Of all faces; of a flat polygon both.
    double area() const;

    /// The centre of gravity: of the volume, or of the polygon, segment or point where there is none.
    Vec3 centroid() const;

    /// Of length 1, out of the largest face (the first of several); of a segment, at right angles to it; of a point,
    /// the first axis. Of the thin or flat overlap of two shapes it is that of the plane they touch in, to either side.
    Vec3 normal() const;

    /// A ball that holds all corners, to the rounding of doubles.
    BoundingBall<3> ball() const;

    /// The corners once more, for vector units; null where there are none of use to them.
    const PointLanes* lanes() const;

private:
    struct Data;
    std::shared_ptr<const Data> data_;  ///< null: the point 0, also after a move
};

Convex<3> convex(const Polyhedron& polyhedron, const Affine<3>& place = {});
inline Given<3> given(const Polyhedron& polyhedron) {
    return {ShapeKind::polytope, &polyhedron};
}

}  // namespace abut
