// Tile layers: every encoding gives one level, and tiles are as their tilesets define them.

#include "tiled_maps.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::Beside;
using test::bytes_of_text;
using test::read_as_text;
using test::tiles_tsj;
using test::tiles_tsx;
using test::tmj;
using test::tmx;

// Row by row: full full nothing slope-mirrored | slope nothing nothing slope | half half-upside-down ledge
// half-transposed.
const char* const uncompressed = "AQAAAAEAAAAAAAAAAgAAgAIAAAAAAAAAAAAAAAIAAAADAAAAAwAAQAQAAAADAAAg";
const char* const zlib = "eNpjZGBgYGSAACYGhgYmBgQAsZkh2IEFQisAABScAPY=";
const char* const gzip = "H4sIAAAAAAACA2NkYGBgZIAAJgaGBiYGBACxmSHYgQVCKwAA1VUyszAAAAA=";
const char* const zstd = "KLUv/QRYJQEA0AEAAAABAAIAAIACAAIAAAADQAQAAAADAAAgAwC7ocEuAygCxwX1ZQ==";
const char* const numbers = "1, 1, 0, 2147483650, 2, 0, 0, 2, 3, 1073741827, 4, 536870915";

const char* const expected = "L: tiles ##.3 4..4 tb^l of 10,10\n";

std::string layer_xml(const std::string& data, const std::string& attributes) {
    return "<layer id='2' name='L' width='4' height='3'><data " + attributes + ">" + data + "</data></layer>";
}
std::string layer_json(const std::string& data, const std::string& more = "") {
    return R"({"type":"tilelayer","id":2,"name":"L","width":4,"height":3,)" + more + R"("data":)" + data + "}";
}

TEST(TiledLayers, AreTheSameInEveryEncoding) {
    const auto xml = [](const std::string& data, const std::string& attributes) {
        return read_as_text(".tmx", tmx(tiles_tsx + layer_xml(data, attributes)));
    };
    EXPECT_EQ(xml(numbers, "encoding='csv'"), expected);
    EXPECT_EQ(xml(std::string("\n  ") + uncompressed + "\n ", "encoding='base64'"), expected);
    EXPECT_EQ(xml(zlib, "encoding='base64' compression='zlib'"), expected);
    EXPECT_EQ(xml(gzip, "encoding='base64' compression='gzip'"), expected);
    EXPECT_EQ(xml(zstd, "encoding='base64' compression='zstd'"), expected);
    std::string tiles, number;
    for (std::istringstream all(numbers); std::getline(all, number, ',');)
        tiles += "<tile gid='" + number.substr(number.find_first_not_of(' ')) + "'/>";
    EXPECT_EQ(xml(tiles, ""), expected);

    const auto json = [](const std::string& data, const std::string& more) {
        return read_as_text(".tmj", tmj(tiles_tsj, layer_json(data, more)));
    };
    EXPECT_EQ(json("[" + std::string(numbers) + "]", ""), expected);
    const auto quoted = [](const char* text) { return "\"" + std::string(text) + "\""; };
    EXPECT_EQ(json(quoted(uncompressed), R"("encoding":"base64",)"), expected);
    EXPECT_EQ(json(quoted(zlib), R"("encoding":"base64","compression":"zlib",)"), expected);
    EXPECT_EQ(json(quoted(gzip), R"("encoding":"base64","compression":"gzip",)"), expected);
    EXPECT_EQ(json(quoted(zstd), R"("encoding":"base64","compression":"zstd",)"), expected);
}

