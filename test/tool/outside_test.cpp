// Files that a scene or a level refers to: read if they are in its folder, refused if the path leads out of it.

#include "tool_runs.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace abut {
namespace {

using test::GltfBuilder;
using test::Ran;

constexpr const char* refused = "': lies outside of the file's folder (--allow-outside permits that)";

class Outside : public test::ToolRuns {
protected:
    Outside() {
        std::filesystem::create_directories(folder() / "in" / "below");
        builder_.add_node("Crate", builder_.add_mesh("Box", test::box_triangles({1, 1, 1})));
        const std::string bytes(reinterpret_cast<const char*>(builder_.bytes().data()), builder_.bytes().size());
        for (const char* name : {"secret.bin", "in/own.bin", "in/below/own.bin"}) write(name, bytes);
        std::filesystem::create_symlink("../secret.bin", folder() / "in" / "link.bin");
        std::filesystem::create_symlink("..", folder() / "in" / "up");
        std::filesystem::create_symlink("own.bin", folder() / "in" / "alias.bin");
        std::filesystem::create_symlink("loop.bin", folder() / "in" / "loop.bin");
    }

    /// A scene in the folder "in" whose buffer has this URI, as in JSON.
    std::string scene(const std::string& uri) const { return write("in/scene.gltf", builder_.text(uri)).string(); }

    std::string absolute() const { return std::filesystem::absolute(folder() / "secret.bin").string(); }

