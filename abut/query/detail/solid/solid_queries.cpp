#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/solid/contact_area.hpp>
#include <abut/query/detail/solid/convex_depth.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/detail/solid/separating_move.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/shape/view/part.hpp>

#include <algorithm>
#include <utility>

namespace abut::detail {
namespace {

/// A distance of triangles smaller than this, relative to the size, is rounding.
constexpr double touching = 1e-9;

void flip(Closest<3>& closest) {
    closest.normal = -closest.normal;
    std::swap(closest.on_a, closest.on_b);
    std::swap(closest.feature_a, closest.feature_b);
}
void flip(Contact<3>& contact) {
    contact.normal = -contact.normal;
    std::swap(contact.feature_a, contact.feature_b);
}

// Two solids.

/// Sets a common point of the surfaces after the move, and its features.
void name_point(const View<3>& a, const View<3>& b, const DVec<3>& move, Closest<3>& closest) {
    const SolidContactArea area =
        contact_area(PlacedSolid(a), PlacedSolid(b), move, DVec<3>(closest.normal), solid_tolerance(a, b));
    if (area.manifold.count == 0) {
        // A move that is longer than the least one along its direction leaves a gap.
        Affine<3> place;
        place.offset = move;
        const Closest<3> parted = abut::closest(surface_view(a), moved(surface_view(b), place));
        closest.on_a = parted.on_a;
        closest.on_b = to_float(DVec<3>(parted.on_b) - move);
        closest.feature_a = parted.feature_a;
        closest.feature_b = parted.feature_b;
        return;
    }
    closest.on_a = to_float(area.manifold.points[0].position);
    closest.on_b = to_float(area.manifold.points[0].position - move);
    closest.feature_a = area.feature_a;
    closest.feature_b = area.feature_b;
}

bool find_exact_depth(const View<3>& a, const View<3>& b, bool names_points, Closest<3>& closest) {
    if (!interiors_overlap(PlacedSolid(a), PlacedSolid(b))) return false;
    const SeparatingMove move = separating_move(a, b);
    closest.distance = -move.depth;
    closest.normal = move.normal;
    if (names_points) name_point(a, b, DVec<3>(move.normal) * static_cast<double>(move.depth), closest);
    return true;
}

DVec<3> move_of(const Closest<3>& nearest) {
    return DVec<3>(nearest.normal) * -static_cast<double>(nearest.distance);
}

/// The contact on a plane on which the solids touch after a move; `depth` is how far the move leads along the normal.
Contact<3> contact_of(const Vec3& normal, float depth, const SolidContactArea& area) {
    Contact<3> result;
    result.normal = normal;
    result.depth = depth;
    result.feature_a = area.feature_a;
    result.feature_b = area.feature_b;
    const DVec<3> half = DVec<3>(normal) * static_cast<double>(depth) * 0.5;
    for (std::size_t i = 0; i < area.manifold.count; ++i) {
        const ManifoldPoint<3>& point = area.manifold.points[i];
        result.points.push_back({to_float(point.position - half), depth, point.feature});
    }
    return result;
}

/// The contact at the middle between the closest points, for shapes whose contact area isn't known.
Contact<3> midpoint_contact(const Closest<3>& nearest) {
    Contact<3> result;
    result.normal = nearest.normal;
    result.depth = 0 - nearest.distance;
    result.feature_a = nearest.feature_a;
    result.feature_b = nearest.feature_b;
    result.points.push_back({to_float((DVec<3>(nearest.on_a) + DVec<3>(nearest.on_b)) * 0.5), result.depth, 0});
    return result;
}

Contact<3> exact_contact(const View<3>& a, const View<3>& b, const Closest<3>& nearest) {
    const DVec<3> normal(nearest.normal);
    const PlacedSolid solid_a(a), solid_b(b);
    const SolidContactArea area = contact_area(solid_a, solid_b, move_of(nearest), normal, solid_tolerance(a, b));
    return area.manifold.count == 0 ? midpoint_contact(nearest)
                                    : contact_of(nearest.normal, 0 - nearest.distance, area);
}

void each_exact_contact(const View<3>& a, const View<3>& b, float margin, const Closest<3>& nearest,
                        FunctionRef<bool(const Contact<3>&)> visit) {
    const DVec<3> move = move_of(nearest), main_normal(nearest.normal);
    bool any = false;
    each_contact_area(PlacedSolid(a), PlacedSolid(b), move, main_normal, solid_tolerance(a, b),
                      [&](const DVec<3>& normal, const SolidContactArea& area) {
                          const auto depth = static_cast<float>(dot(normal, move));
                          if (area.manifold.count == 0 || depth < -margin) return true;
                          any = true;
                          return visit(normal == main_normal ? contact_of(nearest.normal, 0 - nearest.distance, area)
                                                             : contact_of(to_float(normal), depth, area));
                      });
    if (!any) visit(exact_contact(a, b, nearest));
}

// A solid and a convex set.

/// Visits the contacts of a solid and a convex set that is in it, on the planes on which they touch after a move.
void each_convex_contact(const View<3>& solid, const Convex<3>& set, float margin, const Closest<3>& nearest,
                         FunctionRef<bool(const Contact<3>&)> visit) {
    const DVec<3> move = move_of(nearest);
    Convex<3> parted = set;
    parted.place.offset += move;
    bool any = false;
    const auto reach = static_cast<float>(solid_tolerance(solid, set));
    each_surface_contact<3>(surface_view(solid), parted, {.margin = reach}, {}, [&](const SurfaceContact<3>& found) {
        const DVec<3> normal(found.contact.normal);
        const double depth = dot(normal, move);
        if (depth < -static_cast<double>(margin) - static_cast<double>(reach)) return true;
        Contact<3> contact = found.contact;
        // No plane is deeper than the move, but an edge's normal that was replaced by one of the surface may say so.
        const auto deepened = [&](float own) {
            return std::min(own + static_cast<float>(depth), 0 - nearest.distance);
        };
        contact.depth = deepened(found.contact.depth);
        contact.points.clear();
        for (const ContactPoint<3>& point : found.contact.points)
            contact.points.push_back(
                {to_float(DVec<3>(point.position) - normal * (0.5 * depth)), deepened(point.depth), point.feature});
        any = true;
        return visit(contact);
    });
    if (!any) visit(midpoint_contact(nearest));
}

/// The contact at the points of the one of these whose normal is that of the move that parts the two.
Contact<3> convex_contact(const View<3>& solid, const Convex<3>& set, const Closest<3>& nearest) {
    Contact<3> result = midpoint_contact(nearest);
    each_convex_contact(solid, set, 0, nearest, [&](const Contact<3>& contact) {
        if (glm::dot(contact.normal, nearest.normal) < 0.9999f) return true;
        result.points = contact.points;
        return false;
    });
    return result;
}

// A solid and any shape.

/// Calls visit(part, index) for the parts of a shape near the solid; false stops.
template <class Visit>
void each_part_near_solid(const View<3>& shape, const View<3>& solid, const Visit& visit) {
    for_each_part(shape, bounds(solid),
                  [&](const Part<3>& part, std::uint32_t index) { return visit(part.convex(), index); });
}

bool find_depth_of_part(const View<3>& solid, const Convex<3>& part, bool names_points, Closest<3>& closest) {
    if (is_solid_polytope(part)) return find_exact_depth(solid, part, names_points, closest);
    return find_convex_depth(solid, part, closest);
}

/// The deepest part of a shape in a solid.
struct DeepestPart {
    bool found = false;
    std::uint32_t index = 0;
    Closest<3> closest;
};

DeepestPart deepest_part(const View<3>& solid, const View<3>& shape, bool names_points) {
    DeepestPart result;
    each_part_near_solid(shape, solid, [&](const Convex<3>& part, std::uint32_t index) {
        Closest<3> nearest;
        if (!find_depth_of_part(solid, part, names_points, nearest)) return true;
        // Among equally deep parts the lowest wins, whatever the order of the visits.
        if (result.found && (nearest.distance > result.closest.distance ||
                             (nearest.distance == result.closest.distance && index > result.index)))
            return true;
        nearest.feature_b.part = index;
        result = {true, index, nearest};
        return true;
    });
    return result;
}

/// Calls visit(part) for the part with an index.
template <class Visit>
void with_part_near_solid(const View<3>& shape, const View<3>& solid, std::uint32_t wanted, const Visit& visit) {
    each_part_near_solid(shape, solid, [&](const Convex<3>& part, std::uint32_t index) {
        if (index == wanted) visit(part);
        return index != wanted;
    });
}

}  // namespace

bool has_solid(const View<3>& a, const View<3>& b) {
    const auto joins = [](const View<3>& shape) {
        return std::holds_alternative<Convex<3>>(shape) || std::holds_alternative<Composite<3>>(shape);
    };
    return (is_solid_mesh(a) || is_solid_mesh(b)) && joins(a) && joins(b);
}

bool are_solids(const View<3>& a, const View<3>& b) {
    const auto joins = [](const View<3>& shape) { return is_solid_mesh(shape) || is_solid_polytope(shape); };
    return (is_solid_mesh(a) || is_solid_mesh(b)) && joins(a) && joins(b);
}

// A coordinate seen from A is at most twice the largest one.
double solid_tolerance(const View<3>& a, const View<3>& b) {
    double farthest = 0;
    for (const View<3>* shape : {&a, &b}) {
        const Aabb3 box = bounds(*shape);
        farthest = std::max({farthest, largest(DVec<3>(box.min)), largest(DVec<3>(box.max))});
    }
    return tolerance_for(std::min(size(a), size(b)), 2 * farthest);
}

bool is_inside_other(const View<3>& a, const View<3>& b) {
    if (are_solids(a, b)) {
        const PlacedSolid solid_a(a), solid_b(b);
        return has_component_inside(solid_a, solid_b) || has_component_inside(solid_b, solid_a);
    }
    const View<3>&solid = is_solid_mesh(a) ? a : b, &shape = is_solid_mesh(a) ? b : a;
    bool found = false;
    each_part_near_solid(shape, solid, [&](const Convex<3>& part, std::uint32_t) {
        if (is_solid_polytope(part) && !std::holds_alternative<Convex<3>>(shape))
            found = is_inside_other(solid, part);
        else
            found = is_inside_solid(solid, part);
        return !found;
    });
    return found;
}

bool find_depth(const View<3>& a, const View<3>& b, bool names_points, Closest<3>& closest) {
    if (are_solids(a, b)) return find_exact_depth(a, b, names_points, closest);
    const bool flipped = !is_solid_mesh(a);
    const DeepestPart deepest = flipped ? deepest_part(b, a, names_points) : deepest_part(a, b, names_points);
    if (!deepest.found) return false;
    closest = deepest.closest;
    if (flipped) flip(closest);
    return true;
}

void name_touching(const View<3>& a, const View<3>& b, bool names_points, Closest<3>& closest) {
    if (!are_solids(a, b) || static_cast<double>(closest.distance) > touching * std::min(size(a), size(b))) return;
    closest.distance = 0;
    closest.normal = to_float(touching_normal(PlacedSolid(a), PlacedSolid(b), solid_tolerance(a, b)));
    closest.on_b = closest.on_a;
    if (names_points) name_point(a, b, DVec<3>(0.0), closest);
}

bool find_solid_contact(const View<3>& a, const View<3>& b, float margin, Contact<3>& result) {
    if (are_solids(a, b)) {
        const Closest<3> nearest = closest_to_solid(a, b, {}, false);
        if (nearest.distance <= margin) result = exact_contact(a, b, nearest);
        return true;
    }
    const bool flipped = !is_solid_mesh(a);
    const View<3>&solid = flipped ? b : a, &shape = flipped ? a : b;
    const DeepestPart deepest = deepest_part(solid, shape, false);
    if (!deepest.found) return false;
    with_part_near_solid(shape, solid, deepest.index, [&](const Convex<3>& part) {
        result = is_solid_polytope(part) ? exact_contact(solid, part, deepest.closest)
                                         : convex_contact(solid, part, deepest.closest);
    });
    result.feature_b.part = deepest.index;
    if (flipped) flip(result);
    return true;
}

bool each_solid_contact(const View<3>& a, const View<3>& b, float margin, FunctionRef<bool(const Contact<3>&)> visit,
                        bool& touch) {
    if (are_solids(a, b)) {
        const Closest<3> nearest = closest_to_solid(a, b, {}, false);
        touch = nearest.distance <= margin;
        if (touch) each_exact_contact(a, b, margin, nearest, visit);
        return true;
    }
    const bool flipped = !is_solid_mesh(a);
    const View<3>&solid = flipped ? b : a, &shape = flipped ? a : b;
    const auto* set = std::get_if<Convex<3>>(&shape);
    Closest<3> nearest;
    // The contacts of a composite shape are those of its parts with the triangles.
    if (set == nullptr || !find_convex_depth(solid, *set, nearest)) return false;
    touch = true;
    each_convex_contact(solid, *set, margin, nearest, [&](const Contact<3>& found) {
        Contact<3> contact = found;
        if (flipped) flip(contact);
        return visit(contact);
    });
    return true;
}

}  // namespace abut::detail
