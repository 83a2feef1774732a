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
constexpr double probe_reach = 4;

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

/// Finds the neighbours of the items of all pairs whose contact may be new: one of the two, or an item near one of
/// them, was added, removed or moved.
template <int D>
void World<D>::find_neighbours() {
    if (!filters_edges_) return;
    EdgeFilterState<D>& state = *edges_;
    const auto has_few = [&](const IdPair& pair) {
        return state.list_of_slot[pair.a.index - 1] < 2 && state.list_of_slot[pair.b.index - 1] < 2;
    };
    for (const IdPair& pair : near_) {
        const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
        if (has_few(pair)) continue;
        if (!items_[a].pending && !items_[b].pending && !neighbours_changed(pair)) continue;
        if (filters_edges(a)) state.add_list(a);
        if (filters_edges(b)) state.add_list(b);
    }
    state.begin_neighbours();
    for (const IdPair& pair : near_) {
        const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
        if (has_few(pair) || !are_solid(a, b) || (widened_ && !overlaps(box(a), box(b)))) continue;
        state.add_neighbour(a, b, box(b));
        state.add_neighbour(b, a, box(a));
    }
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
    const Vec<D> middle = to_float(point);
    Aabb<D> near = grown(Aabb<D>{middle, middle}, static_cast<float>(within));
    const auto narrow = [&](const ClosestPoint<D>& closest) {
        const double reach = visit(closest);
        if (reach < within) {
            const Aabb<D> around = box_around(point, std::max(reach, 0.0));
            if (abut::contains(near, around)) near = around;
        }
        return within = reach;
    };
    const auto visit_item = [&](std::uint32_t item) {
        each_closest_point_on<D>(edges_->views.of(item, [&] { return placed(items_[item]); }), point, within, narrow);
        return within > stop_visiting;
    };
    if (edges_->list_of(slot)->size <= max_listed_neighbours) {
        edges_->each_neighbour(slot, near, [&](std::uint32_t neighbour) {
            return neighbour == other || !overlaps_branchless(box(neighbour), near) || visit_item(neighbour);
        });
        return;
    }
    const Item& item = items_[slot];
    const Filter filter{.layers = item.layers, .mask = item.mask};
    for (const detail::ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (within == stop_visiting) return;
        items->phase().each_overlapping(near, [&](std::uint32_t place) {
            const std::uint32_t found = items->slot(place);
            const Item& candidate = items_[found];
            if (found == slot || found == other || !passes(found, filter)) return true;
            if (!overlaps(box(found), near) || !overlaps(box(found), box(slot))) return true;
            if (candidate.type == ShapeType::half_space && item.type == ShapeType::half_space) return true;
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
    if (!edges_->each_neighbour(slot, {middle, middle}, [](std::uint32_t) { return false; }))
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
    const double radius =
        static_cast<double>(std::min(items_[slot].local_ball.radius, items_[other].local_ball.radius));
    const double scale = surface_probe_scale * radius;
    const double min_depth = static_cast<double>(contact.depth) - 0.5 * deepest_tolerance * scale;
    return std::any_of(contact.points.begin(), contact.points.end(), [&](const ContactPoint<D>& point) {
        const double depth = static_cast<double>(point.depth);
        if (depth < min_depth) return false;
        const DVec<D> on_surface = DVec<D>(point.position) - DVec<D>(contact.normal) * (0.5 * side * depth);
        const Aabb<D> near = box_around(on_surface, probe_reach * scale);
        return edges_->each_neighbour(slot, near, [&](std::uint32_t neighbour) { return neighbour == other; });
    });
}

/// Whether the item in `slot` needs the surface of its neighbours for its contact with another item. The points of a
/// contact of items without parts are known.
template <int D>
bool World<D>::needs_filter(std::uint32_t slot, std::uint32_t other, const Contact<D>* contact, double side) {
    if (!filters_edges(slot)) return false;
    const auto* const list = edges_->list_of(slot);
    if (list == nullptr || list->size < 2 || list->is_center_covered) return false;
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
    const auto others = edges_->found_by_slot.of(slot);
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t place) {
        const FoundContact& other = found_[place];
        return other.reported && &other != &ghost &&
               covers_contact<D>(normal_from_item(other.result), static_cast<double>(other.result.contact.depth),
                                 normal_from_item(result), static_cast<double>(result.contact.depth),
                                 static_cast<double>(ghost.size));
    });
}

/// Finds the contacts of the items that have ghosts.
template <int D>
void World<D>::find_contacts_beside_ghosts() {
    std::vector<char>& has_ghost = edges_->has_ghost;
    has_ghost.assign(items_.size(), false);
    for (const FoundContact& found : found_) {
        if (!found.surface_normal.a) has_ghost[found.result.a.index - 1] = true;
        if (!found.surface_normal.b) has_ghost[found.result.b.index - 1] = true;
    }
    edges_->found_by_slot.build(items_.size(), [&](auto&& add) {
        for (std::uint32_t place = 0; place < found_.size(); ++place)
            for (const Id& id : {found_[place].result.a, found_[place].result.b})
                if (has_ghost[id.index - 1]) add(id.index - 1, [place] { return place; });
    });
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
    if (any_ghost) find_contacts_beside_ghosts();
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
