// Questions to a world. What has moved since the last update is looked at one by one, the rest through the broad
// phases.

#include <abut/broad_phase/boxes.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {
namespace {

/// Told once here, and not by every item that is looked at.
template <int D>
bool can_be_asked(const View<D>& shape) {
    const bool finite = is_finite(shape);
    ABUT_ASSERT(finite);
    return finite;
}
template <int D>
bool can_be_asked(const Ray<D>& ray) {
    const bool finite = is_finite(ray.origin) && is_finite(ray.direction) && !std::isnan(ray.length);
    ABUT_ASSERT(finite);
    return finite;
}

}  // namespace

/// A free slot has no box, and neither has an item that is not finite or has no parts.
template <int D>
bool World<D>::asked(std::uint32_t slot, const Filter& filter) const {
    const Item& item = items_[slot];
    if (is_empty(item.box) || (item.options.sensor && !filter.sensors)) return false;
    if ((filter.layers & item.options.mask) == 0 || (item.options.layers & filter.mask) == 0) return false;
    return id_of(slot) != filter.ignore;
}

/// visit(slot) for the items whose boxes overlap; it returns false to stop.
template <int D>
template <class F>
void World<D>::each_near(const Aabb<D>& box, const Filter& filter, F&& visit) const {
    asked_.add(region_weight);
    bool go_on = true;
    const auto among = [&](const ItemBoxes<D>& items) {
        items.phase().each_overlapping(box, [&](std::uint32_t place) -> bool {
            const std::uint32_t slot = items.slot(place);
            if (!items_[slot].pending && asked(slot, filter)) go_on = visit(slot);
            return go_on;
        });
    };
    among(moving_);
    if (go_on) among(fixed_);
    for (std::size_t i = 0; go_on && i < pending_.size(); ++i)
        if (asked(pending_[i], filter) && overlaps(items_[pending_[i]].box, box)) go_on = visit(pending_[i]);
}

/// visit(slot) for the items whose boxes the ray touches; it returns the new reach.
template <int D>
template <class F>
void World<D>::each_near_ray(const Ray<D>& ray, const Filter& filter, F&& visit) const {
    if (!can_be_asked(ray)) return;
    asked_.add(ray_weight);
    Ray<D> rest = ray;
    const auto any = [&](std::uint32_t slot) -> float {
        if (asked(slot, filter)) rest.length = std::min(rest.length, static_cast<float>(visit(slot)));
        return rest.length;
    };
    for (const std::uint32_t slot : pending_) any(slot);
    for (const ItemBoxes<D>* items : {&moving_, &fixed_})
        items->phase().raycast(rest, [&](std::uint32_t place) -> float {
            const std::uint32_t slot = items->slot(place);
            return items_[slot].pending ? rest.length : any(slot);
        });
}

template <int D>
std::optional<WorldHit<D>> World<D>::raycast(const Ray<D>& ray, const Filter& filter) const {
    std::optional<WorldHit<D>> first;
    each_near_ray(ray, filter, [&](std::uint32_t slot) {
        const std::optional<Hit<D>> hit = abut::raycast(ray, items_[slot].placed);
        const Id id = id_of(slot);
        if (hit &&
            (!first || hit->distance < first->hit.distance || (hit->distance == first->hit.distance && id < first->id)))
            first = WorldHit<D>{id, *hit};
        return first ? first->hit.distance : ray.length;
    });
    return first;
}

template <int D>
bool World<D>::raycast_any(const Ray<D>& ray, const Filter& filter) const {
    bool any = false;
    each_near_ray(ray, filter, [&](std::uint32_t slot) {
        any = any || abut::raycast(ray, items_[slot].placed);
        return any ? -1.0f : ray.length;
    });
    return any;
}

template <int D>
std::vector<WorldHit<D>> World<D>::raycast_all(const Ray<D>& ray, const Filter& filter) const {
    std::vector<WorldHit<D>> all;
    each_near_ray(ray, filter, [&](std::uint32_t slot) {
        if (const std::optional<Hit<D>> hit = abut::raycast(ray, items_[slot].placed))
            all.push_back({id_of(slot), *hit});
        return ray.length;
    });
    std::sort(all.begin(), all.end(), [](const WorldHit<D>& a, const WorldHit<D>& b) {
        return a.hit.distance != b.hit.distance ? a.hit.distance < b.hit.distance : a.id < b.id;
    });
    return all;
}

template <int D>
std::optional<WorldClosest<D>> World<D>::closest_to(const View<D>& shape, const Filter& filter) const {
    std::optional<WorldClosest<D>> nearest;
    if (!can_be_asked(shape)) return nearest;
    asked_.add(ray_weight);
    float reach = std::numeric_limits<float>::infinity();
    const auto any = [&](std::uint32_t slot) -> float {
        const View<D>& placed = items_[slot].placed;
        if (!asked(slot, filter) ||
            (std::holds_alternative<Solid<D>>(shape) && std::holds_alternative<Solid<D>>(placed)))
            return reach;
        const Closest<D> found = abut::closest(shape, placed);
        if (std::isinf(found.distance)) return reach;
        const Id id = id_of(slot);
        const bool nearer = !nearest || found.distance < nearest->closest.distance;
        if (nearer || (found.distance == nearest->closest.distance && id < nearest->id)) {
            nearest = WorldClosest<D>{id, found};
            reach = std::max(found.distance, 0.0f);
        }
        return reach;
    };
    for (const std::uint32_t slot : pending_) any(slot);
    const Aabb<D> box = bounds(shape);
    for (const ItemBoxes<D>* items : {&moving_, &fixed_})
        items->phase().closest(
            box,
            [&](std::uint32_t place) -> float {
                const std::uint32_t slot = items->slot(place);
                return items_[slot].pending ? reach : any(slot);
            },
            reach);
    return nearest;
}

template <int D>
void World<D>::visit_overlapping(const View<D>& shape, const Filter& filter, FunctionRef<bool(Id)> visit) const {
    if (!can_be_asked(shape)) return;
    each_near(bounds(shape), filter, [&](std::uint32_t slot) {
        const View<D>& placed = items_[slot].placed;
        if (std::holds_alternative<Solid<D>>(shape) && std::holds_alternative<Solid<D>>(placed)) return true;
        return !overlaps(shape, placed) || visit(id_of(slot));
    });
}

template <int D>
void World<D>::visit_in_box(const Aabb<D>& box, const Filter& filter,
                            FunctionRef<bool(Id, const View<D>&)> visit) const {
    each_near(box, filter, [&](std::uint32_t slot) { return visit(id_of(slot), items_[slot].placed); });
}

template <int D>
std::vector<Id> World<D>::all_overlapping(const View<D>& shape, const Filter& filter) const {
    std::vector<Id> result;
    visit_overlapping(shape, filter, [&](Id id) {
        result.push_back(id);
        return true;
    });
    std::sort(result.begin(), result.end());
    return result;
}

template <int D>
std::vector<Id> World<D>::containing(const Vec<D>& point, const Filter& filter) const {
    std::vector<Id> result;
    if (!can_be_asked(View<D>(round_points<D>({point}, 0)))) return result;
    each_near(Aabb<D>{point, point}, filter, [&](std::uint32_t slot) {
        if (abut::contains(items_[slot].placed, point)) result.push_back(id_of(slot));
        return true;
    });
    std::sort(result.begin(), result.end());
    return result;
}

template class World<2>;
template class World<3>;

}  // namespace abut
