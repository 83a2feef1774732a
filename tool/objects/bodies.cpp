#include "tool/objects/bodies.hpp"

#include "tool/shared/name_pattern.hpp"
#include <abut/io/mesh/collider_names.hpp>

#include <map>
#include <string_view>
#include <utility>

namespace abut::tool {
namespace {

struct NodeName {
    std::string path, name, type;
};

Problem unmatched(const std::string& pattern) {
    return {ProblemCode::bad_argument, "--body: no node is named '" + pattern + "'"};
}

}  // namespace

Result<std::vector<std::uint32_t>> bodies_of(const Scene& scene, const SceneObjects& objects,
                                             const std::vector<std::string>& patterns) {
    std::vector<bool> is_body(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) is_body[i] = scene.nodes[i].is_body;
    for (const std::string& pattern : patterns) {
        bool any = false;
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
            if (matches_name(pattern, NodeName{path(scene, i), scene.nodes[i].name, {}})) is_body[i] = any = true;
        if (!any) return unmatched(pattern);
    }
    // The colliders of one thing, such as UCX_Crate_01 and UCX_Crate_02, are one body as well.
    std::map<std::pair<std::uint32_t, std::string_view>, std::uint32_t> colliders;
    std::vector<std::uint32_t> bodies;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::uint32_t own = objects.node(i);
        std::uint32_t node = own;
        while (node != SceneNode::no_parent && !is_body[node]) node = scene.nodes[node].parent;
        const std::string& name = scene.nodes[own].name;
        if (node == SceneNode::no_parent && detail::collider_name(name))
            node = colliders.try_emplace({scene.nodes[own].parent, detail::body_name(name)}, own).first->second;
        bodies.push_back(node == SceneNode::no_parent ? own : node);
    }
    return bodies;
}

Result<std::vector<std::uint32_t>> bodies_of(const Level& level, const LevelObjects& objects,
                                             const std::vector<bool>& ground,
                                             const std::vector<std::string>& patterns) {
    std::map<std::string_view, bool> is_ground;
    for (std::size_t i = 0; i < ground.size(); ++i) is_ground[level.objects[i].path] = ground[i];
    std::map<std::string_view, std::uint32_t> numbers;  // of paths at which a body begins
    const auto number_of = [&](std::string_view begin) {
        return numbers.try_emplace(begin, static_cast<std::uint32_t>(numbers.size())).first->second;
    };
    const std::uint32_t ground_number = number_of("");
    std::vector<bool> used(patterns.size());
    // The longest part of a path, up to a slash or the end, that matches a pattern.
    const auto begin_of = [&](const Object<2>& object) {
        const std::string_view path = object.path;
        std::string_view longest;
        for (std::size_t p = 0; p < patterns.size(); ++p)
            for (std::size_t end = path.find('/');; end = path.find('/', end + 1)) {
                const bool is_whole = end == std::string_view::npos;
                const std::string_view above = path.substr(0, end);
                const bool is_match =
                    is_whole ? matches_name(patterns[p], object) : detail::glob_matches(patterns[p], above);
                if (is_match) {
                    used[p] = true;
                    if (above.size() > longest.size()) longest = above;
                }
                if (is_whole) break;
            }
        return longest;
    };
    std::vector<std::uint32_t> bodies;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::string_view begin = begin_of(objects[i]);
        bodies.push_back(begin.empty() && is_ground[objects[i].path]
                             ? ground_number
                             : number_of(begin.empty() ? std::string_view(objects[i].path) : begin));
    }
    for (std::size_t p = 0; p < patterns.size(); ++p)
        if (!used[p]) return unmatched(patterns[p]);
    return bodies;
}

}  // namespace abut::tool
