// The contacts of pairs, without ghost collisions at the internal edges between items: an item gets the surface normals
// of the union of all that it touches (docs/ghosts.md).

#include <abut/broad_phase/boxes.hpp>
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
void World<D>::begin_edge_filter() {
    if (edges_ == nullptr) edges_.reset(new EdgeFilterState<D>());
    edges_->begin_update();
}

template <int D>
void World<D>::reserve_edge_filter() {
    edges_->reserve(items_.size(), near_.capacity(), found_.capacity());
}

/// Finds the neighbours of the items with new contacts.
template <int D>
void World<D>::find_neighbours() {
    using State = EdgeFilterState<D>;
    std::vector<std::uint32_t>& list_of_slot = edges_->list_of_slot;
    list_of_slot.assign(items_.size(), State::none);
    edges_->centers.clear();
    for (const auto& added : edges_->new_contacts) {
        const WorldContact<D>& contact = found_[added.place].result;
        for (const Id& id : {contact.a, contact.b}) {
            std::uint32_t& list = list_of_slot[id.index - 1];
            if (list != State::none || !filters_edges(id.index - 1)) continue;
            list = static_cast<std::uint32_t>(edges_->centers.size());
            edges_->centers.emplace_back();
        }
    }
    const auto each = [&](auto&& add) {
        for (const IdPair& pair : near_) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            const std::uint32_t list_a = list_of_slot[a], list_b = list_of_slot[b];
            if (list_a == State::none && list_b == State::none) continue;
            if (!are_solid(a, b) || (widened_ && !overlaps(box(a), box(b)))) continue;
            const auto neighbour = [](std::uint32_t slot) { return [slot] { return slot; }; };
            if (list_a != State::none) add(list_a, neighbour(b));
            if (list_b != State::none) add(list_b, neighbour(a));
        }
    };
    edges_->neighbours.build(edges_->centers.size(), each);
    const std::span<const std::uint32_t> all = edges_->neighbours.all();
    edges_->neighbour_boxes.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) edges_->neighbour_boxes.set(i, box(all[i]));
}

/// A contact may change if an item near one of the two was added, removed or moved.
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

