#pragma once

// What the sweep has seen of the inside of an outline and not yet cut into triangles.

#include <abut/bake/outline_sweep.hpp>

namespace abut::outline {

/// The front of what is done between two edges that the sweep line crosses: from the left end of the lower one to that
/// of the upper one, along which no corner is convex. So the point of it that came last is the rightmost.
struct Chain {
    std::uint32_t bottom = none, top = none, last = none;
};

/// Chains, and the triangles to the left of them.
class Chains {
public:
    explicit Chains(Triangulation& made) : made_(made) {}

    /// That of a region which begins at the point.
    Chain begin(std::uint32_t point);
    /// The point is next on the upper edge, or on the lower one.
    void add_on_top(Chain& chain, std::uint32_t point);
    void add_at_bottom(Chain& chain, std::uint32_t point);
    /// The point lies between the edges. What is above it is returned, `chain` is what is below.
    Chain split(Chain& chain, std::uint32_t point);
    /// The two end and begin with the same point, and are one from there on.
    void join(Chain& lower, const Chain& upper);

private:
    /// What is on the left of a node's line to the node above it: a half-edge up, `none` for the boundary, or, from
    /// `open` on, a line whose two sides wait for each other's half-edge.
    using Link = std::uint32_t;
    static constexpr Link open = 0x80000000u;

    struct Node {
        std::uint32_t point, below, above;
        Link link;
    };

    std::uint32_t add(std::uint32_t point, std::uint32_t below, std::uint32_t above, Link link);
    /// Cuts the triangles off that are convex corners of the chain beside one of its ends.
    void cut_below(std::uint32_t node);
    void cut_above(std::uint32_t node);
    bool cut(std::uint32_t middle);
    void join_twins(std::uint32_t half_edge, Link link);

    Triangulation& made_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> waiting_;
};

}  // namespace abut::outline
