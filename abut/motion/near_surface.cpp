#include <abut/motion/near_surface.hpp>
#include <abut/query/front_touch.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

/// What is in a one-sided part, and behind its front by more than this part of its size, is on its way through. What is
/// behind it by less has come to stand on it, such as on a platform that rises.
constexpr double way_through = 0.05;

/// Sides whose normals differ by less are one.
constexpr double same_side = 0.99;

/// A side is one of those that keep a shape off if its normal has at least this part in the normal there.
constexpr double least_part = 0.05;

template <int D>
Aabb<D> moved_box(const Aabb<D>& box, const DVec<D>& move) {
    const Vec<D> by = to_float(move);
    return {box.min + by, box.max + by};
}

}  // namespace

template <int D>
void NearSurface<D>::begin(const World<D>& world, const Filter& filter, const Convex<D>& shape, const DVec<D>& start,
                           const Passes<D>* passes) {
    world_ = &world;
    filter_ = filter;
    shape_ = shape;
    start_ = start;
    passes_ = passes;
    size_ = abut::size(shape);
    scale_ = felt_scale * size_;
    parts_.forget();
    passed_.clear();
    passed_fronts_.clear();
    contacts_known_ = false;
}

template <int D>
Convex<D> NearSurface<D>::shape_at(const DVec<D>& at) const {
    Convex<D> result = shape_;
    result.place.offset += at;
    return result;
}

template <int D>
void NearSurface<D>::expect(const DVec<D>& move, const DVec<D>& lift, const DVec<D>& drop, double around) {
    const Aabb<D> box = bounds(shape_at(start_));
    const Aabb<D> way = merged(box, moved_box(box, move));
    const Aabb<D> all = merged(way, merged(moved_box(way, lift), moved_box(way, drop)));
    need(grown(all, static_cast<float>(around)));
}

/// What is gathered anew holds the old as well, so that going to and fro doesn't gather again and again.
template <int D>
void NearSurface<D>::need(const Aabb<D>& box) {
    if (contains(parts_.box(), box)) return;
    parts_.gather(*world_, merged(parts_.box(), box), filter_);
}

template <int D>
bool NearSurface<D>::is_passed(const PartName& name) const {
    return std::find(passed_.begin(), passed_.end(), name) != passed_.end();
}

template <int D>
void NearSurface<D>::each_foot(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const {
    each_foot_of_others({}, point, within, visit);
}

template <int D>
void NearSurface<D>::each_foot_of_others(const PartName& but, const DVec<D>& point, double within,
                                         ClosestPointVisitor<D> visit) const {
    const Vec<D> middle = to_float(point);
    parts_.each(grown(Aabb<D>{middle, middle}, static_cast<float>(within)),
                [&](const PartName& name, const auto& part) {
                    if (name == but) return;
                    if (!passed_.empty() && is_passed(name)) return;
                    if (!passed_fronts_.empty() && is_passed_front(name)) return;
                    Foot<D> foot;
                    if (within > no_others && find_foot(part, point, within, foot)) within = visit(foot);
                });
}

template <int D>
void NearSurface<D>::find_passed_fronts(const Convex<D>& shape, const Aabb<D>& box) {
    passed_fronts_.clear();
    if (!parts_.has_one_sided()) return;
    parts_.each(box, [&](const PartName& name, const auto& part) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(part)>, Convex<D>>) {
            if (!part.one_sided) return;
            const SignedDistance<D> distance = part_distance(shape, part, {});
            if (!(distance.distance < 0)) return;
            const DVec<D> out = normalized(front(part));
            const double depth = dot(out, distance.on_b() - support(shape, -out));
            if (depth > way_through * size_) passed_fronts_.push_back(name);
        }
    });
}

template <int D>
bool NearSurface<D>::is_passed_front(const PartName& name) const {
    return std::find(passed_fronts_.begin(), passed_fronts_.end(), name) != passed_fronts_.end();
}

/// Also of another part, where the two meet in a seam.
template <int D>
bool NearSurface<D>::is_on_passed_front(const DVec<D>& point) const {
    if (passed_fronts_.empty()) return false;
    bool result = false;
    const Vec<D> middle = to_float(point);
    parts_.each(grown(Aabb<D>{middle, middle}, static_cast<float>(scale_)),
                [&](const PartName& name, const auto& part) {
                    result = result || (is_passed_front(name) && foot_on(part, point).distance <= scale_);
                });
    return result;
}

