#include "meeting.hpp"

#include <algorithm>

namespace abut::tool {
namespace {

// Of the smaller object's size: what things that stand on things may sink in.
constexpr float default_allow = 1e-3f;
// Of the smaller object's size: the margin of every answer, within which a gap is none.
constexpr float margin = 1e-5f;

// Whether a point from inside of one body is inside of the other, a mesh that is filled. What the point is under of
// both surfaces together is how far they must move to come apart by the shortest way there: at least, and exact for
// balls and for things placed twice.
template <int D>
std::optional<Meeting<D>> inside(const Standing<D>& outer, const Standing<D>& inner, float allow) {
    if (!outer.object.filled) return std::nullopt;
    const Vec<D> point = inner.pose * inner.object.inside.point;
    if (!contains(outer.box, point) || !contains(outer.placed, point)) return std::nullopt;
    const Closest<D> way_out = closest(outer.placed, point);
    const float depth = way_out.distance + inner.object.inside.depth;
    if (!(depth > allow)) return std::nullopt;
    // From the nearest place of the surface to the point: the way in.
    return Meeting<D>{-depth, allow, -way_out.normal, {point}, true};
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
std::optional<Meeting<D>> meeting(const Standing<D>& a, const Standing<D>& b, const Limits& limits) {
    const float allow = allowed_depth(a.object, b.object, limits);
    const bool wants_gaps = limits.clearance > 0;
    if (wants_gaps || overlaps(a.placed, b.placed)) {
        const Contact<D> c = contact(a.placed, b.placed, {.margin = limits.clearance});
        const bool collides = c && c.depth > allow;
        const bool too_near =
            c && wants_gaps && (c.depth < -margin * smaller_size(a.object, b.object)) && (c.depth > -limits.clearance);
        if (collides || too_near) {
            Meeting<D> result{-c.depth, allow, c.normal, {}, false};
            for (const auto& point : c.points) result.points.push_back(point.position);
            return result;
        }
    }
    if (std::optional<Meeting<D>> result = inside(a, b, allow)) return result;
    std::optional<Meeting<D>> result = inside(b, a, allow);
    if (result) result->normal = -result->normal;
    return result;
}

template float smaller_size(const Object<2>& a, const Object<2>& b);
template float smaller_size(const Object<3>& a, const Object<3>& b);
template float allowed_depth(const Object<2>& a, const Object<2>& b, const Limits& limits);
template float allowed_depth(const Object<3>& a, const Object<3>& b, const Limits& limits);
template std::optional<Meeting<2>> meeting(const Standing<2>& a, const Standing<2>& b, const Limits& limits);
template std::optional<Meeting<3>> meeting(const Standing<3>& a, const Standing<3>& b, const Limits& limits);

}  // namespace abut::tool
