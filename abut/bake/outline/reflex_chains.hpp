#pragma once

// The reflex chains of the sweep: parts of the interior that are not triangulated yet.

#include <abut/bake/outline/triangulate.hpp>

namespace abut::outline {

/// The untriangulated front between two edges that the sweep line crosses. It runs from the left end of the lower edge
/// to that of the upper edge, and no corner along it is convex. The point added last is the rightmost.
struct ReflexChain {
    std::uint32_t bottom = detail::no_index, top = detail::no_index, last = detail::no_index;
};

/// The chains, and the triangles cut off to their left.
class ReflexChains {
public:
    explicit ReflexChains(Triangulation& made) : made_(made) {}

    /// Begins the chain of a region whose leftmost point is given.
    ReflexChain begin(std::uint32_t point);
    /// Adds the next point of the upper or of the lower edge.
    void add_on_top(ReflexChain& chain, std::uint32_t point);
    void add_at_bottom(ReflexChain& chain, std::uint32_t point);
    /// Splits a chain at a point between its edges. Returns the upper chain; `chain` becomes the lower one.
    ReflexChain split(ReflexChain& chain, std::uint32_t point);
    /// Joins two chains of which one ends and the other begins with the same point.
    void join(ReflexChain& lower, const ReflexChain& upper);

private:
    /// The left side of a node's line to the node above it: a half-edge that runs upwards, or `none` for the boundary.
    /// Values from `open` on are lines whose two half-edges are not known yet.
    using Link = std::uint32_t;
    static constexpr Link open = 0x80000000u;

    struct Node {
        std::uint32_t point, below, above;
        Link link;
    };

    std::uint32_t add(std::uint32_t point, std::uint32_t below, std::uint32_t above, Link link);
    /// Cuts off the triangles at convex corners of the chain, next to one of its ends.
    void cut_below(std::uint32_t node);
    void cut_above(std::uint32_t node);
    bool cut(std::uint32_t middle);
    void join_twins(std::uint32_t half_edge, Link link);

    Triangulation& made_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> open_links_;
};

}  // namespace abut::outline
