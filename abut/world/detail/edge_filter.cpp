// The contacts of pairs, without ghost collisions at the internal edges between items: an item gets the surface normals
// of the union of all that it touches (docs/ghosts.md).

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/contact.hpp>
#include <abut/world/detail/edge_filter_state.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// An item with more neighbours finds those near a point through the broad phases.
constexpr std::size_t max_listed_neighbours = 96;

/// The filter looks for neighbours around a point at most this far away, in units of s by the radii of the bounding
/// balls: 2.1 s, and s may be sqrt(3) times as large (see detail::size).
constexpr float probe_reach = 4;

}  // namespace

/// Whether contacts of the item are filtered for its sake. A fixed item is not pushed, so no normal matters to it.
template <int D>
bool World<D>::filters_edges(std::uint32_t slot) const {
    return filters_edges_ && !items_[slot].fixed;
}

/// Whether both items are part of the surface that a third one touches. Sensors are not.
template <int D>
bool World<D>::are_solid(std::uint32_t slot, std::uint32_t other) const {
    return !items_[slot].sensor && !items_[other].sensor;
}

template <int D>
void World<D>::DeleteEdgeFilterState::operator()(EdgeFilterState<D>* state) const {
    delete state;
}

template <int D>
void World<D>::reserve_edge_filter() {
    if (filters_edges_) edges_->reserve(items_.size(), near_.capacity(), found_.capacity());
}

/// Lists the partners of the items whose contacts are filtered, among which needs_filter() finds their neighbours.
template <int D>
void World<D>::list_partners() {
    if (!filters_edges_) return;
    for (const IdPair& pair : near_) {
        edges_->add_partner(pair.a.index - 1, pair.b.index - 1);
        edges_->add_partner(pair.b.index - 1, pair.a.index - 1);
    }
    // References to its elements stay valid during the update.
    edges_->nearest_to_center.reserve(edges_->lists.size());
}

/// Marks the items near which another one has changed.
template <int D>
void World<D>::find_changed_neighbours() {
    edges_->neighbour_changed_is_known = true;
    std::vector<char>& changed = edges_->neighbour_changed;
    changed.assign(items_.size(), false);
    for (const std::vector<IdPair>* pairs : {&near_, &last_near_})
        for (const IdPair& pair : *pairs) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (items_[a].pending) changed[b] = true;
            if (items_[b].pending) changed[a] = true;
        }
}

/// Whether an item near one of the two has changed.
template <int D>
bool World<D>::neighbours_changed(const IdPair& pair) {
    if (filters_edges_ && !edges_->neighbour_changed_is_known) find_changed_neighbours();
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    return (filters_edges(a) && edges_->neighbour_changed[a]) || (filters_edges(b) && edges_->neighbour_changed[b]);
}

/// Visits the closest points on the neighbours of the item in `slot`, except on the item in `other`.
template <int D>
void World<D>::each_closest_point_beside(std::uint32_t slot, std::uint32_t other, const DVec<D>& point, double within,
                                         ClosestPointVisitor<D> visit) {
    const Aabb<D> near = box_around(point, within);
    const auto visit_item = [&](std::uint32_t item) {
        each_closest_point_on<D>(edges_->views.of(item, [&] { return placed(items_[item]); }), point, within,
                                 [&](const ClosestPoint<D>& closest) { return within = visit(closest); });
        return within > stop_visiting;
    };
    const auto& list = *edges_->list_of(slot);
    if (list.size <= max_listed_neighbours) {
        edges_->each_neighbour(list, near,
                               [&](std::uint32_t neighbour) { return neighbour == other || visit_item(neighbour); });
        return;
    }
    const Item& item = items_[slot];
    const Filter filter{.layers = item.layers, .mask = item.mask};
    for (const detail::ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (within == stop_visiting) return;
        items->phase().each_overlapping(near, [&](std::uint32_t place) {
            const std::uint32_t found = items->slot(place);
            if (found == slot || found == other || !passes(found, filter) || !overlaps(box(found), box(slot)))
                return true;
            if (items_[found].type == ShapeType::half_space && item.type == ShapeType::half_space) return true;
            return visit_item(found);
        });
    }
}