    GltfBuilder builder_;
};

TEST_F(Outside, WhatIsInTheFolderIsRead) {
    for (const char* uri :
         {"own.bin", "./own.bin", "below/own.bin", "below/../own.bin", "below%2fown.bin", "alias.bin"})
        EXPECT_EQ(run({"info", scene(uri)}).code, 0) << uri;
    // The folder is that of the file as it was named, which may be a link itself.
    scene("own.bin");
    std::filesystem::create_directories(folder() / "elsewhere");
    std::filesystem::create_symlink("../in/scene.gltf", folder() / "elsewhere" / "scene.gltf");
    std::filesystem::create_symlink("in", folder() / "linked");
    EXPECT_EQ(run({"info", (folder() / "linked" / "scene.gltf").string()}).code, 0);
    EXPECT_NE(refusal({"info", (folder() / "elsewhere" / "scene.gltf").string()}).find("'own.bin': no such file"),
              std::string::npos);
}

// Each of these was once read, and numbers from any file of the machine appeared in messages.
TEST_F(Outside, EveryPathOutIsRefused) {
    const std::vector<std::string> paths{"../secret.bin",
                                         "%2e%2e/secret.bin",
                                         "%2E%2e%2fsecret.bin",
                                         "./.././secret.bin",
                                         "below/../../secret.bin",
                                         "none/../../secret.bin",
                                         "own.bin/../../secret.bin",
                                         absolute(),
                                         "/" + absolute(),
                                         "file://" + absolute(),
                                         "FILE://localhost" + absolute(),
                                         "file:" + absolute(),
                                         "link.bin",
                                         "up/secret.bin",
                                         "below/../up/secret.bin"};
    for (const std::string& path : paths) {
        const std::string file = scene(path);
        const std::string line = refusal({"info", file});
        EXPECT_TRUE(line.starts_with("abut: " + file + ": mesh 'Box': accessors[0]: buffers[0]: '")) << line;
        EXPECT_TRUE(line.ends_with(refused)) << line;
        const bool exists = path.find("none/") == std::string::npos && path.find("own.bin/") == std::string::npos;
        if (exists) {
            EXPECT_EQ(run({"info", file, "--allow-outside"}).code, 0) << path;
        }
    }
    // Missing files give the same message, so that nobody learns which files exist.
    for (const char* path : {"../none.bin", "..\\\\secret.bin", "\\\\\\\\server\\\\secret.bin", "C:/secret.bin",
                             "c:\\\\secret.bin", "up/none.bin", "/etc/none"})
        EXPECT_TRUE(refusal({"info", scene(path)}).ends_with(refused)) << path;
}

TEST_F(Outside, OtherBadNamesAreNamed) {
    const auto complaint = [&](const std::string& uri) {
        const std::string line = refusal({"info", scene(uri)});
        return line.substr(line.find("buffers[0]: ") + 12);
    };
    EXPECT_EQ(complaint("own.bin%00.png"), "'own.bin\\x00.png': isn't the name of a file");
    EXPECT_EQ(complaint("http://example.org/own.bin"), "'http://example.org/own.bin': isn't a file beside this one");
    EXPECT_EQ(complaint("%252e%252e/secret.bin"), "'%2e%2e/secret.bin': no such file") << "decoded once";
    const std::string shown = complaint(std::string(100'000, 'x'));
    EXPECT_LT(shown.size(), 300u);
    EXPECT_NE(complaint("loop.bin").find("can't be read"), std::string::npos);
    EXPECT_EQ(complaint("below"), "'below': is a directory");
}

TEST_F(Outside, EveryVerbThatReadsScenes) {
    const std::string file = scene("../secret.bin");
    const std::vector<std::vector<std::string>> verbs{{"check", file},
                                                      {"info", file},
                                                      {"cast", file, "--from", "-5,0,0", "--to", "5,0,0"},
                                                      {"hull", file, "-o", out("hull.obj")},
                                                      {"decompose", file, "-o", out("parts.obj")},
                                                      {"field", file, "-o", out("a.field"), "--cell", "0.5"},
                                                      {"walk", file}};
    for (std::vector<std::string> verb : verbs) {
        EXPECT_TRUE(refusal(verb).ends_with(refused)) << verb[0];
        verb.push_back("--allow-outside");
        EXPECT_NE(run(verb).code, 2) << verb[0];
    }
}

TEST_F(Outside, WhatAssimpOpens) {
    const auto obj = [&](const std::string& library) {
        return write("in/a.obj", "mtllib " + library + "\no A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
            .string();
    };
    const char* material = "newmtl red\nKd 1 0 0\n";
    write("secret.mtl", material);
    write("in/own.mtl", material);
    std::filesystem::create_symlink("../secret.mtl", folder() / "in" / "link.mtl");
    for (const std::string library : {"own.mtl", "none.mtl", "./below/../own.mtl"})
        EXPECT_EQ(run({"info", obj(library)}).code, 0) << library;
    for (const std::string library : {"../secret.mtl", "/etc/passwd", "link.mtl", "up/secret.mtl"}) {
        const std::string file = obj(library);
        const std::string line = refusal({"info", file});
        EXPECT_TRUE(line.ends_with(refused)) << line;
        EXPECT_EQ(run({"info", file, "--allow-outside"}).code, 0) << library;
    }
    // A scene of another file.
    write("secret.obj", "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string lws = write("in/a.lws", "LWSC\n1\n\nLoadObject ../secret.obj\n").string();
    EXPECT_TRUE(refusal({"info", lws}).ends_with("no triangles in it: 0 objects")) << "not found";
    EXPECT_EQ(run({"info", lws, "--allow-outside"}).code, 0);
}

TEST_F(Outside, TilesetsAndTemplates) {
    const std::string set =
        "<tileset tilewidth='8' tileheight='8'><tile id='0'><objectgroup><object width='8' height='4'/>"
        "</objectgroup></tile></tileset>";
    const std::string made = "<template><object name='Box' width='8' height='8'/></template>";
    for (const char* name : {"secret.tsx", "in/own.tsx", "in/below/own.tsx"}) write(name, set);
    for (const char* name : {"secret.tx", "in/own.tx"}) write(name, made);
    std::filesystem::create_symlink("../secret.tsx", folder() / "in" / "link.tsx");
    const auto tmx = [&](const std::string& source, const std::string& object) {
        return write("in/m.tmx",
                     "<map tilewidth='8' tileheight='8' width='1' height='1'><tileset firstgid='1' source='" + source +
                         "'/><layer name='L'><data encoding='csv'>1</data></layer>" +
                         "<objectgroup name='O'><object id='1' x='0' y='0'" + object + "/></objectgroup></map>")
            .string();
    };
    const auto tmj = [&](const std::string& source, const std::string& object) {
        return write("in/m.tmj",
                     R"({"tilewidth":8,"tileheight":8,"width":1,"height":1,"tilesets":[{"firstgid":1,"source":")" +
                         source + R"("}],"layers":[{"type":"tilelayer","name":"L","width":1,"height":1,)" +
                         R"("data":[1]},{"type":"objectgroup","name":"O","objects":[{"id":1,"x":0,"y":0)" + object +
                         "}]}]}")
            .string();
    };
    const std::string plain_xml = " width='8' height='8'", plain_json = R"(,"width":8,"height":8)";
    for (const std::string source : {"own.tsx", "below/own.tsx", "below/../own.tsx"}) {
        EXPECT_EQ(run({"info", tmx(source, plain_xml)}).code, 0) << source;
        EXPECT_EQ(run({"info", tmj(source, plain_json)}).code, 0) << source;
    }
    for (const std::string& source :
         {std::string("../secret.tsx"), std::string("below/../../secret.tsx"), std::string("link.tsx"),
          std::string("up/secret.tsx"), (folder() / "secret.tsx").string(),
          "file://" + (folder() / "secret.tsx").string()}) {
        for (const std::string& file : {tmx(source, plain_xml), tmj(source, plain_json)}) {
            EXPECT_TRUE(refusal({"check", file}).ends_with(refused)) << source;
            EXPECT_NE(run({"check", file, "--allow-outside"}).code, 2)
                << source << run({"check", file, "--allow-outside"}).err;
        }
    }
    EXPECT_NE(run({"check", tmx("own.tsx", " template='own.tx'")}).code, 2);
    EXPECT_TRUE(refusal({"check", tmx("own.tsx", " template='../secret.tx'")}).ends_with(refused));
    EXPECT_TRUE(refusal({"check", tmj("own.tsx", R"(,"template":"../secret.tx")")}).ends_with(refused));
    // A template's own tileset is relative to the template.
    write("in/below/up.tx", "<template><tileset firstgid='1' source='../../secret.tsx'/><object gid='1'/></template>");
    EXPECT_TRUE(refusal({"check", tmx("own.tsx", " template='below/up.tx'")}).ends_with(refused));
    // Pictures aren't read, wherever they are.
    const std::string picture =
        "<tileset firstgid='1' tilewidth='8' tileheight='8'><image source='../../../etc/passwd'/></tileset>"
        "<layer name='L'><data encoding='csv'>1</data></layer>";
    EXPECT_EQ(
        run({"info", write("in/p.tmx", "<map tilewidth='8' tileheight='8' width='1' height='1'>" + picture + "</map>")
                         .string()})
            .code,
        0);
}

TEST_F(Outside, DrawingsReadNoOtherFile) {
    const auto drawing = [&](const std::string& more) {
        return write("in/d.svg", "<svg><rect id='r' width='8' height='8'/>" + more + "</svg>").string();
    };
    write("secret.svg", "<svg><rect id='s' width='8' height='8'/></svg>");
    const Ran there = run({"info", drawing("<use href='../secret.svg#s'/><image href='../secret.svg'/>")});
    EXPECT_EQ(there.code, 0) << there.err;
    std::filesystem::remove(folder() / "secret.svg");
    EXPECT_EQ(run({"info", drawing("<use href='../secret.svg#s'/><image href='../secret.svg'/>")}).out, there.out);
}

}  // namespace
}  // namespace abut