TEST(TiledLayers, TilesetsMayBeBesideTheMapInEitherFormat) {
    const std::string layer = layer_xml(numbers, "encoding='csv'");
    const Beside beside{{"sets/a.tsx", std::string("<?xml version='1.0'?>") + tiles_tsx}, {"sets/a.tsj", tiles_tsj}};
    EXPECT_EQ(read_as_text(".tmx", tmx("<tileset firstgid='1' source='sets/a.tsx'/>" + layer), beside), expected);
    EXPECT_EQ(read_as_text(".tmx", tmx("<tileset firstgid='1' source='./sets/../sets/a.tsj'/>" + layer), beside),
              expected);
    EXPECT_EQ(read_as_text(".tmj",
                           tmj(R"({"firstgid":1,"source":"sets/a.tsx"})", layer_json(std::string("[") + numbers + "]")),
                           beside),
              expected);
    EXPECT_EQ(read_as_text(".tmx", tmx("<tileset firstgid='1' source='no.tsx'/>" + layer), beside),
              "PROBLEM: line 3: 'no.tsx': no such file\n");
    for (const char* elsewhere : {"/etc/passwd", "http://example.org/a.tsx", "file:///a.tsx"})
        EXPECT_EQ(read_as_text(".tmx", tmx("<tileset firstgid='1' source='" + std::string(elsewhere) + "'/>"), beside)
                      .substr(0, 19),
                  "PROBLEM: line 3: '" + std::string(1, elsewhere[0]))
            << elsewhere;
}

// Each of the eight orientations of a tile, a slope that is solid in its corner of high x and high y.
TEST(TiledLayers, FlipsAndTurns) {
    const std::string set = R"(<tileset firstgid="1" name="t" tilewidth="10" tileheight="10"><tile id="0"><objectgroup>
        <object id="1" x="0" y="10"><polygon points="0,0 10,-10 10,0"/></object></objectgroup></tile></tileset>)";
    const auto one = [&](std::uint32_t flips) {
        return read_as_text(".tmx", tmx(set + "<layer name='L' width='1' height='1'><data encoding='csv'>" +
                                        std::to_string(1u | flips << 29) + "</data></layer>"));
    };
    // 1: low x low y, 2: high x low y, 3: low x high y, 4: high x high y. Flips: 4 = x, 2 = y, 1 = diagonal, first.
    const char kinds[] = {'4', '4', '2', '2', '3', '3', '1', '1'};
    for (std::uint32_t flips = 0; flips < 8; ++flips)
        EXPECT_EQ(one(flips), std::string("L: tiles ") + kinds[flips] + " of 10,10\n") << flips;
}

TEST(TiledLayers, AFlippedTileIsTurnedAsTiledTurnsIt) {
    // A box in the corner of low x and high y: rotated a quarter clockwise (flips x and diagonal) it is at low x, low
    // y.
    const std::string set = R"(<tileset firstgid="1" name="t" tilewidth="10" tileheight="10"><tile id="0"><objectgroup>
        <object id="1" x="0" y="7" width="2" height="3"/></objectgroup></tile></tileset>)";
    const auto one = [&](std::uint32_t flips) {
        return read_as_text(".tmx", tmx(set + "<layer name='L' width='1' height='1'><data encoding='csv'>" +
                                        std::to_string(1u | flips << 29) + "</data></layer>"));
    };
    EXPECT_EQ(one(0), "L: box 1,8.5 half 1,1.5\n");
    EXPECT_EQ(one(5), "L: box 1.5,1 half 1.5,1\n") << "a quarter clockwise";
    EXPECT_EQ(one(6), "L: box 9,1.5 half 1,1.5\n") << "half a turn";
    EXPECT_EQ(one(3), "L: box 8.5,9 half 1.5,1\n") << "a quarter counter-clockwise";
    EXPECT_EQ(one(4), "L: box 9,8.5 half 1,1.5\n") << "mirrored";
}

