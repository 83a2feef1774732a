// The contacts of pairs, without ghost collisions at the internal edges between items: an item gets the surface normals
// of the union of all that it touches (docs/ghosts.md).

#include <abut/query/contact.hpp>
#include <abut/world/detail/pair_tests.hpp>

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

}  // namespace

/// Moves a view from the item's position, where it was made, to where the item is in the frame.
template <int D>
void World<D>::PairTests::move_to_frame(std::uint32_t slot, View<D>& view) {
    const DVec<D>& own = memory_.own_offsets.of(slot, [&] { return offset_of(view); });
    set_offset(view, own, world_.positions_.of(slot) - frame_);
}

/// Visits the closest points on the neighbours of an item beside another one. Near the contact these are few and known.
template <int D>
template <class Visit>
void World<D>::PairTests::each_closest_point_beside(const ContactSide& side, const DVec<D>& point, double within,
                                                    const Visit& visit) {
    const auto visit_item = [&](std::uint32_t item) {
        each_closest_point_on<D>(placed_view(item), point, within,
                                 [&](const ClosestPoint<D>& closest) { return within = visit(closest); });
        return within > stop_visiting;
    };
    Aabb<D> near = box_around(point, within);
    if (is_large_) near = world_.positions_.about_origin(near, frame_);
    const NeighbourList<D> neighbours = neighbours_.of(side.slot);
    if (side.near != nullptr && side.near->cover(near)) return side.near->each(neighbours, visit_item);
    if (neighbours.size() <= max_listed_neighbours) return neighbours.each_overlapping(near, side.other, visit_item);
    for (const detail::ItemBoxes<D>* items : {&world_.moving_, &world_.fixed_}) {
        if (within == stop_visiting) return;
        items->phase().each_overlapping(near, [&](std::uint32_t place) {
            const std::uint32_t found = items->slot(place);
            if (found == side.slot || found == side.other || !world_.are_neighbours(side.slot, found) ||
                !world_.may_pair(side.slot, found))
                return true;
            if (is_large_ && !world_.are_boxes_near(side.slot, found)) return true;
            return visit_item(found);
        });
    }
}

/// Whether a neighbour contains the centre of the item's bounding ball. Then the item is too deep in others to have a
/// surface.
template <int D>
bool World<D>::PairTests::is_center_covered(std::uint32_t slot) {
    using Center = typename Neighbourhoods<D>::Center;
    const auto known = neighbours_.center(slot);
    if (const Center center = known.load(std::memory_order_relaxed); center != Center::unknown)
        return center == Center::covered;
    bool is_covered = false;
    // The answer is for all pairs of the item, so it doesn't depend on their frame.
    const DVec<D> frame = frame_;
    set_frame(slot);
    if (const BoundingBall<D> around = world_.ball(slot, frame_); std::isfinite(around.radius))
        each_closest_point_beside({slot, slot, true}, around.center, 0, [&](const ClosestPoint<D>& closest) {
            is_covered = closest.distance < 0;
            return is_covered ? stop_visiting : 0.0;
        });
    frame_ = frame;
    known.store(is_covered ? Center::covered : Center::uncovered, std::memory_order_relaxed);
    return is_covered;
}

/// Whether a composite contact of the item in `slot` needs the surface of its neighbours: it has several, so that it
/// may touch another one beside the contact.
template <int D>
bool World<D>::PairTests::needs_filter(std::uint32_t slot) {
    return neighbours_.may_matter(slot) && !is_center_covered(slot);
}

/// Finds which of the two items of a contact without parts need the surface of their neighbours: there is one near each
/// of the deepest points.
template <int D>
bool World<D>::PairTests::find_sides_to_filter(const WorldContact<D>& found, UnfilteredContact<D>& unfiltered) {
    const Contact<D>& contact = found.contact;
    const std::uint32_t a = found.a.index - 1, b = found.b.index - 1;
    const float s =
        static_cast<float>(surface_probe_scale) * std::min(items_[a].local_ball.radius, items_[b].local_ball.radius);
    // All points are within the smaller item, and so near the first one.
    constexpr float rounding = 0x1p-21f;
    float reach = probe_reach * s + rounding * std::abs(contact.depth);
    for (int i = 0; i < D; ++i) reach += rounding * std::abs(contact.points[0].position[i]);
    Vec<D> to_origin(0.0f);
    if (is_large_) {
        to_origin = to_float(frame_ - world_.positions_.origin());
        for (int i = 0; i < D; ++i) reach += rounding * std::abs(to_origin[i]);
    }
    const float min_depth = contact.depth - static_cast<float>(0.5 * deepest_tolerance) * s;
    // `to_surface` leads from a point of depth 1 to the surface of the other item.
    const auto needs_filter = [&](std::uint32_t slot, std::uint32_t other, const Vec<D>& to_surface,
                                  NearNeighbours<D>& near) {
        if (!neighbours_.may_matter(slot)) return false;
        const NeighbourList<D> neighbours = neighbours_.of(slot);
        Aabb<D> around_all = Aabb<D>::empty();
        bool is_first = true;
        for (const ContactPoint<D>& point : contact.points) {
            if (point.depth < min_depth) continue;
            const Vec<D> middle = point.position + to_surface * point.depth + to_origin;
            const Aabb<D> around{middle - reach, middle + reach};
            // Mostly there is one point.
            if (is_first ? !near.find(neighbours, around, other) : !neighbours.any_overlaps(around, other))
                return false;
            is_first = false;
            around_all = merged(around_all, around);
        }
        if (!near.cover(around_all)) near.find(neighbours, around_all, other);
        return !is_center_covered(slot);
    };
    unfiltered.for_a = needs_filter(a, b, contact.normal * -0.5f, unfiltered.near_a);
    unfiltered.for_b = needs_filter(b, a, contact.normal * 0.5f, unfiltered.near_b);
    return unfiltered.for_a || unfiltered.for_b;
}

