#pragma once

// Solid level geometry as a binary space partitioning tree (BSP tree) whose leaves are solid or open. Built from
// segments in 2D, from triangles in 3D, or from brushes (convex pieces) in both.

#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/view/view.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

template <int D>
struct SolidTree;

/// The point at which a ray enters the solid.
template <int D>
struct SolidEntry {
    double along = 0;     ///< in lengths of the ray's direction
    DVec<D> normal{0.0};  ///< out of the solid, of any length
    std::uint32_t face = 0;
    bool has_face = false;  ///< false if there is no face, as in open geometry
    bool started_inside = false;
};

}  // namespace abut::detail

namespace abut {

/// A solid BSP tree. Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures" (1980);
/// Thibault, Naylor, "Set operations on polyhedra using binary space partitioning trees" (1987).
///
/// Faces are segments in 2D, with the solid on their left, so a counter-clockwise loop is solid inside. In 3D they are
/// triangles, counter-clockwise seen from the open side. One tree holds both solids and rooms: if the faces bound a
/// negative area or volume in total, as those of a room do, the solid is unbounded outside.
///
/// Closed geometry may self-overlap, repeat faces, touch itself, and be arbitrarily thin: the solid is where the
/// winding number is positive. Geometry is closed if every vertex (2D) or edge (3D) has equally many incoming and
/// outgoing faces. Open geometry also makes a tree, but its leaves are classified by their last plane: open in front
/// and solid behind. That is right if no face lies within the solid. It also applies to closed 3D surfaces with
/// T-junctions. A wall of zero thickness, two faces back to back in the open, is not solid.
///
/// Splitting planes are those of faces, or axis-aligned planes if they balance the tree better; the cost is the
/// imbalance and the number of cut faces. Coplanar faces share a node. The side of a face is decided by exact
/// predicates; the end of a cut face is accurate to about 1e-12 of the largest coordinate.
///
/// For all queries but rays and points the level is the union of its parts, which are convex and solid. They are the
/// input brushes, by index; or for faces the convex cells of the tree, numbered from 0. The depth is the shortest
/// separating translation of one part. Where parts overlap or touch, depth is that of each by itself, and normals are
/// those of the whole surface (docs/ghosts.md). Cells of an unbounded solid extend beyond the bounds of the faces by
/// their width. `nearest_face` maps an answer to a face.
///
/// Immutable: copies share the data. Memory, with the input and the parts: about 440 bytes a segment, 780 a triangle, 4
/// kilobytes a brush of nine sides.
template <int D>
class SolidBsp {
public:
    using Face = glm::vec<D, std::uint32_t>;

    /// Takes one or more faces; degenerate faces are ignored. Returns a Problem if a coordinate is not finite (index:
    /// the point) or a point index is out of range (index: the face).
    static Result<SolidBsp> build(const PointSpan<D>& points, std::span<const Face> faces);

    /// The union of brushes. Brush k is the intersection of the half-spaces from ends[k - 1] (0 for k = 0) up to
    /// ends[k]. A brush of zero volume is ignored. Faces are numbered as the half-spaces. Returns a Problem if there is
    /// no brush, a number isn't finite, `ends` isn't ascending or is out of range, or a brush is unbounded (index: the
    /// half-space or brush). Coplanar sides need the same numbers up to the sign.
    static Result<SolidBsp> from_brushes(std::span<const HalfSpace<D>> sides, std::span<const std::uint32_t> ends);

    /// True if the point is in the solid or on its boundary. Exact, except within rounding of a cut (for brushes: of a
    /// side). False for a point that isn't finite.
    bool contains(const Vec<D>& point) const;

