#include <abut/convex/support.hpp>
#include <abut/motion/mover/nearby_surface.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace abut::detail {
namespace {

/// Maximum number of planes.
template <int D>
inline constexpr std::size_t max_sdf_planes = D == 2 ? 8 : 26;

/// Extra range of rays, relative to the shape's size: the maximum curvature offset of a ball.
constexpr double max_curvature_offset = 0.2;

/// A ray that hits at about its own direction has found a plane.
constexpr double same_normal = 0.9999;

/// Planes whose normals are closer than this cosine count once.
constexpr double same_plane = 0.99;

/// Maximum number of rays per start direction.
constexpr int max_rays = 6;

/// Rays from the support point to the surface.
template <int D>
class SurfaceRays {
public:
    SurfaceRays(const Convex<D>& shape, const DistanceFunction<D>& function, double max_distance)
        : shape_(shape), function_(function), sdf_(function), max_distance_(max_distance) {}

    bool find(const DVec<D>& direction, PartHit<D>& hit) const {
        const DVec<D> from = support(shape_, direction);
        return sdf_.at(from) <= sdf_.slope() * max_distance_ &&
               part_hit(DRay<D>{from, direction, max_distance_}, function_, hit);
    }

    /// Iterates from a direction against the normal found, until the direction is the plane's normal. Nothing if it
    /// reaches a known plane.
    std::optional<SdfPlane<D>> plane_from(DVec<D> direction, std::span<const SdfPlane<D>> known) const {
        for (int i = 0; i < max_rays; ++i) {
            PartHit<D> hit;
            if (!find(direction, hit)) return std::nullopt;
            const DVec<D> normal = normalized(hit.normal);
            const auto has_normal = [&](const SdfPlane<D>& plane) { return dot(plane.normal, normal) >= same_plane; };
            if (std::any_of(known.begin(), known.end(), has_normal)) return std::nullopt;
            if (dot(normal, direction) <= -same_normal)
                return SdfPlane<D>{normal, support(shape_, direction) + direction * hit.along, hit.along};
            direction = -normal;
        }
        return std::nullopt;
    }

private:
    const Convex<D>& shape_;
    const DistanceFunction<D>& function_;
    PlacedFunction<D> sdf_;
    double max_distance_;
};

/// Writes the planes within `reach` of the shape, or a fifth of its size if that is more, to `planes`, and returns
/// their number. Planes with similar normals count once. All planes are found for flat surfaces whose corner angles
/// differ by 40 degrees or more; otherwise those that rays in 8 (26) directions hit.
template <int D>
std::size_t find_sdf_planes(const Convex<D>& shape, const DistanceFunction<D>& function, double reach,
                            std::span<SdfPlane<D>, max_sdf_planes<D>> planes) {
    const double around = size(shape);
    const SurfaceRays<D> rays(shape, function, std::min(1.2 * (reach + max_curvature_offset * around), around));
    std::size_t count = 0;
    // All combinations of -1, 0 and 1 along the axes, except 0.
    constexpr int all = D == 2 ? 9 : 27;
    for (int number = 0; number < all; ++number) {
        if (number == all / 2) continue;
        DVec<D> direction;
        for (int i = 0, rest = number; i < D; ++i, rest /= 3) direction[i] = rest % 3 - 1;
        if (const auto plane = rays.plane_from(normalized(direction), planes.first(count))) planes[count++] = *plane;
    }
    return count;
}

/// The distance from the support point along a unit direction to the surface; infinite beyond the shape's size.
template <int D>
double distance_to_surface(const Convex<D>& shape, const DistanceFunction<D>& function, const DVec<D>& direction) {
    PartHit<D> hit;
    const bool found = SurfaceRays<D>(shape, function, size(shape)).find(direction, hit);
    return found ? hit.along : std::numeric_limits<double>::infinity();
}

/// A shape deeper behind a one-sided front than this part of its size is passing through. A shallower one stands on it,
/// such as on a rising platform.
constexpr double pass_through_depth = 0.05;

/// Planes whose normals are closer than this cosine count once.
constexpr double min_equal_cosine = 0.99;

/// A plane supports the shape if its normal has at least this component in the contact normal.
constexpr double min_normal_share = 0.05;

template <int D>
Aabb<D> moved_box(const Aabb<D>& box, const DVec<D>& move) {
    const Vec<D> by = to_float(move);
    return {box.min + by, box.max + by};
}

}  // namespace

