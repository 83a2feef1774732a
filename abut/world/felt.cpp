// Contacts of pairs, with the normals of all that an item touches as one surface: seams between items are as little
// felt as those inside one.

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/detail/surface/contact_with_neighbours.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {
namespace {

/// Of more partners than these the broad phases are asked.
constexpr std::size_t few = 48;

}  // namespace

/// What hardly ever moves isn't pushed, and feels nothing.
template <int D>
bool World<D>::feels(std::uint32_t slot) const {
    return !items_[slot].fixed;
}

/// Whether two are parts of one surface for what pairs with both: sensors aren't.
template <int D>
bool World<D>::are_solid(std::uint32_t slot, std::uint32_t other) const {
    return !items_[slot].sensor && !items_[other].sensor;
}

template <int D>
void World<D>::find_partners() {
    const auto each = [this](auto&& add) {
        for (const IdPair& pair : near_) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (!are_solid(a, b) || (widened_ && !overlaps(box(a), box(b)))) continue;
            const auto partner = [this](std::uint32_t slot) {
                return [this, slot]() -> Partner { return {box(slot), slot}; };
            };
            if (feels(a)) add(a, partner(b));
            if (feels(b)) add(b, partner(a));
        }
    };
    partners_.build(items_.size(), each);
    // A contact isn't what it was where another item near one of the two has come, gone or moved.
    disturbed_.assign(items_.size(), false);
    for (const std::vector<IdPair>* pairs : {&near_, &last_near_})
        for (const IdPair& pair : *pairs) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (items_[a].pending) disturbed_[b] = true;
            if (items_[b].pending) disturbed_[a] = true;
        }
}

template <int D>
bool World<D>::is_disturbed(const IdPair& pair) const {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    return (feels(a) && disturbed_[a]) || (feels(b) && disturbed_[b]);
}

/// Of what the item of the first slot feels beside that of the other.
template <int D>
void World<D>::each_foot_beside(std::uint32_t slot, std::uint32_t other, const DVec<D>& point, double within,
                                ClosestPointVisitor<D> visit) {
    const Vec<D> middle = to_float(point);
    Aabb<D> near = grown(Aabb<D>{middle, middle}, static_cast<float>(within));
    const auto narrow = [&](const ClosestPoint<D>& foot) {
        const double wanted = visit(foot);
        if (wanted < within) {
            const Aabb<D> around = box_around(point, std::max(wanted, 0.0));
            if (abut::contains(near, around)) near = around;
        }
        return within = wanted;
    };
    const auto visit_item = [&](std::uint32_t item) {
        each_closest_point_on<D>(views_.of(item, [&] { return placed(items_[item]); }), point, within, narrow);
        return within > stop_visiting;
    };
    const std::span<const Partner> partners = partners_.of(slot);
    if (partners.size() <= few) {
        for (const auto& partner : partners)
            if (overlaps_branchless(partner.box, near) && partner.slot != other && !visit_item(partner.slot)) return;
        return;
    }
    const Item& item = items_[slot];
    const Filter filter{.layers = item.layers, .mask = item.mask};
    for (const ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (within == stop_visiting) return;
        items->phase().each_overlapping(near, [&](std::uint32_t place) {
            const std::uint32_t found = items->slot(place);
            const Item& beside = items_[found];
            if (found == slot || found == other || !asked(found, filter)) return true;
            if (!overlaps(box(found), near) || !overlaps(box(found), box(slot))) return true;
            if (beside.type == ShapeType::half_space && item.type == ShapeType::half_space) return true;
            return visit_item(found);
        });
    }
}

/// Keeps the contact of two items that may touch; false where they don't.
template <int D>
bool World<D>::find_contact(const IdPair& pair) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    const View<D>& placed_a = first_placed(a);
    const View<D> placed_b = placed(items_[b]);
    const bool others_of_a = partners_.of(a).size() > 1, others_of_b = partners_.of(b).size() > 1;
    if (!others_of_a && !others_of_b) {
        const Contact<D> contact = abut::contact(placed_a, placed_b);
        if (contact) found_.push_back({{pair.a, pair.b, contact}, {}, true});
        return static_cast<bool>(contact);
    }
    const auto beside = [this](std::uint32_t slot, std::uint32_t other) {
        return [this, slot, other](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_foot_beside(slot, other, point, within, visit);
        };
    };
    const auto beside_b = beside(a, b), beside_a = beside(b, a);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    const ContactWithNeighbours<D> among =
        contact_with_neighbours<D>(placed_a, placed_b, {others_of_a ? &of_a : nullptr, others_of_b ? &of_b : nullptr});
    if (among.touch)
        found_.push_back({{pair.a, pair.b, among.contact}, among.surface_normals, static_cast<bool>(among.contact)});
    return among.touch;
}

template <int D>
typename World<D>::Found* World<D>::find_found(std::vector<Found>& list, const IdPair& pair) {
    const auto place = std::lower_bound(list.begin(), list.end(), pair, [](const Found& found, const IdPair& p) {
        return IdPair{found.told.a, found.told.b} < p;
    });
    return place != list.end() && place->told.a == pair.a && place->told.b == pair.b ? &*place : nullptr;
}

/// Whether what stands in for a normal that the item doesn't feel is told by another of its contacts.
template <int D>
bool World<D>::is_told(const Found& ghost, const Id& feeler) const {
    const auto seen_by = [&](const WorldContact<D>& told) {
        return DVec<D>(told.contact.normal) * (told.a == feeler ? 1.0 : -1.0);
    };
    const WorldContact<D>& told = ghost.told;
    const double size = std::min(abut::size(shape(told.a)), abut::size(shape(told.b)));
    const std::uint32_t slot = feeler.index - 1;
    if (!feels(slot)) return false;
    const auto others = found_of_.of(slot);
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t place) {
        const Found& other = found_[place];
        return other.kept && &other != &ghost &&
               covers_contact<D>(seen_by(other.told), static_cast<double>(other.told.contact.depth), seen_by(told),
                                 static_cast<double>(told.contact.depth), size);
    });
}

/// First those that are felt, then, in the order of their ids, what stands in for others and isn't told yet.
template <int D>
void World<D>::tell_contacts() {
    bool any_ghost = false;
    for (Found& found : found_) {
        if (found.felt) continue;
        found.kept = false;
        any_ghost = true;
    }
    if (any_ghost)
        found_of_.build(items_.size(), [this](auto&& add) {
            for (std::uint32_t place = 0; place < found_.size(); ++place)
                for (const Id& id : {found_[place].told.a, found_[place].told.b})
                    add(id.index - 1, [place] { return place; });
        });
    for (Found& found : found_) {
        if (found.felt || !found.told.contact) continue;
        found.kept = (found.felt.a || !is_told(found, found.told.a)) && (found.felt.b || !is_told(found, found.told.b));
    }
    for (const Found& found : found_)
        if (found.kept) contacts_.push_back(found.told);
}

template class World<2>;
template class World<3>;

}  // namespace abut
