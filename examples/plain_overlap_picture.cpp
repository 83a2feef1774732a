// Draws the queries and their results as SVG: the picture of the README.
// example_plain_overlap_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>

int main(int count, char** arguments) {
    const abut::Style blue{{37, 99, 235}, 2, {37, 99, 235, 38}}, orange{{217, 119, 6}, 2, {245, 158, 11, 56}};
    const abut::Style answer{{225, 29, 72}, 2}, missed{{217, 119, 6, 130}, 1.5f, abut::transparent, true};
    abut::SvgCanvas canvas({{0, 0}, {18, 6.2f}}, 50, {248, 250, 252});

    const auto name = [&](abut::Vec2 position, const char* text, const abut::Style& style) {
        canvas.set_text_height(18);
        canvas.text(position, text, style);
    };
    const auto label = [&](float x, const char* question, const char* format, double number) {
        char text[32];
        std::snprintf(text, sizeof text, format, number);
        name({x, 0.9f}, question, {{30, 41, 59}});
        canvas.set_text_height(14);
        canvas.text({x, 0.45f}, text, {{100, 116, 139}});
    };

    // Closest points and distance.
    const auto crate = abut::rounded(abut::Box2{{1.9f, 2.5f}, {0.8f, 0.5f}, abut::Turn::by(0.5f)}, 0.2f);
    const auto rock = abut::Polygon::build({{4.2f, 4}, {5.3f, 3.7f}, {5.7f, 4.7f}, {4.9f, 5.6f}, {3.9f, 5.1f}});
    if (!rock) return 1;
    const abut::Closest<2> gap = abut::closest(crate, *rock);
    draw(canvas, crate, blue);
    draw(canvas, *rock, orange);
    draw(canvas, gap, answer);
    name({1.9f, 2.5f}, "a", blue);
    name({4.8f, 4.65f}, "b", orange);
    label(3.2f, "closest(a, b)", "%.2f apart", gap.distance);

    // Contact points, normal and depth.
    const abut::Box2 table{{8.4f, 2.4f}, {1.7f, 0.75f}};
    const abut::Box2 box{{9.8f, 3.85f}, {1, 0.9f}, abut::Turn::by(0.16f)};
    const abut::Contact<2> contact = abut::contact(table, box);
    draw(canvas, table, blue);
    draw(canvas, box, orange);
    draw(canvas, contact, answer);
    name({8.1f, 2.4f}, "a", blue);
    name({10.5f, 4.2f}, "b", orange);
    label(8.8f, "contact(a, b)", "%.2f deep", contact.depth);

    // The first hit of a ray.
    const abut::Capsule2 pill{{14, 2.3f}, {16.2f, 3.1f}, 0.75f};
    const auto ray = abut::Ray2::between({12.7f, 5.5f}, {16.1f, 1.6f});
    const auto hit = abut::raycast(ray, pill);
    if (!hit) return 1;
    draw(canvas, pill, blue);
    canvas.line(hit->point, ray.origin + ray.direction * ray.length, missed);
    draw(canvas, abut::Ray2::between(ray.origin, hit->point), orange);
    draw(canvas, *hit, answer);
    name({14.2f, 2.35f}, "a", blue);
    name({12.9f, 4.4f}, "ray", orange);
    label(15, "raycast(ray, a)", "a hit after %.2f", hit->distance);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