/// Remembers what is passed, so that it covers nothing.
template <int D>
template <class Part>
bool NearSurface<D>::passes(const Part& part, NearContact<D>& contact) {
    if (passes_ == nullptr) return false;
    contact.overlapped = part_distance(shape_at(start_), part, {}).distance < 0;
    if (!(*passes_)(contact)) return false;
    passed_.push_back(contact.name);
    return true;
}

template <int D>
std::span<const NearContact<D>> NearSurface<D>::contacts(const DVec<D>& at, double reach) {
    if (contacts_known_ && contacts_at_ == at && contacts_reach_ == reach) return contacts_;
    contacts_known_ = true;
    contacts_at_ = at;
    contacts_reach_ = reach;
    contacts_.clear();
    ghosts_.clear();
    passed_.clear();
    const Convex<D> shape = shape_at(at);
    const Aabb<D> box = grown(bounds(shape), static_cast<float>(reach));
    need(box);
    find_passed_fronts(shape, box);
    const auto contact_with = [&](const PartName& name, const auto& part) -> std::optional<NearContact<D>> {
        const SignedDistance<D> distance = part_distance(shape, part, {});
        if (!(distance.distance <= reach) || !meet_at_fronts(shape, part, distance.normal)) return std::nullopt;
        if (is_one_sided(shape, part) && is_on_passed_front(distance.on_b())) return std::nullopt;
        NearContact<D> contact{name, -distance.normal, distance.on_b(), distance.distance, {}, false};
        contact.has_sides = is_function<std::remove_cvref_t<decltype(part)>>;
        name_feature(part, distance.corners.b, distance.corners.count, -distance.normal, name.part, contact.feature);
        return contact;
    };
    if (passes_ != nullptr)
        parts_.each(box, [&](const PartName& name, const auto& part) {
            if (std::optional<NearContact<D>> contact = contact_with(name, part)) passes(part, *contact);
        });
    const DVec<D> middle = middle_of(shape, at);
    SeenFromMiddle<D> seen;
    const auto feet = [this](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
        each_foot(point, within, visit);
    };
    parts_.each(box, [&](const PartName& name, const auto& part) {
        if (!passed_.empty() && is_passed(name)) return;
        const std::optional<NearContact<D>> contact = contact_with(name, part);
        if (!contact) return;
        const FeltPlace<D> place{contact->point, contact->normal, middle, scale_};
        if (is_felt<D>(part, place, feet))
            contacts_.push_back(*contact);
        else if (contact->gap < scale_)
            ghosts_.push_back({*contact, felt_plane<D>(part, place, feet, seen)});
        if constexpr (is_function<std::remove_cvref_t<decltype(part)>>) add_sides(*contact, shape, part, reach);
    });
    tell_ghosts(shape, reach);
    return contacts_;
}

/// The other sides of a part that is known by its distance alone.
template <int D>
void NearSurface<D>::add_sides(const NearContact<D>& nearest, const Convex<D>& shape, const DistanceFunction<D>& part,
                               double reach) {
    // The part takes a corner for rounder than it is: the shape is kept off by something that isn't there.
    const double border = gap_to_border(shape, part, -nearest.normal);
    const bool kept_off = std::isfinite(border) && border > 1.5 * std::max(nearest.gap, 0.0) + scale_;
    std::array<FunctionSide<D>, most_sides<D>> sides;
    const std::size_t count =
        find_sides<D>(shape, part, kept_off ? std::numeric_limits<double>::infinity() : reach, sides);
    // Beside x = 0 and y = 0 its distance is about x y / cell, whose normal is along (y, x): each side is so far away
    // that its gap times its part of the normal is the same.
    const auto share = [&](const FunctionSide<D>& side) { return side.gap * dot(side.normal, nearest.normal); };
    const auto is_in_normal = [&](const FunctionSide<D>& side) {
        return dot(side.normal, nearest.normal) > least_part;
    };
    double least_share = std::numeric_limits<double>::infinity();
    for (const FunctionSide<D>& side : std::span(sides).first(count))
        if (is_in_normal(side)) least_share = std::min(least_share, share(side));
    for (const FunctionSide<D>& side : std::span(sides).first(count)) {
        if (dot(side.normal, nearest.normal) >= same_side) continue;
        const bool keeps_off = kept_off && is_in_normal(side) && share(side) <= 2 * least_share;
        if ((side.gap > reach && !keeps_off) || is_covered(nearest.name, side)) continue;
        NearContact<D> contact{nearest.name, side.normal, side.point, side.gap, nearest.feature, false};
        contact.has_sides = true;
        contacts_.push_back(contact);
    }
}

