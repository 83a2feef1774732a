// Draws a laser that is reflected by mirrors until it hits a wall. The picture of docs/laser.md.
// example_laser_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>

int main(int count, char** arguments) {
    const abut::Style mirror{{37, 99, 235}, 2, {37, 99, 235, 38}}, wall{{71, 85, 105}, 2, {71, 85, 105, 70}};
    const abut::Style light{{225, 29, 72}, 2};
    enum Kind : std::uint64_t { is_mirror, is_wall };

    abut::World2 room;
    for (const float x : {0.25f, 11.75f}) room.add(abut::Box2{{x, 3}, {0.25f, 3}}, {.user = is_wall});
    for (const float y : {0.25f, 5.75f}) room.add(abut::Box2{{6, y}, {5.5f, 0.25f}}, {.user = is_mirror});
    room.add(abut::Circle{{4.2f, 3.1f}, 0.7f}, {.user = is_mirror});
    room.add(abut::Box2{{7.6f, 2.6f}, {0.8f, 0.5f}, abut::Turn::by(0.6f)}, {.user = is_mirror});
    room.add(*abut::Polygon::build({{9, 4.2f}, {10.2f, 3.6f}, {10.4f, 4.8f}}), {.user = is_mirror});

    abut::SvgCanvas canvas({{0, 0}, {12, 6}}, 70, {248, 250, 252});
    for (const abut::Id id : room.overlapping(canvas.shown()))
        draw(canvas, room.shape(id), room.user(id) == is_wall ? wall : mirror);

    // The number of hits is limited to 50: two parallel mirrors could reflect it forever.
    int hits = 0;
    const auto each_hit = [&](const abut::Ray2& piece, const abut::WorldHit<2>& hit) {
        canvas.line(piece.origin, hit.hit.point, light);
        canvas.point(hit.hit.point, light);
        return room.user(hit.id) == is_mirror && ++hits < 50;
    };
    const abut::Ray2 last = follow_laser(room, {{0.6f, 1}, {0.5403f, 0.8415f}}, each_hit);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    const bool written = file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0;
    return written && hits > 3 && room.raycast(last) ? 0 : 1;
}
