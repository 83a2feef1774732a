#pragma once

// The contacts that an update of a world finds, and what the filter of internal edges knows of them.

#include <abut/query/detail/surface/surface_normal_flags.hpp>
#include <abut/world/results.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// The entries of a pair, in any order of its ids, in a list sorted by pairs.
template <class Entry>
std::span<const Entry> entries_of(std::span<const Entry> list, const IdPair& pair) {
    const IdPair wanted{std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
    const auto pair_of = [](const Entry& entry) { return IdPair{entry.a, entry.b}; };
    const auto first =
        std::partition_point(list.begin(), list.end(), [&](const Entry& entry) { return pair_of(entry) < wanted; });
    const auto end = std::find_if(first, list.end(), [&](const Entry& entry) { return pair_of(entry) != wanted; });
    return {first, end};
}

/// What else is known of a contact of a touching pair.
struct FoundState {
    static constexpr std::uint32_t no_own_area = 0xFFFFFFFF;

    /// False for an item if the normal is a substitute for one of an internal edge.
    SurfaceNormalFlags surface_normal;
    float size = 0;                        ///< then that of the smaller item
    bool reported = true;                  ///< whether it is among World::contacts()
    std::uint32_t own_area = no_own_area;  ///< of a ghost: the index of its points on the faces of the two items
};

/// Contacts of touching pairs, before ghost contacts are dropped.
template <int D>
struct FoundContacts {
    std::vector<WorldContact<D>> contacts;
    std::vector<FoundState> states;  ///< by index in contacts
    std::vector<WorldContact<D>> own_areas;

    std::size_t size() const { return contacts.size(); }
    void clear() {
        contacts.clear();
        states.clear();
        own_areas.clear();
    }
    void reserve(std::size_t count) {
        contacts.reserve(count);
        states.reserve(count);
    }
    void reserve_like(const FoundContacts& other) {
        contacts.reserve(other.contacts.capacity());
        states.reserve(other.states.capacity());
        own_areas.reserve(other.own_areas.capacity());
    }
    void append(const FoundContacts& later) {
        const auto first_area = static_cast<std::uint32_t>(own_areas.size());
        const std::size_t first = states.size();
        contacts.insert(contacts.end(), later.contacts.begin(), later.contacts.end());
        states.insert(states.end(), later.states.begin(), later.states.end());
        own_areas.insert(own_areas.end(), later.own_areas.begin(), later.own_areas.end());
        for (FoundState& state : std::span(states).subspan(first))
            if (state.own_area != FoundState::no_own_area) state.own_area += first_area;
    }
    void set_own_area(std::size_t index, const WorldContact<D>& area) {
        states[index].own_area = static_cast<std::uint32_t>(own_areas.size());
        own_areas.push_back(area);
    }
    WorldContact<D>& add(const IdPair& pair, const FoundState& state) {
        states.push_back(state);
        WorldContact<D>& added = contacts.emplace_back();
        added.a = pair.a;
        added.b = pair.b;
        return added;
    }
    void pop_back() {
        contacts.pop_back();
        states.pop_back();
    }
};

}  // namespace abut::detail