template <int D>
bool World<D>::neighbours_changed(const IdPair& pair) {
    if (!edges_->neighbour_changed_is_known) find_changed_neighbours();
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
    if (edges_->neighbour_count(slot) <= max_listed_neighbours) {
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

/// Finds the contact of two items by themselves and appends it to found_; false if they don't touch.
template <int D>
bool World<D>::find_contact(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    FoundContact& found = found_.emplace_back();
    found.result.a = pair.a;
    found.result.b = pair.b;
    found.reported = true;
    bool touch = false;
    if (filters_edges(a) || filters_edges(b)) {
        auto& added = edges_->new_contacts.emplace_back(found_.size() - 1);
        touch = find_deepest_parts(first_placed(a), placed(items_[b]), {}, added.deepest, found.result.contact);
        if (!touch) edges_->new_contacts.pop_back();
    } else {
        found.result.contact = abut::contact(first_placed(a), placed(items_[b]));
        touch = static_cast<bool>(found.result.contact);
    }
    if (!touch) found_.pop_back();
    return touch;
}

/// Whether a neighbour contains the centre of the item's AABB. Then the item is too deep in others to have a surface.
template <int D>
bool World<D>::is_center_covered(std::uint32_t slot) {
    auto& state = edges_->center_of(slot);
    if (std::exchange(state.is_tested, true)) return state.is_covered;
    const Vec<D> middle = center(box(slot));
    if (!edges_->each_neighbour(slot, {middle, middle}, [](std::uint32_t) { return false; }))
        each_closest_point_beside(slot, slot, DVec<D>(middle), 0, [&](const ClosestPoint<D>& closest) {
            state.is_covered = closest.distance < 0;
            return state.is_covered ? stop_visiting : 0.0;
        });
    return state.is_covered;
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

/// Replaces the contact of a pair by that with the surface of its neighbours, if they are near.
template <int D>
void World<D>::filter_contact(FoundContact& found, const DeepestParts<D>& deepest) {
    const std::uint32_t a = found.result.a.index - 1, b = found.result.b.index - 1;
    const ShapeType type_a = items_[a].type, type_b = items_[b].type;
    // Balls have no edges to catch on.
    if (type_a == ShapeType::ball && type_b == ShapeType::ball) return;
    const bool has_parts = type_a == ShapeType::composite || type_b == ShapeType::composite;
    const auto needs_filter = [&](std::uint32_t slot, std::uint32_t other, double side) {
        return filters_edges(slot) && edges_->neighbour_count(slot) > 1 && !is_center_covered(slot) &&
               (has_parts || !is_alone(found.result.contact, slot, other, side));
    };
    const bool for_a = needs_filter(a, b, 1), for_b = needs_filter(b, a, -1);
    if (!for_a && !for_b && !has_parts) return;
    const auto closest_points_beside = [this](std::uint32_t slot, std::uint32_t other) {
        return [this, slot, other](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_beside(slot, other, point, within, visit);
        };
    };
    const auto beside_b = closest_points_beside(a, b), beside_a = closest_points_beside(b, a);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    const auto nearest_to = [&](std::uint32_t slot) {
        return has_parts || !filters_edges(slot) ? nullptr : &edges_->center_of(slot).nearest;
    };
    const NeighbourSurfaces<D> neighbours{for_a ? &of_a : nullptr, for_b ? &of_b : nullptr, nearest_to(a),
                                          nearest_to(b)};
    const View<D>& placed_a = first_placed(a);
    const View<D> placed_b = placed(items_[b]);
    if (!has_parts) {
        set_contact(filtered_contact(placed_a, placed_b, deepest.contact, found.result.contact, neighbours), found);
        return;
    }
    found.reported = false;
    bool is_first = true;
    each_surface_contact<D>(placed_a, placed_b, {}, neighbours, [&](const SurfaceContact<D>& filtered) {
        if (!is_first) more_found_.push_back(found);
        set_contact(filtered, std::exchange(is_first, false) ? found : more_found_.back());
        return true;
    });
}

/// The area of a ghost follows it in the list.
template <int D>
void World<D>::set_contact(const detail::SurfaceContact<D>& filtered, FoundContact& found) {
    found.result.contact = filtered.contact;
    found.surface_normal = filtered.surface_normals;
    found.reported = static_cast<bool>(filtered.contact);
    found.is_own_area = false;
    if (!filtered.own_area) return;
    const WorldContact<D> area{found.result.a, found.result.b, filtered.own_area};
    more_found_.push_back({.result = area, .surface_normal = {}, .reported = false, .is_own_area = true});
}

/// Merges the further contacts of pairs into found_. Both lists are sorted by pairs.
template <int D>
void World<D>::merge_more_found() {
    std::size_t found = found_.size(), more = more_found_.size(), place = found + more;
    found_.resize(place);
    const auto pair_of = [](const FoundContact& contact) { return IdPair{contact.result.a, contact.result.b}; };
    while (more > 0) {
        const bool is_more = found == 0 || !(pair_of(more_found_[more - 1]) < pair_of(found_[found - 1]));
        found_[--place] = is_more ? more_found_[--more] : found_[--found];
    }
    more_found_.clear();
}

template <int D>
void World<D>::filter_contacts() {
    if (edges_->new_contacts.empty()) return;
    find_neighbours();
    for (const auto& added : edges_->new_contacts) filter_contact(found_[added.place], added.deepest);
    merge_more_found();
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
    const double size = std::min(detail::size(shape(result.a)), detail::size(shape(result.b)));
    const std::uint32_t slot = item.index - 1;
    if (!filters_edges(slot)) return false;
    const auto others = edges_->found_by_slot.of(slot);
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t place) {
        const FoundContact& other = found_[place];
        return other.reported && &other != &ghost &&
               covers_contact<D>(normal_from_item(other.result), static_cast<double>(other.result.contact.depth),
                                 normal_from_item(result), static_cast<double>(result.contact.depth), size);
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
