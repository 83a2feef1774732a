#include "tool/objects/level_objects.hpp"

#include <algorithm>
#include <string>
#include <variant>

namespace abut::tool {
namespace {

struct PartName {
    std::string_view operator()(const TileMap&) const { return "tile"; }
    std::string_view operator()(const Chain&) const { return "segment"; }
    std::string_view operator()(const Outlines&) const { return "segment"; }
    std::string_view operator()(const Compound2&) const { return "part"; }
    template <class Convex>
    std::string_view operator()(const Convex&) const {
        return {};
    }
};

}  // namespace

LevelObjects::LevelObjects(const Level& level, const std::vector<bool>& solid) {
    for (std::size_t i = 0; i < level.objects.size(); ++i)
        if (solid.empty() || solid[i]) sources_.push_back(&level.objects[i]);
    std::sort(sources_.begin(), sources_.end(),
              [](const LevelObject* a, const LevelObject* b) { return a->path < b->path; });
    for (const LevelObject* source : sources_) {
        Object<2>& object = objects_.emplace_back();
        object.path = source->path;
        object.name = source->name;
        object.type = source->type;
    }
}

std::optional<Problem> LevelObjects::go_to(double, ProgressCall progress) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        Object<2>& object = objects_[i];
        const LevelObject& source = *sources_[i];
        object.moved = !object.present;
        if (!object.moved) continue;
        object.present = true;
        object.kind = abut::kind(source.shape);
        object.part_name = std::visit(PartName(), source.shape);
        object.parts = count_parts(source.shape);
        object.solid = object.part_name.empty();
        object.filled = source.filled;
        object.inside = interior_point(source.shape, source.filled);
        object.pose = source.pose;
        object.placed = view(source);
        object.radius = static_cast<float>(abut::detail::size(object.placed));
        object.box = bounds(object.placed);
        if (!detail::is_finite(object.box.min) || !detail::is_finite(object.box.max))
            return Problem{ProblemCode::not_finite,
                           "object '" + object.path + "': it reaches out of the range of floats"};
        progress(i + 1, objects_.size());
    }
    return std::nullopt;
}

std::vector<double> key_times(const Level&) {
    return {0};
}
std::vector<double> frame_times(const Level&, std::size_t) {
    return {0};
}

}  // namespace abut::tool
