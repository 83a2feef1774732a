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
    std::vector<FoundState> states;  ///< by index in contacts; it ends where all that follow have the default state
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
    /// For as many contacts as another list has memory for.
    void reserve_like(const FoundContacts& other) {
        reserve(other.contacts.capacity());
        own_areas.reserve(other.own_areas.capacity());
    }
    const FoundState& state(std::size_t index) const { return index < states.size() ? states[index] : default_state; }
    /// The state of a contact, to be changed.
    FoundState& change_state(std::size_t index) {
        if (states.size() <= index) states.resize(index + 1);
        return states[index];
    }
    /// Adds contacts `begin` to `end - 1` of a list.
    void append(const FoundContacts& from, std::size_t begin, std::size_t end) {
        const std::size_t first = size();
        contacts.insert(contacts.end(), from.contacts.begin() + static_cast<std::ptrdiff_t>(begin),
                        from.contacts.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t i = begin; i < std::min(end, from.states.size()); ++i) {
            change_state(first + i - begin) = from.states[i];
            if (const std::uint32_t area = from.states[i].own_area; area != FoundState::no_own_area)
                set_own_area(first + i - begin, from.own_areas[area]);
        }
    }
    void set_own_area(std::size_t index, const WorldContact<D>& area) {
        change_state(index).own_area = static_cast<std::uint32_t>(own_areas.size());
        own_areas.push_back(area);
    }
    WorldContact<D>& add(const IdPair& pair) {
        WorldContact<D>& added = contacts.emplace_back(no_contact);
        added.a = pair.a;
        added.b = pair.b;
        return added;
    }
    /// Removes the last contact, whose state was not changed.
    void pop_back() { contacts.pop_back(); }

private:
    /// To copy: compilers clear a new contact byte by byte.
    static inline const WorldContact<D> no_contact{};
    static constexpr FoundState default_state{};
};

}  // namespace abut::detail
