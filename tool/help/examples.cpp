#include "tool/help/command_help.hpp"

namespace abut::tool {
namespace {

struct VerbExamples {
    const char* verb;
    std::vector<Example> examples;
};

const std::vector<VerbExamples>& all_examples() {
    static const std::vector<VerbExamples> all{
        {"",
         {{"abut check level.glb --character 0.3,1.8", "what is wrong in a level"},
          {"abut decompose rock.obj -o rock.glb", "convex parts for a game"},
          {"abut help check", "all options of a verb"}}},
        {"check",
         {{"abut check level.glb", "what touches, what is doubled, what leaks"},
          {"abut check level.glb --character 0.3,1.8", "blocked spawns and narrow passages too"},
          {"abut check map.tmj --character 6,24 --up -y", "a 2D level seen from the side"},
          {"abut check level.glb --report out.html", "a page that shows each finding in its place"},
          {"abut check level.glb --json > old.json", "remember what is known"},
          {"abut check level.glb --baseline old.json", "report only what is new"}}},
        {"init",
         {{"abut init level.glb --character 0.3,1.8", "an abut.toml with this option that ignores what is found now"}}},
        {"cast",
         {{"abut cast level.glb --from 0,1,0 --to 5,1,0", "what is between two points"},
          {"abut cast level.glb --from 0,1,0 --to 5,1,0 --bounces 8 -o laser.svg", "a laser and its picture"}}},
        {"hull",
         {{"abut hull rock.obj -o rock.glb", "the convex hull of all objects"},
          {"abut hull rock.obj -o rock.glb --each --max-vertices 32", "a hull per object, with few vertices"}}},
        {"fix", {{"abut fix level.obj -o fixed.glb", "welded, without doubles and areas of zero, oriented alike"}}},
        {"decompose",
         {{"abut decompose house.glb -o parts.glb", "at most 32 convex parts"},
          {"abut decompose house.glb -o parts.glb --parts 100 --picture parts.svg", "more parts, and a picture"}}},
        {"field",
         {{"abut field rock.obj -o rock.field", "a signed distance field"},
          {"abut field rock.obj -o rock.field --cell 0.05 --picture rock.svg", "a finer one, and slices of it"}}},
        {"walk",
         {{"abut walk ground.glb", "connected components and borders of a walk mesh"},
          {"abut walk ground.glb --from 0,0,0 --to 9,0,9 --picture path.svg", "a path, and a picture of it"}}},
        {"info", {{"abut info level.glb", "which objects a file has, and which are convex solids"}}},
        {"replay", {{"abut replay session.rec", "where an answer differs from the recorded one"}}},
        {"bake",
         {{"abut bake meshes.txt --verb decompose --cache parts", "convex parts of every mesh in a list"},
          {"abut bake meshes.txt --verb field --cache fields -- --cell 0.1", "options of the verb follow --"},
          {"abut bake meshes.txt --verb hull --cache https://cache.example/abut --shard 3/16",
           "one of sixteen workers that share a cache"},
          {"find levels -name '*.glb' | abut bake - --verb check --cache checks --report", "all results together"}}},
        {"help",
         {{"abut help check", "the options of a verb"},
          {"abut help --completions bash > /etc/bash_completion.d/abut", "completions by hand"}}},
    };
    return all;
}

}  // namespace

std::vector<Example> examples_of(std::string_view verb) {
    for (const VerbExamples& entry : all_examples())
        if (entry.verb == verb) return entry.examples;
    return {};
}

std::vector<ExitCodeHelp> exit_codes_of(std::string_view verb) {
    const ExitCodeHelp bad{"2", "bad input or usage, with one line on stderr"};
    if (verb == "check") return {{"0", "no errors"}, {"1", "errors were found"}, bad};
    if (verb == "cast") return {{"0", "the ray hits nothing"}, {"1", "it hits something"}, bad};
    if (verb == "field") return {{"0", "done"}, {"1", "done, but the surface has gaps, or signs are uncertain"}, bad};
    if (verb == "walk") return {{"0", "fine"}, {"1", "no path, or a point is out of reach"}, bad};
    if (verb == "replay") return {{"0", "all answers are equal"}, {"1", "an answer differs"}, bad};
    if (verb == "bake")
        return {{"0", "all results are there, and nothing was found"},
                {"1", "something was found, or --audit found a difference"},
                {"2", "bad input or usage, an input was rejected, or --report misses a result"}};
    if (verb.empty()) return {{"0", "fine"}, {"1", "something was found"}, bad};
    return {{"0", "done"}, bad};
}

}  // namespace abut::tool
