// Objects of Tiled maps: placed shapes, tiles, templates, points.

#include "tiled_maps.hpp"

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::Beside;
using test::read_as_text;
using test::read_object;
using test::tiles_tsx;
using test::tmj;
using test::tmx;

TEST(TiledObjects, AreShapes) {
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2' width='4' height='6'/>"), "L/a: box 3,5 half 2,3\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2' width='4' height='4'><ellipse/></object>"),
              "L/a: circle 3,4 radius 2\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2' width='6' height='4'><ellipse/></object>"),
              "L/a: ellipse radii 3,2 at 4,4\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2' width='4' height='10'><capsule/></object>"),
              "L/a: capsule 3,4 3,10 radius 2\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2' width='4' height='4'><capsule/></object>"),
              "L/a: circle 3,4 radius 2\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2'><polygon points='0,0 4,0 0,3'/></object>"),
              "L/a: polygon 1,2 5,2 1,5\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2'><polygon points='0,0 4,0 4,4 2,1'/></object>"),
              "L/a: chain 1,2 5,2 5,6 3,3 closed filled\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2'><polyline points='0,0 4,0 4,0 0,-3.5'/></object>"),
              "L/a: chain 1,2 5,2 1,-1.5\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2'><point/></object>"), "L/a: point 1,2\n");
    EXPECT_EQ(read_object("<object id='3' name='a' x='1' y='2'/>"), "L/a: point 1,2\n")
        << "as older versions write them";
}

TEST(TiledObjects, TurnClockwiseAboutTheirPosition) {
    EXPECT_EQ(read_object("<object name='a' x='10' y='20' width='4' height='6' rotation='90'/>"),
              "L/a: box 7,22 half 3,2\n");
    EXPECT_EQ(read_object("<object name='a' x='10' y='20' width='4' height='2' rotation='30'/>"),
              "L/a: box 11.232,21.866 half 2,1 turned 0.86603,0.5\n");
    EXPECT_EQ(read_object("<object name='a' x='10' y='20' width='4' height='6' rotation='-270'/>"),
              "L/a: box 7,22 half 3,2\n");
    EXPECT_EQ(read_object("<object name='a' x='10' y='20' width='8' height='4' rotation='90'><ellipse/></object>"),
              "L/a: ellipse radii 4,2 at 8,24 turned 0,1\n");
    EXPECT_EQ(read_object("<object name='a' x='10' y='20' rotation='180'><polygon points='0,0 4,0 0,3'/></object>"),
              "L/a: polygon 6,20 10,17 10,20\n");
}

TEST(TiledObjects, TilesStandOnTheirPosition) {
    EXPECT_EQ(read_object("<object id='1' name='a' gid='1' x='10' y='20' width='10' height='10'/>", tiles_tsx),
              "L/a: box 15,15 half 5,5\n");
    EXPECT_EQ(read_object("<object id='1' name='a' gid='2' x='10' y='20' width='10' height='10'/>", tiles_tsx),
              "L/a (slope): polygon 10,20 20,10 20,20 {grip: float 0.5}\n");
    EXPECT_EQ(read_object("<object id='1' name='a' gid='2147483650' x='10' y='20' width='30' height='20'/>", tiles_tsx),
              "L/a (slope): polygon 10,0 40,20 10,20 {grip: float 0.5}\n")
        << "mirrored and stretched";
    EXPECT_EQ(
        read_object("<object id='1' name='a' gid='2' x='10' y='20' width='10' height='10' rotation='90'/>", tiles_tsx),
        "L/a (slope): polygon 10,20 20,30 10,30 {grip: float 0.5}\n");
    EXPECT_EQ(read_object("<object id='1' name='a' gid='5' x='10' y='20' width='8' height='6'/>", tiles_tsx),
              "L/a: box 14,17 half 4,3\n")
        << "one without shapes is its rectangle";
    EXPECT_EQ(read_object("<object id='1' name='a' gid='99' x='10' y='20' width='8' height='6'/>"),
              "L/a: box 14,17 half 4,3\n");
    const char* const alignments[] = {"topleft", "top",        "topright", "left",       "center",
                                      "right",   "bottomleft", "bottom",   "bottomright"};
    for (int i = 0; i < 9; ++i) {
        const std::string set = "<tileset firstgid='1' tilewidth='10' tileheight='10' objectalignment='" +
                                std::string(alignments[i]) + "'/>";
        const Vec2 middle(14.0f - 4.0f * static_cast<float>(i % 3), 23.0f - 3.0f * static_cast<float>(i / 3));
        EXPECT_EQ(read_object("<object id='1' name='a' gid='1' x='10' y='20' width='8' height='6'/>", set),
                  "L/a: box " + test::text_of(middle) + " half 4,3\n")
            << alignments[i];
    }
}

