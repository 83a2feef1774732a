// The contacts of pairs, without ghost collisions at the internal edges between items: an item gets the surface normals
// of the union of all that it touches (docs/ghosts.md).

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

namespace {

/// An item with more neighbours finds those near a point through the broad phases.
constexpr std::size_t max_listed_neighbours = 48;

}  // namespace

/// Whether contacts of the item are filtered for its sake. A fixed item is not pushed, so no normal matters to it.
template <int D>
bool World<D>::filters_edges(std::uint32_t slot) const {
    return !items_[slot].fixed;
}

/// Whether both items are part of the surface that a third one touches. Sensors are not.
template <int D>
bool World<D>::are_solid(std::uint32_t slot, std::uint32_t other) const {
    return !items_[slot].sensor && !items_[other].sensor;
}

template <int D>
void World<D>::find_neighbours() {
    const auto each = [this](auto&& add) {
        for (const IdPair& pair : near_) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (!are_solid(a, b) || (widened_ && !overlaps(box(a), box(b)))) continue;
            const auto neighbour = [this](std::uint32_t slot) {
                return [this, slot]() -> Neighbour { return {box(slot), slot}; };
            };
            if (filters_edges(a)) add(a, neighbour(b));
            if (filters_edges(b)) add(b, neighbour(a));
        }
    };
    neighbours_.build(items_.size(), each);
    // A contact may change if an item near one of the two was added, removed or moved.
    neighbour_changed_.assign(items_.size(), false);
    for (const std::vector<IdPair>* pairs : {&near_, &last_near_})
        for (const IdPair& pair : *pairs) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (items_[a].pending) neighbour_changed_[b] = true;
            if (items_[b].pending) neighbour_changed_[a] = true;
        }
}

template <int D>
bool World<D>::neighbours_changed(const IdPair& pair) const {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    return (filters_edges(a) && neighbour_changed_[a]) || (filters_edges(b) && neighbour_changed_[b]);
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
        each_closest_point_on<D>(views_.of(item, [&] { return placed(items_[item]); }), point, within, narrow);
        return within > stop_visiting;
    };
    const std::span<const Neighbour> neighbours = neighbours_.of(slot);
    if (neighbours.size() <= max_listed_neighbours) {
        for (const auto& neighbour : neighbours)
            if (overlaps_branchless(neighbour.box, near) && neighbour.slot != other && !visit_item(neighbour.slot))
                return;
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

/// Finds the contact of two items and appends it to found_; false if they don't touch.
template <int D>
bool World<D>::find_contact(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    const View<D>& placed_a = first_placed(a);
    const View<D> placed_b = placed(items_[b]);
    const bool a_has_others = neighbours_.of(a).size() > 1, b_has_others = neighbours_.of(b).size() > 1;
    if (!a_has_others && !b_has_others) {
        const Contact<D> contact = abut::contact(placed_a, placed_b);
        if (contact) found_.push_back({{pair.a, pair.b, contact}, {}, true});
        return static_cast<bool>(contact);
    }
    const auto closest_points_beside = [this](std::uint32_t slot, std::uint32_t other) {
        return [this, slot, other](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_beside(slot, other, point, within, visit);
        };
    };
    const auto beside_b = closest_points_beside(a, b), beside_a = closest_points_beside(b, a);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    const ContactWithNeighbours<D> among = contact_with_neighbours<D>(
        placed_a, placed_b, {a_has_others ? &of_a : nullptr, b_has_others ? &of_b : nullptr});
    if (among.touch)
        found_.push_back({{pair.a, pair.b, among.contact}, among.surface_normals, static_cast<bool>(among.contact)});
    return among.touch;
}

template <int D>
typename World<D>::FoundContact* World<D>::found_contact(std::vector<FoundContact>& list, const IdPair& pair) {
    const auto place = std::lower_bound(list.begin(), list.end(), pair, [](const FoundContact& found, const IdPair& p) {
        return IdPair{found.result.a, found.result.b} < p;
    });
    return place != list.end() && place->result.a == pair.a && place->result.b == pair.b ? &*place : nullptr;
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
    const auto others = found_by_slot_.of(slot);
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t place) {
        const FoundContact& other = found_[place];
        return other.reported && &other != &ghost &&
               covers_contact<D>(normal_from_item(other.result), static_cast<double>(other.result.contact.depth),
                                 normal_from_item(result), static_cast<double>(result.contact.depth), size);
    });
}

/// Reports the contacts with surface normals, and then, by id, those ghosts that no reported contact covers.
template <int D>
void World<D>::report_contacts() {
    bool any_ghost = false;
    for (FoundContact& found : found_) {
        if (found.surface_normal) continue;
        found.reported = false;
        any_ghost = true;
    }
    if (any_ghost)
        found_by_slot_.build(items_.size(), [this](auto&& add) {
            for (std::uint32_t place = 0; place < found_.size(); ++place)
                for (const Id& id : {found_[place].result.a, found_[place].result.b})
                    add(id.index - 1, [place] { return place; });
        });
    for (FoundContact& found : found_) {
        if (found.surface_normal || !found.result.contact) continue;
        found.reported = (found.surface_normal.a || !is_covered(found, found.result.a)) &&
                         (found.surface_normal.b || !is_covered(found, found.result.b));
    }
    for (const FoundContact& found : found_)
        if (found.reported) contacts_.push_back(found.result);
}

template class World<2>;
template class World<3>;

}  // namespace abut
