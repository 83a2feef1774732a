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
/// balls: 2.1 s, and s may be sqrt(3) times as large (see detail::size). The rest is for rounding.
constexpr float probe_reach = 4;

/// Calls visit(pair) for the pairs that only one of two sorted lists has.
template <class Visit>
void each_difference(const std::vector<IdPair>& first, const std::vector<IdPair>& second, const Visit& visit) {
    auto a = first.begin(), b = second.begin();
    while (a != first.end() || b != second.end()) {
        if (b == second.end() || (a != first.end() && *a < *b))
            visit(*a++);
        else if (a == first.end() || *b < *a)
            visit(*b++);
        else
            ++a, ++b;
    }
}

}  // namespace

/// Whether contacts of the item are filtered for its sake. A fixed item is not pushed, so no normal matters to it.
template <int D>
bool World<D>::filters_edges(std::uint32_t slot) const {
    return filters_edges_ && !items_[slot].fixed;
}

template <int D>
void detail::DeleteEdgeFilterState<D>::operator()(EdgeFilterState<D>* state) const {
    delete state;
}

template <int D>
void World<D>::reserve_edge_filter() {
    if (filters_edges_) edges_->reserve(items_.size(), near_.capacity(), found_.contacts.capacity());
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
    if (!filters_pairs_) return;
    // A pair filter may change its answer for items that did not change.
    each_difference(near_, last_near_, [&](const IdPair& pair) {
        changed[pair.a.index - 1] = true;
        changed[pair.b.index - 1] = true;
    });
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
    const auto visit_item = [&](std::uint32_t item) {
        each_closest_point_on<D>(placed_view(item), point, within,
                                 [&](const ClosestPoint<D>& closest) { return within = visit(closest); });
        return within > stop_visiting;
    };
    std::uint32_t& last_cover = edges_->search_of(slot).last_cover;
    const std::uint32_t first = last_cover == other ? edges_->none : last_cover;
    if (first != edges_->none && !visit_item(first)) return;
    const Aabb<D> near = box_around(point, within);
    if (const std::span neighbours = edges_->neighbours_of(slot); neighbours.size() <= max_listed_neighbours) {
        const typename Neighbour<D>::Query query(near);
        for (const Neighbour<D>& neighbour : neighbours) {
            if (!query.overlaps(neighbour) || neighbour.slot == other || neighbour.slot == first) continue;
            if (!visit_item(neighbour.slot)) {
                last_cover = neighbour.slot;
                return;
            }
        }
        return;
    }
    for (const detail::ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (within == stop_visiting) return;
        items->phase().each_overlapping(near, [&](std::uint32_t place) {
            const std::uint32_t found = items->slot(place);
            if (found == slot || found == other || !are_neighbours(slot, found) || !may_pair(slot, found)) return true;
            return visit_item(found);
        });
    }
}

/// Whether a neighbour contains the centre of the item's bounding ball. Then the item is too deep in others to have a
/// surface.
template <int D>
bool World<D>::is_center_covered(std::uint32_t slot) {
    NeighbourSearch<D>& search = edges_->search_of(slot);
    if (std::exchange(search.is_center_tested, true)) return search.is_center_covered;
    const BoundingBall<D> around = ball(items_[slot]);
    if (std::isfinite(around.radius))
        each_closest_point_beside(slot, slot, around.center, 0, [&](const ClosestPoint<D>& closest) {
            search.is_center_covered = closest.distance < 0;
            return search.is_center_covered ? stop_visiting : 0.0;
        });
    return search.is_center_covered;
}

/// Whether a composite contact of the item in `slot` needs the surface of its neighbours: it has several, so that it
/// may touch another one beside the contact.
template <int D>
bool World<D>::needs_filter(std::uint32_t slot) {
    return edges_->neighbours_of(slot).size() >= 2 && !is_center_covered(slot);
}