/// Whether a neighbour contains the centre of the item's AABB. Then the item is too deep in others to have a surface.
template <int D>
bool World<D>::is_center_covered(std::uint32_t slot) {
    auto& list = *edges_->list_of(slot);
    if (std::exchange(list.is_center_tested, true)) return list.is_center_covered;
    const Vec<D> middle = center(box(slot));
    if (!edges_->each_neighbour(list, {middle, middle}, [](std::uint32_t) { return false; }))
        each_closest_point_beside(slot, slot, DVec<D>(middle), 0, [&](const ClosestPoint<D>& closest) {
            list.is_center_covered = closest.distance < 0;
            return list.is_center_covered ? stop_visiting : 0.0;
        });
    return list.is_center_covered;
}

/// Whether no neighbour's AABB is near one of the deepest points of a contact, except that of `other`, which the item
/// touches there. `side` is 1 if the item is A, and -1 if it is B.
template <int D>
bool World<D>::is_alone(const Contact<D>& contact, std::uint32_t slot, std::uint32_t other, double side) const {
    constexpr auto scale = static_cast<float>(surface_probe_scale), rounding = 0x1p-21f;
    const float s = scale * std::min(items_[slot].local_ball.radius, items_[other].local_ball.radius);
    const float min_depth = contact.depth - static_cast<float>(0.5 * deepest_tolerance) * s;
    const auto to_surface = static_cast<float>(-0.5 * side);
    const auto& list = *edges_->list_of(slot);
    return std::any_of(contact.points.begin(), contact.points.end(), [&](const ContactPoint<D>& point) {
        if (point.depth < min_depth) return false;
        Aabb<D> near;
        for (int i = 0; i < D; ++i) {
            const float on_surface = point.position[i] + contact.normal[i] * (to_surface * point.depth);
            const float reach = probe_reach * s + rounding * (std::abs(point.position[i]) + std::abs(point.depth));
            near.min[i] = on_surface - reach;
            near.max[i] = on_surface + reach;
        }
        return edges_->each_neighbour(list, near, [&](std::uint32_t neighbour) { return neighbour == other; });
    });
}

/// Whether the item in `slot` needs the surface of its neighbours for its contact with another item. The points of a
/// contact of items without parts are known.
template <int D>
bool World<D>::needs_filter(std::uint32_t slot, std::uint32_t other, const Contact<D>* contact, double side) {
    auto* const list = filters_edges_ ? edges_->list_of(slot) : nullptr;
    if (list == nullptr) return false;
    const auto box_of_neighbour = [&](std::uint32_t partner) {
        const Aabb<D>& found = box(partner);
        return are_solid(slot, partner) && (!widened_ || overlaps(box(slot), found)) ? &found : nullptr;
    };
    if (edges_->find_neighbours(*list, box_of_neighbour) < 2 || list->is_center_covered) return false;
    return (contact == nullptr || !is_alone(*contact, slot, other, side)) && !is_center_covered(slot);
}

/// Finds the contacts of two items and appends them to found_, with the surface of their neighbours where these are
/// near. Returns whether the items touch.
template <int D>
bool World<D>::find_contact(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    const ShapeType type_a = items_[a].type, type_b = items_[b].type;
    const bool has_parts = type_a == ShapeType::composite || type_b == ShapeType::composite;
    const bool is_filtered = filters_edges(a) || filters_edges(b);
    const View<D>& placed_a = first_placed(a);
    const View<D> placed_b = placed(items_[b]);
    DeepestParts<D> deepest;
    if (!has_parts || !is_filtered) {
        FoundContact& found = found_.emplace_back();
        found.result.a = pair.a;
        found.result.b = pair.b;
        found.reported = true;
        if (has_parts)
            found.result.contact = abut::contact(placed_a, placed_b);
        else
            find_deepest_parts(placed_a, placed_b, {}, deepest, found.result.contact);
        const bool touch = static_cast<bool>(found.result.contact);
        if (!touch) found_.pop_back();
        // Balls have no edges to catch on.
        if (!touch || !is_filtered || (type_a == ShapeType::ball && type_b == ShapeType::ball)) return touch;
    }
    const Contact<D>* const own = has_parts ? nullptr : &found_.back().result.contact;
    const bool for_a = needs_filter(a, b, own, 1), for_b = needs_filter(b, a, own, -1);
    if (!for_a && !for_b && !has_parts) return true;
    const auto closest_points_beside = [this](std::uint32_t slot, std::uint32_t other) {
        return [this, slot, other](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_beside(slot, other, point, within, visit);
        };
    };
    const auto beside_b = closest_points_beside(a, b), beside_a = closest_points_beside(b, a);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    const auto nearest_to = [&](std::uint32_t slot, bool is_needed) {
        return has_parts || !is_needed ? nullptr : &edges_->nearest_of(*edges_->list_of(slot));
    };
    const NeighbourSurfaces<D> neighbours{for_a ? &of_a : nullptr, for_b ? &of_b : nullptr, nearest_to(a, for_a),
                                          nearest_to(b, for_b)};
    if (!has_parts) {
        const SurfaceContact<D> filtered = filtered_contact(placed_a, placed_b, deepest.contact, *own, neighbours);
        found_.pop_back();
        add_found(pair, filtered);
        return true;
    }
    const std::size_t first = found_.size();
    const bool touch =
        each_surface_contact<D>(placed_a, placed_b, {}, neighbours, [&](const SurfaceContact<D>& filtered) {
            add_found(pair, filtered);
            return true;
        });
    // A pair that touches without a contact is in the list too.
    if (touch && found_.size() == first) add_found(pair, {});
    return touch;
}

