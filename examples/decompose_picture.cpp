// Draws three convex decompositions of a polygon with two holes: one with the fewest parts, one without T-junctions,
// and one that covers slightly more with even fewer parts. The picture of docs/decompose_outline.md.
// example_decompose_picture [FILE]          writes to stdout without a file
#include <abut/bake/decompose_outline.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>
#include <vector>

namespace {

using Ring = std::vector<abut::Vec2>;

Ring moved(Ring ring, float x) {
    for (abut::Vec2& point : ring) point.x += x;
    return ring;
}

}  // namespace

int main(int count, char** arguments) {
    const Ring island{{0, 1}, {1, 0.2f}, {2, 0.6f}, {3, 0}, {4, 0.8f}, {5, 0.8f}, {6, 0.8f}, {6, 2}, {5.4f, 3},
                      {6, 4}, {5, 5},    {4, 4.4f}, {3, 5}, {2, 4.6f}, {1, 5},    {0.6f, 4}, {0, 3}, {0.8f, 2}};
    const std::vector<Ring> lakes{{{1.5f, 1.6f}, {2.6f, 1.4f}, {2.2f, 2}, {2.5f, 2.8f}, {1.6f, 2.7f}},
                                  {{3.6f, 2.4f}, {4.6f, 2.2f}, {4.4f, 3.4f}, {3.9f, 3.6f}}};
    const abut::Style part{{37, 99, 235}, 1.2f, {59, 130, 246, 48}}, shore{{15, 23, 42}, 2};

    abut::SvgCanvas canvas({{-0.3f, -0.3f}, {20.3f, 5.3f}}, 44, {248, 250, 252});
    const abut::OutlineOptions all[] = {{}, {.conforming = true}, {.concavity = 0.5}};
    std::size_t sizes[3] = {};
    for (int i = 0; i < 3; ++i) {
        const float x = 7.0f * static_cast<float>(i);
        std::vector<Ring> holes;
        for (const Ring& lake : lakes) holes.push_back(moved(lake, x));
        const Ring outline = moved(island, x);
        const auto parts = abut::decompose(outline, holes, all[i]);
        if (!parts) return 1;
        sizes[i] = parts->size();
        for (const abut::Polygon& each : *parts) draw(canvas, each, part);
        holes.push_back(outline);
        for (const Ring& ring : holes)
            for (std::size_t j = 0; j < ring.size(); ++j) canvas.line(ring[j], ring[(j + 1) % ring.size()], shore);
    }
    std::fprintf(stderr, "%zu parts, %zu conforming, %zu that add\n", sizes[0], sizes[1], sizes[2]);

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    const bool written = file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0;
    return written && sizes[0] <= sizes[1] && sizes[2] < sizes[0] ? 0 : 1;
}
