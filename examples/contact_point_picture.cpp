// Draws different definitions of a contact point. The picture of docs/contact.md.
// example_contact_point_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>
#include <abut/query/intersection.hpp>

#include <cstdio>

namespace {

const abut::Style blue{{37, 99, 235}, 2, {37, 99, 235, 38}}, orange{{217, 119, 6}, 2, {245, 158, 11, 56}};
const abut::Style mark{{225, 29, 72}, 2, {225, 29, 72, 50}}, help{{225, 29, 72, 150}, 1.5f, abut::transparent, true};

/// The pair drawn in each panel.
struct Pair {
    explicit Pair(float x) : a{{x, 1.9f}, {1.25f, 0.9f}}, b{{x + 0.45f, 3.25f}, {1, 0.95f}, abut::Turn::by(0.2f)} {}

    abut::Box2 a, b;
};

}  // namespace

int main(int count, char** arguments) {
    abut::SvgCanvas canvas({{0, 0}, {18, 4.9f}}, 50, {248, 250, 252});
    canvas.set_point_size(9);

    int panels = 0;
    const auto next = [&](const char* name, const char* more) {
        const float x = 1.8f + 3.6f * static_cast<float>(panels++);
        const Pair pair(x);
        draw(canvas, pair.a, blue);
        draw(canvas, pair.b, orange);
        canvas.set_text_height(18);
        canvas.text({x - 0.95f, 1.3f}, "a", blue);
        canvas.text({x + 0.3f, 3.75f}, "b", orange);
        canvas.text({x, 0.62f}, name, {{30, 41, 59}});
        canvas.set_text_height(14);
        canvas.text({x, 0.25f}, more, {{100, 116, 139}});
        return pair;
    };

    {
        const Pair pair = next("on a", "at the deepest");
        canvas.point(closest(pair.a, pair.b).on_a, mark);
    }
    {
        const Pair pair = next("on b", "at the deepest");
        canvas.point(closest(pair.a, pair.b).on_b, mark);
    }
    {
        const Pair pair = next("midway", "two, each with a depth");
        draw(canvas, contact(pair.a, pair.b), mark);
    }
    {
        const Pair pair = next("on one face", "a's, where it faces b");
        const abut::Contact<2> contact = abut::contact(pair.a, pair.b);
        for (const float side : {-pair.a.half.x, pair.a.half.x})
            canvas.line(pair.a.center + abut::Vec2(side, 0), pair.a.center + abut::Vec2(side, 2.6f), help);
        for (const abut::ContactPoint<2>& point : contact.points) {
            const abut::Vec2 half = contact.normal * (0.5f * point.depth);
            canvas.line(point.position - half, point.position + half, help);
            canvas.point(point.position + half, mark);
        }
    }
    {
        const Pair pair = next("in the middle", "of the overlap's area");
        abut::Polygon overlap;
        if (!abut::intersection(pair.a, pair.b, overlap)) return 1;
        draw(canvas, overlap, mark);
        canvas.point(overlap.centroid(), mark);
    }

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
