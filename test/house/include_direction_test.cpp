// Includes have one direction: math <- {broad_phase, convex} <- shape <- query <- {motion, field, walk, world} <- bake
// <- {draw, io, c, recast}. Folders in one pair of braces don't include one another, but motion may use world. The
// library includes no tests, tools or scenes. Public headers include only the standard library, glm and abut.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

// The layer of each folder, and of the headers <abut/abut.hpp>, ... that include whole folders. Each may include its
// own folder and lower layers.
const std::map<std::string, int> kRank{{"math", 0},   {"broad_phase", 1}, {"convex", 1},   {"shape", 2},
                                       {"query", 3},  {"motion", 4},      {"field", 4},    {"walk", 4},
                                       {"world", 4},  {"abut.hpp", 5},    {"bake", 6},     {"bake.hpp", 7},
                                       {"draw", 8},   {"io", 8},          {"draw.hpp", 9}, {"io.hpp", 9},
                                       {"recast", 8}, {"recast.hpp", 9},  {"c", 8}};

std::vector<std::string> split(const fs::path& path) {
    std::vector<std::string> parts;
    for (const auto& part : path) parts.push_back(part.string());
    return parts;
}

// The fault of a file of abut's that includes a header of abut's, if any. Both are paths in the repository.
std::optional<std::string> wrong_own(const fs::path& file, const fs::path& header) {
    const std::string from = split(file)[1];
    const std::string to = split(header)[1];
    if (!kRank.contains(from) || !kRank.contains(to)) return "the repository has no such folder";
    if (from == to || (from == "motion" && to == "world")) return std::nullopt;
    return kRank.at(to) < kRank.at(from) ? std::nullopt : std::optional{"against the direction"};
}

struct Include {
    bool quoted;
    std::string target;
};

// The include on a line of source, if it holds one: #, include, and a name in quotes or angle brackets.
std::optional<Include> read_include(std::string_view line) {
    const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
    skip_blanks();
    if (!line.starts_with('#')) return std::nullopt;
    line.remove_prefix(1);
    skip_blanks();
    constexpr std::string_view kWord = "include";
    if (!line.starts_with(kWord)) return std::nullopt;
    line.remove_prefix(kWord.size());
    skip_blanks();
    if (!line.starts_with('<') && !line.starts_with('"')) return std::nullopt;
    const bool quoted = line.front() == '"';
    line.remove_prefix(1);
    const auto end = line.find(quoted ? '"' : '>');
    if (end == 0 || end == std::string_view::npos) return std::nullopt;
    return Include{quoted, std::string{line.substr(0, end)}};
}

// The fault of a line of a file under abut/, if any.
std::optional<std::string> wrong(const fs::path& file, std::string_view line) {
    const auto include = read_include(line);
    if (!include) return std::nullopt;

    const auto& [quoted, name] = *include;
    const fs::path target = quoted ? (file.parent_path() / name).lexically_normal() : fs::path{name};
    const auto parts = split(target);
    const std::string& root = parts[0];
    if (root == "abut" && parts.size() > 1) return wrong_own(file, target);
    if (quoted) return "quoted, and outside abut/";

    const bool is_header = file.extension() == ".hpp" || file.extension() == ".h";
    const std::string folder = split(file)[1];
    const bool is_c = file.extension() == ".h" && target.extension() == ".h";
    const bool is_standard = parts.size() == 1 && (target.extension().empty() || is_c);
    if (is_standard || root == "glm") return std::nullopt;
    if (is_header) return "a public header includes only the standard library, glm and abut";
    if (folder == "io") return std::nullopt;  // reads files, with whatever reads them
    if (folder == "recast" && root == "recastnavigation") return std::nullopt;
    if (root == "hwy") return std::nullopt;  // SIMD, in .cpp files alone
    if (file == "abut/math/detail/large_pages.cpp" && target == "sys/mman.h")
        return std::nullopt;  // where there is one
    return "abut needs only glm";
}

TEST(IncludeDirection, HoldsInTheWholeLibrary) {
    const fs::path root = ABUT_SOURCE_FOLDER;
    int includes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / "abut")) {
        const auto extension = entry.path().extension();
        const fs::path file = fs::relative(entry.path(), root);
        const bool is_c = extension == ".h" && split(file)[1] == "c";
        if (extension != ".hpp" && extension != ".cpp" && !is_c) continue;
        std::ifstream in(entry.path());
        ASSERT_TRUE(in) << file;
        std::string line;
        for (int number = 1; std::getline(in, line); ++number) {
            includes += read_include(line) ? 1 : 0;
            const auto problem = wrong(file, line);
            EXPECT_FALSE(problem) << file.string() << ':' << number << ": " << line << "\n    " << *problem;
        }
    }
    EXPECT_GT(includes, 100) << "it searched the wrong folder";
}

