#pragma once

// Pictures as SVG: the canvas for documentation, reports and tests.

#include <abut/draw/canvas.hpp>

#include <string>

namespace abut {

/// A part of the plane at a number of pixels a unit; y points up in the world and down in the picture. Numbers are
/// written to 1/100 of a pixel, the same everywhere: equal drawings make equal documents, byte by byte.
class SvgCanvas final : public Canvas<2> {
public:
    /// `shown` is finite, `pixels_a_unit` above zero. Without a background the picture is transparent.
    SvgCanvas(const Aabb2& shown, float pixels_a_unit, Color background = transparent);

    /// What follows is drawn with texts so many pixels high (by default 14) and points so many pixels wide (by default
    /// 7).
    void set_text_height(float pixels) { text_height_ = pixels; }
    void set_point_size(float pixels) { point_size_ = pixels; }

    Aabb2 shown() const override { return shown_; }
    void line(const Vec2& a, const Vec2& b, const Style& style) override;
    void point(const Vec2& position, const Style& style) override;
    void polygon(std::span<const Vec2> points, const Style& style) override;
    void ball(const Vec2& center, float radius, const Style& style) override;
    void text(const Vec2& position, std::string_view text, const Style& style) override;

    /// The whole document, with all that was drawn so far.
    std::string document() const;

private:
    std::string x(const Vec2& position) const;
    std::string y(const Vec2& position) const;

    Aabb2 shown_;
    double scale_;
    Color background_;
    float text_height_ = 14, point_size_ = 7;
    std::string body_;
};

}  // namespace abut
