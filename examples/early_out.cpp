// Orders the tests that decide whether a guard sees the player: the test that rejects most per cost goes first.
#include <abut/abut.hpp>
#include <abut/query/early_out.hpp>

#include <cstdio>

int main() {
    struct Guard {
        abut::Vec2 place, facing;
    };
    const abut::Vec2 player{20, 30};
    abut::World2 walls;
    for (int i = 0; i < 50; ++i) {
        const abut::Vec2 place{static_cast<float>(i * 37 % 100), static_cast<float>(i * 61 % 100)};
        walls.add(abut::Box2{place, {2, 1}}, {.fixed = true});
    }
    walls.update();

    const auto not_hidden = [&](const Guard& guard) {
        return !walls.raycast(abut::Ray2::between(guard.place, player));
    };
    const auto in_front = [&](const Guard& guard) { return glm::dot(player - guard.place, guard.facing) > 0; };
    const auto in_range = [&](const Guard& guard) {
        const abut::Vec2 to_player = player - guard.place;
        return glm::dot(to_player, to_player) < 15 * 15;
    };

    // The ray cast, the most expensive test, is listed first. It doesn't stay first.
    abut::EarlyOut sees{not_hidden, in_front, in_range};
    int seen = 0;
    for (int frame = 0; frame < 10; ++frame) {
        seen = 0;
        for (int i = 0; i < 4000; ++i) {
            const Guard guard{{static_cast<float>(i % 100), static_cast<float>(i * 7 % 89)}, {i % 2 == 0 ? 1 : -1, 0}};
            if (sees.measured(guard)) ++seen;
        }
        sees.reorder();
    }
    for (const std::size_t i : sees.order())
        std::printf("test %d: %.0f ns, passes %.0f %%\n", static_cast<int>(i), sees.cost(i).time,
                    100 * sees.cost(i).pass);
    std::printf("%d guards see the player\n", seen);
    return seen == 126 ? 0 : 1;
}
