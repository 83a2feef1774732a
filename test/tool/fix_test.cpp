// `abut fix` as a program.

#include "tool_runs.hpp"

namespace abut {
namespace {

using test::Json;

class Fix : public test::ToolRuns {};

TEST_F(Fix, MendsWhatHasOneRightAnswer) {
    // A tetrahedron with own corners for each face, one face twice, one turned, and a triangle of zero area.
    const std::string file = write("a.obj",
                                   "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\nv 1 0 0\n"
                                   "f 1 3 2\nf 1 3 2\nf 5 6 4\nf 1 3 4\nf 2 3 4\nf 1 2 6\n")
                                 .string();
    const Json json = json_of({"fix", file, "-o", out("b.glb")}, 0);
    ASSERT_EQ(json["objects"].size(), 1u);
    EXPECT_EQ(json["objects"][0]["closed"], true);
    EXPECT_EQ(json["objects"][0]["triangles_double"], 1);
    EXPECT_EQ(json["objects"][0]["triangles_turned"], 1);
    const Json info = json_of({"info", out("b.glb")}, 0);
    EXPECT_EQ(info["objects"][0]["kind"], "solid");
    EXPECT_EQ(info["objects"][0]["triangles"], 4);
    EXPECT_EQ(json_of({"fix", out("b.glb"), "-o", out("c.glb")}, 0)["objects"][0]["changed"], false);
}

TEST_F(Fix, HolesStay) {
    const std::string file =
        write("a.obj", "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n").string();
    const Json json = json_of({"fix", file, "-o", out("b.obj")}, 0);
    EXPECT_EQ(json["objects"][0]["open_edges"], 3);
}

TEST_F(Fix, BadMeshesAreRefused) {
    expect_bad_meshes_refused("fix", out("b.glb"));
    const std::string file = write("a.obj", "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    EXPECT_EQ(refusal({"fix", file, "-o", file}), "abut: " + file + ": is the mesh itself, and would be overwritten");
}

}  // namespace
}  // namespace abut
