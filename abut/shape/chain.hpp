#pragma once

// Polyline: level geometry in 2D.

#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/view/view.hpp>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace abut {

struct ChainOptions {
    /// Rays, sweeps and contacts hit a segment only from its front, the right side of the direction from its first
    /// point to its second. The front of a closed chain that runs counter-clockwise is outside. A shape that overlaps a
    /// segment is in front of it if the shortest separating direction leads to the front. A shape that entered from the
    /// back collides again once it has been clear of the segment. `overlaps`, `closest` and `contains` ignore sides.
    bool one_sided = false;
};

/// The union of its segments, of zero thickness. Part i goes from point i to the next; the last part of a closed chain
/// goes back to the first point. Only `contains` treats a closed chain as solid, where its winding number isn't zero.
/// A chain may cross and overlap itself. Immutable: copies share the data. Memory: the points, and about 50 bytes a
/// segment for the tree.
class Chain {
public:
    /// Takes at least two points, or three for a closed chain. Returns a Problem if there are fewer, if a coordinate is
    /// not finite (index: the point) or if a segment has no length (index: the segment).
    static Result<Chain> build(const PointSpan<2>& points, bool closed, const ChainOptions& options = {});
    static Result<Chain> build(std::initializer_list<Vec2> points, bool closed, const ChainOptions& options = {});

    std::span<const Vec2> points() const;
    bool closed() const;
    bool one_sided() const;

    std::uint32_t size() const;  ///< number of segments
    Segment2 segment(std::uint32_t index) const;

    /// The adjacent segment at end 0 (first point) or 1 (second point), or no_neighbour.
    std::uint32_t neighbour(std::uint32_t segment, std::uint32_t end) const;

private:
    struct Data;
    explicit Chain(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    friend Aabb2 bounds(const Chain& chain);
    friend void each_part(const Chain& chain, const Aabb2& box, detail::PartVisitor<2> visit);
    friend void each_part_along(const Chain& chain, const MovingBox<2>& box, detail::PartReachVisitor<2> visit);
    friend void each_part_near(const Chain& chain, const Aabb2& box, detail::PartReachVisitor<2> visit);
    friend bool solid_contains(const Chain& chain, const Vec2& point);
    friend std::vector<std::byte> save(const Chain& chain);
    friend Result<Chain> load_chain(std::span<const std::byte> bytes);

    std::shared_ptr<const Data> data_;
};

Aabb2 bounds(const Chain& chain);

/// Visits the segments whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Chain& chain, const Aabb2& box, detail::PartVisitor<2> visit);

/// Visits the segments whose boxes the moving box overlaps, roughly front to back. The visitor returns the new, shorter
/// reach.
void each_part_along(const Chain& chain, const MovingBox<2>& box, detail::PartReachVisitor<2> visit);

/// Visits the segments, roughly nearest first by the distance of their boxes to `box`. The visitor returns the new,
/// shorter reach.
void each_part_near(const Chain& chain, const Aabb2& box, detail::PartReachVisitor<2> visit);

/// True if a closed chain winds around the point, decided exactly; false for an open chain. Points on the chain itself
/// are left to the tests of its segments.
bool solid_contains(const Chain& chain, const Vec2& point);

inline std::uint32_t part_neighbour(const Chain& chain, std::uint32_t part, std::uint32_t side) {
    return chain.neighbour(part, side);
}

namespace detail {

template <>
inline constexpr CompositeKind composite_kind<Chain> = CompositeKind::chain;

}  // namespace detail

}  // namespace abut
