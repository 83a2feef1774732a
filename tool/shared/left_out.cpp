#include "tool/shared/left_out.hpp"

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Limit of the text report; --json lists all.
constexpr std::size_t max_named = 10;

std::uint64_t count_triangles(const std::vector<LeftOutOf>& left_out) {
    std::uint64_t result = 0;
    for (const LeftOutOf& object : left_out) result += object.triangles;
    return result;
}

}  // namespace

std::vector<LeftOutOf> left_out_of(const Scene& scene) {
    std::vector<LeftOutOf> result;
    for (const NodeLeftOut& node : scene.left_out)
        result.push_back({path(scene, node.node), node.triangles, !scene.nodes[node.node].geometries.empty()});
    return result;
}

std::vector<LeftOutOf> left_out_of(const Level&) {
    return {};
}

std::string text_of(const std::vector<LeftOutOf>& left_out) {
    if (left_out.empty()) return {};
    std::string text = counted(count_triangles(left_out), "triangle", "triangles") + " of zero area:";
    for (std::size_t i = 0; i < left_out.size() && i < max_named; ++i)
        text += fmt::format("{} {} of '{}'{}", i == 0 ? "" : ",", left_out[i].triangles, left_out[i].path,
                            left_out[i].has_shape ? "" : ", which has no others and so no shape");
    if (left_out.size() > max_named)
        text += " and of " + counted(left_out.size() - max_named, "more object", "more objects");
    return text;
}

Json json_of(const std::vector<LeftOutOf>& left_out) {
    Json objects = Json::array();
    for (const LeftOutOf& object : left_out)
        objects.push_back({{"name", object.path}, {"triangles", object.triangles}, {"shape", object.has_shape}});
    return {{"triangles", count_triangles(left_out)}, {"objects", std::move(objects)}};
}

}  // namespace abut::tool
