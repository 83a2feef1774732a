#pragma once

// An SVG canvas for documentation, reports and tests.

#include <abut/draw/canvas.hpp>

#include <string>

namespace abut {

/// A rectangle of the plane at a number of pixels per unit; y points up in the world and down in the picture. Numbers
/// are written to 1/100 of a pixel. Equal drawings give equal documents on every machine, byte by byte.
class SvgCanvas final : public Canvas<2> {
public:
    /// `shown` is finite, `pixels_a_unit` positive. Without a background the picture is transparent.
    SvgCanvas(const Aabb2& shown, float pixels_a_unit, Color background = transparent);

    /// The height of texts (default 14 pixels) and the size of points (default 7 pixels) for what is drawn next.
    void set_text_height(float pixels) { text_height_ = pixels; }
    void set_point_size(float pixels) { point_size_ = pixels; }

    Aabb2 shown() const override { return shown_; }
    void line(const Vec2& a, const Vec2& b, const Style& style) override;
    void point(const Vec2& position, const Style& style) override;
    void polygon(std::span<const Vec2> points, const Style& style) override;
    void ball(const Vec2& center, float radius, const Style& style) override;
    void text(const Vec2& position, std::string_view text, const Style& style) override;

    /// The whole document with everything drawn so far.
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
