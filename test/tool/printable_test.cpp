// Names that try to write on the terminal.

#include "tool/shared/printable.hpp"

#include "tool_runs.hpp"

#include <algorithm>

namespace abut {
namespace {

using test::GltfBuilder;
using test::Ran;
using tool::printable;

TEST(Printable, EscapesWhatMovesOrReorders) {
    EXPECT_EQ(printable("Crate \xc3\xa4 \xe2\x82\xac \xf0\x9f\x93\xa6 \\n"),
              "Crate \xc3\xa4 \xe2\x82\xac \xf0\x9f\x93\xa6 \\n");
    EXPECT_EQ(printable("a\x1b[31mb\n\t\x7f"), "a\\x1b[31mb\\x0a\\x09\\x7f");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"), "\\x9b") << "C1 controls start sequences too";
    EXPECT_EQ(printable("a\xe2\x80\xae"
                        "b\xe2\x81\xa6"),
              "a\\u202eb\\u2066");
    EXPECT_EQ(printable("\xff\xc0\x80\xed\xa0\x80\xe2\x82"), "\\xff\\xc0\\x80\\xed\\xa0\\x80\\xe2\\x82");
}

class PrintableNames : public test::ToolRuns {};

TEST_F(PrintableNames, InAllOutput) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({1, 1, 1}));
    builder.add_node("a\\u001b[2Jb", mesh);
    builder.add_node("c\\u202ed\\n", mesh, {0.5f, 0, 0});
    const std::string file = write("scene\x1b.gltf", builder.text()).string();
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"check", file},
                                                 {"check", file, "--json"},
                                                 {"info", file},
                                                 {"cast", file, "--from", "-9,0,0", "--to", "9,0,0"}}) {
        const Ran ran = run(verb);
        EXPECT_NE(ran.code, 2) << ran.err;
        EXPECT_EQ(ran.out.find('\x1b'), std::string::npos) << verb[0];
        EXPECT_EQ(ran.out.find("\xe2\x80\xae"), std::string::npos) << verb[0];
        EXPECT_NE(ran.out.find("\\x1b[2J"), std::string::npos) << verb[0];
    }
    EXPECT_EQ(refusal({"info", file + "\n"}).find('\x1b'), std::string::npos);
}

TEST_F(PrintableNames, ScaleAppliesToAllLengths) {
    GltfBuilder builder;
    builder.add_node("Box", builder.add_mesh("Box", test::box_triangles({100, 100, 100})), {300, 0, 0});
    const std::string file = write("cm.gltf", builder.text()).string();
    const test::Json json = json_of({"info", file, "--scale", "0.01"}, 0);
    EXPECT_NEAR(json["objects"][0]["min"][0].get<double>(), 2, 1e-5);
    EXPECT_EQ(refusal({"info", file, "--scale", "0"}), "abut: --scale: must be a number above 0");
}

}  // namespace
}  // namespace abut
