// Writes meshes, and reads them again with this library and with Assimp.

#include "../oracle/random.hpp"
#include "gltf_builder.hpp"
#include <abut/io/file/base64.hpp>
#include <abut/io/file/read_file.hpp>
#include <abut/io/mesh/read_assimp.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/write_file.hpp>
#include <abut/io/write_gltf.hpp>
#include <abut/io/write_mesh.hpp>
#include <abut/io/write_obj.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace abut {

using namespace detail;

namespace {

using Corners = std::array<std::array<float, 3>, 3>;

/// A canonical form that doesn't depend on the order of points: triangles, each from its least corner on.
std::vector<Corners> triangles_of(const Geometry& mesh) {
    std::vector<Corners> result;
    for (const glm::uvec3& t : mesh.triangles) {
        Corners corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.points[t[static_cast<glm::length_t>(k)]];
            corners[k] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        result.push_back(corners);
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Convex parts of random points, with coordinates that need all their digits.
std::vector<Geometry> some_parts(std::uint64_t seed) {
    oracle::Random random(seed);
    std::vector<Geometry> parts;
    for (int part = 0; part < 4; ++part) {
        const double scale = random.power_of_two(-12, 12);
        std::vector<Vec3> points;
        for (int i = 0; i < 20; ++i) points.push_back(to_float(random.in_cube<3>() * scale));
        parts.push_back(mesh_of(*Polyhedron::build(points), "part_" + std::to_string(part)));
    }
    return parts;
}

class WriteMesh : public test::SceneFiles {
protected:
    /// Compares to within `ulps` of the largest coordinate: Assimp reads decimal numbers to about one.
    static void expect_same(const Result<Scene>& scene, const std::vector<Geometry>& parts, float ulps) {
        ASSERT_TRUE(scene) << scene.problem().message;
        EXPECT_TRUE(scene->warnings.empty());
        std::vector<std::size_t> with_geometry;
        for (std::size_t i = 0; i < scene->nodes.size(); ++i)
            if (!scene->nodes[i].geometries.empty()) with_geometry.push_back(i);
        ASSERT_EQ(with_geometry.size(), parts.size()) << "one node a part";
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const SceneNode& node = scene->nodes[with_geometry[i]];
            EXPECT_TRUE(path(*scene, with_geometry[i]).ends_with(parts[i].name)) << path(*scene, with_geometry[i]);
            EXPECT_EQ(node.local, glm::dmat4(1.0));
            ASSERT_EQ(node.geometries.size(), 1u);
            const std::vector<Corners> got = triangles_of(scene->geometries[node.geometries[0]]);
            const std::vector<Corners> expected = triangles_of(parts[i]);
            ASSERT_EQ(got.size(), expected.size());
            for (std::size_t t = 0; t < got.size(); ++t)
                for (std::size_t k = 0; k < 9; ++k) {
                    const float number = expected[t][k / 3][k % 3];
                    EXPECT_NEAR(got[t][k / 3][k % 3], number, ulps * 0x1p-23f * std::abs(number)) << t;
                }
        }
    }
    std::string text_of(const std::filesystem::path& file) {
        const std::vector<std::byte> bytes = *read_file(file);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    std::size_t files_in_folder() {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder()), {}));
    }
};

TEST_F(WriteMesh, ComesBackAsItWas) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<Geometry> parts = some_parts(seed);
        for (const char* name : {"parts.gltf", "parts.glb", "parts.obj", "PARTS.GLB"}) {
            SCOPED_TRACE(name);
            const std::filesystem::path file = folder() / name;
            EXPECT_TRUE(can_write_meshes(file));
            const std::optional<Problem> problem = write_meshes(file, parts);
            ASSERT_FALSE(problem) << problem->message;
            const float ulps = file.extension() == ".obj" ? 2 : 0;
            expect_same(read_scene(file), parts, ulps);
            const Result<ReadScene> other = read_assimp(file, {});
            ASSERT_TRUE(other) << other.problem().message;
            expect_same(other->scene, parts, ulps);
        }
        EXPECT_EQ(files_in_folder(), 4u);
    }
}

TEST_F(WriteMesh, WritesGltfAsSpecified) {
    const std::vector<Geometry> parts = some_parts(7);
    const nlohmann::json json = nlohmann::json::parse(*write_gltf(parts));
    EXPECT_EQ(json["asset"]["version"], "2.0");
    ASSERT_EQ(json["buffers"].size(), 1u);
    ASSERT_EQ(json["nodes"].size(), parts.size());
    ASSERT_EQ(json["accessors"].size(), 2 * parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_EQ(json["nodes"][i]["name"], parts[i].name);
        const auto& points =
            json["accessors"][json["meshes"][i]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
        for (std::size_t k = 0; k < 3; ++k) {
            float low = std::numeric_limits<float>::infinity(), high = -low;
            for (const Vec3& p : parts[i].points) {
                low = std::min(low, p[static_cast<int>(k)]);
                high = std::max(high, p[static_cast<int>(k)]);
            }
            EXPECT_EQ(points["min"][k].get<float>(), low);
            EXPECT_EQ(points["max"][k].get<float>(), high);
        }
    }
    std::size_t end = 0;
    for (const auto& view : json["bufferViews"]) {
        EXPECT_EQ(view["byteOffset"], end);
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
        end += view["byteLength"].get<std::size_t>();
    }
    EXPECT_EQ(json["buffers"][0]["byteLength"], end);
    const std::vector<std::byte> glb = *write_glb(parts);
    EXPECT_EQ(glb.size() % 4, 0u);
    EXPECT_EQ(std::to_integer<std::size_t>(glb[8]) | std::to_integer<std::size_t>(glb[9]) << 8 |
                  std::to_integer<std::size_t>(glb[10]) << 16,
              glb.size());
}

TEST_F(WriteMesh, WritesAnObjThatPeopleCanRead) {
    const Geometry triangle{"a\nname", {{0, 0.5f, -1}, {1, 0, 0}, {0.1f, 1e-10f, 3e20f}}, {{0, 1, 2}}};
    Geometry unnamed = triangle;
    unnamed.name.clear();
    EXPECT_EQ(*write_obj(std::vector{triangle, unnamed}),
              "# obj, written by abut\no a_name\nv 0 0.5 -1\nv 1 0 0\nv 0.1 1e-10 3e+20\nf 1 2 3\n"
              "o part\nv 0 0.5 -1\nv 1 0 0\nv 0.1 1e-10 3e+20\nf 4 5 6\n");
}

TEST_F(WriteMesh, TheDigitsOfAnObjAreTheFloats) {
    const std::vector<Geometry> parts = some_parts(3);
    std::istringstream text(*write_obj(parts));
    std::vector<Vec3> points;
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with("v ")) continue;
        Vec3 point;
        const char *at = line.data() + 1, *end = line.data() + line.size();
        for (int i = 0; i < 3; ++i) at = std::from_chars(at + 1, end, point[i]).ptr;
        points.push_back(point);
    }
    std::vector<Vec3> expected;
    for (const Geometry& part : parts) expected.insert(expected.end(), part.points.begin(), part.points.end());
    EXPECT_EQ(points, expected);
}

