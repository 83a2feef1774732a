#include "report_json.hpp"
#include "verbs.hpp"

#include <fmt/format.h>

namespace abut::tool {
namespace {

constexpr std::size_t most_objects = 100;

std::string text_info(const std::string& name, const Scene& scene, const Objects& objects,
                      const std::vector<double>& times) {
    std::size_t solids = 0;
    std::size_t triangles = 0;
    Aabb3 box = Aabb3::empty();
    std::string list;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& object = objects[i];
        const std::size_t count = objects.model_of(object).surface.triangles.size();
        solids += object.solid ? 1 : 0;
        triangles += count;
        if (object.present) box = merged(box, object.box);
        if (i < most_objects)
            list += fmt::format("  {:5}  {:8} triangles  {}\n", object.solid ? "solid" : "mesh", count, object.path);
    }
    if (objects.size() > most_objects)
        list += fmt::format("  and {} more (--json lists them all)\n", objects.size() - most_objects);

    std::string text = fmt::format("{}\n\n{}\n", name, list);
    for (const std::string& warning : scene.warnings) text += "note: " + warning + "\n";
    text += fmt::format("nodes       {}\nobjects     {}: {} convex solids, {} meshes\ntriangles   {}\n",
                        scene.nodes.size(), objects.size(), solids, objects.size() - solids, triangles);
    for (const Animation& animation : scene.animations)
        text += fmt::format("animation   '{}', {:.4g} s, from {:.4g} s on\n", animation.name, animation.length,
                            animation.start);
    text += fmt::format("frames      {}\n", times.size());
    if (box.min.x <= box.max.x)
        text += fmt::format("size        {:.4g} x {:.4g} x {:.4g}, from ({:.4g}, {:.4g}, {:.4g}) on\n",
                            box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z, box.min.x, box.min.y,
                            box.min.z);
    return text;
}

}  // namespace

Result<ExitCode> run_info(const InfoRequest& request) {
    const Result<Scene> scene = load(request.scene, request.skip_degenerate);
    if (!scene) return scene.problem();
    const std::vector<double> times = key_times(*scene);
    Objects objects(*scene);
    if (const std::optional<Problem> problem = build(objects, times.front()))
        return Problem{problem->code, request.scene + ": " + problem->message};
    return print(request.json ? json_info(objects, *scene, times) : text_info(request.scene, *scene, objects, times),
                 fine);
}

}  // namespace abut::tool
