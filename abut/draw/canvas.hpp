#pragma once

// The drawing interface: a few calls that the user implements with his engine. It is independent of any screen.

#include <abut/math/aabb.hpp>

#include <cstdint>
#include <span>
#include <string_view>

namespace abut {

struct Color {
    std::uint8_t red = 0, green = 0, blue = 0;
    std::uint8_t alpha = 255;  ///< 0: invisible, 255: opaque

    bool visible() const { return alpha > 0; }

    friend bool operator==(const Color&, const Color&) = default;
};

inline constexpr Color transparent{0, 0, 0, 0};

struct Style {
    Color stroke{51, 65, 85, 255};
    float width = 1;           ///< of lines, in the canvas's own unit, mostly pixels
    Color fill = transparent;  ///< of areas
    bool dashed = false;       ///< a canvas without dashes draws solid lines
};

/// A surface to draw on. `line`, `point` and `shown` must be implemented; the others have default implementations based
/// on these.
template <int D>
class Canvas {
public:
    virtual ~Canvas() = default;

    /// The visible part of the world, finite. Unbounded shapes are clipped to it, arrows are scaled by it, and parts of
    /// levels and items of worlds outside are not drawn.
    virtual Aabb<D> shown() const = 0;

    virtual void line(const Vec<D>& a, const Vec<D>& b, const Style& style) = 0;

    /// A mark of a place, in a readable size.
    virtual void point(const Vec<D>& position, const Style& style) = 0;

    /// A closed line through at least three points, and its area. It is flat and convex; in 3D an unfilled one need not
    /// be flat. By default its lines.
    virtual void polygon(std::span<const Vec<D>> points, const Style& style);

    /// By default a polygon in 2D, and great circles across the three axes in 3D.
    virtual void ball(const Vec<D>& center, float radius, const Style& style);

    /// UTF-8, centered at the position, in the stroke's color. By default nothing.
    virtual void text(const Vec<D>& position, std::string_view text, const Style& style);
};

extern template class Canvas<2>;
extern template class Canvas<3>;

}  // namespace abut
