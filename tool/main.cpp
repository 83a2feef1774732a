// The tool `abut`: collision checks for asset pipelines. Parses the command line and runs the verb.

#include "tool/arguments.hpp"
#include "tool/shared/out_of_memory.hpp"
#include "tool/verbs.hpp"

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
    "3D: glTF 2.0, or any format that Assimp reads; 2D: a Tiled map (.tmx, .tmj) or a drawing (.svg)";

// Options of reading files. Verbs that repair meshes have no --strict.
void add_options(CLI::App& verb, FileOptions& options, bool can_be_strict) {
    verb.add_flag("--allow-outside", options.allow_outside,
                  "Allow references to files outside of the file's own folder, such as ../shared/a.bin");
    if (!can_be_strict) return;
    CLI::Option* strict =
        verb.add_flag("--strict", options.strict,
                      "Reject a file with a triangle of zero area; by default such triangles are left "
                      "out and counted");
    // Accepted for scripts of earlier versions: it is the default now. --help names it nowhere.
    CLI::Option* skip = verb.add_flag("--skip-degenerate")->group("")->excludes(strict);
    strict->remove_excludes(skip);
}

// Arguments of `abut check`; numbers and patterns are still text.
struct CheckArguments {
    CheckRequest request;
    std::optional<std::string> clearance, allow, frames, character, up, gap;
    std::vector<std::string> pairs;
};

void add_options(CLI::App& verb, CheckArguments& arguments) {
    verb.add_option("SCENE", arguments.request.scene, files)->required();
    verb.add_option("--clearance", arguments.clearance, "Report also pairs closer than D that don't touch")
        ->type_name("D");
    verb.add_option("--allow", arguments.allow, "Ignore depths up to DEPTH; default 1e-3 of the smaller object's size")
        ->type_name("DEPTH");
    verb.add_option("--baseline", arguments.request.baseline,
                    "Report only findings that this earlier --json report doesn't have")
        ->type_name("OLD.json");
    verb.add_option("--frames", arguments.frames,
                    "Test N evenly spaced frames; default: the file's key times, at most 30 per second. Between "
                    "frames, pairs are tested by continuous sweeps")
        ->type_name("N");
    verb.add_option("--pairs", arguments.pairs,
                    "Only pairs of an object that matches A and one that matches B, by path or name, with * and ?")
        ->type_name("A:B")
        ->allow_extra_args(false);
    verb.add_option("--spawn", arguments.request.faults.spawns,
                    "Spawn points: nodes or points by path, name or class, with * and ?. Default: those "
                    "with 'spawn', 'player_start', 'playerstart' or 'player start' in their name or class, in any case")
        ->type_name("PATTERN")
        ->allow_extra_args(false);
    verb.add_option("--character", arguments.character,
                    "The character: a capsule with its lowest point at the spawn; a ball if --up is none. It must "
                    "fit there, and through every passage")
        ->type_name("RADIUS,HEIGHT");
    verb.add_option("--up", arguments.up,
                    "The up direction: x, -x, y, -y, z, -z or none. Default: y in 3D, none in 2D; a level seen "
                    "from the side has -y, as y points down in its file")
        ->type_name("AXIS");
    verb.add_option("--gap", arguments.gap,
                    "Report passages narrower than WIDTH and wider than LEAST, default WIDTH / 10; by default "
                    "those too narrow for the --character")
        ->type_name("[LEAST,]WIDTH");
    verb.add_option("--closed", arguments.request.faults.closed,
                    "3D: objects whose meshes must be watertight; by default only small holes of all meshes are "
                    "reported")
        ->type_name("PATTERN")
        ->allow_extra_args(false);
    verb.footer(
        "At the first frame it also reports spawns that are inside an object, below a ground or above nothing; "
        "passages that are too narrow (--gap); duplicates; and in 3D leaks: holes, cracks, non-manifold edges, and "
        "triangles of the wrong orientation. --pairs restricts these to gaps and duplicate "
        "objects, and to what --spawn and --closed select.");
    verb.add_flag("--json", arguments.request.json, "Print one JSON object instead of text");
    add_options(verb, arguments.request.files, true);
}

// Arguments of `abut cast`; numbers are still text.
struct CastArguments {
    CastRequest request;
    std::optional<std::string> bounces, time;
};