/// Whether another part is in front of it.
template <int D>
bool NearSurface<D>::is_covered(const PartName& name, const FunctionSide<D>& side) const {
    const DVec<D> beside = side.point + side.normal * scale_;
    bool result = false;
    each_foot_of_others(name, beside, scale_, [&](const Foot<D>& foot) {
        result = result || foot.distance < 0.9 * scale_;
        return result ? no_others : scale_;
    });
    return result;
}

/// Where what covers a place that isn't felt is out of reach of the shape itself, or not felt either, the surface there
/// is told of all the same.
template <int D>
void NearSurface<D>::tell_ghosts(const Convex<D>& shape, double reach) {
    for (const Ghost& ghost : ghosts_) {
        NearContact<D> contact = ghost.contact;
        if (ghost.plane) {
            contact.normal = ghost.plane->normal;
            contact.point = ghost.plane->point;
            contact.gap = dot(contact.normal, support(shape, -contact.normal) - contact.point);
        }
        const bool told = std::any_of(contacts_.begin(), contacts_.end(), [&](const NearContact<D>& other) {
            return tells_of<D>(other.normal, -other.gap, contact.normal, -contact.gap, size_);
        });
        if (contact.gap <= reach && !told) contacts_.push_back(contact);
    }
}

template <int D>
std::optional<FirstTouch<D>> NearSurface<D>::first_touch(const DVec<D>& at, const DVec<D>& move, double grown_by) {
    std::optional<FirstTouch<D>> result;
    const double way = length(move);
    if (!(way > 0)) return result;
    Convex<D> shape = shape_at(at);
    shape.radius += grown_by;
    const Aabb<D> first_box = bounds(shape);
    // A touch may be told where the two are apart by the margin of doubt.
    const Aabb<D> box = grown(merged(first_box, moved_box(first_box, move)), static_cast<float>(1e-4 * size_));
    need(box);
    find_passed_fronts(shape_at(at), grown(bounds(shape_at(at)), static_cast<float>(1e-4 * size_)));
    Path<D> path{move / way, way};
    if (passes_ != nullptr) {
        passed_.clear();
        contacts_known_ = false;
    }
    parts_.each(box, [&](const PartName& name, const auto& part) {
        PartTouch<D> touch;
        if (!front_touch(shape, path, part, name.part, SweepOptions<D>{}, touch)) return;
        if (result && touch.along >= path.length) return;
        if (is_one_sided(shape, part) && (is_passed_front(name) || is_on_passed_front(touch.point))) return;
        NearContact<D> contact{name, -touch.normal, touch.point, 0, touch.feature, false};
        contact.has_sides = is_function<std::remove_cvref_t<decltype(part)>>;
        if (passes(part, contact)) return;
        path.length = touch.along;
        result = FirstTouch<D>{std::min(touch.along / way, 1.0), contact};
    });
    return result;
}

template <int D>
std::optional<DVec<D>> NearSurface<D>::normal_above(const DVec<D>& point, const DVec<D>& up) {
    constexpr double clear = 0.1;
    const DVec<D> above = point + up * scale_;
    const auto feet = [this](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
        each_foot(from, within, visit);
    };
    const Foot<D> foot = nearest_foot<D>(feet, above, 2 * scale_, scale_, clear * scale_);
    if (!(foot.distance > clear * scale_) || !std::isfinite(foot.distance)) return std::nullopt;
    return normalized(above - foot.point);
}

template class NearSurface<2>;
template class NearSurface<3>;

}  // namespace abut
