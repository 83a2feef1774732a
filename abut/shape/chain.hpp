#pragma once

// Line of the plane with corners: level geometry in 2D.

#include <abut/math/result.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/view.hpp>

#include <initializer_list>
#include <memory>
#include <span>

namespace abut {

struct ChainOptions {
    /// Rays, sweeps and contacts meet a segment only from the right of the way from its first point to its second: from
    /// outside, where a closed chain runs counter-clockwise. Which side that is of something in a segment, the least
    /// way out tells. What goes in at the back of a segment is met by it again after they have been apart. `overlaps`,
    /// `closest` and `contains` know no sides.
    bool one_sided = false;
};

/// The union of its segments, of zero thickness; part i goes from point i to the next, the last of a closed chain back
/// to the first. Only `contains` takes a closed chain as solid: what it winds around. It may cross and overlap itself.
/// Immutable: copies share the data. Memory: the points, and about 50 bytes a segment for the tree.
class Chain {
public:
    /// At least two points, of a closed chain three. A Problem where there are fewer, where a coordinate is not finite
    /// (its index is the point's), or where a segment has no length (the segment's).
    static Result<Chain> build(std::span<const Vec2> points, bool closed, const ChainOptions& options = {});
    static Result<Chain> build(std::initializer_list<Vec2> points, bool closed, const ChainOptions& options = {});

    std::span<const Vec2> points() const;
    bool closed() const;
    bool one_sided() const;

    std::uint32_t size() const;  ///< of segments
    Segment2 segment(std::uint32_t index) const;

    /// The segment that goes on at an end: 0, before the segment, 1, after it; or no_neighbour.
    std::uint32_t neighbour(std::uint32_t segment, std::uint32_t end) const;

private:
    struct Data;
    explicit Chain(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    friend Aabb2 bounds(const Chain& chain);
    friend void each_part(const Chain& chain, const Aabb2& box, PartVisitor<2> visit);
    friend void each_part_along(const Chain& chain, const MovingBox<2>& box, PartReachVisitor<2> visit);
    friend void each_part_near(const Chain& chain, const Aabb2& box, PartReachVisitor<2> visit);
    friend bool solid_contains(const Chain& chain, const Vec2& point);

    std::shared_ptr<const Data> data_;
};

Aabb2 bounds(const Chain& chain);

/// Visits the segments whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Chain& chain, const Aabb2& box, PartVisitor<2> visit);

/// Visits the segments whose boxes the moving box meets, roughly in the order in which it does; the visitor returns the
/// new, shorter reach.
void each_part_along(const Chain& chain, const MovingBox<2>& box, PartReachVisitor<2> visit);

/// Visits the segments, roughly those first whose boxes are nearest to `box`; the visitor returns the new, shorter
/// reach.
void each_part_near(const Chain& chain, const Aabb2& box, PartReachVisitor<2> visit);

/// Whether a closed chain winds around the point, decided exactly; false for an open one. Points of the line itself are
/// told by the segments.
bool solid_contains(const Chain& chain, const Vec2& point);

inline std::uint32_t part_neighbour(const Chain& chain, std::uint32_t part, std::uint32_t side) {
    return chain.neighbour(part, side);
}

}  // namespace abut
