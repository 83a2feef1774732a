#pragma once

// Solid level geometry as a tree of planes whose leaves are solid or open: a BSP. In 2D from segments, in 3D from
// triangles, in both from convex lumps (brushes).

#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/view.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>

namespace abut {

template <int D>
struct SolidTree;

/// Where a motion comes from the open into the solid.
template <int D>
struct SolidEntry {
    double along = 0;     ///< in lengths of the direction
    DVec<D> normal{0.0};  ///< of any length, out of the solid
    std::uint32_t face = 0;
    bool has_face = false;  ///< false where no face is there: of open geometry
    bool started_inside = false;
};

/// Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures" (1980); Thibault, Naylor, "Set
/// operations on polyhedra using binary space partitioning trees" (1987).
///
/// Faces are segments in 2D: the solid lies to the left of each, so that an outline that runs counter-clockwise is
/// solid inside. In 3D they are triangles, counter-clockwise seen from the open side. One tree holds pillars and rooms:
/// where the faces bound a negative area or volume as a whole, as those of a room do, the solid goes on without end
/// outside.
///
/// Closed geometry (every corner in 2D, every edge in 3D is left as often as it is come to) may overlap itself, repeat
/// faces, touch, and be as thin as floats allow: solid is what it winds around. Open geometry makes a tree as well:
/// there a leaf is what its last plane says, open in front and solid behind, which is right as long as no face lies
/// within the solid. So it is where closed surfaces in 3D meet in T-junctions. A wall of no thickness, two faces back
/// to back in the open, is not solid.
///
/// Planes are those of faces, where balance asks for it also such as stand across an axis; the next is the one that
/// leaves both sides alike and cuts the fewest faces. Faces in one plane share a node. On which side of a face a point
/// is, is decided exactly; where a face has been cut, the end of the piece is known to about 1e-12 of the largest
/// coordinate.
///
/// In every question but the ray's and the point's the level is the union of its parts, which are convex and solid: the
/// lumps that it was built from, by their numbers, or else, of faces, the cells that the tree cuts the solid into, from
/// 0 on. What is in them is as deep as the least way out of one of them, so where cells meet, as where lumps overlap or
/// touch, depth is that of each by itself, and normals are those of the whole surface (docs/ghosts.md). Where the solid
/// goes on without end, its cells do as far beyond the bounds of the faces as those are wide. `nearest_face` tells
/// which of the faces an answer is about.
///
/// Immutable: copies share the data. Memory, the input and the parts included: about 440 bytes a segment, 780 a
/// triangle, 4 kilobytes a lump of nine sides.
template <int D>
class SolidBsp {
public:
    using Face = glm::vec<D, std::uint32_t>;

    /// Any number of faces but zero; those of no length or area are left out. A Problem where a coordinate is not
    /// finite (its index is the point's) or an index is out of range (the face's).
    static Result<SolidBsp> build(std::span<const Vec<D>> points, std::span<const Face> faces);

    /// The union of convex lumps: the k-th is where all half-spaces from ends[k - 1] (from the first, for k = 0) up to
    /// ends[k] overlap. A lump of no volume is left out. Faces are numbered as the half-spaces are. A Problem where
    /// there is no lump, a number isn't finite, the ends aren't ascending up to the number of half-spaces, or a lump
    /// has no bound (the index is that of the half-space or lump). Sides that shall be in one plane need the same
    /// numbers, but for the sign.
    static Result<SolidBsp> from_brushes(std::span<const HalfSpace<D>> sides, std::span<const std::uint32_t> ends);

    /// Whether the point is in the solid; a point on its border is. Exact, but for points nearer to where faces cut one
    /// another than a rounding of doubles (and of brushes: nearer to a side). False of a point that isn't finite.
    bool contains(const Vec<D>& point) const;

    /// Visits the faces in an order in which none is behind a later one, seen from the eye: `visit(face)` or
    /// `visit(face, std::span<const Vec<D>> corners)`, which returns nothing, or false to stop. A face that is cut
    /// comes in pieces, each with its number; a piece is a segment or a convex polygon. Those that look away come too.
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

    /// Where something that moves from the origin along the direction, at most `length` times, comes into the solid.
    /// One that starts inside comes out first. Along a face is no way in: the ray counts as in front of it. What
    /// raycast is made of.
    bool enter(const Vec<D>& origin, const DVec<D>& direction, double length, SolidEntry<D>& entry) const;

    /// The face that is nearest to a point, of several the one of the lowest number: whose material a contact there is
    /// about. Nothing where no face has an extent, or the point isn't finite.
    std::optional<std::uint32_t> nearest_face(const Vec<D>& point) const;

    /// Of all faces.
    Aabb<D> bounds() const;

    /// Of all parts.
    Aabb<D> part_bounds() const;
    void each_part(const Aabb<D>& box, PartVisitor<D> visit) const;
    void each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const;
    void each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const;
    std::size_t part_count() const;

    std::size_t node_count() const;
    /// Of nodes on the way from the root to the deepest leaf; never above 256.
    std::size_t depth() const;
    /// Of faces, those that were cut counted by their pieces.
    std::size_t piece_count() const;

private:
    using PieceCall = FunctionRef<bool(std::uint32_t, std::span<const Vec<D>>)>;

    explicit SolidBsp(std::shared_ptr<const SolidTree<D>> tree) : tree_(std::move(tree)) {}
    void visit_from(const Vec<D>& eye, PieceCall visit) const;

    std::shared_ptr<const SolidTree<D>> tree_;
};

extern template class SolidBsp<2>;
extern template class SolidBsp<3>;
using SolidBsp2 = SolidBsp<2>;
using SolidBsp3 = SolidBsp<3>;

/// Of all parts: beyond its faces, where the solid goes on without end.
template <int D>
Aabb<D> bounds(const SolidBsp<D>& level) {
    return level.part_bounds();
}

/// Visits the parts whose boxes overlap `box`; the visitor returns false to stop.
template <int D>
void each_part(const SolidBsp<D>& level, const Aabb<D>& box, std::type_identity_t<PartVisitor<D>> visit) {
    level.each_part(box, visit);
}

/// Visits those that the moving box meets, roughly in the order in which it does; the visitor returns the new, shorter
/// reach.
template <int D>
void each_part_along(const SolidBsp<D>& level, const MovingBox<D>& box,
                     std::type_identity_t<PartReachVisitor<D>> visit) {
    level.each_part_along(box, visit);
}

/// Visits them, roughly those first whose boxes are nearest to `box`; the visitor returns the new, shorter reach.
template <int D>
void each_part_near(const SolidBsp<D>& level, const Aabb<D>& box, std::type_identity_t<PartReachVisitor<D>> visit) {
    level.each_part_near(box, visit);
}

/// Whether the point is in the solid, by the tree, as far as the parts go: solid around a room is endless to the tree.
template <int D>
bool solid_contains(const SolidBsp<D>& level, const Vec<D>& point) {
    return contains(bounds(level), point) && level.contains(point);
}

}  // namespace abut
