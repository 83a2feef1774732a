// Draws a sweep in world space and in the Minkowski difference of the two shapes. The picture of docs/motion.md.
// example_sweep_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>
#include <abut/draw/trace.hpp>
#include <abut/query/minkowski_sum.hpp>

#include <cstdio>

namespace {

const abut::Style blue{{37, 99, 235}, 2, {37, 99, 235, 38}}, orange{{217, 119, 6}, 2, {245, 158, 11, 56}};
const abut::Style mark{{225, 29, 72}, 2, {225, 29, 72, 50}}, grey{{100, 116, 139}, 1.5f, {100, 116, 139, 30}};
const abut::Style faint{{37, 99, 235, 120}, 1.5f, abut::transparent, true};

/// Translates everything that is drawn.
abut::Aabb2 window(float x, float y, float width, float height) {
    return {{-x, -y}, {width - x, height - y}};
}

}  // namespace

int main(int count, char** arguments) {
    const abut::Box2 mover{{-3.2f, 1.4f}, {0.7f, 0.5f}, abut::Turn::by(0.35f)};
    const abut::Polygon wall = *abut::Polygon::build({{1.4f, -1.2f}, {2.6f, -0.4f}, {2.4f, 1.5f}, {1.2f, 0.9f}});
    const abut::Vec2 motion{5, -1.6f};

    abut::Trace<2> trace;
    const auto hit = sweep(mover, motion, wall, {.trace = &trace});
    if (!hit) return 1;

    // World space.
    abut::SvgCanvas canvas(window(4.9f, 4.9f, 8.6f, 8.2f), 60, {248, 250, 252});
    canvas.set_point_size(9);
    canvas.set_text_height(18);
    const abut::Box2 then{mover.center + motion * hit->fraction, mover.half, mover.rotation};
    draw(canvas, mover, faint);
    draw(canvas, then, blue);
    draw(canvas, wall, orange);
    canvas.line(mover.center, mover.center + motion * hit->fraction, faint);
    canvas.line(hit->point, hit->point + hit->normal * 0.8f, mark);
    canvas.point(hit->point, mark);
    canvas.text({-3.3f, 2.2f}, "a", blue);
    canvas.text({2.75f, 0.4f}, "b", orange);

    // Configuration space: the Minkowski difference, which is all translations of b that bring one of its points onto a
    // point of a.
    const abut::Polygon difference = minkowski_difference(mover, wall);
    const abut::Vec2 place{1.2f, -2.4f};
    const auto there = [&](const abut::Vec2& point) { return point * 0.55f + place; };
    std::vector<abut::Vec2> outline;
    for (const abut::Vec2& point : difference.points()) outline.push_back(there(point));
    canvas.polygon(outline, grey);
    canvas.line(there({0, 0}), there(-motion), faint);
    for (const abut::TraceStep<2>& step : trace.steps)
        if (const auto* stop = std::get_if<abut::SweepStep<2>>(&step)) canvas.point(there(stop->position), faint);
    canvas.point(there({0, 0}), grey);
    canvas.point(there(motion * -hit->fraction), mark);
    canvas.text(there({0.5f, 0.1f}), "0", grey);
    canvas.text(there({-5.6f, -0.9f}), "a - b", grey);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
