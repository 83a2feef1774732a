#include "tool/check/pair_contact.hpp"

#include <algorithm>
#include <span>
#include <variant>

namespace abut::tool {
namespace {

// Default allowed depth relative to the smaller object's size: objects that rest on others may penetrate this far.
constexpr float default_allow = 1e-3f;
// Tolerance of queries relative to the smaller object's size: smaller gaps count as touching.
constexpr float tolerance = 1e-5f;

// A shape as its surface alone, at its place.
View<3> surface_of(const ObjectAt<3>& object) {
    return view(at(object.object.surface, object.pose));
}
const View<2>& surface_of(const ObjectAt<2>& object) {
    return object.placed;
}

// Tests if an interior point of one body is inside the other, a filled mesh. The sum of the point's depths below both
// surfaces is a lower bound of the separating distance. It is exact for balls and for identical bodies.
template <int D>
std::optional<PairContact<D>> contained(const ObjectAt<D>& outer, const ObjectAt<D>& inner, float allow) {
    if (!outer.object.filled) return std::nullopt;
    const Vec<D> point = inner.pose * inner.object.inside.point;
    if (!contains(outer.box, point) || !contains(outer.placed, point)) return std::nullopt;
    const Closest<D> nearest = closest(surface_of(outer), point);
    const float depth = nearest.distance + inner.object.inside.depth;
    if (!(depth > allow)) return std::nullopt;
    // The normal points from the closest surface point to the interior point.
    return PairContact<D>{-depth, allow, -nearest.normal, {point}, true};
}

// Solids in space: their contact says all.
template <int D>
bool are_solids(const Object<D>& a, const Object<D>& b) {
    return D == 3 && (a.filled || b.filled) && (a.filled || a.solid) && (b.filled || b.solid);
}

// Whether all corners of a convex body are inside another one, and none on its surface.
bool holds_all_corners(const ObjectAt<3>& outer, const ObjectAt<3>& inner) {
    const float least = tolerance * smaller_size(outer.object, inner.object);
    const auto& convex = std::get<detail::Convex<3>>(inner.placed);
    const std::span<const Vec3> corners(convex.vertices(), convex.count);
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
        const Vec3 point = detail::to_float(convex.place.point(detail::DVec<3>(corner)));
        return closest(outer.placed, point).distance < -least;
    });
}

// True if one of two overlapping bodies contains the other: of convex ones by the corners, else if the surfaces don't
// touch.
bool is_inside(const ObjectAt<3>& a, const ObjectAt<3>& b) {
    if (a.object.solid && b.object.solid) return holds_all_corners(a, b) || holds_all_corners(b, a);
    return are_solids(a.object, b.object) && !overlaps(surface_of(a), surface_of(b));
}
bool is_inside(const ObjectAt<2>&, const ObjectAt<2>&) {
    return false;
}

// Whether two overlapping bodies are deeper than allowed for as little as two of their triangles: no move that parts
// the bodies is shorter than one that parts these.
template <int D>
bool are_surely_deep(const ObjectAt<D>& a, const ObjectAt<D>& b, float allow) {
    constexpr float certainly = 1.001f;
    return are_solids(a.object, b.object) && -closest(surface_of(a), surface_of(b)).distance > certainly * allow;
}

}  // namespace

template <int D>
float smaller_size(const Object<D>& a, const Object<D>& b) {
    return std::min(a.radius, b.radius);
}

template <int D>
float allowed_depth(const Object<D>& a, const Object<D>& b, const Limits& limits) {
    return limits.allow.value_or(default_allow * smaller_size(a, b));
}

template <int D>
std::optional<PairContact<D>> pair_contact(const ObjectAt<D>& a, const ObjectAt<D>& b, const Limits& limits,
                                           Depth depth) {
    const float allow = allowed_depth(a.object, b.object, limits);
    const bool has_clearance = limits.clearance > 0;
    if (has_clearance || overlaps(a.placed, b.placed)) {
        if (!has_clearance && depth == Depth::not_needed && are_surely_deep(a, b, allow))
            return PairContact<D>{.allow = allow, .points = {}, .has_depth = false};
        const Contact<D> c = contact(a.placed, b.placed, {.margin = limits.clearance});
        const bool is_deep = c && c.depth > allow;
        const bool is_close = c && has_clearance && (c.depth < -tolerance * smaller_size(a.object, b.object)) &&
                              (c.depth > -limits.clearance);
        if (is_deep || is_close) {
            PairContact<D> result{-c.depth, allow, c.normal, {}};
            for (const auto& point : c.points) result.points.push_back(point.position);
            result.inside = is_deep && is_inside(a, b);
            return result;
        }
    }
    if (are_solids(a.object, b.object)) return std::nullopt;
    if (std::optional<PairContact<D>> result = contained(a, b, allow)) return result;
    std::optional<PairContact<D>> result = contained(b, a, allow);
    if (result) result->normal = -result->normal;
    return result;
}

template float smaller_size(const Object<2>& a, const Object<2>& b);
template float smaller_size(const Object<3>& a, const Object<3>& b);
template float allowed_depth(const Object<2>& a, const Object<2>& b, const Limits& limits);
template float allowed_depth(const Object<3>& a, const Object<3>& b, const Limits& limits);
template std::optional<PairContact<2>> pair_contact(const ObjectAt<2>& a, const ObjectAt<2>& b, const Limits& limits,
                                                    Depth depth);
template std::optional<PairContact<3>> pair_contact(const ObjectAt<3>& a, const ObjectAt<3>& b, const Limits& limits,
                                                    Depth depth);

}  // namespace abut::tool
