#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/solid/contact_area.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/detail/solid/separating_move.hpp>
#include <abut/query/detail/solid/solid_ball.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>

#include <algorithm>
#include <utility>

namespace abut::detail {
namespace {

/// A distance of triangles smaller than this, relative to the size, is rounding.
constexpr double touching = 1e-9;

/// The tolerance of distances; a coordinate seen from A is at most twice the largest one.
double distance_tolerance(const View<3>& a, const View<3>& b) {
    double farthest = 0;
    for (const View<3>* shape : {&a, &b}) {
        const Aabb3 box = bounds(*shape);
        farthest = std::max({farthest, largest(DVec<3>(box.min)), largest(DVec<3>(box.max))});
    }
    return tolerance_for(std::min(size(a), size(b)), 2 * farthest);
}

/// Sets a common point of the surfaces after the move, and its features.
void name_point(const View<3>& a, const View<3>& b, const DVec<3>& move, Closest<3>& closest) {
    const SolidContactArea area =
        contact_area(PlacedSolid(a), PlacedSolid(b), move, DVec<3>(closest.normal), distance_tolerance(a, b));
    if (area.manifold.count == 0) return;
    closest.on_a = to_float(area.manifold.points[0].position);
    closest.on_b = to_float(area.manifold.points[0].position - move);
    closest.feature_a = area.feature_a;
    closest.feature_b = area.feature_b;
}

/// Whether the centre of a ball is inside a solid mesh.
bool contains_center(const View<3>& solid, const View<3>& ball) {
    const auto& convex = std::get<Convex<3>>(ball);
    const DVec<3> center = convex.place.point(DVec<3>(convex.vertices()[0]));
    return PlacedSolid(solid).side_of(center) == PointSide::inside;
}

}  // namespace

bool are_solids(const View<3>& a, const View<3>& b) {
    const auto joins = [](const View<3>& shape) {
        return is_solid_mesh(shape) || is_solid_polytope(shape) || is_ball(shape);
    };
    return (is_solid_mesh(a) || is_solid_mesh(b)) && joins(a) && joins(b);
}

bool is_inside_other(const View<3>& a, const View<3>& b) {
    if (is_ball(b)) return contains_center(a, b);
    if (is_ball(a)) return contains_center(b, a);
    const PlacedSolid solid_a(a), solid_b(b);
    return has_component_inside(solid_a, solid_b) || has_component_inside(solid_b, solid_a);
}

bool find_depth(const View<3>& a, const View<3>& b, Closest<3>& closest) {
    if (is_ball(b)) return find_ball_depth(a, b, closest);
    if (is_ball(a)) {
        if (!find_ball_depth(b, a, closest)) return false;
        closest.normal = -closest.normal;
        std::swap(closest.on_a, closest.on_b);
        std::swap(closest.feature_a, closest.feature_b);
        return true;
    }
    const PlacedSolid solid_a(a), solid_b(b);
    if (!interiors_overlap(solid_a, solid_b)) return false;
    const SeparatingMove move = separating_move(a, b);
    closest.distance = -move.depth;
    closest.normal = move.normal;
    name_point(a, b, DVec<3>(move.normal) * static_cast<double>(move.depth), closest);
    return true;
}

void name_touching(const View<3>& a, const View<3>& b, Closest<3>& closest) {
    if (static_cast<double>(closest.distance) > touching * std::min(size(a), size(b))) return;
    closest.distance = 0;
    if (is_ball(a) || is_ball(b)) return;
    closest.normal = to_float(touching_normal(PlacedSolid(a), PlacedSolid(b), distance_tolerance(a, b)));
    closest.on_b = closest.on_a;
    name_point(a, b, DVec<3>(0.0), closest);
}

Contact<3> contact_of_solids(const View<3>& a, const View<3>& b, const Closest<3>& closest) {
    Contact<3> result;
    result.normal = closest.normal;
    result.depth = 0 - closest.distance;
    result.feature_a = closest.feature_a;
    result.feature_b = closest.feature_b;
    if (!is_ball(a) && !is_ball(b)) {
        const DVec<3> move = DVec<3>(closest.normal) * -static_cast<double>(closest.distance);
        const SolidContactArea area =
            contact_area(PlacedSolid(a), PlacedSolid(b), move, DVec<3>(closest.normal), distance_tolerance(a, b));
        for (std::size_t i = 0; i < area.manifold.count; ++i) {
            const ManifoldPoint<3>& point = area.manifold.points[i];
            result.points.push_back({to_float(point.position - move * 0.5), result.depth, point.feature});
        }
    }
    if (result.points.empty())
        result.points.push_back({to_float((DVec<3>(closest.on_a) + DVec<3>(closest.on_b)) * 0.5), result.depth, 0});
    return result;
}

}  // namespace abut::detail
