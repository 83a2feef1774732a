// The tool `abut`: collision checks for asset pipelines. Parses the command line and runs the verb.

#include "tool/arguments.hpp"
#include "tool/bake/bake_arguments.hpp"
#include "tool/command/command_line.hpp"
#include "tool/shared/version.hpp"
#include "tool/verbs.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace abut::tool {
namespace {

constexpr const char* files =
    "3D: glTF 2.0, a scene of Godot (.tscn), or any format that Assimp reads; 2D: a Tiled map (.tmx, .tmj) or a "
    "drawing (.svg)";

// Options of reading files. Verbs that repair meshes have no --strict.
void add_options(CLI::App& verb, bool& allow_outside, bool& all_meshes, bool* be_strict) {
    verb.add_flag("--all-meshes", all_meshes,
                  "Take the meshes that are drawn even where the file has colliders, by name or by an extension");
    verb.add_flag("--allow-outside", allow_outside,
                  "Allow references to files outside of the file's own folder, such as ../shared/a.bin");
    if (be_strict == nullptr) return;
    CLI::Option* strict =
        verb.add_flag("--strict", *be_strict,
                      "Reject a file with a triangle of zero area; by default such triangles are left "
                      "out and counted");
    // Accepted for scripts of earlier versions: it is the default now. --help names it nowhere.
    CLI::Option* skip = verb.add_flag("--skip-degenerate")->group("")->excludes(strict);
    strict->remove_excludes(skip);
}

void add_options(CLI::App& verb, FileOptions& options, bool can_be_strict) {
    add_options(verb, options.allow_outside, options.all_meshes, can_be_strict ? &options.strict : nullptr);
    verb.add_option("--scale", options.scale, "Multiply all lengths of a 3D scene by F, such as 0.01")->type_name("F");
}

// Options that `abut.toml` may have too, as text; also those of `abut init`.
struct SettingArguments {
    std::map<std::string, std::vector<std::string>> texts;
    bool strict = false, allow_outside = false, all_meshes = false, warnings_as_errors = false;