    /// Visits the faces front to back as seen from the eye: `visit(face)` or `visit(face, std::span<const Vec<D>>
    /// corners)`, which returns nothing, or false to stop. A cut face comes in several pieces, each a segment or a
    /// convex polygon. Faces that point away from the eye are visited too.
    template <class F>
    void front_to_back(const Vec<D>& eye, F&& visit) const {
        visit_from(eye, [&visit](std::uint32_t face, std::span<const Vec<D>> corners) -> bool {
            const auto call = [&] {
                if constexpr (std::is_invocable_v<F&, std::uint32_t, std::span<const Vec<D>>>)
                    return visit(face, corners);
                else
                    return visit(face);
            };
            if constexpr (std::is_void_v<decltype(call())>) {
                call();
                return true;
            } else {
                return call();
            }
        });
    }

    /// Casts a ray of at most `length` lengths of the direction: the first point where it enters the solid. A ray that
    /// starts inside has to leave first. A ray along a face counts as in front of it. The base of raycast.
    bool enter(const Vec<D>& origin, const detail::DVec<D>& direction, double length,
               detail::SolidEntry<D>& entry) const;

    /// The face nearest to a point, the lowest index of equals; for the material of a contact. Nothing if no face has
    /// an extent or the point isn't finite.
    std::optional<std::uint32_t> nearest_face(const Vec<D>& point) const;

    /// The box around all faces.
    Aabb<D> bounds() const;

    /// The box around all parts.
    Aabb<D> part_bounds() const;
    void each_part(const Aabb<D>& box, detail::PartVisitor<D> visit) const;
    void each_part_along(const MovingBox<D>& box, detail::PartReachVisitor<D> visit) const;
    void each_part_near(const Aabb<D>& box, detail::PartReachVisitor<D> visit) const;
    std::size_t part_count() const;

    std::size_t node_count() const;
    /// The number of nodes on the longest path from the root to a leaf; at most 256.
    std::size_t depth() const;
    /// The number of faces, with cut faces counted by their pieces.
    std::size_t piece_count() const;

private:
    template <int E>
    friend std::vector<std::byte> save(const SolidBsp<E>& level);
    template <int E>
    friend Result<SolidBsp<E>> load_solid_bsp(std::span<const std::byte> bytes);

    using PieceCall = FunctionRef<bool(std::uint32_t, std::span<const Vec<D>>)>;

    explicit SolidBsp(std::shared_ptr<const detail::SolidTree<D>> tree) : tree_(std::move(tree)) {}
    void visit_from(const Vec<D>& eye, PieceCall visit) const;

    std::shared_ptr<const detail::SolidTree<D>> tree_;
};

extern template class SolidBsp<2>;
extern template class SolidBsp<3>;
using SolidBsp2 = SolidBsp<2>;
using SolidBsp3 = SolidBsp<3>;

/// The box around all parts. For an unbounded solid it extends beyond the faces.
template <int D>
Aabb<D> bounds(const SolidBsp<D>& level) {
    return level.part_bounds();
}

/// Visits the parts whose boxes overlap `box`; the visitor returns false to stop.
template <int D>
void each_part(const SolidBsp<D>& level, const Aabb<D>& box, std::type_identity_t<detail::PartVisitor<D>> visit) {
    level.each_part(box, visit);
}

/// Visits the parts whose boxes the moving box overlaps, roughly front to back. The visitor returns the new, shorter
/// reach.
template <int D>
void each_part_along(const SolidBsp<D>& level, const MovingBox<D>& box,
                     std::type_identity_t<detail::PartReachVisitor<D>> visit) {
    level.each_part_along(box, visit);
}

/// Visits the parts, roughly nearest first by the distance of their boxes to `box`. The visitor returns the new,
/// shorter reach.
template <int D>
void each_part_near(const SolidBsp<D>& level, const Aabb<D>& box,
                    std::type_identity_t<detail::PartReachVisitor<D>> visit) {
    level.each_part_near(box, visit);
}

/// True if the tree classifies the point as solid and it is within the bounds of the parts: an unbounded solid ends
/// there.
template <int D>
bool solid_contains(const SolidBsp<D>& level, const Vec<D>& point) {
    return contains(bounds(level), point) && level.contains(point);
}

namespace detail {

template <int D>
inline constexpr CompositeKind composite_kind<SolidBsp<D>> = CompositeKind::solid_bsp;

}  // namespace detail

}  // namespace abut
