// Draws the path of a character through a 2D level. The picture of docs/mover.md.
// example_mover_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>

int main(int count, char** arguments) {
    const abut::Style ground{{100, 116, 139}, 1.5f, {100, 116, 139, 60}}, lift{{217, 119, 6}, 2, {245, 158, 11, 56}};
    const abut::Style path{{225, 29, 72}, 2}, ghost{{37, 99, 235, 90}, 1.2f, {37, 99, 235, 14}};

    abut::World2 world;
    for (int i = 0; i < 6; ++i)  // a floor of tiles
        world.add(abut::Box2{{static_cast<float>(i) + 0.5f, -0.5f}, {0.5f, 0.5f}}, {.fixed = true});
    for (int i = 0; i < 3; ++i)  // stairs
        world.add(abut::Box2{{6.4f + 0.8f * static_cast<float>(i), 0.125f * static_cast<float>(i) - 0.375f},
                             {0.4f, 0.125f * static_cast<float>(i) + 0.625f}},
                  {.fixed = true});
    world.add(*abut::Polygon::build({{8.4f, -1}, {8.4f, 0.75f}, {11.5f, -0.6f}, {11.5f, -1}}),
              {.fixed = true});  // a slope
    world.add(abut::Box2{{12.5f, -0.8f}, {1, 0.2f}}, {.fixed = true});
    world.add(abut::Box2{{17.9f, 1.2f}, {1.5f, 0.2f}}, {.fixed = true});
    const abut::Box2 deck{{14.9f, -0.7f}, {1.2f, 0.12f}};
    const abut::Id ride = world.add(deck);

    abut::SvgCanvas canvas({{-0.2f, -1.2f}, {19.6f, 3.9f}}, 46, {248, 250, 252});
    abut::Mover2 mover;
    const abut::Capsule2 hero{{0, -0.35f}, {0, 0.35f}, 0.35f};
    abut::Vec2 position{0.6f, 3}, velocity{3, 0};
    for (int frame = 0; frame < 500; ++frame) {
        const float dt = 1.0f / 60;
        velocity.y -= 20 * dt;
        velocity.x = frame > 310 && frame < 440 ? 0.0f : 3.0f;  // waits on the lift
        if (frame > 320 && frame < 440) world.move(ride, {{0, 2.1f * static_cast<float>(frame - 320) / 120}});
        const auto moved = mover.move(world, hero, position, velocity * dt);
        canvas.line(position, moved.position, path);
        position = moved.position;
        if (moved.grounded) velocity.y = 0;
        if (frame % 24 == 0) draw(canvas, at(hero, abut::Pose2{position}), ghost);
    }
    draw(canvas, world, ground);
    draw(canvas, deck, lift);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    const bool written = file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0;
    return written && position.x > 17 ? 0 : 1;
}