void add_options(CLI::App& verb, CastArguments& arguments) {
    verb.add_option("SCENE", arguments.request.scene, files)->required();
    verb.add_option("--from", arguments.request.from, "Where the ray starts; in 2D X,Y")
        ->type_name("X,Y,Z")
        ->required();
    verb.add_option("--to", arguments.request.to, "The point it aims at; without --bounces it ends there")
        ->type_name("X,Y,Z")
        ->required();
    CLI::Option* bounces = verb.add_option("--bounces", arguments.bounces,
                                           "Continue beyond --to and reflect N times: every object is a mirror")
                               ->type_name("N");
    verb.add_flag("--all", arguments.request.all, "Report all objects that the ray hits, nearest first")
        ->excludes(bounces);
    verb.add_option("--time", arguments.time,
                    "The time in the animation, as `abut check` prints it; default: the first")
        ->type_name("SECONDS");
    verb.add_option("-o,--output", arguments.request.picture, "Draw a picture as well")->type_name("PICTURE.svg");
    verb.add_flag("--json", arguments.request.json, "Print one JSON object instead of text");
    add_options(verb, arguments.request.files, true);
}

constexpr const char *mesh_files = "glTF 2.0, or any format that Assimp reads",
                     *mesh_output = "The output file: .gltf, .glb or .obj";

// Arguments of `abut hull`; numbers are still text.
struct HullArguments {
    HullRequest request;
    std::optional<std::string> vertices;
};

void add_options(CLI::App& verb, HullArguments& arguments) {
    verb.add_option("MESH", arguments.request.mesh, mesh_files)->required();
    verb.add_option("-o,--output", arguments.request.output, mesh_output)->type_name("OUT")->required();
    verb.add_option("--max-vertices", arguments.vertices,
                    "At most N vertices, 4 or more: a larger hull that contains the exact hull")
        ->type_name("N");
    verb.add_flag("--each", arguments.request.each, "One hull per object, instead of one for all of them");
    verb.add_flag("--json", arguments.request.json, "Print one JSON object instead of text");
    add_options(verb, arguments.request.files, false);
    verb.footer("Objects are placed as at the first moment of the animation.");
}

// Arguments of `abut decompose`; numbers are still text.
struct DecomposeArguments {
    DecomposeRequest request;
    std::optional<std::string> parts, concavity, vertices;
};

void add_options(CLI::App& verb, DecomposeArguments& arguments) {
    verb.add_option("MESH", arguments.request.mesh, mesh_files)->required();
    verb.add_option("-o,--output", arguments.request.output, mesh_output)->type_name("OUT")->required();
    verb.add_option("--parts", arguments.parts, "At most N parts; default 32")->type_name("N");
    verb.add_option("--concavity", arguments.concavity,
                    "Maximum concavity of a part, as a fraction of half the longest side of the mesh's box: 0 to 1, "
                    "default 0.05. Smaller values give more parts")
        ->type_name("C");
    verb.add_option("--max-vertices", arguments.vertices, "At most N vertices per part, 4 or more; default 64")
        ->type_name("N");
    verb.add_flag("--rooms", arguments.request.rooms,
                  "Keep closed surfaces that face inwards as rooms: walls of zero thickness. By default "
                  "they count as inverted solids, unless they enclose several others");
    verb.add_option("--picture", arguments.request.picture, "Draw the parts as well")->type_name("FILE.svg");
    verb.add_flag("--json", arguments.request.json, "Print one JSON object instead of text");
    add_options(verb, arguments.request.files, false);
    verb.footer(
        "All objects are merged, placed as at the first moment of the animation, and repaired: coincident points are "
        "welded, "
        "triangles are oriented consistently, small holes are filled.");
}

// Arguments of `abut field`; numbers are still text.
struct FieldArguments {
    FieldRequest request;
    std::optional<std::string> cell, padding, band;
    std::vector<std::string> slices;
};

void add_options(CLI::App& verb, FieldArguments& arguments) {
    FieldRequest& request = arguments.request;
    verb.add_option("MESH", request.mesh, std::string(mesh_files) + "; or a 2D level: a Tiled map or an SVG drawing")
        ->required();
    verb.add_option("-o,--output", request.output, "The output file")->type_name("OUT.field")->required();
    verb.add_option("--cell", arguments.cell,
                    "The side of a cell; default 1/64 of the longest side of the surface's box")
        ->type_name("D");
    verb.add_option("--padding", arguments.padding,
                    "How far the volume extends beyond the surface, in cells, 1 or more; default 3")
        ->type_name("N");
    CLI::Option* band =
        verb.add_option("--band", arguments.band,
                        "How far from the surface all samples are stored, in cells, 1 or more; default 3")
            ->type_name("N");
    verb.add_flag("--dense", request.dense, "Store all samples of the volume")->excludes(band);
    verb.add_flag("--gradient", request.gradient,
                  "Store the gradient of each sample as well: less error at edges, more memory");
    verb.add_flag("--quantised", request.quantised, "Samples of 16 bits, half the memory");
    verb.add_option("--picture", request.picture, "Draw slices with contour lines as well")->type_name("FILE.svg");
    verb.add_option("--slice", arguments.slices,
                    "Where the picture cuts the volume, such as z=0.3; default: the middle of each axis")
        ->type_name("AXIS=N")
        ->allow_extra_args(false);
    verb.add_flag("--json", request.json, "Print one JSON object instead of text");
    add_options(verb, request.files, false);
    verb.footer(
        "All objects are merged, placed as at the first moment of the animation. The winding number of the surface "
        "decides between inside "
        "and outside. Exits with 1 if the surface has gaps or the sign of over 0.1 % of the samples is uncertain; "
        "the field is written in any case.");
}