template <int D>
void NearbySurface<D>::begin(const World<D>& world, const Filter& filter, const Convex<D>& shape, const DVec<D>& start,
                             const Passes<D>* passes) {
    world_ = &world;
    filter_ = filter;
    shape_ = shape;
    start_ = start;
    passes_ = passes;
    size_ = detail::size(shape);
    scale_ = surface_probe_scale * size_;
    parts_.clear();
    passed_.clear();
    passed_fronts_.clear();
    contacts_valid_ = false;
}

template <int D>
Convex<D> NearbySurface<D>::shape_at(const DVec<D>& at) const {
    Convex<D> result = shape_;
    result.place.offset += at;
    return result;
}

template <int D>
void NearbySurface<D>::prefetch(const DVec<D>& move, const DVec<D>& lift, const DVec<D>& drop, double around) {
    const Aabb<D> box = bounds(shape_at(start_));
    const Aabb<D> swept = merged(box, moved_box(box, move));
    const Aabb<D> all = merged(swept, merged(moved_box(swept, lift), moved_box(swept, drop)));
    gather(grown(all, static_cast<float>(around)));
}

/// The new region includes the old one, so that moving back and forth doesn't gather repeatedly.
template <int D>
void NearbySurface<D>::gather(const Aabb<D>& box) {
    if (contains(parts_.box(), box)) return;
    parts_.gather(*world_, merged(parts_.box(), box), filter_);
}

template <int D>
bool NearbySurface<D>::is_passed(const PartName& name) const {
    return std::find(passed_.begin(), passed_.end(), name) != passed_.end();
}