/// The area of a ghost follows it in the list.
template <int D>
void World<D>::add_found(const IdPair& pair, const detail::SurfaceContact<D>& filtered) {
    found_.push_back({{pair.a, pair.b, filtered.contact},
                      filtered.surface_normals,
                      static_cast<float>(filtered.size),
                      static_cast<bool>(filtered.contact),
                      false});
    if (filtered.own_area) found_.push_back({{pair.a, pair.b, filtered.own_area}, {}, 0, false, true});
}

template <int D>
std::span<const typename World<D>::FoundContact> World<D>::last_contacts(const IdPair& pair) const {
    const auto pair_of = [](const FoundContact& found) { return IdPair{found.result.a, found.result.b}; };
    const auto first =
        std::partition_point(last_found_.begin(), last_found_.end(), [&](const auto& f) { return pair_of(f) < pair; });
    const auto end = std::find_if(first, last_found_.end(), [&](const auto& f) { return pair_of(f) != pair; });
    return {first, end};
}

/// Whether another reported contact of the item covers a contact with a substitute normal, a ghost.
template <int D>
bool World<D>::is_covered(const FoundContact& ghost, const Id& item) const {
    const auto normal_from_item = [&](const WorldContact<D>& contact) {
        return DVec<D>(contact.contact.normal) * (contact.a == item ? 1.0 : -1.0);
    };
    const WorldContact<D>& result = ghost.result;
    const std::uint32_t slot = item.index - 1;
    if (!filters_edges(slot)) return false;
    for (std::uint32_t link = edges_->last_found[slot]; link != edges_->none; link = edges_->found_before[link]) {
        const FoundContact& other = found_[link / 2];
        if (other.reported && &other != &ghost &&
            covers_contact<D>(normal_from_item(other.result), static_cast<double>(other.result.contact.depth),
                              normal_from_item(result), static_cast<double>(result.contact.depth),
                              static_cast<double>(ghost.size)))
            return true;
    }
    return false;
}

/// Links the contacts of each item.
template <int D>
void World<D>::link_contacts() {
    std::vector<std::uint32_t>& last = edges_->last_found;
    last.assign(items_.size(), edges_->none);
    edges_->found_before.clear();
    for (const FoundContact& found : found_)
        for (const Id& id : {found.result.a, found.result.b}) {
            edges_->found_before.push_back(last[id.index - 1]);
            last[id.index - 1] = static_cast<std::uint32_t>(edges_->found_before.size() - 1);
        }
}

/// Reports the contacts with surface normals, and then, by id, the ghosts. A ghost that a reported contact covers is
/// reported by the area that its items have on the surface, if they have any, so that they still hold each other.
template <int D>
void World<D>::report_contacts() {
    bool any_ghost = false;
    for (FoundContact& found : found_) {
        if (found.surface_normal) continue;
        found.reported = false;
        any_ghost = true;
    }
    if (any_ghost) link_contacts();
    for (FoundContact& found : found_) {
        if (found.surface_normal || !found.result.contact || found.is_own_area) continue;
        found.reported = (found.surface_normal.a || !is_covered(found, found.result.a)) &&
                         (found.surface_normal.b || !is_covered(found, found.result.b));
    }
    bool is_before_reported = true;
    for (const FoundContact& found : found_) {
        if (found.is_own_area ? !is_before_reported : found.reported) contacts_.push_back(found.result);
        is_before_reported = found.reported;
    }
}

template class World<2>;
template class World<3>;

}  // namespace abut