TEST(TiledObjects, ATileOfSeveralShapesIsOneObject) {
    const std::string set =
        R"(<tileset firstgid="1" tilewidth="10" tileheight="10" fillmode="preserve-aspect-fit"><tile id="0"><objectgroup>
        <object x="0" y="0" width="10" height="2"/><object x="4" y="2" width="2" height="8"/></objectgroup></tile></tileset>)";
    EXPECT_EQ(read_object("<object name='a' gid='1' x='0' y='40' width='20' height='40'/>", set),
              "L/a: compound of 2 0,10:20,14 8,14:12,30\n")
        << "as large as fits, in the middle";
}

TEST(TiledObjects, TemplatesAreTheirBegin) {
    const Beside beside{
        {"things/crate.tx",
         "<?xml version='1.0'?><template><object name='Crate' type='crate' width='4' height='6'>"
         "<properties><property name='mass' type='int' value='5'/><property name='wood' value='oak'/>"
         "</properties></object></template>"},
        {"things/crate.tj", R"({"type":"template","object":{"name":"Crate","type":"crate","width":4,"height":6,
            "properties":[{"name":"mass","type":"int","value":5},{"name":"wood","type":"string","value":"oak"}]}})"},
        {"things/slope.tx",
         "<template><tileset firstgid='1' source='../tiles.tsx'/>"
         "<object name='Slope' gid='2' width='10' height='10'/></template>"},
        {"tiles.tsx", tiles_tsx}};
    const std::string crate = "L/Crate (crate): box 12,23 half 2,3 {mass: int 7} {wood: string oak}\n";
    const auto in_xml = [&](const std::string& name, const std::string& rest, const std::string& sets = "") {
        return read_as_text(".tmx",
                            tmx(sets + "<objectgroup name='L'><object id='1' template='" + name + "' x='10' y='20'" +
                                rest + "</objectgroup>"),
                            beside);
    };
    const std::string heavier = "><properties><property name='mass' type='int' value='7'/></properties></object>";
    EXPECT_EQ(in_xml("things/crate.tx", heavier), crate);
    EXPECT_EQ(in_xml("things/crate.tj", heavier), crate);
    EXPECT_EQ(
        read_as_text(
            ".tmj",
            tmj("", R"({"type":"objectgroup","name":"L","objects":[{"id":1,"template":"things/crate.tx","x":10,"y":20,
        "properties":[{"name":"mass","type":"int","value":7}]}]})"),
            beside),
        crate);
    EXPECT_EQ(in_xml("things/crate.tx", " name='Box' height='2'/>"),
              "L/Box (crate): box 12,21 half 2,1 {mass: int 5} {wood: string oak}\n");
    // The tile's id is that of the template, whose tileset may have another first id in the map, or not be in it.
    const std::string slope = "L/Slope (slope): polygon 10,20 20,10 20,20 {grip: float 0.5}\n";
    EXPECT_EQ(
        in_xml("things/slope.tx", "/>",
               "<tileset firstgid='1' tilewidth='10' tileheight='10'/><tileset firstgid='50' source='tiles.tsx'/>"),
        slope);
    EXPECT_EQ(in_xml("things/slope.tx", "/>"), slope);
    EXPECT_EQ(in_xml("things/none.tx", "/>"), "PROBLEM: line 3: 'things/none.tx': no such file\n");
    EXPECT_EQ(in_xml("tiles.tsx", "/>"),
              "PROBLEM: line 3: 'tiles.tsx': <template> was expected, and there is <tileset>\n");
}