template <int D>
void NearbySurface<D>::each_closest_point(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const {
    each_closest_point_of_others({}, point, within, visit);
}

template <int D>
void NearbySurface<D>::each_closest_point_of_others(const PartName& but, const DVec<D>& point, double within,
                                                    ClosestPointVisitor<D> visit) const {
    const Vec<D> middle = to_float(point);
    parts_.each(grown(Aabb<D>{middle, middle}, static_cast<float>(within)),
                [&](const PartName& name, const Part<D>& part) {
                    if (name == but) return;
                    if (!passed_.empty() && is_passed(name)) return;
                    if (!passed_fronts_.empty() && is_passed_front(name)) return;
                    ClosestPoint<D> closest;
                    if (within > stop_visiting && find_closest_point(part, point, within, closest))
                        within = visit(closest);
                });
}

template <int D>
void NearbySurface<D>::find_passed_fronts(const DVec<D>& at, double reach) {
    passed_fronts_.clear();
    if (!parts_.has_one_sided()) return;
    const Convex<D> shape = shape_at(at);
    parts_.each(grown(bounds(shape), static_cast<float>(reach)), [&](const PartName& name, const Part<D>& part) {
        if (!is_one_sided(part)) return;
        const SignedDistance<D> distance = part_distance<D>(shape, part);
        if (!(distance.distance < 0)) return;
        const DVec<D> out = normalized(front(part.convex()));
        const double depth = dot(out, distance.on_b() - support(shape, -out));
        if (depth > pass_through_depth * size_) passed_fronts_.push_back(name);
    });
}

template <int D>
bool NearbySurface<D>::is_passed_front(const PartName& name) const {
    return std::find(passed_fronts_.begin(), passed_fronts_.end(), name) != passed_fronts_.end();
}

/// Another part may share the point at a seam.
template <int D>
bool NearbySurface<D>::is_on_passed_front(const DVec<D>& point) const {
    if (passed_fronts_.empty()) return false;
    bool result = false;
    const Vec<D> middle = to_float(point);
    parts_.each(grown(Aabb<D>{middle, middle}, static_cast<float>(scale_)),
                [&](const PartName& name, const Part<D>& part) {
                    result = result || (is_passed_front(name) && closest_point_on(part, point).distance <= scale_);
                });
    return result;
}

/// Passed parts are stored and hide nothing.
template <int D>
bool NearbySurface<D>::passes(const Part<D>& part, NearContact<D>& contact) {
    if (passes_ == nullptr) return false;
    contact.overlapped = part_distance<D>(shape_at(start_), part).distance < 0;
    if (!(*passes_)(contact)) return false;
    passed_.push_back(contact.name);
    return true;
}

template <int D>
std::span<const NearContact<D>> NearbySurface<D>::contacts(const DVec<D>& at, double reach) {
    if (contacts_valid_ && contacts_at_ == at && contacts_reach_ == reach) return contacts_;
    contacts_valid_ = true;
    contacts_at_ = at;
    contacts_reach_ = reach;
    contacts_.clear();
    ghosts_.clear();
    passed_.clear();
    const Convex<D> shape = shape_at(at);
    const Aabb<D> own_box = bounds(shape), box = grown(own_box, static_cast<float>(reach));
    gather(box);
    find_passed_fronts(at, reach);
    const auto contact_with = [&](const PartName& name, const Part<D>& part) -> std::optional<NearContact<D>> {
        SignedDistance<D> distance;
        if (!part_distance_up_to<D>(shape, part, reach, distance) || !touch_at_fronts<D>(shape, part, distance.normal))
            return std::nullopt;
        if ((shape.one_sided || is_one_sided(part)) && is_on_passed_front(distance.on_b())) return std::nullopt;
        NearContact<D> contact{name, -distance.normal, distance.on_b(), distance.distance, {}, false};
        contact.is_sdf = part.is_function();
        name_feature(part, distance.corners.b, distance.corners.count, -distance.normal, name.part, contact.feature);
        return contact;
    };
    if (passes_ != nullptr)
        parts_.each(box, [&](const PartName& name, const Part<D>& part) {
            if (std::optional<NearContact<D>> contact = contact_with(name, part)) passes(part, *contact);
        });
    const DVec<D> middle(center(own_box));
    NearestToCenter<D> seen;
    const auto closest_points = [this](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
        each_closest_point(point, within, visit);
    };
    const EdgeFilter<D> filter(closest_points, size_);
    const auto ghost_of = [&](const Part<D>& part, const NearContact<D>& own) {
        Ghost ghost{own};
        const std::optional<SurfacePlane<D>> plane = filter.plane_near(part, {own.point, own.normal, middle}, seen);
        if (!plane) return ghost;
        const DVec<D> deepest = support(shape, -plane->normal);
        const double gap = dot(plane->normal, deepest - plane->point);
        ghost.is_on_ridge = gap < own.gap && filter.is_of_ridge(part, *plane, deepest - plane->normal * gap);
        if (ghost.is_on_ridge) return ghost;
        ghost.contact.normal = plane->normal;
        ghost.contact.point = plane->point;
        ghost.contact.gap = gap;
        return ghost;
    };
    parts_.each(box, [&](const PartName& name, const Part<D>& part) {
        if (!passed_.empty() && is_passed(name)) return;
        const std::optional<NearContact<D>> contact = contact_with(name, part);
        if (!contact) return;
        const SurfacePlace<D> place{contact->point, contact->normal, middle};
        if (filter.is_surface_normal(part, place))
            contacts_.push_back(*contact);
        else if (contact->gap < scale_)
            ghosts_.push_back(ghost_of(part, *contact));
        if (part.is_function()) add_sides(*contact, shape, part.function(), reach);
    });
    resolve_ghosts(reach);
    return contacts_;
}

/// Adds the other contact planes of a signed distance function.
template <int D>
void NearbySurface<D>::add_sides(const NearContact<D>& nearest, const Convex<D>& shape, const DistanceFunction<D>& part,
                                 double reach) {
    // A field rounds its corners: the shape is held off by a surface that isn't there.
    const double surface_distance = distance_to_surface(shape, part, -nearest.normal);
    const bool is_held_off =
        std::isfinite(surface_distance) && surface_distance > 1.5 * std::max(nearest.gap, 0.0) + scale_;
    std::array<SdfPlane<D>, max_sdf_planes<D>> sides;
    const std::size_t count =
        find_sdf_planes<D>(shape, part, is_held_off ? std::numeric_limits<double>::infinity() : reach, sides);
    // Beside x = 0 and y = 0 its distance is about x y / cell, whose normal is along (y, x): each side is so far away
    // that its gap times its part of the normal is the same.
    const auto share = [&](const SdfPlane<D>& side) { return side.gap * dot(side.normal, nearest.normal); };
    const auto is_in_normal = [&](const SdfPlane<D>& side) {
        return dot(side.normal, nearest.normal) > min_normal_share;
    };
    double min_share = std::numeric_limits<double>::infinity();
    for (const SdfPlane<D>& side : std::span(sides).first(count))
        if (is_in_normal(side)) min_share = std::min(min_share, share(side));
    for (const SdfPlane<D>& side : std::span(sides).first(count)) {
        if (dot(side.normal, nearest.normal) >= min_equal_cosine) continue;
        const bool holds_off = is_held_off && is_in_normal(side) && share(side) <= 2 * min_share;
        if ((side.gap > reach && !holds_off) || is_covered(nearest.name, side)) continue;
        NearContact<D> contact{nearest.name, side.normal, side.point, side.gap, nearest.feature, false};
        contact.is_sdf = true;
        contacts_.push_back(contact);
    }
}

/// True if another part is in front of the plane.
template <int D>
bool NearbySurface<D>::is_covered(const PartName& name, const SdfPlane<D>& side) const {
    const DVec<D> beside = side.point + side.normal * scale_;
    bool result = false;
    each_closest_point_of_others(name, beside, scale_, [&](const ClosestPoint<D>& closest) {
        result = result || closest.distance < 0.9 * scale_;
        return result ? stop_visiting : scale_;
    });
    return result;
}

/// A contact that the internal-edge filter dropped is restored if what covers it is out of reach or was dropped too.
template <int D>
void NearbySurface<D>::resolve_ghosts(double reach) {
    for (const Ghost& ghost : ghosts_) {
        const NearContact<D>& contact = ghost.contact;
        const bool reported = std::any_of(contacts_.begin(), contacts_.end(), [&](const NearContact<D>& other) {
            return ghost.is_on_ridge ||
                   covers_contact<D>(other.normal, -other.gap, contact.normal, -contact.gap, size_);
        });
        if (contact.gap <= reach && !reported) contacts_.push_back(contact);
    }
}

template <int D>
std::optional<FirstTouch<D>> NearbySurface<D>::first_touch(const DVec<D>& at, const DVec<D>& move, double grown_by) {
    std::optional<FirstTouch<D>> result;
    const double distance = length(move);
    if (!(distance > 0)) return result;
    Convex<D> shape = shape_at(at);
    shape.radius += grown_by;
    const Aabb<D> first_box = bounds(shape);
    // A time of impact may be early by the tolerance.
    const Aabb<D> box = grown(merged(first_box, moved_box(first_box, move)), static_cast<float>(1e-4 * size_));
    gather(box);
    find_passed_fronts(at, 1e-4 * size_);
    Path<D> path{move / distance, distance};
    if (passes_ != nullptr) {
        passed_.clear();
        contacts_valid_ = false;
    }
    parts_.each(box, [&](const PartName& name, const Part<D>& part) {
        LinearImpact<D> touch;
        if (!front_time_of_impact<D>(shape, path, part, name.part, {}, touch)) return;
        if (result && touch.along >= path.length) return;
        if ((shape.one_sided || is_one_sided(part)) && (is_passed_front(name) || is_on_passed_front(touch.point)))
            return;
        NearContact<D> contact{name, -touch.normal, touch.point, 0, touch.feature, false};
        contact.is_sdf = part.is_function();
        if (passes(part, contact)) return;
        path.length = touch.along;
        result = FirstTouch<D>{std::min(touch.along / distance, 1.0), contact};
    });
    return result;
}

template <int D>
std::optional<DVec<D>> NearbySurface<D>::normal_above(const DVec<D>& point, const DVec<D>& up) {
    const auto closest_points = [this](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
        each_closest_point(from, within, visit);
    };
    return EdgeFilter<D>(closest_points, size_).normal_towards(point + up * scale_);
}

template class NearbySurface<2>;
template class NearbySurface<3>;

}  // namespace abut::detail
