// Draws the contacts of crates and a plank with a tile map: one for each plane, over all its tiles. The picture of
// docs/ghosts.md.
// example_surface_contacts_picture [FILE]          writes to stdout without a file
#include <abut/abut.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>

#include <cstdio>
#include <vector>

namespace {

const abut::Style blue{{37, 99, 235}, 2, {37, 99, 235, 38}}, orange{{217, 119, 6}, 2, {245, 158, 11, 56}};
const abut::Style mark{{225, 29, 72}, 3, {225, 29, 72}}, text{{30, 41, 59}};

/// A floor of tiles with a wall of two tiles at its end.
abut::TileMap level() {
    constexpr std::uint32_t columns = 18;
    std::vector<abut::Tile> tiles(columns, abut::Tile::full);
    tiles.resize(3 * columns, abut::Tile::empty);
    tiles[2 * columns - 1] = tiles[3 * columns - 1] = abut::Tile::full;
    return *abut::TileMap::build(tiles, columns, 1.0f);
}

}  // namespace

int main(int count, char** arguments) {
    abut::SvgCanvas canvas({{0, 0}, {18, 4}}, 50, {248, 250, 252});
    canvas.set_point_size(9);
    canvas.set_text_height(18);
    const abut::TileMap tiles = level();
    draw(canvas, tiles, orange);

    const auto show = [&](const abut::Box2& box, const char* name) {
        draw(canvas, box, blue);
        canvas.text(box.center + abut::Vec2(0, box.half.y + 0.3f), name, text);
        each_contact(box, tiles, [&](const abut::Contact<2>& contact) {
            for (const abut::ContactPoint<2>& point : contact.points) {
                canvas.line(point.position, point.position - 0.6f * contact.normal, mark);
                canvas.point(point.position, mark);
            }
        });
    };
    // All are 0.05 deep.
    show({{2.2f, 1.55f}, {0.6f, 0.6f}, abut::Turn::by(0.03f)}, "a tilted crate over a seam");
    show({{8.6f, 1.15f}, {2.6f, 0.2f}}, "a plank over six tiles");
    show({{16.45f, 1.55f}, {0.6f, 0.6f}}, "floor and wall");

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    return file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0 ? 0 : 1;
}