TEST_F(WriteMesh, TakesNamesThatAreNoText) {
    std::vector<Geometry> parts = some_parts(1);
    parts[0].name = "\xff\xfe \"quoted\" \\";
    parts[1].name = "";
    EXPECT_TRUE(read_scene(test::bytes_of(*write_gltf(parts)), ".gltf"));
    EXPECT_TRUE(read_scene(*write_glb(parts), ".glb"));
}

TEST_F(WriteMesh, OfFlatPartsWritesBothSides) {
    const Polyhedron square = *Polyhedron::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    EXPECT_EQ(mesh_of(square).triangles.size(), 4u);
    EXPECT_TRUE(write_gltf(std::vector{mesh_of(square)}));
    EXPECT_TRUE(mesh_of(Polyhedron()).triangles.empty());
}

TEST_F(WriteMesh, NamesWhatCantBeWritten) {
    const std::vector<Geometry> good = some_parts(2);
    const auto problem = [](const std::vector<Geometry>& meshes) {
        const Result<std::string> gltf = write_gltf(meshes), obj = write_obj(meshes);
        const Result<std::vector<std::byte>> glb = write_glb(meshes);
        EXPECT_FALSE(gltf || obj || glb);
        return gltf ? Problem{} : gltf.problem();
    };
    EXPECT_EQ(problem({}).code, ProblemCode::empty_input);
    std::vector<Geometry> bad = good;
    bad[2].triangles.clear();
    EXPECT_EQ(problem(bad).message, "mesh 2 'part_2' has no triangles");
    bad = good;
    bad[1].points[3].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(problem(bad).code, ProblemCode::not_finite);
    EXPECT_EQ(problem(bad).index, 1u);
    bad = good;
    bad[3].triangles[0].z = 1000;
    EXPECT_EQ(problem(bad).code, ProblemCode::index_out_of_range);

    const auto refusal = [&](const std::filesystem::path& file) {
        const std::optional<Problem> refused = write_meshes(file, good);
        return refused ? refused->message : std::string();
    };
    EXPECT_EQ(refusal(folder() / "parts.stl"), "doesn't end in .gltf, .glb or .obj");
    EXPECT_EQ(refusal(folder() / "none" / "parts.obj"), "can't be written: No such file or directory");
    std::filesystem::create_directory(folder() / "folder.obj");
    EXPECT_EQ(refusal(folder() / "folder.obj"), "can't be written: it is a directory");
    EXPECT_EQ(files_in_folder(), 1u) << "nothing half-written stays";
}

TEST_F(WriteMesh, FilesAreReplacedAsAWhole) {
    const std::filesystem::path file = write("file", "old"), link = folder() / "link";
    std::filesystem::create_symlink(file, link);
    EXPECT_FALSE(write_file(link, "new"));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(text_of(file), "new");
    write("file.part0", "somebody else's");
    EXPECT_FALSE(write_file(file, ""));
    EXPECT_EQ(text_of(file), "");
    EXPECT_EQ(text_of(folder() / "file.part0"), "somebody else's");
    EXPECT_EQ(files_in_folder(), 3u);
    EXPECT_FALSE(write_file("/dev/null", "gone"));
    const std::optional<Problem> full = write_file("/dev/full", "too much");
    ASSERT_TRUE(full);
    EXPECT_EQ(full->message, "can't be written: No space left on device");
}

TEST_F(WriteMesh, ReplacedFilesKeepTheirMode) {
    const std::filesystem::path file = write("file", "old");
    const auto mode = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write |
                      std::filesystem::perms::group_write | std::filesystem::perms::others_exec;
    std::filesystem::permissions(file, mode);
    EXPECT_FALSE(write_file(file, "new"));
    EXPECT_EQ(text_of(file), "new");
    EXPECT_EQ(std::filesystem::status(file).permissions(), mode);
}

TEST(Base64, IsWhatComesBack) {
    std::string text;
    for (const char* expected : {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"}) {
        EXPECT_EQ(encode_base64(test::bytes_of(text)), expected);
        EXPECT_EQ(*decode_base64(expected), test::bytes_of(text));
        text = std::string("foobar").substr(0, text.size() + 1);
    }
}

}  // namespace
}  // namespace abut