/// Calls use(neighbours) with what two items touch beside each other.
template <int D>
template <class Use>
void World<D>::PairTests::with_neighbours(const ContactSide& a, const ContactSide& b, const Use& use) {
    const auto closest_points_beside = [this](const ContactSide& side) {
        return [this, &side](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_beside(side, point, within, visit);
        };
    };
    const auto beside_b = closest_points_beside(a), beside_a = closest_points_beside(b);
    const EachClosestPoint<D> of_a(beside_b), of_b(beside_a);
    use(NeighbourSurfaces<D>{a.is_filtered ? &of_a : nullptr, b.is_filtered ? &of_b : nullptr});
}

/// Finds the contacts of two items and appends them to results_.found. Those of items without parts are filtered later,
/// all at once. Returns whether the items touch.
template <int D>
bool World<D>::PairTests::find_contact(const Pair& pair) {
    const auto& [slots, a, b] = pair;
    const bool has_parts = a.type == ShapeType::composite || b.type == ShapeType::composite;
    const bool is_filtered = world_.filters_edges_ && !(a.fixed && b.fixed);
    if (has_parts && is_filtered) return find_surface_contacts(pair);
    const auto [placed_a, placed_b] = placed_views(slots);
    WorldContact<D>& found = results_.found.add(pair.ids());
    UnfilteredContact<D>& unfiltered = memory_.next_unfiltered();
    if (has_parts)
        found.contact = abut::contact(placed_a, placed_b);
    else
        find_deepest_parts(placed_a, placed_b, {}, unfiltered.deepest, found.contact);
    if (!found.contact) {
        results_.found.pop_back();
        return false;
    }
    // Balls have no edges to catch on.
    if (is_filtered && (a.type != ShapeType::ball || b.type != ShapeType::ball) &&
        (neighbours_.may_matter(slots.a) || neighbours_.may_matter(slots.b)) &&
        find_sides_to_filter(found, unfiltered) && memory_.add_unfiltered(results_.found.size() - 1))
        filter_contacts();
    return true;
}

/// Finds the contacts of two items of which at least one is composite, with the surface of their neighbours.
template <int D>
bool World<D>::PairTests::find_surface_contacts(const Pair& pair) {
    const auto& [a, b] = pair.slots;
    const ContactSide for_a{a, b, needs_filter(a)}, for_b{b, a, needs_filter(b)};
    // Copies: the neighbours may take their places in the cache.
    const View<D> placed_a = placed_view(a), placed_b = placed_view(b);
    const std::size_t first = results_.found.size();
    bool touch = false;
    with_neighbours(for_a, for_b, [&](const NeighbourSurfaces<D>& neighbours) {
        touch = each_surface_contact<D>(placed_a, placed_b, {}, neighbours, [&](const SurfaceContact<D>& filtered) {
            results_.found.add(pair.ids());
            set_found(results_.found.size() - 1, filtered);
            return true;
        });
    });
    // A pair that touches without a contact is in the list too.
    if (touch && results_.found.size() == first) {
        results_.found.add(pair.ids());
        results_.found.change_state(first).reported = false;
    }
    return touch;
}

/// Filters the contacts of items without parts that were found last.
template <int D>
void World<D>::PairTests::filter_contacts() {
    const auto last = std::span(memory_.unfiltered).first(std::exchange(memory_.unfiltered_count, 0));
    for (const auto& unfiltered : last) {
        const WorldContact<D>& found = results_.found.contacts[unfiltered.found];
        const std::uint32_t a = found.a.index - 1, b = found.b.index - 1;
        set_frame(a);
        // Copies: the neighbours may take their places in the cache.
        const View<D> placed_a = placed_view(a), placed_b = placed_view(b);
        const ContactSide for_a{a, b, unfiltered.for_a, &unfiltered.near_a};
        const ContactSide for_b{b, a, unfiltered.for_b, &unfiltered.near_b};
        with_neighbours(for_a, for_b, [&](NeighbourSurfaces<D> neighbours) {
            const auto nothing = [] { return NearestToCenter<D>(); };
            if (unfiltered.for_a) neighbours.nearest_to_a = &memory_.nearest[0].of(a, nothing);
            // B's is about the frame of another A.
            if (unfiltered.for_b && !is_large_) neighbours.nearest_to_b = &memory_.nearest[1].of(b, nothing);
            set_found(unfiltered.found,
                      filtered_contact(placed_a, placed_b, unfiltered.deepest.contact, found.contact, neighbours));
        });
    }
}

/// Writes a contact to its place in results_.found.
template <int D>
void World<D>::PairTests::set_found(std::size_t index, const detail::SurfaceContact<D>& filtered) {
    WorldContact<D>& found = results_.found.contacts[index];
    found.contact = filtered.contact;
    if (filtered.surface_normals && found.contact) return;
    FoundState& state = results_.found.change_state(index);
    state.surface_normal = filtered.surface_normals;
    state.size = static_cast<float>(filtered.size);
    state.reported = static_cast<bool>(filtered.contact);
    if (filtered.own_area) results_.found.set_own_area(index, {found.a, found.b, filtered.own_area});
}

template class World<2>::PairTests;
template class World<3>::PairTests;

}  // namespace abut