TEST(IncludeDirection, FindsReversedIncludes) {
    const struct {
        const char* file;
        const char* line;
    } bad[] = {
        {"abut/math/pose.hpp", "#include <abut/shape/ball.hpp>"},
        {"abut/math/pose.hpp", "\t#include<abut/shape/ball.hpp>"},
        {"abut/math/pose.cpp", "  #  include  <abut/query/closest.hpp>  // why"},
        {"abut/convex/gjk.cpp", "#include <abut/broad_phase/bvh.hpp>"},
        {"abut/broad_phase/bvh.cpp", "#include <abut/convex/gjk.hpp>"},
        {"abut/broad_phase/bvh.cpp", "#include \"../convex/gjk.hpp\""},
        {"abut/shape/mesh.hpp", "#include <abut/query/overlaps.hpp>"},
        {"abut/world/world.hpp", "#include <abut/motion/mover.hpp>"},
        {"abut/walk/walk_mesh.hpp", "#include <abut/world/world.hpp>"},
        {"abut/query/closest.hpp", "#include <abut/bake/field.hpp>"},
        {"abut/io/scene.hpp", "#include <abut/draw/canvas.hpp>"},
        {"abut/draw/canvas.hpp", "#include <abut/io/scene.hpp>"},
        {"abut/query/closest.hpp", "#include <abut/abut.hpp>"},
        {"abut/bake/field.hpp", "#include <abut/bake.hpp>"},
        {"abut/abut.hpp", "#include <abut/bake/field.hpp>"},
        {"abut/abut.hpp", "#include <abut/bake.hpp>"},
        {"abut/attic/box.hpp", "#include <abut/math/vec.hpp>"},
        {"abut/shape/box.hpp", "#include <abut/attic/box.hpp>"},
        {"abut/shape/box.hpp", "#include \"../../test/oracle/exact.hpp\""},
        {"abut/shape/box.cpp", "#include <scenes/level.hpp>"},
        {"abut/shape/box.cpp", "#include <tool/check/report.hpp>"},
        {"abut/shape/box.cpp", "#include <bench/peers.hpp>"},
        {"abut/shape/box.cpp", "#include <examples/touch.hpp>"},
        {"abut/shape/box.hpp", "#include <hwy/highway.h>"},
        {"abut/shape/box.cpp", "#include <nlohmann/json.hpp>"},
        {"abut/world/world.cpp", "#include <fmt/core.h>"},
        {"abut/io/scene.hpp", "#include <assimp/scene.h>"},
        {"abut/bake/field.cpp", "#include <assimp/scene.h>"},
        {"abut/walk/walk_mesh.hpp", "#include <abut/recast/bake_walk_mesh.hpp>"},
        {"abut/walk/walk_mesh.cpp", "#include <recastnavigation/Recast.h>"},
        {"abut/recast/bake_walk_mesh.hpp", "#include <recastnavigation/Recast.h>"},
        {"abut/recast/bake_walk_mesh.cpp", "#include <assimp/scene.h>"},
        {"abut/recast/bake_walk_mesh.cpp", "#include <abut/io/scene.hpp>"},
        {"abut/bake/field.cpp", "#include <abut/c/abut.h>"},
        {"abut/c/field.cpp", "#include <abut/io/scene.hpp>"},
        {"abut/c/field.cpp", "#include <stdio.h>"},
    };
    for (const auto& [file, line] : bad) EXPECT_TRUE(wrong(file, line)) << file << ": " << line;
}

TEST(IncludeDirection, AcceptsAllowedIncludes) {
    const struct {
        const char* file;
        const char* line;
    } good[] = {
        {"abut/math/pose.hpp", "#include <abut/math/vec.hpp>"},
        {"abut/math/vec.hpp", "#include <glm/vec3.hpp>"},
        {"abut/math/result.hpp", "#include <optional>"},
        {"abut/convex/gjk.cpp", "#include <hwy/highway.h>"},
        {"abut/shape/mesh.hpp", "#include <abut/broad_phase/bvh.hpp>"},
        {"abut/query/closest.cpp", "#include \"closest.hpp\""},
        {"abut/motion/mover.hpp", "#include <abut/world/world.hpp>"},
        {"abut/bake/field.hpp", "#include <abut/abut.hpp>"},
        {"abut/io/scene.cpp", "#include <assimp/scene.h>"},
        {"abut/io/scene.cpp", "#include <abut/bake/repair.hpp>"},
        {"abut/io/scene.cpp", "#include <abut/bake.hpp>"},
        {"abut/abut.hpp", "#include <abut/world/world.hpp>"},
        {"abut/bake.hpp", "#include <abut/bake/field.hpp>"},
        {"abut/io.hpp", "#include <abut/io/scene.hpp>"},
        {"abut/recast/bake_walk_mesh.cpp", "#include <recastnavigation/Recast.h>"},
        {"abut/recast/bake_walk_mesh.hpp", "#include <abut/walk/walk_mesh.hpp>"},
        {"abut/recast.hpp", "#include <abut/recast/bake_walk_mesh.hpp>"},
        {"abut/c/types.h", "#include <stdint.h>"},
        {"abut/c/field.cpp", "#include <abut/bake.hpp>"},
        {"abut/shape/box.hpp", "// like #include <abut/world/world.hpp>, but"},
    };
    for (const auto& [file, line] : good) EXPECT_FALSE(wrong(file, line)) << file << ": " << line;
}

}  // namespace
