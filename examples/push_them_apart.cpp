// Depenetration: crates that overlap each other and the floor are moved apart until they lie side by side.
// A contact has a direction and a depth. Moving a crate changes its other contacts, so the loop runs until no overlap
// is left.
#include <abut/abut.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

const abut::HalfSpace2 the_floor{{0, 1}, 0};

/// Moves all overlapping crates; returns the maximum depth.
float push_apart(std::vector<abut::Box2>& crates) {
    float deepest = 0;
    for (std::size_t i = 0; i < crates.size(); ++i) {
        if (const abut::Contact<2> c = abut::contact(the_floor, crates[i])) {
            crates[i].center += c.normal * c.depth;  // the floor stays where it is
            deepest = std::max(deepest, c.depth);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (const abut::Contact<2> c = abut::contact(crates[j], crates[i])) {
                crates[j].center -= c.normal * (0.5f * c.depth);
                crates[i].center += c.normal * (0.5f * c.depth);
                deepest = std::max(deepest, c.depth);
            }
        }
    }
    return deepest;
}

}  // namespace

int main() {
    const abut::Vec2 half{0.5f, 0.5f};
    std::vector<abut::Box2> crates{
        {{0, 0.3f}, half}, {{0.7f, 0.4f}, half}, {{1.5f, 0.5f}, half}, {{0.4f, 1.2f}, half, abut::Turn::by(0.3f)}};

    const float nobody_sees = 0.001f;
    int rounds = 1;
    while (push_apart(crates) > nobody_sees && rounds < 100) ++rounds;

    std::printf("apart after %d rounds:\n", rounds);
    bool apart = true;
    for (const abut::Box2& a : crates) {
        std::printf("  a crate at %.3f, %.3f\n", a.center.x, a.center.y);
        for (const abut::Box2& b : crates)
            if (&a != &b) apart = apart && abut::closest(a, b).distance > -2 * nobody_sees;
        apart = apart && abut::closest(the_floor, a).distance > -2 * nobody_sees;
    }
    return apart ? 0 : 1;
}
