// `abut field` as a command line.

#include "../../scenes/solid_meshes.hpp"
#include "tool_runs.hpp"
#include <abut/field/file.hpp>
#include <abut/io/file/read_file.hpp>
#include <abut/io/write_obj.hpp>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class FieldVerb : public test::ToolRuns {
protected:
    Json baked(std::vector<std::string> arguments, int code = 0) const {
        arguments.insert(arguments.begin(), "field");
        return json_of(std::move(arguments), code);
    }
    std::string write_mesh(const std::string& name, const scenes::SolidMesh& mesh) const {
        return write(name, *write_obj(std::vector{Geometry{"mesh", mesh.points, mesh.triangles}})).string();
    }
    std::string cube() const { return write_mesh("cube.obj", scenes::of_cubes({{"#"}})); }
    template <int D>
    static Field<D> loaded(const std::string& file) {
        const Result<std::vector<std::byte>> bytes = detail::read_file(file);
        EXPECT_TRUE(bytes) << file;
        Result<Field<D>> field = load_field<D>(*bytes);
        EXPECT_TRUE(field) << (field ? "" : field.problem().message);
        return *std::move(field);
    }
    static std::size_t count(const std::string& text, std::string_view what) {
        std::size_t result = 0;
        for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++result;
        return result;
    }
};

TEST_F(FieldVerb, WritesAFieldThatIsTheMesh) {
    const std::string file = cube();
    const Json json = baked({file, "-o", out("cube.field"), "--cell", "0.05"});
    EXPECT_EQ(json["output"], out("cube.field"));
    EXPECT_EQ(json["triangles"], 12);
    EXPECT_EQ(json["closed"], true);
    EXPECT_EQ(json["gaps"], 0);
    EXPECT_EQ(json["rewound"], 0);
    EXPECT_EQ(json["doubtful"], 0);
    EXPECT_EQ(json["field"]["dimension"], 3);
    EXPECT_EQ(json["field"]["store"], "sparse");
    EXPECT_EQ(json["field"]["lookup"], "linear");
    EXPECT_EQ(json["field"]["bits"], 32);
    EXPECT_NEAR(json["field"]["cell"].get<double>(), 0.05, 1e-6);
    EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(out("cube.field")));
    for (const char* stage : {"read", "bake", "measure", "write"})
        EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;

    const Field3 field = loaded<3>(out("cube.field"));
    EXPECT_EQ(json["field"]["samples"], field.data().samples());
    EXPECT_EQ(json["field"]["bytes"], field.bytes());
    EXPECT_NEAR(field.distance({0.5f, 0.5f, 0.5f}), -0.5, 0.2) << "a block from the ridges of the inside";
    EXPECT_NEAR(field.distance({0.5f, 0.5f, 0.9f}), -0.1, 1e-5);
    EXPECT_NEAR(field.distance({0.5f, 0.5f, 1.1f}), 0.1, 1e-5);
}

TEST_F(FieldVerb, MeasuresHowFarOffItIs) {
    const std::string file = write_mesh("tube.obj", scenes::knotted_tube(48, 8));
    const Json rough = baked({file, "-o", out("rough.field")})["error"];
    for (const char* where : {"near", "volume"}) {
        const Json& error = rough[where];
        EXPECT_GT(error["points"], 1000) << where;
        EXPECT_GT(error["rms"], 0) << where;
        EXPECT_GT(error["max"], error["rms"]) << where;
        EXPECT_LT(error["wrong_side"].get<double>(), 0.05 * error["points"].get<double>()) << where;
    }
    EXPECT_LT(rough["near"]["points"], rough["volume"]["points"]);
    const double cell = baked({file, "-o", out("same.field")})["field"]["cell"];
    const Json fine = baked({file, "-o", out("fine.field"), "--cell", std::to_string(cell / 2)})["error"];
    EXPECT_LT(fine["near"]["rms"].get<double>(), 0.7 * rough["near"]["rms"].get<double>());
    const Json sharp = baked({file, "-o", out("sharp.field"), "--gradient"})["error"];
    EXPECT_LT(sharp["near"]["rms"], rough["near"]["rms"]);
}