TEST(TiledLayers, AllKindsOfTiles) {
    struct Case {
        const char *shape, *kind;
    };
    const Case cases[] = {
        {R"(<object x="0" y="0" width="10" height="10"/>)", "#"},
        {R"(<object x="0" y="0"><polygon points="0,0 10,0 10,10 0,10"/></object>)", "#"},
        {R"(<object x="0" y="0" width="5" height="10"/>)", "l"},
        {R"(<object x="5" y="0" width="5" height="10"/>)", "r"},
        {R"(<object x="0" y="5" width="10" height="5"/>)", "b"},
        {R"(<object x="0" y="0" width="10" height="5"/>)", "t"},
        {R"(<object x="0" y="0"><polygon points="0,0 10,0 0,10"/></object>)", "1"},
        {R"(<object x="0" y="0"><polygon points="0,0 0,10 10,10"/></object>)", "3"},
        {R"(<object x="0" y="0"><polyline points="0,0 0,10"/></object>)", "<"},
        {R"(<object x="10" y="0"><polyline points="0,10 0,0"/></object>)", ">"},
        {R"(<object x="0" y="10"><polyline points="0,0 10,0"/></object>)", "_"},
        {R"(<object x="10" y="0" width="10" height="5" rotation="90"/>)", "r"},
    };
    for (const Case& one : cases)
        EXPECT_EQ(
            read_as_text(".tmx", tmx("<tileset firstgid='1' tilewidth='10' tileheight='10'><tile id='0'><objectgroup>" +
                                     std::string(one.shape) +
                                     "</objectgroup></tile></tileset><layer name='L' width='1' height='1'><data "
                                     "encoding='csv'>1</data></layer>")),
            std::string("L: tiles ") + one.kind + " of 10,10\n")
            << one.shape;
}

TEST(TiledLayers, OtherShapesStandBesideTheTiles) {
    const std::string set = R"(<tileset firstgid="1" tilewidth="10" tileheight="10">
        <tile id="0"><objectgroup><object x="0" y="0" width="10" height="10"/></objectgroup></tile>
        <tile id="1"><objectgroup><object x="0" y="0" width="4" height="4"><ellipse/></object><object x="5" y="8" width="5" height="2"/></objectgroup></tile>
        </tileset>)";
    EXPECT_EQ(
        read_as_text(
            ".tmx",
            tmx(set + "<layer name='L' width='2' height='1' offsetx='100'><data encoding='csv'>1,2</data></layer>")),
        "L: compound of 3 100,0:110,10 110,0:114,4 115,8:120,10\n");
}

TEST(TiledLayers, LargerTilesStandOnTheirCell) {
    const std::string set = R"(<tileset firstgid="1" tilewidth="10" tileheight="20"><tileoffset x="1" y="2"/>
        <tile id="0"><objectgroup><object x="0" y="0" width="10" height="20"/></objectgroup></tile></tileset>)";
    EXPECT_EQ(
        read_as_text(".tmx", tmx(set + "<layer name='L' width='1' height='2'><data encoding='csv'>0,1</data></layer>")),
        "L: box 6,2 half 5,10 at 0,10\n");
    const std::string filling = R"(<tileset firstgid="1" tilewidth="20" tileheight="20" tilerendersize="grid">
        <tile id="0"><objectgroup><object x="0" y="0" width="20" height="10"/></objectgroup></tile></tileset>)";
    EXPECT_EQ(read_as_text(".tmx",
                           tmx(filling + "<layer name='L' width='1' height='1'><data encoding='csv'>1</data></layer>")),
              "L: tiles t of 10,10\n");
}

TEST(TiledLayers, WithoutAnyCollisionShapeEveryTileIsFull) {
    const std::string set = "<tileset firstgid='1' tilewidth='10' tileheight='10'/>";
    EXPECT_EQ(
        read_as_text(".tmx", tmx(set + "<layer name='L' width='2' height='1'><data encoding='csv'>0,7</data></layer>")),
        "L: tiles .# of 10,10\nnote: no tileset has collision shapes: every tile is taken as full\n");
    EXPECT_EQ(
        read_as_text(".tmx", tmx(tiles_tsx + std::string("<layer name='L' width='2' height='1'><data encoding='csv'>"
                                                         "1,5</data></layer><layer name='Grass' width='1' height='1'>"
                                                         "<data encoding='csv'>5</data></layer>"))),
        "L: tiles #. of 10,10\n"
        "note: 1 tile layer is left out: none of their tiles has a collision shape: 'Grass'\n");
}