// Arguments of `abut walk`; numbers are still text.
struct WalkArguments {
    WalkRequest request;
    std::optional<std::string> from, to, reach;
};

void add_options(CLI::App& verb, WalkArguments& arguments) {
    WalkRequest& request = arguments.request;
    verb.add_option("MESH", request.mesh, std::string(mesh_files) + "; or a file that -o wrote (.walk)")->required();
    verb.add_option("--name", request.name,
                    "Only nodes and meshes that match, by path or name, with * and ?; default: all")
        ->type_name("PATTERN");
    verb.add_option("--from", arguments.from, "The start of a path: the nearest point on the mesh is used")
        ->type_name("X,Y,Z");
    verb.add_option("--to", arguments.to, "The end of the path: the nearest point on the mesh is used")
        ->type_name("X,Y,Z");
    verb.add_option("--reach", arguments.reach, "Maximum distance of --from and --to from the mesh; default: any")
        ->type_name("D");
    verb.add_option("-o,--output", request.output, "Write the baked mesh as well")->type_name("OUT.walk");
    verb.add_option("--picture", request.picture,
                    "Draw the mesh as well, with its connected components, its boundary and the path")
        ->type_name("FILE.svg");
    verb.add_flag("--json", request.json, "Print one JSON object instead of text");
    add_options(verb, request.files, false);
    verb.footer(
        "The triangles are a walkable surface, placed as at the first moment of the animation; any direction may be "
        "up. "
        "Exits with 1 if no path leads from --from to --to, or one of them is out of reach.");
}

void add_options(CLI::App& verb, InfoRequest& request) {
    verb.add_option("FILE", request.scene,
                    std::string(files) + "; or a file that abut field (.field) or abut walk (.walk) wrote")
        ->required();
    verb.add_flag("--json", request.json, "Print one JSON object instead of text");
    add_options(verb, request.files, true);
}

// Arguments of `abut replay`; the number is still text.
struct ReplayArguments {
    ReplayRequest request;
    std::optional<std::string> max;
};

void add_options(CLI::App& verb, ReplayArguments& arguments) {
    verb.add_option("FILE", arguments.request.file, "The file that a RecordedWorld wrote")->required();
    verb.add_option("--max", arguments.max, "Report the first N differences; default 10. All are counted")
        ->type_name("N");
    verb.add_flag("--json", arguments.request.json, "Print one JSON object instead of text");
}

// Parses the text of an option into `to`. Returns the error line for stderr if that fails.
template <class Value, class To>
std::optional<std::string> parse_option(const char* option, const std::optional<std::string>& text,
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
        parse_option("--clearance", arguments.clearance, parse_length, options.limits.clearance);
    if (!problem) problem = parse_option("--allow", arguments.allow, parse_length, options.limits.allow);
    if (!problem) problem = parse_option("--frames", arguments.frames, parse_frames, arguments.request.frames);
    FaultOptions& faults = arguments.request.faults;
    if (!problem) problem = parse_option("--character", arguments.character, parse_character, faults.character);
    if (!problem) problem = parse_option("--up", arguments.up, parse_up, faults.up);
    if (!problem) problem = parse_option("--gap", arguments.gap, parse_gap, faults.gap);
    for (const std::string& text : arguments.pairs)
        if (!problem) problem = parse_option("--pairs", text, parse_pair, options.pairs.emplace_back());
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_check(arguments.request);
}

Result<ExitCode> run_cast(CastArguments& arguments) {
    std::optional<std::string> problem =
        parse_option("--bounces", arguments.bounces, parse_bounces, arguments.request.bounces);
    if (!problem) problem = parse_option("--time", arguments.time, parse_time, arguments.request.time);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_cast(arguments.request);
}

Result<ExitCode> run_hull(HullArguments& arguments) {
    if (const std::optional<std::string> problem =
            parse_option("--max-vertices", arguments.vertices, parse_vertices, arguments.request.max_vertices))
        return Problem{ProblemCode::bad_argument, *problem};
    return run_hull(arguments.request);
}