TEST_F(FieldVerb, StoresItsOptions) {
    const std::string file = cube();
    const Json sparse = baked({file, "-o", out("a.field"), "--cell", "0.04"})["field"],
               wide = baked({file, "-o", out("b.field"), "--cell", "0.04", "--band", "9"})["field"],
               dense = baked({file, "-o", out("c.field"), "--cell", "0.04", "--dense"})["field"],
               halved = baked({file, "-o", out("d.field"), "--cell", "0.04", "--dense", "--quantised"})["field"],
               sharp = baked({file, "-o", out("e.field"), "--cell", "0.04", "--gradient"})["field"],
               padded = baked({file, "-o", out("f.field"), "--cell", "0.04", "--padding", "10"})["field"];
    EXPECT_GT(wide["samples"], sparse["samples"]);
    EXPECT_EQ(dense["store"], "dense");
    EXPECT_EQ(halved["bits"], 16);
    EXPECT_EQ(halved["samples"], dense["samples"]);
    EXPECT_LT(halved["bytes"].get<double>(), 0.6 * dense["bytes"].get<double>());
    EXPECT_EQ(sharp["lookup"], "gradient");
    EXPECT_GT(sharp["bytes"], sparse["bytes"]);
    EXPECT_LE(padded["min"][0], -0.4f + 1e-4f);
    EXPECT_GT(sparse["min"][0], -0.4f);
    EXPECT_EQ(loaded<3>(out("d.field")).data().steps.size(), dense["samples"]);
}

TEST_F(FieldVerb, SaysWhatItDid) {
    const Ran ran = run({"field", cube(), "-o", out("cube.field")});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    for (const char* said : {"12 triangles: closed\n", "of 32 bits", "blocks have bricks", "signs       all certain",
                             "cells root mean square", "s to read"})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;
}

TEST_F(FieldVerb, ReportsUndecidedSamples) {
    scenes::SolidMesh mesh = scenes::of_cubes({{"#"}});
    std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
    const Json turned = baked({write_mesh("turned.obj", mesh), "-o", out("turned.field")});
    EXPECT_EQ(turned["rewound"], 1);
    EXPECT_EQ(turned["closed"], true);
    mesh.triangles.pop_back();
    const std::string file = write_mesh("open.obj", mesh);
    const Json open = baked({file, "-o", out("open.field")}, 1);
    EXPECT_EQ(open["closed"], false);
    EXPECT_EQ(open["gaps"], 3);
    EXPECT_GT(open["doubtful"], 0);
    const Ran ran = run({"field", file, "-o", out("open.field")});
    EXPECT_EQ(ran.code, 1);
    for (const char* said : {"not closed, 3 edges on the boundary, 1 triangle reversed", "% of the samples uncertain"})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;
    EXPECT_LT(loaded<3>(out("open.field")).distance({0.5f, 0.5f, 0.5f}), 0) << "it is written all the same";
}

TEST_F(FieldVerb, TakesObjectsWhereTheyStand) {
    GltfBuilder builder;
    builder.add_mesh("Box", box_triangles({1, 1, 1}));
    builder.add_node("Left", 0, {-5, 0, 0});
    builder.add_node("Right", ",\"mesh\":0,\"translation\":[5,0,0],\"scale\":[-2,1,1]");
    const Json json = baked({write("two.gltf", builder.text()).string(), "-o", out("two.field")});
    EXPECT_EQ(json["triangles"], 24);
    EXPECT_EQ(json["rewound"], 0);
    const Field3 field = loaded<3>(out("two.field"));
    EXPECT_LT(field.distance({-5, 0, 0}), 0);
    EXPECT_GT(field.distance({0, 0, 0}), 0);
    EXPECT_LT(field.distance({6.5f, 0, 0}), 0);
}

TEST_F(FieldVerb, BakesLevelsOfThePlane) {
    const std::string file = write("level.svg",
                                   R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30">
                                      <rect x="5" y="5" width="10" height="20"/>
                                      <rect x="12" y="5" width="20" height="8"/></svg>)")
                                 .string();
    const Json json = baked({file, "-o", out("level.field"), "--cell", "0.5", "--picture", out("level.svg.svg")});
    EXPECT_EQ(json["objects"], 2);
    EXPECT_EQ(json["field"]["dimension"], 2);
    const Field2 field = loaded<2>(out("level.field"));
    EXPECT_NEAR(field.distance({7, 20}), -2, 1e-5);
    EXPECT_NEAR(field.distance({13.5f, 9}), -4, 1e-5) << "where both lie there is no border";
    EXPECT_GT(field.distance({25, 20}), 0);
    EXPECT_TRUE(content(out("level.svg.svg")).ends_with("</svg>\n"));
}

