// Picks the item below the mouse: on a 2D screen the topmost item that contains the point, in the game's own order; in
// 3D the first item that the ray through the mouse hits.
#include <abut/abut.hpp>

#include <cstdio>
#include <optional>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

namespace {

bool pick_on_a_screen() {
    enum Thing : std::uint64_t { nothing, window, button, badge };
    const char* const names[] = {"nothing", "window", "button", "badge"};
    const int layer[] = {-1, 0, 1, 1};  // drawing order; on one layer the later one is on top

    abut::World2 screen;
    screen.add(abut::Box2{{400, 300}, {300, 200}}, {.user = window});
    screen.add(abut::rounded(abut::Box2{{400, 200}, {60, 10}}, 10), {.user = button});  // with rounded corners
    screen.add(abut::Circle{{470, 220}, 12}, {.user = badge});

    const auto under = [&](abut::Vec2 mouse) {
        std::uint64_t top = nothing;
        for (const abut::Id id : screen.containing(mouse))  // in the order of insertion
            if (layer[screen.user(id)] >= layer[top]) top = screen.user(id);
        std::printf("at %g, %g: %s\n", mouse.x, mouse.y, names[top]);
        return top;
    };
    return under({400, 200}) == button && under({468, 218}) == badge && under({120, 450}) == window &&
           under({331, 181}) == window &&  // outside of the rounded corner
           under({50, 50}) == nothing;
}

bool pick_in_space() {
    const glm::mat4 view = glm::lookAtRH(abut::Vec3(0, 2, 10), abut::Vec3(0), abut::Vec3(0, 1, 0));
    const glm::mat4 projection = glm::perspectiveRH_ZO(1.0f, 800.0f / 600.0f, 0.1f, 100.0f);
    const abut::Vec2 window(800, 600);

    abut::World3 world;
    const abut::Id crate = world.add(abut::Box3{{0, 0, 0}, {1, 1, 1}});
    const abut::Id ball = world.add(abut::Sphere{{0, 0, -8}, 3});  // behind the crate, and larger

    const auto under = [&](abut::Vec2 mouse) -> abut::Id {
        const abut::Ray3 ray = abut::ray_through(mouse, window, projection * view, abut::clip_zero_to_one);
        const auto hit = world.raycast(ray);
        if (hit) std::printf("at %g, %g: item %u\n", mouse.x, mouse.y, hit->id.index);
        return hit ? hit->id : abut::Id{};
    };
    return under({400, 300}) == crate && under({480, 240}) == ball && !under({10, 10});
}

}  // namespace

int main() {
    return pick_on_a_screen() && pick_in_space() ? 0 : 1;
}
