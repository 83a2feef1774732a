// Which of the contacts that an update has found it reports: not the ghosts that others cover (docs/ghosts.md). And
// which contacts of items at rest are to be found anew.

#include <abut/world/detail/update_state.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <span>
#include <utility>

#include <hwy/cache_control.h>

namespace abut {

using namespace detail;

/// Whether contacts of the item are filtered for its sake. A fixed item is not pushed, so no normal matters to it.
template <int D>
bool World<D>::filters_edges(std::uint32_t slot) const {
    return filters_edges_ && !items_[slot].fixed;
}

/// Marks the items near which another one has changed.
template <int D>
void World<D>::find_changed_neighbours() {
    std::vector<char>& changed = memory_->neighbour_changed;
    changed.assign(items_.size(), false);
    const auto mark = [&](const std::vector<SlotPair>& pairs, const std::vector<SlotPair>& others) {
        for (const SlotPair& pair : pairs) {
            const auto& [a, b] = pair;
            // A pair filter may change its answer for items that did not change.
            const bool is_new = filters_pairs_ && !std::binary_search(others.begin(), others.end(), pair);
            if (is_new || has_changed_near(a, b)) changed[b] = true;
            if (is_new || has_changed_near(b, a)) changed[a] = true;
        }
    };
    mark(near_, last_near_);
    mark(last_near_, near_);
}

/// Whether an item near one of the two has changed.
template <int D>
bool World<D>::neighbours_changed(const SlotPair& pair) {
    if (filters_edges_) memory_->find_neighbour_changed.run([this] { find_changed_neighbours(); });
    const auto& [a, b] = pair;
    return (filters_edges(a) && memory_->neighbour_changed[a]) || (filters_edges(b) && memory_->neighbour_changed[b]);
}

/// Whether another reported contact of the item covers a contact with a substitute normal, a ghost.
template <int D>
bool World<D>::is_covered(std::size_t ghost, const Id& item) const {
    const auto normal_from_item = [&](const WorldContact<D>& contact) {
        return DVec<D>(contact.contact.normal) * (contact.a == item ? 1.0 : -1.0);
    };
    const WorldContact<D>& result = results_.found.contacts[ghost];
    const std::uint32_t slot = item.index - 1;
    if (!filters_edges(slot)) return false;
    for (std::uint32_t link = memory_->last_found[slot]; link != none; link = memory_->found_before[link]) {
        const std::size_t other = link / 2;
        const WorldContact<D>& cover = results_.found.contacts[other];
        if (results_.found.state(other).reported && other != ghost &&
            covers_contact<D>(normal_from_item(cover), static_cast<double>(cover.contact.depth),
                              normal_from_item(result), static_cast<double>(result.contact.depth),
                              static_cast<double>(results_.found.state(ghost).size)))
            return true;
    }
    return false;
}

/// Links the contacts of each item.
template <int D>
void World<D>::link_contacts() {
    std::vector<std::uint32_t>& last = memory_->last_found;
    last.assign(items_.size(), none);
    std::vector<std::uint32_t>& before = memory_->found_before;
    const std::vector<WorldContact<D>>& contacts = results_.found.contacts;
    before.resize(std::max(before.size(), 2 * contacts.size()));
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
        before[2 * i] = std::exchange(last[contacts[i].a.index - 1], 2 * i);
        before[2 * i + 1] = std::exchange(last[contacts[i].b.index - 1], 2 * i + 1);
    }
}

/// Whether a contact is reported, by ids in their order. Contacts with surface normals are; a ghost that one of these
/// or a ghost before it covers is not.
template <int D>
bool World<D>::is_reported(std::size_t found) {
    FoundState& state = results_.found.change_state(found);
    const WorldContact<D>& contact = results_.found.contacts[found];
    if (!state.surface_normal && contact.contact)
        state.reported = (state.surface_normal.a || !is_covered(found, contact.a)) &&
                         (state.surface_normal.b || !is_covered(found, contact.b));
    return state.reported;
}

/// Lists the touching pairs and the reported contacts, both sorted. A ghost that isn't reported has the area that its
/// items have on the surface instead, if they have any, so that they still hold each other.
template <int D>
void World<D>::list_results() {
    constexpr std::size_t ahead = 8, cache_line = 64;
    FoundContacts<D>& found = results_.found;
    bool any_ghost = false;
    for (FoundState& state : found.states) {
        const bool is_ghost = !state.surface_normal;
        any_ghost = any_ghost || is_ghost;
        state.reported = state.reported && !is_ghost;
    }
    if (any_ghost) link_contacts();
    const std::span<const TouchingSlots> touches = results_.touching;
    std::swap(touching_, last_touching_);
    touching_.resize(touches.size());
    contacts_.resize(found.size());
    IdPair* pair = touching_.data();
    WorldContact<D>* contact = contacts_.data();
    const bool are_cached = items_.size() <= detail::max_cached_items;
    for (std::size_t i = 0; i < touches.size(); ++i) {
        // The contacts are in memory in the order of the tests.
        if (!are_cached) {
            const std::size_t later = touches[std::min(i + ahead, touches.size() - 1)].begin;
            const char* const next = reinterpret_cast<const char*>(found.contacts.data() + later);
            for (std::size_t at = 0; at < sizeof(WorldContact<D>); at += cache_line) hwy::Prefetch(next + at);
            if (later < found.states.size()) hwy::Prefetch(&found.states[later]);
        }
        const auto& [slots, begin, end] = touches[i];
        if (begin < end)
            *pair++ = {found.contacts[begin].a, found.contacts[begin].b};
        else
            *pair++ = {id_of(slots.a), id_of(slots.b)};
        for (std::size_t k = begin; k < end; ++k) {
            if (found.state(k).reported || is_reported(k))
                *contact++ = found.contacts[k];
            else if (const std::uint32_t area = found.state(k).own_area; area != FoundState::no_own_area)
                *contact++ = found.own_areas[area];
        }
    }
    contacts_.resize(static_cast<std::size_t>(contact - contacts_.data()));
}

template class World<2>;
template class World<3>;

}  // namespace abut
