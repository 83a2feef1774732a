// Draws the Voronoi regions of a shape's features. The picture of docs/drawing.md.
// example_closest_feature_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw.hpp>

#include <cstdio>
#include <vector>

namespace {

const abut::Style outline{{30, 41, 59}, 2}, regions{{37, 99, 235, 140}, 1, {37, 99, 235, 64}};
const abut::Style walls{{37, 99, 235, 170}, 1, {37, 99, 235, 14}}, answer{{225, 29, 72}, 2};

/// A part of a canvas with its own origin and view.
class Panel final : public abut::Canvas<2> {
public:
    Panel(abut::Canvas<2>& whole, const abut::Vec2& origin) : whole_(whole), origin_(origin) {}

    abut::Aabb2 shown() const override { return {{-2.8f, -2.5f}, {2.8f, 2.7f}}; }
    void line(const abut::Vec2& a, const abut::Vec2& b, const abut::Style& style) override {
        whole_.line(origin_ + a, origin_ + b, style);
    }
    void point(const abut::Vec2& position, const abut::Style& style) override {
        whole_.point(origin_ + position, style);
    }
    void polygon(std::span<const abut::Vec2> points, const abut::Style& style) override {
        std::vector<abut::Vec2> moved(points.begin(), points.end());
        for (abut::Vec2& point : moved) point += origin_;
        whole_.polygon(moved, style);
    }

private:
    abut::Canvas<2>& whole_;
    abut::Vec2 origin_;
};

template <class S>
void draw_answers(Panel& panel, const S& shape, std::initializer_list<abut::Vec2> points) {
    draw(panel, voronoi(shape), regions);
    draw(panel, shape, outline);
    for (const abut::Vec2& point : points) {
        panel.point(point, answer);
        draw_arrow(panel, point, closest(shape, point).on_a, answer);
    }
}

}  // namespace

int main(int count, char** arguments) {
    abut::SvgCanvas canvas({{0, 0}, {18, 6.2f}}, 50, {248, 250, 252});
    Panel left(canvas, {3.1f, 3.3f}), middle(canvas, {9, 3.3f}), right(canvas, {14.9f, 3.2f});
    canvas.set_text_height(18);
    canvas.text({3.1f, 0.35f}, "outside: corners and edges", outline);
    canvas.text({9, 0.35f}, "inside: edges", outline);
    canvas.text({14.9f, 0.35f}, "in space: faces too", outline);

    const abut::Triangle2 triangle{{-1.1f, -0.6f}, {1.4f, -1}, {-0.3f, 1.1f}};
    draw_answers(left, triangle, {{-2.2f, -1.6f}, {0.1f, -2}, {2, 0.9f}, {-1.9f, 0.9f}, {-0.7f, 2.2f}, {2.4f, -1.5f}});

    const auto rock =
        abut::Polygon::build({{-1.5f, -0.5f}, {-0.4f, -1.3f}, {1.1f, -1}, {1.6f, 0.5f}, {0.3f, 1.4f}, {-1.1f, 1}});
    if (!rock) return 1;
    draw_answers(middle, *rock,
                 {{-0.9f, 0.2f}, {0.1f, -0.8f}, {0.9f, 0.4f}, {-2.3f, -1.1f}, {1.8f, 1.9f}, {0.1f, -2.1f}});

    const auto crystal = abut::Polyhedron::build(
        {{1.2f, -0.9f, -0.7f}, {1.2f, 1.2f, -0.7f}, {-1.2f, 1.1f, -0.7f}, {-1, -1.2f, -0.7f}, {0, 0, 1.5f}});
    if (!crystal) return 1;
    abut::Projected space(right, {{-3, -3, -3}, {3, 3, 3}}, {1, -2.2f, 0.9f}, {0, 0, 1});
    draw(space, voronoi(*crystal), walls);
    draw(space, *crystal, outline);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
