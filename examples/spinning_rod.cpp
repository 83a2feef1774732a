// A rod is thrown through a row of posts, spinning. It touches none of them at its start and its end, and its centre
// passes between two of them. Only a sweep with rotation finds which post it hits, and when.
#include <abut/abut.hpp>

#include <cstdio>
#include <optional>
#include <vector>

int main() {
    const abut::Box2 rod{{0, 0}, {1, 0.05f}};
    std::vector<abut::Circle> posts;
    for (int i = -3; i <= 3; ++i) posts.push_back({{static_cast<float>(i) * 1.2f + 0.6f, 0}, 0.1f});

    // Moves up by six units in one step and rotates by one and a quarter turns.
    const abut::Motion2 thrown{{{0, -3}}, {0, 6}, 7.854f};
    std::optional<abut::Hit<2>> first;
    for (const abut::Circle& post : posts)
        if (const auto hit = abut::sweep(rod, thrown, post); hit && (!first || hit->fraction < first->fraction))
            first = hit;
    if (!first) {
        std::printf("it went through untouched\n");
        return 1;
    }
    const abut::Pose2 there = abut::pose_at(thrown, first->fraction);
    std::printf("it hits at fraction %.3f of its motion, at %.3f, %.3f\n", first->fraction, first->point.x,
                first->point.y);

    // Discrete tests at the start and the end of the step miss the post.
    bool seen = false, touches = false;
    for (const abut::Circle& post : posts) {
        for (const float fraction : {0.0f, 1.0f})
            seen = seen || abut::overlaps(abut::at(rod, abut::pose_at(thrown, fraction)), post);
        touches = touches || abut::closest(abut::at(rod, there), post).distance < 1e-4f;
    }
    std::printf("seen from both ends of the step alone: %s\n", seen ? "a post" : "nothing");
    return touches && !seen ? 0 : 1;
}
