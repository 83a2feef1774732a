// Draws a motion plan from one arrangement of pieces to another, one straight move at a time. The picture of
// docs/rearrangement.md.
// example_rearrange_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>
#include <vector>

namespace {

/// The pieces of a square, each about its own origin, and their positions.
struct Square {
    std::vector<abut::Polygon> pieces;
    std::vector<abut::Pose2> poses;

    void add(abut::Vec2 middle, std::vector<abut::Vec2> corners) {
        for (abut::Vec2& corner : corners) corner -= middle;
        pieces.push_back(*abut::Polygon::build(corners));
        poses.push_back({middle});
    }
};

}  // namespace

int main(int count, char** arguments) {
    const abut::Color colors[] = {{37, 99, 235}, {217, 119, 6}, {22, 163, 74}, {147, 51, 234}, {8, 145, 178}};

    // The start is packed without gaps; in the goal each corner piece takes the opposite corner, rotated to fit.
    Square square;
    square.add({0.5f, 0.5f}, {{0, 0}, {2, 0}, {0, 2}});
    square.add({3.5f, 0.5f}, {{2, 0}, {4, 0}, {4, 2}});
    square.add({2, 2}, {{2, 0}, {4, 2}, {2, 4}, {0, 2}});
    square.add({0.5f, 3.5f}, {{0, 2}, {2, 4}, {0, 4}});
    square.add({3.5f, 3.5f}, {{4, 2}, {4, 4}, {2, 4}});
    std::vector<abut::Pose2> to = square.poses;
    std::swap(to[0].position, to[4].position);
    std::swap(to[1].position, to[3].position);
    for (const std::size_t corner : {0u, 1u, 3u, 4u}) to[corner].rotation = {-1, 0};

    const abut::Rearrangement<2> plan = rearrange(square.pieces, square.poses, to);
    if (!plan) return 1;

    // One panel for the start, and one after every few moves.
    constexpr int panels = 5;
    constexpr float width = 36, height = 33;
    abut::SvgCanvas canvas({{0, 0}, {panels * width, height}}, 6, {248, 250, 252});
    std::vector<abut::Pose2> now = square.poses;
    std::size_t done = 0;
    for (int panel = 0; panel < panels; ++panel) {
        const std::size_t until = plan.moves.size() * static_cast<std::size_t>(panel) / (panels - 1);
        for (; done < until; ++done) now[plan.moves[done].shape] = plan.moves[done].to;
        const abut::Pose2 place{{static_cast<float>(panel) * width + 28.5f, 2.5f}};
        for (std::size_t i = 0; i < now.size(); ++i) {
            abut::Color fill = colors[i];
            fill.alpha = 70;
            draw(canvas, at(square.pieces[i], place * now[i]), {colors[i], 1.5f, fill});
        }
        char text[32];
        std::snprintf(text, sizeof text, panel == 0 ? "start" : "%zu moves", done);
        canvas.text(place.position + abut::Vec2(2, -1.4f), text, {{71, 85, 105}});
    }

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
