// A level given by a distance function: unbounded hills without a triangle. Two functions make the type a shape; balls
// roll over it in a World.
#include <abut/abut.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace game {

/// Repeated paraboloids: bumps of height 0.5 every 4 units.
struct Hills {};

float height(float x, float z) {
    const auto bump = [](float t) {
        const float off = t - 4 * std::floor(t / 4 + 0.5f);  // from the nearest summit
        return 0.25f - off * off / 16;
    };
    return bump(x) + bump(z);
}

abut::Aabb3 bounds(const Hills&) {
    constexpr float far = std::numeric_limits<float>::infinity();
    return {{-far, -far, -far}, {far, 0.5f, far}};
}

/// A lower bound of the distance: the height of a point above the hills times the cosine of the steepest slope.
float signed_distance(const Hills&, const abut::Vec3& point) {
    constexpr float steepest = 0.8164966f;  // a slope of 1/4 + 1/4 along x and z: 1 / sqrt(1 + 1/4 + 1/4)
    return (point.y - height(point.x, point.z)) * steepest;
}

}  // namespace game

int main() {
    constexpr float radius = 0.25f, time = 1.0f / 60;
    abut::World3 world;
    world.add(game::Hills(), {.fixed = true});

    struct Body {
        abut::Id id;
        abut::Vec3 position, velocity;
    };
    std::array<Body, 16> balls;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const abut::Vec3 start{1.3f * static_cast<float>(i % 4), 2 + 0.2f * static_cast<float>(i),
                               1.7f * static_cast<float>(i / 4)};
        const abut::Id id = world.add(abut::Sphere{{0, 0, 0}, radius}, {.pose = {start}, .user = i});
        balls[i] = {id, start, {0, 0, 0}};
    }

    for (int frame = 0; frame < 600; ++frame) {
        for (Body& ball : balls) {
            ball.velocity.y -= 9.8f * time;
            ball.velocity = ball.velocity * 0.999f;
            ball.position = ball.position + ball.velocity * time;
            world.move(ball.id, {ball.position});
        }
        world.update();
        for (const auto& [a, b, contact] : world.contacts()) {
            // The ground was added first, and is fixed.
            const bool on_ground = world.user(b) == 0 && a != balls[0].id;
            for (const auto& [id, side] : {std::pair(a, -1.0f), std::pair(b, 1.0f)})
                for (Body& ball : balls) {
                    if (ball.id != id) continue;
                    const abut::Vec3 out = contact.normal * side;
                    const float along = ball.velocity.x * out.x + ball.velocity.y * out.y + ball.velocity.z * out.z;
                    ball.position = ball.position + out * (contact.depth * (on_ground ? 1.0f : 0.5f));
                    if (along < 0) ball.velocity = ball.velocity - out * along;
                }
        }
    }

    float deepest = 0;
    int low = 0;
    for (const Body& ball : balls) {
        const float gap = signed_distance(game::Hills(), ball.position) - radius;
        deepest = gap < deepest ? gap : deepest;
        low += ball.position.y < 0.75f ? 1 : 0;
    }
    std::printf("%d of %zu balls came to rest in the dells, none deeper in the ground than %g\n", low, balls.size(),
                static_cast<double>(-deepest));
    return deepest > -0.02f && low > 8 ? 0 : 1;
}