/// Whether the item in `slot` needs the surface of its neighbours for a contact with another item: there is one near
/// each of the deepest points. `side` is 1 if the item is A, and -1 if it is B.
template <int D>
bool World<D>::needs_filter(std::uint32_t slot, std::uint32_t other, const Contact<D>& contact, float side) {
    const std::span neighbours = edges_->neighbours_of(slot);
    if (neighbours.size() < 2 || edges_->is_center_known_covered(slot)) return false;
    const float s = static_cast<float>(surface_probe_scale) *
                    std::min(items_[slot].local_ball.radius, items_[other].local_ball.radius);
    // All points are within the smaller item, and so near the first one.
    constexpr float rounding = 0x1p-21f;
    float reach = probe_reach * s + rounding * std::abs(contact.depth);
    for (int i = 0; i < D; ++i) reach += rounding * std::abs(contact.points[0].position[i]);
    const Vec<D> to_surface = contact.normal * (-0.5f * side);
    const float min_depth = contact.depth - static_cast<float>(0.5 * deepest_tolerance) * s;
    for (const ContactPoint<D>& point : contact.points) {
        if (point.depth < min_depth) continue;
        const Vec<D> on_surface = point.position + to_surface * point.depth;
        const typename Neighbour<D>::Query near({on_surface - reach, on_surface + reach});
        bool is_alone = true;
        for (const Neighbour<D>& neighbour : neighbours)
            is_alone &= !near.overlaps(neighbour) | (neighbour.slot == other);
        if (is_alone) return false;
    }
    return !is_center_covered(slot);
}

/// Calls use(neighbours) with what the items in two slots touch beside each other.
template <int D>
template <class Use>
void World<D>::with_neighbours(std::uint32_t a, std::uint32_t b, bool for_a, bool for_b, const Use& use) {
    const auto closest_points_beside = [this](std::uint32_t slot, std::uint32_t other) {
        return [this, slot, other](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_beside(slot, other, point, within, visit);
        };
    };
    const auto beside_b = closest_points_beside(a, b), beside_a = closest_points_beside(b, a);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    use(NeighbourSurfaces<D>{for_a ? &of_a : nullptr, for_b ? &of_b : nullptr});
}

/// Finds the contacts of two items and appends them to found_. Those of items without parts are filtered later, all at
/// once. Returns whether the items touch.
template <int D>
bool World<D>::find_contact(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    const ShapeType type_a = items_[a].type, type_b = items_[b].type;
    const bool has_parts = type_a == ShapeType::composite || type_b == ShapeType::composite;
    const bool is_filtered = filters_edges(a) || filters_edges(b);
    if (has_parts && is_filtered) return find_surface_contacts(pair);
    const View<D>&placed_a = first_placed(a), &placed_b = placed_view(b);
    Contact<D>& found = found_.add(pair, {}).contact;
    // Balls have no edges to catch on.
    const bool is_unfiltered = is_filtered && (type_a != ShapeType::ball || type_b != ShapeType::ball);
    DeepestParts<D> own;
    if (has_parts)
        found = abut::contact(placed_a, placed_b);
    else
        find_deepest_parts(placed_a, placed_b, {}, is_unfiltered ? edges_->next_deepest() : own, found);
    if (!found) {
        found_.pop_back();
        return false;
    }
    if (is_unfiltered && edges_->add_unfiltered(found_.size() - 1)) filter_contacts();
    return true;
}

/// Finds the contacts of two items of which at least one is composite, with the surface of their neighbours.
template <int D>
bool World<D>::find_surface_contacts(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    const bool for_a = needs_filter(a), for_b = needs_filter(b);
    const View<D>& placed_a = first_placed(a);
    const View<D> placed_b = placed_view(b);  // a copy: the neighbours may take its place in the cache
    const std::size_t first = found_.size();
    bool touch = false;
    with_neighbours(a, b, for_a, for_b, [&](const NeighbourSurfaces<D>& neighbours) {
        touch = each_surface_contact<D>(placed_a, placed_b, {}, neighbours, [&](const SurfaceContact<D>& filtered) {
            found_.add(pair, {});
            set_found(found_.size() - 1, filtered);
            return true;
        });
    });
    // A pair that touches without a contact is in the list too.
    if (touch && found_.size() == first) {
        found_.add(pair, {});
        found_.states.back().reported = false;
    }
    return touch;
}

