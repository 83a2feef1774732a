#include <abut/io/level.hpp>

#include <algorithm>
#include <array>

namespace abut {

std::string_view kind(const LevelShape& shape) {
    constexpr std::array<std::string_view, std::variant_size_v<LevelShape>> names{
        "polygon", "box", "circle", "capsule", "ellipse", "rounded box", "tiles", "chain", "outlines", "compound"};
    return names[shape.index()];
}

namespace {

struct CountParts {
    std::size_t operator()(const TileMap& map) const {
        const auto tiles = map.tiles();
        return tiles.size() - static_cast<std::size_t>(std::count(tiles.begin(), tiles.end(), Tile::empty));
    }
    std::size_t operator()(const Chain& chain) const { return chain.size(); }
    std::size_t operator()(const Compound2& compound) const { return compound.size(); }
    std::size_t operator()(const Outlines& outlines) const {
        std::size_t count = 0;
        for (const Chain& chain : outlines.chains) count += chain.size();
        return count;
    }
    template <class Convex>
    std::size_t operator()(const Convex&) const {
        return 1;
    }
};

}  // namespace

std::size_t count_parts(const LevelShape& shape) {
    return std::visit(CountParts(), shape);
}

View<2> view(const LevelObject& object) {
    return std::visit([&](const auto& shape) { return View<2>(view(at(shape, object.pose))); }, object.shape);
}

Aabb2 bounds(const LevelObject& object) {
    return bounds(view(object));
}

const std::string* property(const std::vector<LevelProperty>& properties, std::string_view name) {
    for (const LevelProperty& one : properties)
        if (one.name == name) return &one.value;
    return nullptr;
}

std::vector<const LevelPoint*> points_called(const Level& level, std::string_view type_or_name) {
    std::vector<const LevelPoint*> result;
    for (const LevelPoint& point : level.points)
        if (point.type == type_or_name || point.name == type_or_name) result.push_back(&point);
    return result;
}

}  // namespace abut