TEST(TiledLayers, InfiniteMapsAreChunks) {
    const std::string xml = R"(<layer id="2" name="L"><data encoding="csv">
        <chunk x="-4" y="0" width="2" height="2">0,1,
0,1</chunk><chunk x="0" y="-2" width="1" height="1">1</chunk></data></layer>)";
    const char* const wanted = "L: tiles ...# .... #... #... of 10,10 at -30,-20\n";
    EXPECT_EQ(read_as_text(".tmx", tmx(tiles_tsx + xml, "width='4' height='3' infinite='1'")), wanted);
    EXPECT_EQ(read_as_text(".tmj", tmj(tiles_tsj, R"({"type":"tilelayer","name":"L","chunks":[
        {"x":-4,"y":0,"width":2,"height":2,"data":[0,1,0,1]},{"x":0,"y":-2,"width":1,"height":1,"data":[1]}]})",
                                       R"("infinite":true,"width":4,"height":3)")),
              wanted);
    const std::string far =
        R"(<layer name="L"><data encoding="csv"><chunk x="-1000000000" y="0" width="1" height="1">1</chunk>
        <chunk x="1000000000" y="9" width="1" height="1">1</chunk></data></layer>)";
    EXPECT_EQ(read_as_text(".tmx", tmx(tiles_tsx + far, "infinite='1'")),
              "PROBLEM: 'L': its tiles are spread over 2000000001 x 10 cells\n");
}

