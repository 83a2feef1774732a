// Pick what the mouse is over: the topmost of the things on a screen that hold the point.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    enum Thing : std::uint64_t { nothing, window, button, badge };  // from back to front
    const char* const names[] = {"nothing", "window", "button", "badge"};

    abut::World2 screen;
    screen.add(abut::Box2{{400, 300}, {300, 200}}, {.user = window});
    screen.add(abut::rounded(abut::Box2{{400, 200}, {60, 10}}, 10), {.user = button});  // with round corners
    screen.add(abut::Circle{{470, 220}, 12}, {.user = badge});

    const auto under = [&](abut::Vec2 mouse) {
        std::uint64_t top = nothing;
        for (const abut::Id id : screen.containing(mouse)) top = std::max(top, screen.user(id));
        std::printf("at %g, %g: %s\n", mouse.x, mouse.y, names[top]);
        return top;
    };
    const bool right = under({400, 200}) == button && under({468, 218}) == badge && under({120, 450}) == window &&
                       under({331, 181}) == window &&  // the corner that isn't there
                       under({50, 50}) == nothing;
    return right ? 0 : 1;
}