TEST(TiledObjects, HaveNamesClassesAndProperties) {
    EXPECT_EQ(read_object(
                  "<object id='7' x='1' y='2' type='door'><point/></object><object id='8' x='1' y='2'><point/></object>"
                  "<object id='9' name='a' class='key' x='1' y='2'><point/></object>"
                  "<object id='10' name='a' x='3' y='2'><point/></object>"),
              "L/door 7 (door): point 1,2\nL/object 8: point 1,2\nL/a (key): point 1,2\nL/a#2: point 3,2\n");
    EXPECT_EQ(
        read_object("<object name='a' x='1' y='2'><properties><property name='s' value='x'/>"
                    "<property name='t'>two\nlines</property><property name='i' type='int' value='3'/>"
                    "<property name='f' type='float' value='2.50'/><property name='b' type='bool' value='false'/>"
                    "<property name='c' type='class' propertytype='P'><properties>"
                    "<property name='d' type='int' value='1'/></properties></property></properties><point/></object>"),
        "L/a: point 1,2 {b: bool false} {c.d: int 1} {f: float 2.5} {i: int 3} {s: string x} {t: string two\nlines}\n");
    EXPECT_EQ(
        read_as_text(
            ".tmj",
            tmj("",
                R"({"type":"objectgroup","name":"L","objects":[{"id":1,"name":"a","x":1,"y":2,"point":true,"properties":[
        {"name":"s","type":"string","value":"x"},{"name":"i","type":"int","value":3},{"name":"f","type":"float","value":2.5},
        {"name":"b","type":"bool","value":false},{"name":"c","type":"class","value":{"d":1}}]}]})")),
        "L/a: point 1,2 {b: bool false} {c.d: int 1} {f: float 2.5} {i: int 3} {s: string x}\n");
}

TEST(TiledObjects, OmissionsAreReported) {
    EXPECT_EQ(
        read_as_text(".tmx",
                     tmx("<imagelayer name='Sky'/><objectgroup name='L' parallaxx='0.5' visible='0'>"
                         "<object id='1' name='a' x='1' y='2'><point/></object>"
                         "<object id='2' name='Hello' x='1' y='2' width='9' height='9'><text>hello</text></object>"
                         "<object id='3' name='Bye' x='1' y='2' width='9' height='9'><text>bye</text></object>"
                         "<object id='4' name='flat' x='1' y='2' width='9'><ellipse/></object>"
                         "<object id='5' name='dot' x='1' y='2'><polyline points='0,0 0,0'/></object></objectgroup>")),
        "L/a: point 1,2\n"
        "note: 1 image layer is left out: 'Sky'\n"
        "note: 1 layer has a parallax, which is ignored: 'L'\n"
        "note: 1 layer is hidden in the editor, but read: 'L'\n"
        "note: 2 texts are left out, such as 'L/Hello'\n"
        "note: 2 objects are left out, without extent, such as 'L/flat'\n");
}

TEST(TiledObjects, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(read_object("\n<object id='1' x='a'/>"), "PROBLEM: line 4: x: a number was expected\n");
    EXPECT_EQ(read_object("<object id='1' x='1e400'/>"), "PROBLEM: line 3: x: a number was expected\n");
    EXPECT_EQ(read_object("<object id='1' name='a' x='1e39' width='1' height='1'/>"),
              "PROBLEM: 'L/a': a coordinate is out of the range of floats\n");
    EXPECT_EQ(read_object("<object id='1' name='a' x='1e39'/>"),
              "PROBLEM: 'L/a': a coordinate is out of the range of floats\n");
    EXPECT_EQ(read_object("<object id='1' name='a' x='1'><polygon points='1,2 3'/></object>"),
              "PROBLEM: line 3: points: pairs of numbers were expected\n");
    EXPECT_EQ(read_object(""), "PROBLEM: no shapes in it: 0 objects\n");
}

}  // namespace
}  // namespace abut