TEST(TiledLayers, GroupsShiftWhatIsInThem) {
    EXPECT_EQ(
        read_as_text(".tmx", tmx(tiles_tsx + std::string(R"(<group name="A" offsetx="100"><group name="B" offsety="7">
        <layer name="L" width="1" height="1" offsetx="3" class="ground"><properties><property name="wet" type="bool" value="true"/></properties>
        <data encoding="csv">1</data></layer></group></group>)"))),
        "A/B/L (ground): tiles # of 10,10 at 103,7 {wet: bool true}\n");
}

TEST(TiledLayers, SaysWhatIsWrongAndWhere) {
    const auto csv = [](const std::string& data, const std::string& size = "width='2' height='1'") {
        return read_as_text(".tmx",
                            tmx("<layer name='L' " + size + "><data encoding='csv'>" + data + "</data></layer>"));
    };
    EXPECT_EQ(csv("1"), "PROBLEM: line 3: layer 'L': 1 tiles, where 2 were expected\n");
    EXPECT_EQ(csv("1,2,3"), "PROBLEM: line 3: layer 'L': 3 tiles, where 2 were expected\n");
    EXPECT_EQ(csv("1,x"), "PROBLEM: line 3: layer 'L': tile 1: a number was expected\n");
    EXPECT_EQ(csv("1 2"), "PROBLEM: line 3: layer 'L': tile 0: a comma was expected after it\n");
    EXPECT_EQ(csv("1", "width='-2' height='1'"),
              "PROBLEM: line 3: width: a whole number from 0 to 4294967295 was expected\n");
    EXPECT_EQ(csv("1", "width='100000' height='10000'"),
              "PROBLEM: line 3: layer 'L': 100000 x 10000 tiles; a map may have 67108864 in all\n");
    const auto base64 = [](const std::string& data, const std::string& compression) {
        return read_as_text(".tmx", tmx("<layer name='L' width='2' height='1'><data encoding='base64' compression='" +
                                        compression + "'>" + data + "</data></layer>"));
    };
    EXPECT_EQ(base64("AQAAAA==", ""), "PROBLEM: line 3: layer 'L': 4 bytes of tiles, where 8 were expected\n");
    EXPECT_EQ(base64("A$", ""), "PROBLEM: line 3: layer 'L': base64: bad character at byte 1\n");
    EXPECT_EQ(base64("AQAAAA==", "zlib"), "PROBLEM: line 3: layer 'L': compressed data is damaged, or cut short\n");
    EXPECT_EQ(base64("AQAAAA==", "zstd"), "PROBLEM: line 3: layer 'L': zstd data is damaged, or cut short\n");
    EXPECT_EQ(base64(zlib, "zlib"), "PROBLEM: line 3: layer 'L': compressed data holds more than 8 bytes\n");
    EXPECT_EQ(base64(zstd, "zstd"), "PROBLEM: line 3: layer 'L': zstd data holds more than 8 bytes\n");
    EXPECT_EQ(base64("AQAAAA==", "lzma"), "PROBLEM: line 3: layer 'L': unknown compression 'lzma'\n");
    EXPECT_EQ(read_as_text(".tmx", tmx("<layer name='L'/>")), "PROBLEM: line 3: layer 'L': no data\n");
    EXPECT_EQ(read_as_text(".tmx", "<map orientation='round' tilewidth='1' tileheight='1'/>"),
              "PROBLEM: line 1: the map is 'round', which is no orientation that abut knows\n");
    EXPECT_EQ(read_as_text(".tmx", "<map tilewidth='0' tileheight='1'/>"),
              "PROBLEM: line 1: tilewidth and tileheight must be above 0\n");
    EXPECT_EQ(read_as_text(".tmx", "<map"), "PROBLEM: line 1: XML: error parsing start element tag\n");
    EXPECT_EQ(read_as_text(".tmx", "<tileset/>"), "PROBLEM: <map> was expected, and there is <tileset>\n");
    EXPECT_EQ(read_as_text(".tmj", "{"), "PROBLEM: JSON: syntax error at byte 2\n");
    EXPECT_EQ(read_as_text(".json", "{}"), "PROBLEM: not a Tiled map: it has no layers and tilewidth\n");
    EXPECT_EQ(read_as_text(".tmj", tmj("", layer_json("[1,2]"))),
              "PROBLEM: layers[0] (layer 'L'): 2 tiles, where 12 were expected\n");
    EXPECT_EQ(read_as_text(".tmj", tmj("", R"({"type":"tilelayer","name":"L","width":1,"height":1,"data":[-1]})")),
              "PROBLEM: layers[0] (layer 'L').data[0]: a whole number of 32 bits was expected\n");
    EXPECT_EQ(read_as_text(".tmj", tmj("", R"({"type":"group","layers":[{"type":"cake"}]})")),
              "PROBLEM: layers[0].layers[0]: unknown type of layer 'cake'\n");
    EXPECT_EQ(read_as_text(".tmj", tmj("", R"({"type":"objectgroup","objects":[{"x":"a"}]})")),
              "PROBLEM: layers[0].objects[0]: x: a number was expected\n");
    std::string deep;
    for (int i = 0; i < 70; ++i) deep += "<group name='g'>";
    for (int i = 0; i < 70; ++i) deep += "</group>";
    EXPECT_EQ(read_as_text(".tmx", tmx(deep)), "PROBLEM: line 3: groups are nested more than 64 deep\n");
}

// One level with JSON and with XML tilesets, its tiles as an array and compressed.
TEST(TiledLayers, TheBundledLevelIsTheSameInBothFormats) {
    const std::string folder = ABUT_SOURCE_FOLDER "/scenes/";
    const Result<Level> json = read_level(folder + "plateau.tmj"), xml = read_level(folder + "plateau.tmx");
    ASSERT_TRUE(json) << json.problem().message;
    ASSERT_TRUE(xml) << xml.problem().message;
    EXPECT_EQ(test::text_of(*json), test::text_of(*xml));
    ASSERT_EQ(json->objects.size(), 8u);
    EXPECT_EQ(json->objects[0].path, "World/Ground");
    ASSERT_EQ(points_called(*json, "spawn").size(), 1u);
    EXPECT_EQ(points_called(*json, "spawn")[0]->position, Vec2(40, 150));
    EXPECT_EQ(points_called(*json, "Exit").size(), 1u);
    EXPECT_EQ(*property(json->points[0].properties, "facing"), "right");
}

// A diamond of the screen is a square of the ground, as high as the diamond; there Tiled measures objects too.
TEST(TiledLayers, IsometricMapsAreReadOnTheGround) {
    const std::string map =
        "<map orientation='isometric' width='2' height='2' tilewidth='64' tileheight='32'>"
        "<layer name='L' width='2' height='2'><data encoding='csv'>0,1,0,0</data></layer>"
        "<objectgroup name='O'><object id='1' x='32' y='0' width='32' height='32'/></objectgroup></map>";
    const Result<Level> level = read_level(bytes_of_text(map), ".tmx", [](const std::string&) {
        return Result<std::vector<std::byte>>(Problem{ProblemCode::not_found, "none"});
    });
    ASSERT_TRUE(level) << level.problem().message;
    ASSERT_EQ(level->objects.size(), 2u);
    const auto* tiles = std::get_if<TileMap>(&level->objects[0].shape);
    ASSERT_NE(tiles, nullptr);
    EXPECT_EQ(tiles->box(1).min, Vec2(32, 0));
    EXPECT_EQ(tiles->box(1).max, Vec2(64, 32));
    EXPECT_EQ(bounds(level->objects[1]).min, Vec2(32, 0)) << "the object lies on the tile";
}

// The places are those of Tiled's own renderer.
TEST(TiledLayers, StaggeredAndHexagonalMapsAreReadAsTheyAreShown) {
    const auto map = [](const std::string& grid, const std::string& tiles, const std::string& tilesets = "") {
        return read_as_text(".tmx", "<map " + grid + " width='2' height='2'>" + tilesets +
                                        "<layer name='L' width='2' height='2'><data encoding='csv'>" + tiles +
                                        "</data></layer></map>");
    };
    const std::string note = "note: no tileset has collision shapes: every tile is taken as full\n";
    const std::string pointed = "orientation='hexagonal' tilewidth='14' tileheight='12' hexsidelength='6' ";
    EXPECT_EQ(map(pointed + "staggeraxis='y' staggerindex='odd'", "1,0,0,0"),
              "L: polygon 0,3 7,0 14,3 14,9 7,12 0,9\n" + note);
    EXPECT_EQ(map(pointed + "staggeraxis='y' staggerindex='odd'", "1,1,1,0"),
              "L: compound of 3 0,0:14,12 14,0:28,12 7,9:21,21\n" + note);
    EXPECT_EQ(map("orientation='hexagonal' tilewidth='20' tileheight='18' hexsidelength='10' staggeraxis='x' "
                  "staggerindex='even'",
                  "1,1,1,0"),
              "L: compound of 3 0,9:20,27 15,0:35,18 0,27:20,45\n" + note);
    EXPECT_EQ(
        map("orientation='staggered' tilewidth='64' tileheight='32' staggeraxis='y' staggerindex='even'", "1,0,1,0"),
        "L: compound of 2 32,0:96,32 0,16:64,48\n" + note);
    // A square at the left end of the middle line, turned by 60 degrees about the middle.
    const std::string tileset =
        "<tileset firstgid='1' name='T' tilewidth='14' tileheight='12'><tile id='0'><objectgroup>"
        "<object id='1' x='0' y='5' width='2' height='2'/></objectgroup></tile></tileset>";
    const std::string turned = map(pointed + "staggeraxis='y' staggerindex='odd'", "536870913,0,0,0", tileset);
    EXPECT_NE(turned.find(" 4,0.80385 "), std::string::npos) << turned;
    EXPECT_EQ(map("orientation='hexagonal' tilewidth='14' tileheight='12' hexsidelength='12'", "1,0,0,0"),
              "PROBLEM: line 1: hexsidelength must be less than the tile's size\n");
}

}  // namespace
}  // namespace abut
