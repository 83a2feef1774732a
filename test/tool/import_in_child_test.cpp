#include "tool/shared/import_in_child.hpp"

#include "../io/gltf_builder.hpp"

#include <cerrno>
#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace abut::tool {
namespace {

class ImportInChild : public test::SceneFiles {
protected:
    std::filesystem::path box() const {
        test::GltfBuilder builder;
        builder.add_node("Crate", builder.add_mesh("Box", test::box_triangles({1, 1, 1})));
        return write("box.glb", builder.glb());
    }
};

std::ptrdiff_t open_files() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

bool has_children() {
    return waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD;
}

TEST_F(ImportInChild, BringsTheScene) {
    const Result<Scene> here = read_scene(box());
    const Result<Scene> there = import_in_child(box(), {});
    ASSERT_TRUE(here && there);
    ASSERT_EQ(there->nodes.size(), 1u);
    EXPECT_EQ(there->nodes[0].name, "Crate");
    EXPECT_EQ(there->geometries[0].points, here->geometries[0].points);
    EXPECT_EQ(there->geometries[0].triangles, here->geometries[0].triangles);
}

TEST_F(ImportInChild, BringsTheProblem) {
    const Result<Scene> scene = import_in_child(folder() / "nowhere.glb", {});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.problem().code, ProblemCode::not_found);
    EXPECT_EQ(scene.problem().message, "no such file");
}

TEST_F(ImportInChild, DoesNotWaitForever) {
    const Result<Scene> scene = import_in_child(box(), {}, {.seconds = 0});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.problem().message, "the importer took longer than 0 s");
}

TEST_F(ImportInChild, LargeFilesMayTakeLonger) {
    EXPECT_EQ(limits_for(folder() / "nowhere.obj").seconds, 10u);
    EXPECT_EQ(limits_for(write("small.obj", "v 0 0 0\n")).seconds, 10u);
    EXPECT_EQ(limits_for(write("large.obj", std::string(5 << 20, ' '))).seconds, 20u);
    EXPECT_EQ(limits_for(box()).seconds, 60u);
}

TEST_F(ImportInChild, LimitsTheMemory) {
    if (!limits_memory()) GTEST_SKIP() << "not in builds with sanitizers";
    // A few bytes request 16 million points of zeros.
    const std::filesystem::path greedy = write("greedy.gltf", R"({"asset":{"version":"2.0"},
        "accessors":[{"count":16000000,"componentType":5126,"type":"VEC3"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})");
    const Result<Scene> scene = import_in_child(greedy, {}, {.bytes = std::uint64_t{300} << 20});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.problem().message, "the importer needs more than 300 MB of memory");
}

TEST_F(ImportInChild, OutlivesWhatCrashesAssimp) {
    // Assimp 5.2 has been seen to crash on triangles with colours in this format.
    const Result<Scene> scene =
        import_in_child(write("odd.raw", "Cube\n0.5 0.5 0.5 0 0 0 0 1 0 1 0 0\n0.5 0.5 0.5 0 0 0 0 1 0 1 0 0\n"), {});
    if (!scene) {
        EXPECT_FALSE(scene.problem().message.empty());
    }
}

TEST_F(ImportInChild, LeavesNothingBehind) {
    const std::filesystem::path good = box();
    const std::ptrdiff_t before = open_files();
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(import_in_child(good, {}));
        EXPECT_FALSE(import_in_child(folder() / "nowhere.glb", {}));
        EXPECT_FALSE(import_in_child(good, {}, {.seconds = 0}));
    }
    EXPECT_EQ(open_files(), before);
    EXPECT_FALSE(has_children());
}

}  // namespace
}  // namespace abut::tool
