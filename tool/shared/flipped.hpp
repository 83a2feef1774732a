#pragma once

#include <abut/draw/canvas.hpp>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace abut::tool {

/// A canvas whose y axis points down, for levels. Refers to the canvas that it draws on.
class Flipped final : public Canvas<2> {
public:
    explicit Flipped(Canvas<2>& canvas) : paper_(canvas) {}

    Aabb2 shown() const override { return flipped(paper_.shown()); }
    void line(const Vec2& a, const Vec2& b, const Style& style) override { paper_.line(flipped(a), flipped(b), style); }
    void point(const Vec2& position, const Style& style) override { paper_.point(flipped(position), style); }
    void polygon(std::span<const Vec2> points, const Style& style) override {
        std::vector<Vec2> turned;
        for (const Vec2& p : points) turned.push_back(flipped(p));
        std::reverse(turned.begin(), turned.end());
        paper_.polygon(turned, style);
    }
    void ball(const Vec2& center, float radius, const Style& style) override {
        paper_.ball(flipped(center), radius, style);
    }

    void text(const Vec2& position, std::string_view text, const Style& style) override {
        paper_.text(flipped(position), text, style);
    }

    static Vec2 flipped(const Vec2& p) { return {p.x, -p.y}; }
    static Aabb2 flipped(const Aabb2& box) { return {{box.min.x, -box.max.y}, {box.max.x, -box.min.y}}; }

private:
    Canvas<2>& paper_;
};

}  // namespace abut::tool
