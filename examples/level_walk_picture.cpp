// Draws the path of a character through a level of a real game: the picture of docs/mover.md, or a level of your own.
// example_level_walk_picture freedoom1.wad [FILE]     E1M1 from above, from the player's start along a path that it
// finds
// example_level_walk_picture LEVEL.sol [FILE]         a level of Neverball from above, in which a ball rolls
// The levels come with the Debian packages freedoom and neverball-data. Without a level nothing is drawn.
#include "../scenes/neverball.hpp"
#include "../scenes/wad.hpp"
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>
#include <queue>
#include <string>

namespace {

const abut::Style wall{{71, 85, 105}, 1.2f, {100, 116, 139, 40}}, ledge{{217, 119, 6}, 1};
const abut::Style path{{225, 29, 72}, 2}, ghost{{37, 99, 235, 90}, 1.2f, {37, 99, 235, 30}};

bool write(const abut::SvgCanvas& canvas, const char* name) {
    std::FILE* file = name != nullptr ? std::fopen(name, "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 &&
           (file == stdout || std::fclose(file) == 0);
}

/// Grid cells of 16 units with clearance for a character of radius 17, the cell that is farthest from the start in
/// steps, and the path to it.
std::vector<abut::Vec2> way_through(const abut::World2& world, const abut::Aabb2& all, const abut::Vec2& start) {
    constexpr float cell = 16;
    const int columns = static_cast<int>((all.max.x - all.min.x) / cell) + 1;
    const int rows = static_cast<int>((all.max.y - all.min.y) / cell) + 1;
    const auto middle = [&](int square) {
        return all.min + cell * abut::Vec2(static_cast<float>(square % columns) + 0.5f,
                                           static_cast<float>(square / columns) + 0.5f);
    };
    const auto goes = [&](const abut::Vec2& from, const abut::Vec2& to) {
        const abut::Circle wide{from, 17};
        return world.overlapping(abut::Circle{to, 17}).empty() && !world.sweep(wide, to - from);
    };
    const int first =
        static_cast<int>((start.y - all.min.y) / cell) * columns + static_cast<int>((start.x - all.min.x) / cell);
    std::vector<int> from(static_cast<std::size_t>(columns * rows), -1);
    std::queue<int> open;
    from[static_cast<std::size_t>(first)] = first;
    open.push(first);
    int last = first;
    while (!open.empty()) {
        last = open.front();
        open.pop();
        for (const int step : {1, -1, columns, -columns}) {
            const int next = last + step;
            if (next < 0 || next >= columns * rows || from[static_cast<std::size_t>(next)] >= 0) continue;
            if (!goes(middle(last), middle(next))) continue;
            from[static_cast<std::size_t>(next)] = last;
            open.push(next);
        }
    }
    std::vector<abut::Vec2> result;
    for (; last != first; last = from[static_cast<std::size_t>(last)]) result.insert(result.begin(), middle(last));
    return result;
}

int draw_map(const char* name, const char* out) {
    const auto maps = abut::scenes::read_wad(name);
    if (!maps || maps->empty() || !maps->front().start) {
        std::fprintf(stderr, "%s\n", maps ? "no map with a player's start" : maps.problem().message.c_str());
        return 1;
    }
    const abut::scenes::WadMap& map = maps->front();
    abut::World2 world;
    abut::Aabb2 all = abut::Aabb2::empty();
    for (const auto* lines : {&map.one_sided, &map.barriers, &map.ledges})
        for (const glm::uvec2& line : *lines) {
            const abut::Segment2 segment{map.points[line.x], map.points[line.y]};
            if (lines == &map.ledges)
                world.add(*abut::Chain::build({segment.a, segment.b}, false, {.one_sided = true}), {.fixed = true});
            else
                world.add(segment, {.fixed = true});
            for (const abut::Vec2& point : {segment.a, segment.b}) all = merged(all, abut::Aabb2{point, point});
        }
    abut::SvgCanvas canvas(grown(all, 64), 900 / (all.max.x - all.min.x), {248, 250, 252});
    for (const auto* lines : {&map.one_sided, &map.barriers, &map.ledges})
        for (const glm::uvec2& line : *lines)
            canvas.line(map.points[line.x], map.points[line.y], lines == &map.ledges ? ledge : wall);

    abut::Mover2 mover({.up = {0, 0}, .step_height = 0, .stick = 0});  // seen from above there is no up
    const abut::Circle player{{0, 0}, 16};
    abut::Vec2 position = *map.start;
    int frame = 0;
    bool arrived = true;
    for (const abut::Vec2& place : way_through(world, all, position)) {
        for (int i = 0; i < 20 && length(glm::dvec2(place - position)) > 9; ++i, ++frame) {
            const abut::Vec2 left = place - position;
            const auto far = static_cast<float>(length(glm::dvec2(left)));
            const auto moved = mover.move(world, player, position, left * std::min(1.0f, 8 / far));
            canvas.line(position, moved.position, path);
            position = moved.position;
            if (frame % 24 == 0) draw(canvas, at(player, abut::Pose2{position}), ghost);
        }
        arrived = arrived && length(glm::dvec2(place - position)) <= 9;
    }
    std::fprintf(stderr, "%s: %d frames\n", map.name.c_str(), frame);
    return write(canvas, out) && arrived && frame > 100 ? 0 : 1;
}

/// A projection from above: x to the right, z down.
abut::Vec2 from_above(const abut::Vec3& point) {
    return {point.x, -point.z};
}

int draw_level(const char* name, const char* out) {
    const auto level = abut::scenes::read_neverball(name);
    if (!level || level->balls.empty()) {
        std::fprintf(stderr, "%s\n", level ? "no ball" : level.problem().message.c_str());
        return 1;
    }
    abut::World3 world;
    abut::scenes::add_to(world, *level);
    abut::Aabb3 all = abut::Aabb3::empty();
    each_solid(*level, [&](const auto& body, const auto&, const abut::Polyhedron& shape) {
        all = merged(all, bounds(at(shape, abut::Pose3{start_of(*level, body)})));
    });
    const abut::Vec2 one = from_above(all.min), two = from_above(all.max);
    const abut::Aabb2 shown{{one.x, two.y}, {two.x, one.y}};
    abut::SvgCanvas canvas(grown(shown, 1), 800 / (shown.max.x - shown.min.x), {248, 250, 252});
    each_solid(*level, [&](const auto& body, const auto&, const abut::Polyhedron& shape) {
        std::vector<abut::Vec2> outline;
        for (const abut::Vec3& point : shape.points()) outline.push_back(from_above(point + start_of(*level, body)));
        draw(canvas, *abut::Polygon::build(outline), wall);
    });
    for (const auto& goal : level->goals) canvas.ball(from_above(goal.position), goal.radius, ledge);

    const float radius = level->balls[0].radius;
    const abut::Sphere ball{{0, 0, 0}, radius};
    abut::Mover3 mover({.step_height = 0.5f * radius, .stick = 0.5f * radius});
    abut::Vec3 position = level->balls[0].position;
    float fall = 0;
    int turn = 0;
    // Goes straight on until a wall or the end of the ground, then turns left.
    const std::array<abut::Vec3, 4> directions{{{0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {1, 0, 0}}};
    for (int frame = 0; frame < 6000; ++frame) {
        const abut::Vec3 ahead = directions[static_cast<std::size_t>(turn % 4)] * (0.1f * radius);
        const bool ends = !world.raycast(abut::Ray3{position + ahead * 12.0f, {0, -1, 0}, 6 * radius});
        if (ends && fall < 0.02f) {
            ++turn;
            continue;
        }
        fall = std::min(fall + 0.005f, 0.2f);
        const auto moved = mover.move(world, ball, position, ahead + abut::Vec3(0, -fall, 0));
        canvas.line(from_above(position), from_above(moved.position), path);
        if (length(glm::dvec3(moved.position - position)) < 0.05 * static_cast<double>(radius)) ++turn;
        position = moved.position;
        if (moved.grounded) fall = 0.01f;
        if (frame % 200 == 0) canvas.ball(from_above(position), radius, ghost);
    }
    return write(canvas, out) ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) return 0;
    const std::string name = arguments[1];
    const char* out = count > 2 ? arguments[2] : nullptr;
    return name.ends_with(".sol") ? draw_level(arguments[1], out) : draw_map(arguments[1], out);
}