TEST_F(FieldVerb, DrawsSlices) {
    const std::string file = cube(), picture = out("cube.svg");
    baked({file, "-o", out("cube.field"), "--picture", picture});
    const std::string svg = content(picture);
    EXPECT_TRUE(svg.starts_with("<svg")) << svg.substr(0, 100);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    for (const char* said : {"x = 0.5", "y = 0.5", "z = 0.5", "lines every"}) EXPECT_EQ(count(svg, said), 1u) << said;
    baked({file, "-o", out("cube.field"), "--picture", picture});
    EXPECT_EQ(content(picture), svg) << "the same bytes";
    baked({file, "-o", out("cube.field"), "--picture", picture, "--slice", "z=0.3", "--slice", "x=-0.01"});
    const std::string two = content(picture);
    EXPECT_EQ(count(two, "z = 0.3"), 1u);
    EXPECT_EQ(count(two, "x = -0.01"), 1u);
    EXPECT_EQ(count(two, "y = "), 0u);
}

TEST_F(FieldVerb, InfoDescribesAField) {
    const Json json = baked({cube(), "-o", out("cube.field")});
    const Json info = json_of({"info", out("cube.field")}, 0);
    for (const auto& [key, value] : json["field"].items()) EXPECT_EQ(info[key], value) << key;
    EXPECT_EQ(info["file_bytes"], json["file_bytes"]);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(info["surface"]["min"][static_cast<std::size_t>(i)].get<double>(), 0, 0.02);
        EXPECT_NEAR(info["surface"]["max"][static_cast<std::size_t>(i)].get<double>(), 1, 0.02);
    }
    const Ran ran = run({"info", out("cube.field")});
    EXPECT_EQ(ran.code, 0);
    for (const char* said : {"volume      ", "samples     ", "surface     from (", "file        "})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;

    std::string bytes = content(out("cube.field"));
    EXPECT_EQ(refusal({"info", out("none.field")}), "abut: " + out("none.field") + ": no such file");
    EXPECT_EQ(refusal({"info", write("text.field", "no field at all").string()}),
              "abut: " + out("text.field") + ": this is not a field: its signature is wrong");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    EXPECT_EQ(refusal({"info", write("damaged.field", bytes).string()}),
              "abut: " + out("damaged.field") + ": the field is damaged: its checksum is wrong");
}

TEST_F(FieldVerb, RefusesInOneLine) {
    const std::string file = cube();
    const auto refused = [&](const std::vector<std::string>& more) { return refusal("field", file, more); };
    EXPECT_EQ(refused({"-o", "cube.bin"}), "abut: cube.bin: doesn't end in .field");
    EXPECT_EQ(refused({"-o", out("none/c.field")}),
              "abut: " + out("none/c.field") + ": can't be written: No such file or directory");
    EXPECT_EQ(refused({"-o", out("c.field"), "--picture", out("none/c.svg")}),
              "abut: " + out("none/c.svg") + ": can't be written: No such file or directory");
    for (const char* cell : {"0", "-1", "nan", "inf", "ten"})
        EXPECT_EQ(refused({"-o", out("c.field"), "--cell", cell}),
                  "abut: --cell: '" + std::string(cell) + "' is not a number above 0");
    EXPECT_EQ(refused({"-o", out("c.field"), "--padding", "0.5"}),
              "abut: --padding: '0.5' is not a number from 1 to 1000000");
    EXPECT_EQ(refused({"-o", out("c.field"), "--band", "0"}), "abut: --band: '0' is not a number from 1 to 1000000");
    EXPECT_EQ(refused({"-o", out("c.field"), "--picture", out("c.svg"), "--slice", "w=1"}),
              "abut: --slice: 'w=1' is not an axis and a number, such as z=0.3");
    EXPECT_EQ(refused({"-o", out("c.field"), "--slice", "z=1"}), "abut: --slice needs --picture");
    EXPECT_EQ(refused({"-o", out("c.field"), "--cell", "1e-5"}),
              "abut: " + file +
                  ": the field would have more than 2^31 samples: a larger --cell or a smaller --padding makes fewer");
    EXPECT_TRUE(refused({"-o", out("c.field"), "--dense", "--band", "3"}).starts_with("abut: "));
    expect_bad_meshes_refused("field", out("p.field"));
}

}  // namespace
}  // namespace abut