    Settings all() const {
        Settings settings;
        for (const auto& [name, values] : texts)
            for (const std::string& text : values) settings[name].push_back({text, "--" + name});
        for (const auto& [name, is_given] :
             {std::pair("strict", strict), std::pair("allow-outside", allow_outside),
              std::pair("all-meshes", all_meshes), std::pair("warnings-as-errors", warnings_as_errors)})
            if (is_given) settings[name] = {{"true", std::string("--") + name}};
        return settings;
    }
};

void add_options(CLI::App& verb, SettingArguments& arguments) {
    const auto one = [&](const char* name, const char* type, const std::string& help) {
        verb.add_option("--" + std::string(name), arguments.texts[name], help)->type_name(type)->expected(1);
    };
    const auto many = [&](const char* name, const char* type, const std::string& help) {
        verb.add_option("--" + std::string(name), arguments.texts[name], help)
            ->type_name(type)
            ->allow_extra_args(false);
    };
    one("clearance", "D", "Report also pairs closer than D that don't touch");
    one("allow", "DEPTH", "Ignore depths up to DEPTH; default 1e-3 of the smaller object's size");
    one("baseline", "OLD.json",
        "Report only findings that this earlier --json report doesn't have, and what it has and is gone");
    one("frames", "N",
        "Test N evenly spaced frames; default: the file's key times, at most 30 per second. Between frames, pairs are "
        "tested by continuous sweeps");
    many("pairs", "A:B",
         "Only pairs of an object that matches A and one that matches B, by path, name or class, with * and ?");
    many("only", "KIND", "Only findings of this kind or code, such as contact, leak, ABUT101 or ABUT6*");
    many("no", "KIND", "No findings of this kind or code. The kinds are " + kind_names());
    many("severity", "KIND=LEVEL", "How severe a kind or a code is: error, warning or off");
    many("ignore", "[CODE ]A[:B]", "No findings between objects that match A and B, or about one that matches A");
    many("solid", "PATTERN",
         "2D: objects and layers that collide; default: those whose layer, class or properties say collision, solid, "
         "...; if none does, all");
    many("body", "PATTERN", "What is at or below each node that matches is one body, without contacts in it");
    many("spawn", "PATTERN",
         "Spawn points: nodes or points by path, name or class, with * and ?. Default: those with 'spawn', "
         "'player_start', 'playerstart' or 'player start' in their name or class, in any case");
    one("character", "RADIUS,HEIGHT",
        "The character: a capsule with its lowest point at the spawn; a ball if --up is none. It must fit there, and "
        "through every passage");
    one("up", "AXIS",
        "The up direction: x, -x, y, -y, z, -z or none. Default: y in 3D, none in 2D; a level seen from the side has "
        "-y, as y points down in its file");
    one("gap", "[LEAST,]WIDTH",
        "Report passages narrower than WIDTH and wider than LEAST, default WIDTH / 10; by default those too narrow "
        "for the --character");
    many("closed", "PATTERN",
         "3D: objects whose meshes must be watertight; by default small holes of all meshes are warnings");
    verb.add_flag("--warnings-as-errors", arguments.warnings_as_errors, "Exit with 1 for warnings too");
    one("scale", "F", "Multiply all lengths of a 3D scene by F, such as 0.01");
    add_options(verb, arguments.allow_outside, arguments.all_meshes, &arguments.strict);
}

// Arguments of `abut check`.
struct CheckArguments {
    CheckRequest request;
    SettingArguments settings;
    std::optional<std::string> threads;
    bool no_config = false;
};

void add_options(CLI::App& verb, CheckArguments& arguments) {
    CheckRequest& request = arguments.request;
    verb.add_option("SCENE", request.scenes,
                    std::string(files) + "; or a folder with such files; or - for a list of them on stdin")
        ->required();
    add_options(verb, arguments.settings);
    CLI::Option* config = verb.add_option("--config", request.config,
                                          "Read options from FILE. Default: the abut.toml in the scene's folder, or "
                                          "else in the nearest folder above it")
                              ->type_name("FILE");
    verb.add_flag("--no-config", arguments.no_config, "Read no abut.toml")->excludes(config);
    verb.add_option("-j,--threads", arguments.threads,
                    "Threads to compute with; default: one for each core. The report is the same with any number")
        ->type_name("N");
    verb.add_option("--report", request.page,
                    "Write a page to FILE too, which shows each finding in its place; one scene only")
        ->type_name("FILE.html");
    verb.add_option("--svg", request.picture, "Draw the scene with all findings too; one scene only")
        ->type_name("FILE.svg");
    verb.add_option("--sarif", request.sarif, "Write the findings to FILE as SARIF 2.1.0 too")->type_name("FILE");
    verb.add_option("--junit", request.junit, "Write the findings to FILE as JUnit's XML too")->type_name("FILE");
    CLI::Option* github =
        verb.add_flag("--github", request.github, "Print annotations for GitHub's workflows before the text");
    verb.add_flag("--json", request.json, "Print one JSON object instead of text")->excludes(github);
    verb.footer(
        "At the first frame it also reports spawns that are inside an object, below a ground or above nothing; "
        "passages that are too narrow (--gap); duplicates; and in 3D leaks: holes, cracks, non-manifold edges, and "
        "triangles of the wrong orientation. --pairs restricts these to gaps and duplicate objects, and to what "
        "--spawn and --closed select. The exit status of several files is the worst one.");
}

// Arguments of `abut init`.
struct InitArguments {
    InitRequest request;
    SettingArguments settings;
};

void add_options(CLI::App& verb, InitArguments& arguments) {
    verb.add_option("SCENE", arguments.request.scene, files)->required();
    add_options(verb, arguments.settings);
    verb.footer(
        "Writes abut.toml beside the scene, or adds a section to it: the options given here, and patterns that ignore "
        "all that is found now. So `abut check` is clean, and reports what is new.");
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

void add_options(CLI::App& verb, FixRequest& request) {
    verb.add_option("MESH", request.mesh, mesh_files)->required();
    verb.add_option("-o,--output", request.output, mesh_output)->type_name("OUT")->required();
    verb.add_flag("--json", request.json, "Print one JSON object instead of text");
    add_options(verb, request.files, false);
    verb.footer(
        "Coincident corners are welded, duplicate triangles and those of zero area removed, and closed surfaces "
        "oriented outwards. Holes stay. Objects are placed as at the first moment of the animation.");
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
    CheckRequest& request = arguments.request;
    if (const std::optional<std::string> problem =
            parse_option("--threads", arguments.threads, parse_threads, request.threads))
        return Problem{ProblemCode::bad_argument, *problem};
    request.settings = arguments.settings.all();
    if (arguments.no_config) request.config = "";
    return run_check(request);
}

Result<ExitCode> run_init(InitArguments& arguments) {
    arguments.request.settings = arguments.settings.all();
    return run_init(arguments.request);
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

// All verbs with their arguments.
class Tool {
public:
    Tool() {
        add(
            "check",
            "Reports which objects of a scene or a level touch, where, how deep and when, and other faults of the "
            "level",
            check_, run_check,
            [this] { return check_.request.scenes.empty() ? std::string() : check_.request.scenes.front(); },
            ": --pairs selects fewer objects");
        add("init", "Writes an abut.toml that ignores what abut check finds now", init_, run_init,
            [this] { return init_.request.scene; });
        add("cast", "Reports the objects that a ray hits, with or without reflections", cast_, run_cast,
            [this] { return cast_.request.scene; });
        add("hull", "Writes the convex hull of a mesh", hull_, run_hull, [this] { return hull_.request.mesh; });
        add("fix", "Writes the meshes of a scene without the faults that have one right answer", fix_, run_fix,
            [this] { return fix_.mesh; });
        add("decompose", "Writes an approximate convex decomposition of a mesh", decompose_, run_decompose,
            [this] { return decompose_.request.mesh; });
        add(
            "field", "Bakes the signed distance field of a mesh or a level", field_, run_field,
            [this] { return field_.request.mesh; }, ": a larger --cell needs less");
        add("walk", "Checks a walk mesh: its connected components, its border, and paths over it", walk_, run_walk,
            [this] { return walk_.request.mesh; });
        add("info", "Lists the contents of a scene, a level, a field or a walk mesh", info_, run_info,
            [this] { return info_.scene; });
        add("replay", "Runs the recording of a world again, and reports where an answer differs, with the C++ for it",
            replay_, run_replay, [this] { return replay_.request.file; });
        add("bake", "Does one of these with every file of a list, and stores the results", bake_, run_bake,
            [this] { return bake_.request.list; });
    }

    int run(const std::vector<std::string>& words) { return command_.run(words); }

private:
    template <class Arguments>
    void add(const char* name, const char* summary, Arguments& arguments, Result<ExitCode> (*call)(Arguments&),
             std::function<std::string()> input, const char* less_memory = "") {
        add_options(command_.add_verb(name, summary,
                                      {[call, &arguments] { return call(arguments); }, std::move(input), less_memory}),
                    arguments);
    }

    static Result<ExitCode> run_fix(FixRequest& request) { return tool::run_fix(request); }
    static Result<ExitCode> run_info(InfoRequest& request) { return tool::run_info(request); }
    static Result<ExitCode> run_bake(BakeArguments& arguments);

    CommandLine command_;
    CheckArguments check_;
    InitArguments init_;
    CastArguments cast_;
    HullArguments hull_;
    FixRequest fix_;
    DecomposeArguments decompose_;
    FieldArguments field_;
    WalkArguments walk_;
    InfoRequest info_;
    ReplayArguments replay_;
    BakeArguments bake_;
};

Result<ExitCode> Tool::run_bake(BakeArguments& arguments) {
    BakeRequest& request = arguments.request;
    std::optional<std::string> problem = parse_option("--shard", arguments.shard, parse_shard, request.shard);
    if (!problem) problem = parse_option("--audit", arguments.audit, parse_percent, request.audit);
    if (problem) return Problem{ProblemCode::bad_argument, *problem};
    if (!output_ending(request.task.verb))
        return Problem{ProblemCode::bad_argument,
                       "--verb: '" + request.task.verb + "' is not one of check, hull, decompose, field and walk"};
    Result<std::vector<std::string>> options = Tool().command_.canonical_options(request.task.verb, arguments.options);
    if (!options) return options.problem();
    request.task.version = version();
    request.task.options = *std::move(options);
    request.task.run = [](const std::vector<std::string>& words) { return Tool().run(words); };
    return tool::run_bake(request);
}

}  // namespace
}  // namespace abut::tool

int main(int count, char** arguments) {
    return abut::tool::Tool().run({arguments + 1, arguments + count});
}
