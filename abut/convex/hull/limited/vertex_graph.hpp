#pragma once

// The vertices of a convex body with their neighbours, for support queries by hill climbing.

#include <abut/convex/hull/limited/convex_surface.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

class VertexGraph {
public:
    explicit VertexGraph(const ConvexSurface& surface);

    std::span<const DVec<3>> points() const { return points_; }

    /// The index of the support point along a direction, found from `start`.
    std::uint32_t highest(const DVec<3>& direction, std::uint32_t start) const;

    /// Gift wrapping: a plane with nothing above it rotates about one of its lines, downwards on the side of `on`,
    /// until it touches a point off the line. Returns the index of the first such point. `on` is a unit vector in the
    /// plane orthogonal to the line, `from` a point of the line; points nearer to it than `near` are on it.
    std::uint32_t first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal, double near,
                                std::uint32_t start) const;

private:
    template <class Better>
    std::uint32_t hill_climb(std::uint32_t start, Better better) const;

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> neighbours_;  ///< of all points, one after the other
    std::vector<std::uint32_t> ends_;        ///< one per point: the end of its neighbours
};

}  // namespace abut::detail
