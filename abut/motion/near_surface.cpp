#include <abut/motion/near_surface.hpp>
#include <abut/query/front_touch.hpp>

#include <algorithm>

namespace abut {
namespace {

/// What is in a one-sided part, and behind its front by more than this part of its size, is on its way through. What is
/// behind it by less has come to stand on it, such as on a platform that rises.
constexpr double way_through = 0.05;

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
void NearSurface<D>::each_foot(const DVec<D>& point, double within, FunctionRef<void(const Foot<D>&)> visit) const {
    const Vec<D> middle = to_float(point);
    parts_.each(grown(Aabb<D>{middle, middle}, static_cast<float>(within)),
                [&](const PartName& name, const auto& part) {
                    if (!passed_.empty() && is_passed(name)) return;
                    if (!passed_fronts_.empty() && is_passed_front(name)) return;
                    Foot<D> foot;
                    if (find_foot(part, point, within, foot)) visit(foot);
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
        name_feature(part, distance.corners.b, distance.corners.count, -distance.normal, name.part, contact.feature);
        return contact;
    };
    if (passes_ != nullptr)
        parts_.each(box, [&](const PartName& name, const auto& part) {
            if (std::optional<NearContact<D>> contact = contact_with(name, part)) passes(part, *contact);
        });
    const DVec<D> middle = middle_of(shape, at);
    SeenFromMiddle<D> seen;
    const auto feet = [this](const DVec<D>& point, double within, FunctionRef<void(const Foot<D>&)> visit) {
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
    });
    tell_ghosts(shape, reach);
    return contacts_;
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
    const auto feet = [this](const DVec<D>& from, double within, FunctionRef<void(const Foot<D>&)> visit) {
        each_foot(from, within, visit);
    };
    const Foot<D> foot = nearest_foot<D>(feet, above, 2 * scale_, scale_);
    if (!(foot.distance > clear * scale_) || !std::isfinite(foot.distance)) return std::nullopt;
    return normalized(above - foot.point);
}

template class NearSurface<2>;
template class NearSurface<3>;

}  // namespace abut
