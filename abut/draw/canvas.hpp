#pragma once

// What draws: a few calls that the user fills with his engine's. Nothing here knows a screen.

#include <abut/math/aabb.hpp>

#include <cstdint>
#include <span>
#include <string_view>

namespace abut {

struct Color {
    std::uint8_t red = 0, green = 0, blue = 0;
    std::uint8_t alpha = 255;  ///< 0: not to be seen, 255: covers all

    bool visible() const { return alpha > 0; }

    friend bool operator==(const Color&, const Color&) = default;
};

inline constexpr Color transparent{0, 0, 0, 0};

struct Style {
    Color stroke{51, 65, 85, 255};
    float width = 1;           ///< of lines, in the canvas's own unit, most often pixels
    Color fill = transparent;  ///< of areas
    bool dashed = false;       ///< a canvas without dashes draws whole lines
};

/// Something to draw on. `line`, `point` and `shown` must be filled; the others have a plain version made of those.
template <int D>
class Canvas {
public:
    virtual ~Canvas() = default;

    /// The part of the world to be seen, finite. What has no end is cut off at it, arrows are sized by it, and parts of
    /// levels and items of worlds that lie outside are left out.
    virtual Aabb<D> shown() const = 0;

    virtual void line(const Vec<D>& a, const Vec<D>& b, const Style& style) = 0;

    /// A mark for a place, as large as is good to see.
    virtual void point(const Vec<D>& position, const Style& style) = 0;

    /// A closed line through three points or more, and the area in it. Flat and convex, except that in 3D an outline
    /// that is not to be filled may be bent. By default its lines.
    virtual void polygon(std::span<const Vec<D>> points, const Style& style);

    /// By default a polygon in 2D, the outlines across the three axes in 3D.
    virtual void ball(const Vec<D>& center, float radius, const Style& style);

    /// UTF-8, centred at the position, in the color of the stroke. By default nothing.
    virtual void text(const Vec<D>& position, std::string_view text, const Style& style);
};

extern template class Canvas<2>;
extern template class Canvas<3>;

}  // namespace abut
