#include <abut/walk/walk_strip.hpp>

namespace abut {
namespace {

/// The side by which the way leaves: from a corner on its right to one on its left. Where the way only touches the
/// triangle, or leads along a side, all corners are on the same side of it or on it, and it leaves at the nearest one.
std::uint32_t side_ahead(const DVec<2> (&corner)[3]) {
    for (std::uint32_t k = 0; k < 3; ++k)
        if (corner[k].y < 0 && corner[next_corner(k)].y >= 0) return k;
    std::uint32_t nearest = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
        const double height = std::abs(corner[k].y), least = std::abs(corner[nearest].y);
        if (height < least || (height == least && corner[k].x > corner[nearest].x)) nearest = k;
    }
    // Round it: to its right where all others are to its left.
    return corner[nearest].y < 0 ? next_corner(next_corner(nearest)) : nearest;
}

}  // namespace

WalkStrip strip_ahead(const WalkTriangle& walk, std::uint32_t triangle, const DVec<2>& at, const DVec<2>& ahead,
                      double near) {
    const WalkFrame frame(walk);
    DVec<2> corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
        const DVec<2> offset = frame.corner(k) - at;
        corner[k] = {dot(ahead, offset), cross(ahead, offset)};
        if (std::abs(corner[k].y) <= near * std::abs(corner[k].x)) corner[k].y = 0;
    }
    WalkStrip strip;
    strip.triangle = triangle;
    strip.side = side_ahead(corner);
    const std::uint32_t end = next_corner(strip.side);
    strip.right = {corner[strip.side].x, std::min(corner[strip.side].y, 0.0)};
    strip.left = {corner[end].x, std::max(corner[end].y, 0.0)};
    strip.rest = corner[next_corner(end)];
    return strip;
}

}  // namespace abut
