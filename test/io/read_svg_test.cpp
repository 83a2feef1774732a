// Reads SVG drawings: levels or problems.

#include "level_text.hpp"
#include <abut/query/contains.hpp>

#include <string>

#include <gtest/gtest.h>

namespace abut {
namespace {

std::string svg(const std::string& content, const std::string& attributes = "") {
    return "<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">" + content + "</svg>";
}
std::string read(const std::string& content, const std::string& attributes = "") {
    return test::read_as_text(".svg", svg(content, attributes));
}
Level level_of(const std::string& content) {
    const std::string text = svg(content);
    const auto nothing = [](const std::string&) -> Result<std::vector<std::byte>> {
        return Problem{ProblemCode::not_found, "no such file"};
    };
    Result<Level> level = read_level(test::bytes_of_text(text), ".svg", nothing);
    EXPECT_TRUE(level);
    return *std::move(level);
}

TEST(ReadSvg, BasicShapesAreWhatTheyAre) {
    EXPECT_EQ(read("<rect id='r' x='1' y='2' width='4' height='6'/>"), "r: box 3,5 half 2,3\n");
    EXPECT_EQ(read("<circle id='c' cx='1' cy='2' r='3' class='ball'/>"), "c (ball): circle 1,2 radius 3\n");
    EXPECT_EQ(read("<ellipse id='e' cx='1' cy='2' rx='3' ry='4'/>"), "e: ellipse radii 4,3 at 1,2 turned 0,1\n");
    EXPECT_EQ(read("<ellipse id='e' cx='1' cy='2' rx='3' ry='3'/>"), "e: circle 1,2 radius 3\n");
    EXPECT_EQ(read("<line id='l' x1='1' y1='2' x2='3' y2='4'/>"), "l: chain 1,2 3,4\n");
    EXPECT_EQ(read("<polygon id='p' points='0,0 4,0 4,3'/>"), "p: polygon 0,0 4,0 4,3\n");
    EXPECT_EQ(read("<polygon id='p' points='0,0 4,0 4,4 2,1 0,4'/>"), "p: chain 0,0 4,0 4,4 2,1 0,4 closed filled\n");
    EXPECT_EQ(read("<polyline id='p' points='0 0,4 0 4-3' fill='none'/>"), "p: chain 0,0 4,0 4,-3\n");
    EXPECT_EQ(read("<polyline id='p' points='0,0 4,0 4,3'/>"), "p: polygon 0,0 4,0 4,3\n")
        << "what is filled is an area";
}

TEST(ReadSvg, RoundCornersAreExactWhereTheyCanBe) {
    EXPECT_EQ(read("<rect id='r' width='10' height='6' rx='1'/>"), "r: rounded box 5,3 half 4,2 rounded 1\n");
    EXPECT_EQ(read("<rect id='r' width='10' height='6' ry='1'/>"), "r: rounded box 5,3 half 4,2 rounded 1\n");
    EXPECT_EQ(read("<rect id='r' width='10' height='6' rx='3'/>"), "r: capsule 3,3 7,3 radius 3\n");
    EXPECT_EQ(read("<rect id='r' width='6' height='6' rx='99'/>"), "r: circle 3,3 radius 3\n");
    EXPECT_EQ(read("<rect id='r' width='10' height='6' rx='5' ry='3'/>"), "r: ellipse radii 5,3 at 5,3\n");
    EXPECT_EQ(read("<rect id='r' width='10' height='6' rx='2' ry='1'/>").substr(0, 11), "r: polygon ");
}

TEST(ReadSvg, TransformsNest) {
    EXPECT_EQ(
        read("<g transform='translate(10 20)'><g transform='scale(2)'><rect id='r' width='1' height='2'/></g></g>"),
        "r: box 11,22 half 1,2\n");
    EXPECT_EQ(read("<rect id='r' width='2' height='4' transform='translate(10) rotate(90)'/>"),
              "r: box 8,1 half 2,1\n");
    EXPECT_EQ(read("<rect id='r' x='1' y='1' width='2' height='4' transform='rotate(90, 1 1)'/>"),
              "r: box -1,2 half 2,1\n");
    EXPECT_EQ(read("<rect id='r' width='2' height='2' transform='rotate(30)'/>"),
              "r: box 0.36603,1.366 half 1,1 turned 0.86603,0.5\n");
    EXPECT_EQ(read("<rect id='r' width='2' height='2' transform='skewX(45)'/>"), "r: polygon 0,0 2,0 4,2 2,2\n");
    EXPECT_EQ(read("<rect id='r' width='2' height='2' transform='skewY(45)'/>"), "r: polygon 0,0 2,2 2,4 0,2\n");
    EXPECT_EQ(read("<rect id='r' width='2' height='2' transform='matrix(1,0,1,1,5,6)'/>"),
              "r: polygon 5,6 7,6 9,8 7,8\n");
    EXPECT_EQ(read("<circle id='c' r='2' transform='scale(3 1)'/>"), "c: ellipse radii 6,2\n");
    EXPECT_EQ(read("<circle id='c' r='2' transform='scale(-3)'/>"), "c: circle 0,0 radius 6\n");
    // A circle sheared by 1: its semi-axes are the singular values of (1 1, 0 1).
    EXPECT_EQ(read("<circle id='c' r='1' transform='matrix(1 0 1 1 0 0)'/>"),
              "c: ellipse radii 1.618,0.61803 at 0,0 turned 0.85065,0.52573\n");
}

TEST(ReadSvg, PathsBecomeWhatTheyEnclose) {
    EXPECT_EQ(read("<path id='p' d='M0 0h4v3z'/>"), "p: polygon 0,0 4,0 4,3\n");
    EXPECT_EQ(read("<path id='p' d='M0 0h4v3' fill='none'/>"), "p: chain 0,0 4,0 4,3\n");
    EXPECT_EQ(read("<path id='p' d='M0 0h4v3z' style='fill: none'/>"), "p: chain 0,0 4,0 4,3 closed\n");
    EXPECT_EQ(read("<g fill='none'><path id='p' d='M0 0h4v3' fill='red'/></g>"), "p: polygon 0,0 4,0 4,3\n");
    EXPECT_EQ(read("<path id='p' d='M0 0h9v9h-9z m2 2v4h4v-4z'/>"),
              "p: outlines [ 0,0 9,0 9,9 0,9 closed ] [ 2,2 2,6 6,6 6,2 closed ] filled\n");
}

TEST(ReadSvg, HolesAreHolesByEitherRule) {
    const char* const reversed_hole = "M0 0h9v9h-9z m2 2v4h4v-4z";
    const char* const equal_hole = "M0 0h9v9h-9z m2 2h4v4h-4z";
    struct Case {
        const char *path, *rule;
        bool hole;
    };
    for (const Case& one : {Case{reversed_hole, "nonzero", true}, Case{equal_hole, "nonzero", false},
                            Case{reversed_hole, "evenodd", true}, Case{equal_hole, "evenodd", true}}) {
        const Level level = level_of("<path fill-rule='" + std::string(one.rule) + "' d='" + one.path + "'/>");
        ASSERT_EQ(level.objects.size(), 1u);
        EXPECT_TRUE(contains(level.objects[0], Vec2(1, 5))) << one.path << one.rule;
        EXPECT_EQ(contains(level.objects[0], Vec2(4, 4)), !one.hole) << one.path << one.rule;
        EXPECT_FALSE(contains(level.objects[0], Vec2(10, 4)));
        EXPECT_TRUE(contains(level.objects[0], Vec2(2, 4))) << "the line itself";
    }
}

TEST(ReadSvg, NamesAreLabelsAndIdsOfGroupsToo) {
    EXPECT_EQ(read("<g id='layer1' inkscape:label='Rock'><g><g id='g7'><rect id='r' width='2' height='2'/></g></g></g>"
                   "<rect width='2' height='2'/><rect width='2' height='2'/>"),
              "Rock/g7/r: box 1,1 half 1,1\nrect: box 1,1 half 1,1\nrect#2: box 1,1 half 1,1\n");
}

TEST(ReadSvg, WhatIsNotDrawnIsNotThere) {
    EXPECT_EQ(
        read("<defs><rect width='9' height='9'/></defs><clipPath><rect width='9' height='9'/></clipPath>"
             "<rect width='9' height='9' display='none'/><g style='stroke:red; display : none'><circle r='2'/></g>"
             "<g visibility='hidden'><circle r='2'/><circle id='c' r='1' visibility='visible'/></g>"
             "<symbol><circle r='3'/></symbol>"),
        "c: circle 0,0 radius 1\n");
    EXPECT_EQ(read("<rect id='flat' width='9' height='0'/><path id='dot' d='M1 1'/><circle id='c' r='1'/><text>a</text>"
                   "<image id='i'/><style>.a{fill:none}</style><use href='other.svg#a'/>"),
              "c: circle 0,0 radius 1\n"
              "note: 2 shapes are left out, without extent, such as 'flat'\n"
              "note: 2 texts and pictures are left out, such as 'text'\n"
              "note: 1 style sheet is not read: ''\n"
              "note: 1 <use> is left out, without a target in the file: 'other.svg#a'\n");
}

TEST(ReadSvg, UseShowsThingsAgain) {
    const std::string defs = "<defs><g id='pair'><circle id='a' r='1'/><circle id='b' cx='5' r='1'/></g></defs>";
    EXPECT_EQ(read(defs + "<use id='u' href='#pair' x='10' transform='scale(2)'/>"),
              "u/pair/a: circle 20,0 radius 2\nu/pair/b: circle 30,0 radius 2\n");
    EXPECT_EQ(read("<symbol id='s' viewBox='0 0 2 2'><circle id='c' cx='1' cy='1' r='1'/></symbol>"
                   "<use id='u' xlink:href='#s' x='10' y='20' width='8' height='4'/>"),
              "u/s/c: circle 14,22 radius 2\n")
        << "fitted into the middle";
    EXPECT_EQ(read("<use id='u' href='#u'/>"), "PROBLEM: line 1: <use>: elements are nested more than 256 deep\n");
    std::string laughs = "<g id='l9'><circle r='1'/></g>";
    for (int i = 8; i >= 0; --i) {
        laughs += "<g id='l" + std::to_string(i) + "'>";
        for (int k = 0; k < 10; ++k) laughs += "<use href='#l" + std::to_string(i + 1) + "'/>";
        laughs += "</g>";
    }
    EXPECT_EQ(read(laughs), "PROBLEM: line 1: <use>: more than 100000 elements are drawn by <use>\n");
}

TEST(ReadSvg, UnitsAndViewBox) {
    EXPECT_EQ(read("<rect id='r' width='1in' height='2.54cm'/>"), "r: box 48,48 half 48,48\n");
    EXPECT_EQ(read("<rect id='r' width='3pt' height='1pc'/>"), "r: box 2,8 half 2,8\n");
    EXPECT_EQ(read("<rect id='r' width='50%' height='25%'/>", "viewBox='0 0 80 40' width='800mm'"),
              "r: box 20,5 half 20,5\n")
        << "in the units of the viewBox";
    EXPECT_EQ(
        read("<svg x='10' width='20' height='20' viewBox='0 0 10 40'><rect id='r' width='10' height='40'/></svg>"),
        "r: box 20,10 half 2.5,10\n");
    EXPECT_EQ(read("<svg x='10' width='20' height='20' viewBox='0 0 10 40' preserveAspectRatio='none'>"
                   "<rect id='r' width='10' height='40'/></svg>"),
              "r: box 20,10 half 10,10\n");
}

TEST(ReadSvg, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(read("\n\n<path id='p' d='M0 0 L5'/>"),
              "PROBLEM: line 3: <path>: 'p': path data: a number was expected at character 8\n");
    EXPECT_EQ(read("<path id='p' d='L5 5'/>"),
              "PROBLEM: line 1: <path>: 'p': path data: M was expected at character 1\n");
    EXPECT_EQ(read("<rect width='a' height='2'/>"), "PROBLEM: line 1: <rect>: width: a length was expected\n");
    EXPECT_EQ(read("<polygon id='p' points='1,2 3'/>"),
              "PROBLEM: line 1: <polygon>: 'p': points: pairs of numbers were expected, syntax error at character 6\n");
    EXPECT_EQ(read("<g transform='rotate(1'/>"), "PROBLEM: line 1: <g>: transform: syntax error at character 9\n");
    EXPECT_EQ(read("<g transform='spin(1)'/>"), "PROBLEM: line 1: <g>: transform: syntax error at character 7\n");
    EXPECT_EQ(read("<rect id='r' width='1e39' height='2'/>"),
              "PROBLEM: line 1: <rect>: 'r': a coordinate is out of the range of floats\n");
    EXPECT_EQ(read(""), "PROBLEM: no shapes in it: 0 objects\n");
    EXPECT_EQ(test::read_as_text(".svg", "<html/>"), "PROBLEM: not an SVG drawing: its outermost element is <html>\n");
    EXPECT_EQ(test::read_as_text(".svg", "<svg>\n<g>\n</svg>"), "PROBLEM: line 3: XML: start-end tags mismatch\n");
    EXPECT_EQ(test::read_as_text(".svg", ""), "PROBLEM: is empty\n");
}

TEST(ReadSvg, ADrawingMayBeCompressed) {
    // gzip of <svg><circle id="c" r="2"/></svg>
    const unsigned char packed[] = {0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0xb3, 0x29, 0x2e,
                                    0x4b, 0xb7, 0xb3, 0x49, 0xce, 0x2c, 0x4a, 0xce, 0x49, 0x55, 0xc8, 0x4c, 0xb1,
                                    0x55, 0x4a, 0x56, 0x52, 0x28, 0xb2, 0x55, 0x32, 0x52, 0xd2, 0xb7, 0xb3, 0xd1,
                                    0x07, 0xc9, 0x01, 0x00, 0x76, 0x5a, 0x4f, 0x1a, 0x21, 0x00, 0x00, 0x00};
    const std::string_view text(reinterpret_cast<const char*>(packed), sizeof(packed));
    EXPECT_EQ(test::read_as_text(".svgz", text), "c: circle 0,0 radius 2\n");
    EXPECT_EQ(test::read_as_text(".svgz", text.substr(0, 30)), "PROBLEM: compressed data is damaged, or cut short\n");
}

}  // namespace
}  // namespace abut
