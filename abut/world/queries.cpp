// Ray, overlap and region queries of a world.

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

template <int D>
bool World<D>::passes(std::uint32_t slot, const Filter& filter) const {
    const Item& item = items_[slot];
    if (is_empty(box(slot)) || (item.sensor && !filter.sensors)) return false;
    if ((filter.layers & item.mask) == 0 || (item.layers & filter.mask) == 0) return false;
    const Id id = id_of(slot);
    const std::span<const Id> ignored = filter.ignore_ids;
    return id != filter.ignore && std::find(ignored.begin(), ignored.end(), id) == ignored.end() &&
           (!filter.accepts || (*filter.accepts)(id));
}

/// Calls visit(slot) for the items whose AABBs overlap a box; it returns false to stop. After an update with continuous
/// items, the broad phases find an item at any place of its motion.
template <int D>
template <class F>
void World<D>::each_near(const Aabb<D>& box, const Query& query, F&& visit) const {
    query_count_.add(detail::region_weight);
    const Aabb<D> there = positions_.are_used() ? positions_.about_origin(box, query.origin) : box;
    bool go_on = true;
    const auto visit_passing = [&](std::uint32_t slot) -> bool {
        if (passes(slot, query.filter) && (!widened_ || overlaps(this->box(slot), there))) go_on = visit(slot);
        return go_on;
    };
    moving_.each_overlapping(there, visit_passing);
    if (go_on) fixed_.each_overlapping(there, visit_passing);
}

/// Calls visit(slot) for the items whose AABBs the ray hits; it returns the new reach.
template <int D>
template <class F>
void World<D>::each_near_ray(const Ray<D>& ray, const Query& query, F&& visit) const {
    if (!detail::is_valid_query(ray)) return;
    query_count_.add(detail::ray_weight);
    Ray<D> rest = ray;
    const auto visit_passing = [&](std::uint32_t slot) -> float {
        if (passes(slot, query.filter)) rest.length = std::min(rest.length, static_cast<float>(visit(slot)));
        return rest.length;
    };
    for (const detail::ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (!positions_.are_used()) {
            items->raycast(rest, visit_passing);
            continue;
        }
        const MovingBox<D> point{DVec<D>(rest.origin), DVec<D>(0.0), DVec<D>(rest.direction),
                                 static_cast<double>(rest.length)};
        items->sweep(positions_.about_origin(point, query.origin), visit_passing);
    }
}

template <int D>
std::optional<WorldHit<D>> World<D>::first_hit(const Ray<D>& ray, const Query& query) const {
    std::optional<WorldHit<D>> first;
    each_near_ray(ray, query, [&](std::uint32_t slot) {
        const std::optional<Hit<D>> hit = abut::raycast(ray, placed(slot, query.origin));
        const Id id = id_of(slot);
        if (hit &&
            (!first || hit->distance < first->hit.distance || (hit->distance == first->hit.distance && id < first->id)))
            first = WorldHit<D>{id, *hit};
        return first ? first->hit.distance : ray.length;
    });
    return first;
}

template <int D>
bool World<D>::any_hit(const Ray<D>& ray, const Query& query) const {
    bool any = false;
    each_near_ray(ray, query, [&](std::uint32_t slot) {
        any = any || abut::raycast_any(ray, placed(slot, query.origin));
        return any ? -1.0f : ray.length;
    });
    return any;
}

template <int D>
std::vector<WorldHit<D>> World<D>::all_hits(const Ray<D>& ray, const Query& query) const {
    std::vector<WorldHit<D>> all;
    each_near_ray(ray, query, [&](std::uint32_t slot) {
        if (const std::optional<Hit<D>> hit = abut::raycast(ray, placed(slot, query.origin)))
            all.push_back({id_of(slot), *hit});
        return ray.length;
    });
    std::sort(all.begin(), all.end(), [](const WorldHit<D>& a, const WorldHit<D>& b) {
        return a.hit.distance != b.hit.distance ? a.hit.distance < b.hit.distance : a.id < b.id;
    });
    return all;
}

template <int D>
void World<D>::visit_overlapping(const View<D>& shape, const Query& query, FunctionRef<bool(Id)> visit) const {
    if (!detail::is_valid_query(shape)) return;
    each_near(bounds(shape), query, [&](std::uint32_t slot) {
        const Item& item = items_[slot];
        if (std::holds_alternative<HalfSpaceView<D>>(shape) && item.type == ShapeType::half_space) return true;
        return !overlaps(shape, placed(slot, query.origin)) || visit(id_of(slot));
    });
}

template <int D>
void World<D>::visit_in_box(const Aabb<D>& box, const Query& query, FunctionRef<bool(Id, const View<D>&)> visit) const {
    each_near(box, query, [&](std::uint32_t slot) { return visit(id_of(slot), placed(slot, query.origin)); });
}

template <int D>
std::vector<Id> World<D>::all_overlapping(const View<D>& shape, const Query& query) const {
    std::vector<Id> result;
    visit_overlapping(shape, query, [&](Id id) {
        result.push_back(id);
        return true;
    });
    std::sort(result.begin(), result.end());
    return result;
}

template <int D>
std::vector<Id> World<D>::all_containing(const Vec<D>& point, const Query& query) const {
    std::vector<Id> result;
    if (!detail::is_valid_query(point_view(point))) return result;
    each_near(Aabb<D>{point, point}, query, [&](std::uint32_t slot) {
        if (abut::contains(placed(slot, query.origin), point)) result.push_back(id_of(slot));
        return true;
    });
    std::sort(result.begin(), result.end());
    return result;
}

template class World<2>;
template class World<3>;

}  // namespace abut