/// Filters the contacts of items without parts that were found last.
template <int D>
void World<D>::filter_contacts() {
    if (!filters_edges_) return;
    const auto last = std::span(edges_->unfiltered).first(std::exchange(edges_->unfiltered_count, 0));
    for (auto& unfiltered : last) {
        const WorldContact<D>& found = found_.contacts[unfiltered.found];
        const std::uint32_t a = found.a.index - 1, b = found.b.index - 1;
        unfiltered.for_a = needs_filter(a, b, found.contact, 1);
        unfiltered.for_b = needs_filter(b, a, found.contact, -1);
    }
    for (const auto& unfiltered : last) {
        if (!unfiltered.for_a && !unfiltered.for_b) continue;
        const WorldContact<D>& found = found_.contacts[unfiltered.found];
        const std::uint32_t a = found.a.index - 1, b = found.b.index - 1;
        const View<D>& placed_a = first_placed(a);
        const View<D> placed_b = placed_view(b);  // a copy: the neighbours may take its place in the cache
        with_neighbours(a, b, unfiltered.for_a, unfiltered.for_b, [&](NeighbourSurfaces<D> neighbours) {
            if (unfiltered.for_a) neighbours.nearest_to_a = &edges_->search_of(a).nearest_to_center;
            if (unfiltered.for_b) neighbours.nearest_to_b = &edges_->search_of(b).nearest_to_center;
            set_found(unfiltered.found,
                      filtered_contact(placed_a, placed_b, unfiltered.deepest.contact, found.contact, neighbours));
        });
    }
}

/// Writes a contact to its place in found_.
template <int D>
void World<D>::set_found(std::size_t index, const detail::SurfaceContact<D>& filtered) {
    WorldContact<D>& found = found_.contacts[index];
    FoundState& state = found_.states[index];
    found.contact = filtered.contact;
    state.surface_normal = filtered.surface_normals;
    state.size = static_cast<float>(filtered.size);
    state.reported = static_cast<bool>(filtered.contact);
    if (filtered.own_area) found_.set_own_area(index, {found.a, found.b, filtered.own_area});
}

/// Whether another reported contact of the item covers a contact with a substitute normal, a ghost.
template <int D>
bool World<D>::is_covered(std::size_t ghost, const Id& item) const {
    const auto normal_from_item = [&](const WorldContact<D>& contact) {
        return DVec<D>(contact.contact.normal) * (contact.a == item ? 1.0 : -1.0);
    };
    const WorldContact<D>& result = found_.contacts[ghost];
    const std::uint32_t slot = item.index - 1;
    if (!filters_edges(slot)) return false;
    for (std::uint32_t link = edges_->last_found[slot]; link != edges_->none; link = edges_->found_before[link]) {
        const std::size_t other = link / 2;
        const WorldContact<D>& cover = found_.contacts[other];
        if (found_.states[other].reported && other != ghost &&
            covers_contact<D>(normal_from_item(cover), static_cast<double>(cover.contact.depth),
                              normal_from_item(result), static_cast<double>(result.contact.depth),
                              static_cast<double>(found_.states[ghost].size)))
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
    for (const WorldContact<D>& found : found_.contacts)
        for (const Id& id : {found.a, found.b}) {
            edges_->found_before.push_back(last[id.index - 1]);
            last[id.index - 1] = static_cast<std::uint32_t>(edges_->found_before.size() - 1);
        }
}

/// Reports the contacts with surface normals, and then, by id, the ghosts. A ghost that a reported contact covers is
/// reported by the area that its items have on the surface, if they have any, so that they still hold each other.
template <int D>
void World<D>::report_contacts() {
    std::vector<FoundState>& states = found_.states;
    bool any_ghost = false;
    are_all_reported_ = true;
    for (FoundState& state : states) {
        const bool is_ghost = !state.surface_normal;
        any_ghost = any_ghost || is_ghost;
        state.reported = state.reported && !is_ghost;
        are_all_reported_ = are_all_reported_ && state.reported;
    }
    if (are_all_reported_) return;
    if (any_ghost) link_contacts();
    contacts_.clear();
    for (std::size_t i = 0; i < states.size(); ++i) {
        const WorldContact<D>& found = found_.contacts[i];
        FoundState& state = states[i];
        if (!state.surface_normal && found.contact)
            state.reported = (state.surface_normal.a || !is_covered(i, found.a)) &&
                             (state.surface_normal.b || !is_covered(i, found.b));
        if (state.reported)
            contacts_.push_back(found);
        else if (state.own_area != FoundState::no_own_area)
            contacts_.push_back(found_.own_areas[state.own_area]);
    }
}

template struct detail::DeleteEdgeFilterState<2>;
template struct detail::DeleteEdgeFilterState<3>;
template class World<2>;
template class World<3>;

}  // namespace abut
