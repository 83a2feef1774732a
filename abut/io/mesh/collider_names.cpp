#include <abut/io/mesh/collider_names.hpp>
#include <abut/io/mesh/primitives.hpp>

#include <array>
#include <map>
#include <utility>

namespace abut::detail {
namespace {

constexpr std::array<std::string_view, 4> prefixes = {"UCX_", "UBX_", "USP_", "UCP_"};
constexpr std::array<std::pair<std::string_view, ColliderName>, 4> suffixes = {
    std::pair{"-convcolonly", ColliderName::convex}, std::pair{"-convcol", ColliderName::convex},
    std::pair{"-colonly", ColliderName::mesh}, std::pair{"-col", ColliderName::mesh}};

// The name without ".001" or "_01" at its end.
std::string_view without_number(std::string_view name) {
    std::size_t end = name.size();
    while (end > 0 && name[end - 1] >= '0' && name[end - 1] <= '9') --end;
    const bool has_number = end > 0 && end < name.size() && (name[end - 1] == '.' || name[end - 1] == '_');
    return has_number ? name.substr(0, end - 1) : name;
}

}  // namespace

std::optional<ColliderName> collider_name(std::string_view name) {
    for (const std::string_view prefix : prefixes)
        if (name.starts_with(prefix) && name.size() > prefix.size()) return ColliderName::convex;
    const std::string_view stem = without_number(name);
    for (const auto& [suffix, meaning] : suffixes)
        if (stem.ends_with(suffix)) return meaning;
    return std::nullopt;
}

std::string_view body_name(std::string_view name) {
    name = without_number(name);
    for (const std::string_view prefix : prefixes)
        if (name.starts_with(prefix)) return name.substr(prefix.size());
    for (const auto& [suffix, meaning] : suffixes)
        if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
    return name;
}

void select_colliders(Scene& scene) {
    // Some exporters name the mesh and not the node.
    const auto name_of = [&](const SceneNode& node) -> const std::string& {
        const bool by_mesh = !collider_name(node.name) && !node.geometries.empty();
        return by_mesh ? scene.geometries[node.geometries.front()].name : node.name;
    };
    std::size_t colliders = 0, others = 0;
    std::string such_as;
    for (const SceneNode& node : scene.nodes) {
        if (node.geometries.empty()) continue;
        const bool is_collider = collider_name(name_of(node)).has_value();
        if (is_collider && colliders == 0) such_as = node.name.empty() ? name_of(node) : node.name;
        (is_collider ? colliders : others)++;
    }
    if (colliders == 0) return;
    std::map<std::uint32_t, std::uint32_t> hulls;
    for (SceneNode& node : scene.nodes) {
        if (node.geometries.empty()) continue;
        const std::optional<ColliderName> meaning = collider_name(name_of(node));
        if (!meaning) {
            node.geometries.clear();
            continue;
        }
        if (*meaning == ColliderName::mesh) continue;
        for (std::uint32_t& geometry : node.geometries) {
            const auto [known, is_new] =
                hulls.try_emplace(geometry, static_cast<std::uint32_t>(scene.geometries.size()));
            if (is_new) {
                Geometry hull = hull_mesh(scene.geometries[geometry]);
                scene.geometries.push_back(std::move(hull));
            }
            geometry = known->second;
        }
    }
    scene.warnings.push_back(std::to_string(colliders) +
                             (colliders == 1 ? " node is a collider" : " nodes are colliders") + " by name, such as '" +
                             such_as + "': " + std::to_string(others) + (others == 1 ? " other is" : " others are") +
                             " left out");
}

}  // namespace abut::detail