Result<ExitCode> run_decompose(DecomposeArguments& arguments) {
    DecomposeRequest& request = arguments.request;
    std::optional<std::string> problem = parse_option("--parts", arguments.parts, parse_parts, request.max_parts);
    if (!problem) problem = parse_option("--concavity", arguments.concavity, parse_share, request.concavity);
    if (!problem) problem = parse_option("--max-vertices", arguments.vertices, parse_vertices, request.max_vertices);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_decompose(request);
}

Result<ExitCode> run_field(FieldArguments& arguments) {
    FieldRequest& request = arguments.request;
    std::optional<std::string> problem = parse_option("--cell", arguments.cell, parse_cell, request.cell);
    if (!problem) problem = parse_option("--padding", arguments.padding, parse_cells, request.padding);
    if (!problem) problem = parse_option("--band", arguments.band, parse_cells, request.band);
    for (const std::string& text : arguments.slices)
        if (!problem) problem = parse_option("--slice", text, parse_slice, request.slices.emplace_back());
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_field(request);
}

Result<ExitCode> run_walk(WalkArguments& arguments) {
    WalkRequest& request = arguments.request;
    std::optional<std::string> problem = parse_option("--from", arguments.from, parse_point<3>, request.from);
    if (!problem) problem = parse_option("--to", arguments.to, parse_point<3>, request.to);
    if (!problem) problem = parse_option("--reach", arguments.reach, parse_length, request.reach);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    return run_walk(request);
}

Result<ExitCode> run_replay(ReplayArguments& arguments) {
    if (const std::optional<std::string> problem =
            parse_option("--max", arguments.max, parse_bounces, arguments.request.max_differences))
        return Problem{ProblemCode::bad_argument, *problem};
    return run_replay(arguments.request);
}

int run(int count, char** arguments) {
    CLI::App app(
        "Checks scenes and levels for collisions: which objects touch, where, how deep and when. Makes convex parts, "
        "signed distance fields and walk meshes from meshes.",
        "abut");
    app.set_version_flag("--version", "abut " ABUT_VERSION);
    app.require_subcommand(1);
    app.footer("Exits with 0 if all is fine, 1 if something was found, 2 for bad input or usage.");

    CheckArguments check;
    CLI::App& check_verb = *app.add_subcommand(
        "check",
        "Reports which objects of a scene or a level touch, where, how deep and when, and other faults of the level");
    add_options(check_verb, check);
    CastArguments cast;
    CLI::App& cast_verb =
        *app.add_subcommand("cast", "Reports the objects that a ray hits, with or without reflections");
    add_options(cast_verb, cast);
    HullArguments hull;
    CLI::App& hull_verb = *app.add_subcommand("hull", "Writes the convex hull of a mesh");
    add_options(hull_verb, hull);
    DecomposeArguments decompose;
    CLI::App& decompose_verb = *app.add_subcommand("decompose", "Writes an approximate convex decomposition of a mesh");
    add_options(decompose_verb, decompose);
    FieldArguments field;
    CLI::App& field_verb = *app.add_subcommand("field", "Bakes the signed distance field of a mesh or a level");
    add_options(field_verb, field);
    WalkArguments walk;
    CLI::App& walk_verb =
        *app.add_subcommand("walk", "Checks a walk mesh: its connected components, its border, and paths over it");
    add_options(walk_verb, walk);
    InfoRequest info;
    CLI::App& info_verb = *app.add_subcommand("info", "Lists the contents of a scene, a level, a field or a walk mesh");
    add_options(info_verb, info);
    ReplayArguments replay;
    CLI::App& replay_verb = *app.add_subcommand(
        "replay", "Runs the recording of a world again, and reports where an answer differs, with the C++ for it");
    add_options(replay_verb, replay);

    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        if (app.get_subcommands().empty() && count > 1 && arguments[1][0] != '-')
            return fail("'" + std::string(arguments[1]) + "' is not a verb; abut --help lists them");
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
                              : replay_verb.parsed()    ? replay.request.file
                                                        : info.scene;
    const std::string too_large = file + ": needs more memory than there is" +
                                  (checks  ? ": --pairs selects fewer objects"
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
                                      : replay_verb.parsed()    ? run_replay(replay)
                                                                : run_info(info);
        return code ? static_cast<int>(*code) : fail(code.problem().message);
    } catch (const std::length_error&) {
        return fail(too_large);
    }
}

}  // namespace
}  // namespace abut::tool

int main(int count, char** arguments) {
    return abut::tool::run(count, arguments);
}
