#pragma once

// The corners of a convex body with their neighbours, for finding the extreme ones by walking uphill.

#include <abut/convex/convex_surface.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

class InnerPoints {
public:
    explicit InnerPoints(const ConvexSurface& surface);

    std::span<const DVec<3>> points() const { return points_; }

    /// The number of the highest along a direction, found from `start`.
    std::uint32_t highest(const DVec<3>& direction, std::uint32_t start) const;

    /// A plane that nothing is above turns about one of its lines, downwards on the side of `on`, until it touches a
    /// point that isn't on the line: the number of the first one. `on` is a unit vector in the plane at right angles to
    /// the line, `from` a point of the line; what is nearer to it than `near` is on it.
    std::uint32_t first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal, double near,
                                std::uint32_t start) const;

private:
    template <class Better>
    std::uint32_t walk(std::uint32_t start, Better better) const;

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> neighbours_;  ///< of all points, one after the other
    std::vector<std::uint32_t> ends_;        ///< one a point: where its own end
};

}  // namespace abut
