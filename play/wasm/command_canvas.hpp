#pragma once

// A canvas that records what is drawn as numbers, which the page draws again: an operation, a number of points, and the
// points.

#include <abut/c/detail/handles.hpp>
#include <abut/draw/canvas.hpp>

#include <cstring>

namespace abut::play {

/// The page has the same numbers in `stage/drawing.ts`.
enum class Operation { line = 1, point = 2, polygon = 3, filled_polygon = 4, faint_polygon = 5 };

template <int D>
class CommandCanvas final : public Canvas<D> {
public:
    explicit CommandCanvas(const Aabb<D>& shown) : shown_(shown) {}

    Aabb<D> shown() const override { return shown_; }
    void line(const Vec<D>& a, const Vec<D>& b, const Style&) override { add(Operation::line, std::array{a, b}); }
    void point(const Vec<D>& position, const Style&) override { add(Operation::point, std::array{position}); }
    void polygon(std::span<const Vec<D>> points, const Style& style) override {
        const bool is_faint = style.fill.alpha < 255;
        add(!style.fill.visible() ? Operation::polygon
            : is_faint            ? Operation::faint_polygon
                                  : Operation::filled_polygon,
            points);
    }

    /// Replaces the bytes of the buffer.
    void write(abut_buffer& out) const {
        const auto bytes = std::as_bytes(std::span(numbers_));
        out.bytes.assign(bytes.begin(), bytes.end());
    }

private:
    void add(Operation operation, std::span<const Vec<D>> points) {
        numbers_.push_back(static_cast<float>(operation));
        numbers_.push_back(static_cast<float>(points.size()));
        for (const Vec<D>& point : points)
            for (int i = 0; i < D; ++i) numbers_.push_back(point[i]);
    }

    Aabb<D> shown_;
    std::vector<float> numbers_;
};

/// A style with an area or without.
inline Style style_of(bool filled) {
    Style style;
    if (filled) style.fill = style.stroke;
    return style;
}

}  // namespace abut::play
