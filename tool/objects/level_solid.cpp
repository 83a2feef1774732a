#include "tool/objects/level_solid.hpp"

#include "tool/objects/flat_surface.hpp"
#include <abut/query/contains.hpp>
#include <abut/shape/segment.hpp>

#include <utility>
#include <variant>
#include <vector>

namespace abut::tool {
namespace {

// `contains` treats every closed Chain as solid, also one that isn't filled, and so it does for children of a Compound.
bool has_inside(const LevelObject& object) {
    if (const auto* chain = std::get_if<Chain>(&object.shape)) return object.filled && chain->closed();
    if (const auto* outlines = std::get_if<Outlines>(&object.shape)) return outlines->rule != FillRule::none;
    return true;
}

void add(const Surface<2>& surface, std::vector<AnyShape<2>>& segments) {
    for (const Surface<2>::Facet& facet : surface.facets)
        segments.emplace_back(Segment2{surface.points[facet[0]], surface.points[facet[1]]});
}

}  // namespace

Result<LevelSolid> level_solid(const Level& level) {
    std::vector<AnyShape<2>> areas, segments;
    for (const LevelObject& object : level.objects) {
        if (has_inside(object))
            std::visit([&](const auto& shape) { areas.emplace_back(at(shape, object.pose)); }, object.shape);
        else if (const Result<Surface<2>> surface = surface_of(view(object), false); surface)
            add(*surface, segments);
        else
            return Problem{surface.problem().code, "object '" + object.path + "': " + surface.problem().message};
    }
    std::optional<Compound2> together;
    if (!areas.empty()) {
        const Result<Compound2> built = Compound2::build(areas);
        if (!built) return built.problem();
        together = *built;
        const Result<Surface<2>> surface = surface_of(view(*together), true);
        if (!surface) return Problem{surface.problem().code, "all objects together: " + surface.problem().message};
        add(*surface, segments);
    }
    if (segments.empty()) return Problem{ProblemCode::empty_input, "there is nothing in it that has a surface"};
    const Result<Compound2> boundary = Compound2::build(segments);
    if (!boundary) return boundary.problem();
    return LevelSolid{*boundary, std::move(together)};
}

Aabb2 bounds(const LevelSolid& solid) {
    return solid.boundary.bounds();
}
void each_part(const LevelSolid& solid, const Aabb2& box, detail::PartVisitor<2> visit) {
    solid.boundary.each_part(box, visit);
}
void each_part_along(const LevelSolid& solid, const MovingBox<2>& box, detail::PartReachVisitor<2> visit) {
    solid.boundary.each_part_along(box, visit);
}
void each_part_near(const LevelSolid& solid, const Aabb2& box, detail::PartReachVisitor<2> visit) {
    solid.boundary.each_part_near(box, visit);
}
bool solid_contains(const LevelSolid& solid, const Vec2& point) {
    return solid.areas && contains(*solid.areas, point);
}

}  // namespace abut::tool
