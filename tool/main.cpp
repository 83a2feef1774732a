// The tool `abut`: collision checks for asset pipelines. What is asked of it, and by which verb.

#include "arguments.hpp"
#include "out_of_memory.hpp"
#include "verbs.hpp"

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace abut::tool {
namespace {

int fail(const std::string& message) {
    std::fputs(one_line(message).c_str(), stderr);
    return unusable;
}

constexpr const char* files =
    "In 3D glTF 2.0, or anything else that Assimp reads; in 2D a Tiled map (.tmx, .tmj) or a drawing (.svg)";

// How files are read. Verbs that mend meshes have no use for --strict.
void describe(CLI::App& verb, FileOptions& options, bool can_be_strict) {
    verb.add_flag("--allow-outside", options.allow_outside,
                  "Read what the file refers to outside of its own folder too, such as ../shared/a.bin");
    if (!can_be_strict) return;
    CLI::Option* strict = verb.add_flag("--strict", options.strict,
                                        "Refuse a file with a triangle of zero area; without it those are left out and "
                                        "counted");
    // What scripts of earlier versions ask for is so anyway.
    verb.add_flag("--skip-degenerate")->group("")->excludes(strict);
}

// What was typed for `abut check`, numbers and patterns as text.
struct CheckArguments {
    CheckRequest request;
    std::optional<std::string> clearance, allow, frames, character, up, gap;
    std::vector<std::string> pairs;
};

void describe(CLI::App& verb, CheckArguments& arguments) {
    verb.add_option("SCENE", arguments.request.scene, files)->required();
    verb.add_option("--clearance", arguments.clearance,
                    "Report pairs closer than D too, unless they rest on one another")
        ->type_name("D");
    verb.add_option("--allow", arguments.allow, "Depth to overlook; without it 1e-3 of the smaller object's size")
        ->type_name("DEPTH");
    verb.add_option("--baseline", arguments.request.baseline,
                    "Report only what this earlier --json report doesn't have")
        ->type_name("OLD.json");
    verb.add_option(
            "--frames", arguments.frames,
            "Look at N moments, evenly spread; without it at the file's key times, at most 30 a second. Between "
            "them pairs are followed all the way")
        ->type_name("N");
    verb.add_option("--pairs", arguments.pairs,
                    "Only pairs of an object that A describes and one that B does, path or name, with * and ?")
        ->type_name("A:B")
        ->allow_extra_args(false);
    verb.add_option("--spawn", arguments.request.faults.spawns,
                    "Where characters enter: nodes or points by path, name or class, with * and ?. Without it those "
                    "with 'spawn' or 'player_start' in their name or class, in capitals or not")
        ->type_name("PATTERN")
        ->allow_extra_args(false);
    verb.add_option("--character", arguments.character,
                    "A standing capsule, its lowest point at the spawn; where nothing is up, a ball around it. It must "
                    "have room there, and pass everywhere")
        ->type_name("RADIUS,HEIGHT");
    verb.add_option(
            "--up", arguments.up,
            "Which way it stands: x, -x, y, -y, z, -z or none. Without it y in 3D, and none in 2D; a level seen "
            "from the side has -y, as y points down in its file")
        ->type_name("AXIS");
    verb.add_option("--gap", arguments.gap,
                    "Report passages narrower than WIDTH, and wider than LEAST, a tenth of it if left out; without it "
                    "what a --character doesn't fit through")
        ->type_name("[LEAST,]WIDTH");
    verb.add_option("--closed", arguments.request.faults.closed,
                    "In 3D, objects whose meshes are to have no hole at all; without it, small holes of all are "
                    "reported")
        ->type_name("PATTERN")
        ->allow_extra_args(false);
    verb.footer(
        "Of the first moment it also tells spawns that are inside of something, under a ground or above nothing; "
        "passages that are too narrow (--gap); what is there twice; and in 3D leaks: holes, cracks, edges of three "
        "triangles, triangles that face the wrong way. --pairs leaves of these only gaps and doubled "
        "objects, and what --spawn and --closed ask for.");
    verb.add_flag("--json", arguments.request.json, "One JSON object in place of text");
    describe(verb, arguments.request.files, true);
}

// What was typed for `abut cast`.
struct CastArguments {
    CastRequest request;
    std::optional<std::string> bounces, time;
};

void describe(CLI::App& verb, CastArguments& arguments) {
    verb.add_option("SCENE", arguments.request.scene, files)->required();
    verb.add_option("--from", arguments.request.from, "Where the ray starts; in 2D X,Y")
        ->type_name("X,Y,Z")
        ->required();
    verb.add_option("--to", arguments.request.to, "Where it goes to; without --bounces it ends there")
        ->type_name("X,Y,Z")
        ->required();
    CLI::Option* bounces = verb.add_option("--bounces", arguments.bounces,
                                           "Go on beyond --to, thrown back N times: all things are mirrors")
                               ->type_name("N");
    verb.add_flag("--all", arguments.request.all, "All things in the way, near to far, not only the first")
        ->excludes(bounces);
    verb.add_option("--time", arguments.time,
                    "The moment of the animation, as `abut check` tells it; without it the first")
        ->type_name("SECONDS");
    verb.add_option("-o,--output", arguments.request.picture, "Draw a picture too")->type_name("PICTURE.svg");
    verb.add_flag("--json", arguments.request.json, "One JSON object in place of text");
    describe(verb, arguments.request.files, true);
}

constexpr const char *mesh_files = "glTF 2.0, or anything else that Assimp reads",
                     *mesh_output = "Where to write it: .gltf, .glb or .obj";

// What was typed for `abut hull`.
struct HullArguments {
    HullRequest request;
    std::optional<std::string> vertices;
};

void describe(CLI::App& verb, HullArguments& arguments) {
    verb.add_option("MESH", arguments.request.mesh, mesh_files)->required();
    verb.add_option("-o,--output", arguments.request.output, mesh_output)->type_name("OUT")->required();
    verb.add_option("--max-vertices", arguments.vertices,
                    "At most N corners: a larger hull, which holds all that the hull does; 4 or more")
        ->type_name("N");
    verb.add_flag("--each", arguments.request.each, "One hull for each object, in place of one around all of them");
    verb.add_flag("--json", arguments.request.json, "One JSON object in place of text");
    describe(verb, arguments.request.files, false);
    verb.footer("Objects are taken where they stand at the first moment.");
}

// What was typed for `abut decompose`.
struct DecomposeArguments {
    DecomposeRequest request;
    std::optional<std::string> parts, concavity, vertices;
};

void describe(CLI::App& verb, DecomposeArguments& arguments) {
    verb.add_option("MESH", arguments.request.mesh, mesh_files)->required();
    verb.add_option("-o,--output", arguments.request.output, mesh_output)->type_name("OUT")->required();
    verb.add_option("--parts", arguments.parts, "At most N parts; without it 32")->type_name("N");
    verb.add_option("--concavity", arguments.concavity,
                    "How far from convex a part may be, as a share of half the longest side of the mesh's box: 0 to 1, "
                    "without it 0.05. Smaller means more parts")
        ->type_name("C");
    verb.add_option("--max-vertices", arguments.vertices, "At most N corners a part, 4 or more; without it 64")
        ->type_name("N");
    verb.add_flag("--rooms", arguments.request.rooms,
                  "Leave closed surfaces that are seen from inside as they are: walls without a thickness. Without it "
                  "they are taken for solids that are inside out, unless they are around several others");
    verb.add_option("--picture", arguments.request.picture, "Draw the parts too")->type_name("FILE.svg");
    verb.add_flag("--json", arguments.request.json, "One JSON object in place of text");
    describe(verb, arguments.request.files, false);
    verb.footer(
        "All objects are taken together, where they stand at the first moment, and repaired first: points in one place "
        "become one, triangles are made to agree which way round they are, small holes are filled.");
}

// What was typed for `abut field`.
struct FieldArguments {
    FieldRequest request;
    std::optional<std::string> cell, padding, band;
    std::vector<std::string> slices;
};

void describe(CLI::App& verb, FieldArguments& arguments) {
    FieldRequest& request = arguments.request;
    verb.add_option("MESH", request.mesh,
                    std::string(mesh_files) + "; or a level of the plane, a Tiled map or an SVG drawing")
        ->required();
    verb.add_option("-o,--output", request.output, "Where to write it")->type_name("OUT.field")->required();
    verb.add_option("--cell", arguments.cell,
                    "The side of a cell; without it a 64th of the longest side of the surface's box")
        ->type_name("D");
    verb.add_option("--padding", arguments.padding,
                    "How far the volume goes beyond the surface, in cells, 1 or more; without it 3")
        ->type_name("N");
    CLI::Option* band =
        verb.add_option("--band", arguments.band,
                        "How far from the surface all samples are kept, in cells, 1 or more; without it 3")
            ->type_name("N");
    verb.add_flag("--dense", request.dense, "Keep all samples of the volume")->excludes(band);
    verb.add_flag("--gradient", request.gradient,
                  "Keep the gradient of each sample too: less error at edges, for more memory");
    verb.add_flag("--quantised", request.quantised, "Samples of 16 bits, half the memory");
    verb.add_option("--picture", request.picture, "Draw slices too, with lines of equal distance")
        ->type_name("FILE.svg");
    verb.add_option("--slice", arguments.slices,
                    "Where the picture cuts the volume, such as z=0.3; without it the middle of each axis")
        ->type_name("AXIS=N")
        ->allow_extra_args(false);
    verb.add_flag("--json", request.json, "One JSON object in place of text");
    describe(verb, request.files, false);
    verb.footer(
        "All objects are taken together, where they stand at the first moment. Inside is where the surface goes round "
        "a place. Exits with 1 where it has gaps or more than a thousandth of the samples may be on either side; the "
        "field is written all the same.");
}

// What was typed for `abut walk`.
struct WalkArguments {
    WalkRequest request;
    std::optional<std::string> from, to, reach;
};

void describe(CLI::App& verb, WalkArguments& arguments) {
    WalkRequest& request = arguments.request;
    verb.add_option("MESH", request.mesh, std::string(mesh_files) + "; or what -o wrote (.walk)")->required();
    verb.add_option("--name", request.name,
                    "Only nodes and meshes that it describes, path or name, with * and ?; without it all")
        ->type_name("PATTERN");
    verb.add_option("--from", arguments.from, "Where a way starts: at the nearest place on the mesh")
        ->type_name("X,Y,Z");
    verb.add_option("--to", arguments.to, "Where it ends, likewise")->type_name("X,Y,Z");
    verb.add_option("--reach", arguments.reach, "How far off the mesh --from and --to may be; without it any distance")
        ->type_name("D");
    verb.add_option("-o,--output", request.output, "Write the mesh too, as a game loads it")->type_name("OUT.walk");
    verb.add_option("--picture", request.picture, "Draw it too, with its islands, its borders and the way")
        ->type_name("FILE.svg");
    verb.add_flag("--json", request.json, "One JSON object in place of text");
    describe(verb, request.files, false);
    verb.footer(
        "The triangles are taken as a surface to walk on, where they stand at the first moment; any side may be up. "
        "Exits with 1 where there is no way from --from to --to, or one of them is out of reach.");
}

void describe(CLI::App& verb, InfoRequest& request) {
    verb.add_option("FILE", request.scene,
                    std::string(files) + "; or what abut field (.field) or abut walk (.walk) wrote")
        ->required();
    verb.add_flag("--json", request.json, "One JSON object in place of text");
    describe(verb, request.files, true);
}

// Puts what the text means in its place; the line for stderr if it means nothing.
template <class Value, class To>
std::optional<std::string> understand(const char* option, const std::optional<std::string>& text,
                                      Result<Value> (*parse)(const std::string&), To& to) {
    if (!text) return std::nullopt;
    Result<Value> value = parse(*text);
    if (!value) return std::string(option) + ": " + value.problem().message;
    to = *std::move(value);
    return std::nullopt;
}

Result<ExitCode> run_check(CheckArguments& arguments) {
    CheckOptions& options = arguments.request.options;
    std::optional<std::string> problem =
        understand("--clearance", arguments.clearance, parse_length, options.limits.clearance);
    if (!problem) problem = understand("--allow", arguments.allow, parse_length, options.limits.allow);
    if (!problem) problem = understand("--frames", arguments.frames, parse_frames, arguments.request.frames);
    FaultOptions& faults = arguments.request.faults;
    if (!problem) problem = understand("--character", arguments.character, parse_character, faults.character);
    if (!problem) problem = understand("--up", arguments.up, parse_up, faults.up);
    if (!problem) problem = understand("--gap", arguments.gap, parse_gap, faults.gap);
    for (const std::string& text : arguments.pairs)
        if (!problem) problem = understand("--pairs", text, parse_pair, options.pairs.emplace_back());
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_check(arguments.request);
}

Result<ExitCode> run_cast(CastArguments& arguments) {
    std::optional<std::string> problem =
        understand("--bounces", arguments.bounces, parse_bounces, arguments.request.bounces);
    if (!problem) problem = understand("--time", arguments.time, parse_time, arguments.request.time);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_cast(arguments.request);
}

Result<ExitCode> run_hull(HullArguments& arguments) {
    if (const std::optional<std::string> problem =
            understand("--max-vertices", arguments.vertices, parse_vertices, arguments.request.max_vertices))
        return Problem{ProblemCode::bad_argument, *problem};
    return run_hull(arguments.request);
}

Result<ExitCode> run_decompose(DecomposeArguments& arguments) {
    DecomposeRequest& request = arguments.request;
    std::optional<std::string> problem = understand("--parts", arguments.parts, parse_parts, request.max_parts);
    if (!problem) problem = understand("--concavity", arguments.concavity, parse_share, request.concavity);
    if (!problem) problem = understand("--max-vertices", arguments.vertices, parse_vertices, request.max_vertices);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_decompose(request);
}

Result<ExitCode> run_field(FieldArguments& arguments) {
    FieldRequest& request = arguments.request;
    std::optional<std::string> problem = understand("--cell", arguments.cell, parse_cell, request.cell);
    if (!problem) problem = understand("--padding", arguments.padding, parse_cells, request.padding);
    if (!problem) problem = understand("--band", arguments.band, parse_cells, request.band);
    for (const std::string& text : arguments.slices)
        if (!problem) problem = understand("--slice", text, parse_slice, request.slices.emplace_back());
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_field(request);
}

Result<ExitCode> run_walk(WalkArguments& arguments) {
    WalkRequest& request = arguments.request;
    std::optional<std::string> problem = understand("--from", arguments.from, parse_point<3>, request.from);
    if (!problem) problem = understand("--to", arguments.to, parse_point<3>, request.to);
    if (!problem) problem = understand("--reach", arguments.reach, parse_length, request.reach);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_walk(request);
}

int run(int count, char** words) {
    CLI::App app(
        "Collision checks for scenes and levels: who touches whom, where, how deep and when; and convex parts, "
        "distance fields and ways over meshes.",
        "abut");
    app.set_version_flag("--version", "abut " ABUT_VERSION);
    app.require_subcommand(1);
    app.footer("Exits with 0 if all is fine, 1 if something was found, 2 for bad input or usage.");

    CheckArguments check;
    CLI::App& check_verb = *app.add_subcommand(
        "check", "Which objects of a scene or a level touch, where, how deep and when, and what else is wrong with it");
    describe(check_verb, check);
    CastArguments cast;
    CLI::App& cast_verb = *app.add_subcommand("cast", "What a ray hits, or a laser from mirror to mirror");
    describe(cast_verb, cast);
    HullArguments hull;
    CLI::App& hull_verb = *app.add_subcommand("hull", "The convex hull of a mesh");
    describe(hull_verb, hull);
    DecomposeArguments decompose;
    CLI::App& decompose_verb = *app.add_subcommand("decompose", "Convex parts that stand for a mesh");
    describe(decompose_verb, decompose);
    FieldArguments field;
    CLI::App& field_verb = *app.add_subcommand("field", "A mesh or a level as a field of signed distances");
    describe(field_verb, field);
    WalkArguments walk;
    CLI::App& walk_verb =
        *app.add_subcommand("walk", "A mesh as a surface to walk on: its islands and borders, and ways over it");
    describe(walk_verb, walk);
    InfoRequest info;
    CLI::App& info_verb = *app.add_subcommand("info", "What is in a scene, a level, a field or a walk mesh");
    describe(info_verb, info);

    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        if (app.get_subcommands().empty() && count > 1 && words[1][0] != '-')
            return fail("'" + std::string(words[1]) + "' is not a verb; abut --help lists them");
        return fail(error.what());
    }
    const bool checks = check_verb.parsed();
    const bool bakes = field_verb.parsed();
    const std::string& file = checks                    ? check.request.scene
                              : cast_verb.parsed()      ? cast.request.scene
                              : hull_verb.parsed()      ? hull.request.mesh
                              : decompose_verb.parsed() ? decompose.request.mesh
                              : bakes                   ? field.request.mesh
                              : walk_verb.parsed()      ? walk.request.mesh
                                                        : info.scene;
    const std::string too_large = file + ": needs more memory than there is" +
                                  (checks  ? ": --pairs asks about fewer objects"
                                   : bakes ? ": a larger --cell needs less"
                                           : "");
    exit_when_out_of_memory(too_large);
    try {
        const Result<ExitCode> code = checks                    ? run_check(check)
                                      : cast_verb.parsed()      ? run_cast(cast)
                                      : hull_verb.parsed()      ? run_hull(hull)
                                      : decompose_verb.parsed() ? run_decompose(decompose)
                                      : bakes                   ? run_field(field)
                                      : walk_verb.parsed()      ? run_walk(walk)
                                                                : run_info(info);
        return code ? static_cast<int>(*code) : fail(code.problem().message);
    } catch (const std::length_error&) {
        return fail(too_large);
    }
}

}  // namespace
}  // namespace abut::tool

int main(int count, char** words) {
    return abut::tool::run(count, words);
}
