#pragma once

// Convex polyhedron: the convex hull of any points in space, with its faces.

#include <abut/convex/bounding_ball.hpp>
#include <abut/convex/hull/hull_options.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/view/shape_ref.hpp>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace abut {

/// A solid convex polyhedron with any number of vertices. A default-constructed polyhedron is the single point 0.
/// Coplanar, collinear or coincident points make a valid polyhedron of zero volume. Copies are cheap and share
/// immutable data: spans and views stay valid as long as any copy lives.
class Polyhedron {
public:
    Polyhedron() = default;

    /// The convex hull of the points, in any order; duplicates are allowed. It takes O(n log n) for usual inputs.
    /// Returns a Problem only if there are no points (`empty_input`) or one is NaN or infinite (`not_finite`, index:
    /// the point). Points within 1.2e-7 of the extent (the longest side of the bounding box) of the hull of the others
    /// may be dropped.
    static Result<Polyhedron> build(const PointSpan<3>& points);
    static Result<Polyhedron> build(std::initializer_list<Vec3> points);

    /// A hull with at most `options.max_vertices` vertices. If the exact hull has more, the result is a larger
    /// polyhedron with new vertices that contains every input point exactly and adds as little volume as the search
    /// finds. Coplanar points stay in their plane, and containment holds in the projection along the axis nearest to
    /// its normal. Otherwise it is the exact hull, bit for bit. Also returns a Problem if the limit is below 4
    /// (`bad_argument`) or if a vertex would leave the range of floats (`too_large`). See docs/limited_hulls.md.
    static Result<Polyhedron> build(const PointSpan<3>& points, const HullOptions& options);

    /// The vertices, in lexicographical order. They are input points, unless a vertex limit made others, and don't
    /// depend on the input's order.
    std::span<const Vec3> points() const;

    /// The faces, in lexicographical order of their loops; each loop starts at its lowest vertex. Every edge belongs to
    /// two faces, once in each direction. Neighbouring faces within a slab of 1e-6 of the extent are merged if the
    /// result is convex. A flat polygon has two faces back to back; a segment or a point has none.
    const detail::Facets& facets() const;

    /// The plane offset of each face: its plane is dot(normal, p) == offset. No input point is above it in double
    /// arithmetic, whether it became a vertex or not: dot(normal, p) <= offset. Planes across an axis, and planes of
    /// flat shapes, touch the farthest point. Other planes are pushed out by at most 1.6e-7 of the extent, or 4e-8 if
    /// no point was dropped. The vertices of a face are below its plane by at most 1.3e-6 of the extent. Offsets are
    /// double, as shapes far from the origin need it.
    std::span<const double> offsets() const;

    /// 0: a point, 1: a segment, 2: a flat polygon, 3: a solid. A hull no thicker than 1.2e-7 of its extent is flat.
    int rank() const;

    /// The volume, in double since it overflows a float long before the coordinates do.
    double volume() const;

    /// The surface area; of a flat polygon that of both faces.
    double area() const;

    /// The centroid of the volume, or of the polygon, segment or point if the volume is zero.
    Vec3 centroid() const;

    /// The unit normal of the largest face (the first of equals). For a segment it is perpendicular to it; for a point
    /// it is the first axis. For the thin overlap of two touching shapes it is the contact normal, up to the sign.
    Vec3 normal() const;

    /// A ball that contains all vertices, to the rounding of doubles.
    detail::BoundingBall<3> ball() const;

    /// The vertices as a structure of arrays for SIMD; null if it isn't useful.
    const detail::PointSoa* lanes() const;

private:
    friend std::vector<std::byte> save(const Polyhedron& polyhedron);
    friend Result<Polyhedron> load_polyhedron(std::span<const std::byte> bytes);

    struct Data;
    std::shared_ptr<const Data> data_;  ///< null: the point 0, also after a move
};

detail::Convex<3> convex(const Polyhedron& polyhedron, const detail::Affine<3>& place = {});
inline detail::ShapeRef<3> shape_ref(const Polyhedron& polyhedron) {
    return {detail::ShapeKind::polytope, &polyhedron};
}

}  // namespace abut
