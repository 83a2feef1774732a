#include "tool/shared/format.hpp"
#include "tool/shared/left_out.hpp"
#include "tool/shared/printable.hpp"
#include "tool/verbs.hpp"

#include <cmath>

#include <fmt/format.h>

namespace abut::tool {
namespace {

template <int D>
std::string size_of(const Aabb<D>& box) {
    const Vec<D> size = box.max - box.min;
    std::string text;
    Vec<D> first = box.min;
    for (int i = 0; i < D; ++i) {
        text += (i == 0 ? "" : " x ") + number(static_cast<double>(size[i]));
        // Boxes are rounded outwards: a coordinate that is a rounding error below zero is printed as zero.
        if (std::abs(first[i]) < 1e-6f * size[i]) first[i] = 0;
    }
    return text + ", from " + vector(first) + " on";
}

std::string line_of(const Object<3>& object) {
    return fmt::format("  {:5}  {:8} triangles  {}\n", object.kind, object.parts, object.path);
}
std::string line_of(const Object<2>& object) {
    const std::string parts =
        object.solid ? ""
                     : counted(object.parts, object.part_name.data(), (std::string(object.part_name) + "s").c_str());
    return fmt::format("  {:11}  {:>14}  {}{}\n", object.kind, parts, object.path,
                       object.type.empty() ? "" : " (" + object.type + ")");
}

// Summary of the file's other contents, and totals.
std::string summary(const Scene& scene, const SceneObjects& objects, const std::vector<double>& times) {
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) triangles += objects[i].parts;
    const std::size_t solids = objects.count_solids();
    std::string text = fmt::format("nodes       {}\nobjects     {}: {} convex solids, {} meshes\ntriangles   {}\n",
                                   scene.nodes.size(), objects.size(), solids, objects.size() - solids, triangles);
    for (const Animation& animation : scene.animations)
        text += fmt::format("animation   '{}', {:.4g} s, from {:.4g} s on\n", animation.name, animation.length,
                            animation.start);
    const std::vector<LeftOutOf> left_out = left_out_of(scene);
    if (!left_out.empty()) text += "left out    " + text_of(left_out) + "\n";
    return text + fmt::format("frames      {}\n", times.size());
}
std::string summary(const Level& level, const LevelObjects& objects, const std::vector<double>&) {
    std::string text;
    for (std::size_t i = 0; i < level.points.size() && i < max_listed; ++i) {
        const LevelPoint& point = level.points[i];
        text += fmt::format("  {:11}  {:>14}  {}{}\n", "point", vector(point.position), point.path,
                            point.type.empty() ? "" : " (" + point.type + ")");
    }
    if (!text.empty()) text += "\n";
    const std::size_t solids = objects.count_solids();
    return text + fmt::format("objects     {}: {} convex solids, {} composites\npoints      {}\n", objects.size(),
                              solids, objects.size() - solids, level.points.size());
}

Json properties_of(const std::vector<LevelProperty>& properties) {
    Json result = Json::object();
    for (const LevelProperty& property : properties) result[property.name] = property.value;
    return result;
}

void add_own(const Object<3>& object, const SceneObjects&, std::size_t, Json& entry) {
    entry["triangles"] = object.parts;
}
void add_own(const Object<2>& object, const LevelObjects& objects, std::size_t i, Json& entry) {
    entry["parts"] = object.parts;
    entry["type"] = object.type;
    entry["filled"] = object.filled;
    entry["properties"] = properties_of(objects.source(i).properties);
}

void add_rest(const Scene& scene, Json& json) {
    Json animations = Json::array();
    for (const Animation& animation : scene.animations)
        animations.push_back({{"name", animation.name}, {"start", animation.start}, {"length", animation.length}});
    json["nodes"] = scene.nodes.size();
    json["left_out"] = json_of(left_out_of(scene));
    json["animations"] = std::move(animations);
}
void add_rest(const Level& level, Json& json) {
    Json points = Json::array();
    for (const LevelPoint& point : level.points)
        points.push_back({{"name", point.path},
                          {"type", point.type},
                          {"position", numbers(point.position)},
                          {"properties", properties_of(point.properties)}});
    json["points"] = std::move(points);
}

template <int D>
std::string text_info(const std::string& name, const File<D>& file, const ObjectsOf<D>& objects,
                      const std::vector<double>& times) {
    Aabb<D> box = Aabb<D>::empty();
    std::string list;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (objects[i].present) box = merged(box, objects[i].box);
        if (i < max_listed) list += line_of(objects[i]);
    }
    if (objects.size() > max_listed)
        list += fmt::format("  and {} more (--json lists them all)\n", objects.size() - max_listed);
    std::string text = fmt::format("{}\n\n{}\n", name, list);
    for (const std::string& warning : file.warnings) text += "note: " + warning + "\n";
    text += summary(file, objects, times);
    if (box.min.x <= box.max.x) text += "size        " + size_of(box) + "\n";
    return text;
}

template <int D>
std::string json_info(const File<D>& file, const ObjectsOf<D>& objects, const std::vector<double>& times) {
    Json list = Json::array();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object<D>& object = objects[i];
        Json entry = {{"name", object.path}, {"kind", object.kind}};
        add_own(object, objects, i, entry);
        if (object.present) {
            entry["min"] = numbers(object.box.min);
            entry["max"] = numbers(object.box.max);
        }
        list.push_back(std::move(entry));
    }
    Json json = {{"objects", std::move(list)}};
    add_rest(file, json);
    json["frames"] = times.size();
    json["warnings"] = file.warnings;
    return to_text(json);
}

template <int D>
Result<ExitCode> run(const InfoRequest& request) {
    const Result<File<D>> file = load<D>(request.scene, request.files);
    if (!file) return file.problem();
    const std::vector<double> times = key_times(*file);
    ObjectsOf<D> objects(*file);
    if (const std::optional<Problem> problem = build<D>(objects, times.front()))
        return Problem{problem->code, request.scene + ": " + problem->message};
    return print(request.json ? json_info<D>(*file, objects, times)
                              : text_info<D>(printable(request.scene), *file, objects, times),
                 fine);
}

}  // namespace

Result<ExitCode> run_info(const InfoRequest& request) {
    if (request.scene.ends_with(field_ending)) return run_field_info(request);
    if (request.scene.ends_with(walk_ending)) {
        WalkRequest walk;
        walk.mesh = request.scene;
        walk.json = request.json;
        return run_walk(walk);
    }
    return in_dimension_of(request.scene, [&](auto dimension) { return run<dimension()>(request); });
}

}  // namespace abut::tool
