// Pairs of the last update: the items that touch an item, and the contact and impact of a pair.

#include <abut/math/assert.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {
namespace {

/// The entry of a pair in a list sorted by pairs; null if there is none.
template <class Entry>
const Entry* entry_of(std::span<const Entry> list, const IdPair& pair) {
    const IdPair wanted{std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
    const auto place = std::lower_bound(list.begin(), list.end(), wanted, [](const Entry& entry, const IdPair& p) {
        return IdPair{entry.a, entry.b} < p;
    });
    return place != list.end() && IdPair{place->a, place->b} == wanted ? &*place : nullptr;
}

}  // namespace

template <int D>
void World<D>::visit_touching(Id id, FunctionRef<bool(Id)> visit) const {
    const bool is_valid = contains(id);
    ABUT_ASSERT(is_valid);
    if (is_valid) pair_index_.visit(touching_, id, [&](Id other) { return !contains(other) || visit(other); });
}

template <int D>
std::vector<Id> World<D>::touching(Id id) const {
    std::vector<Id> result;
    visit_touching(id, [&](Id other) {
        result.push_back(other);
        return true;
    });
    return result;
}

template <int D>
Contact<D> World<D>::contact(const IdPair& pair) const {
    const WorldContact<D>* found = entry_of(contacts(), pair);
    return found != nullptr ? found->contact : Contact<D>{};
}

template <int D>
std::optional<Hit<D>> World<D>::impact(const IdPair& pair) const {
    const WorldImpact<D>* found = entry_of(std::span<const WorldImpact<D>>(impacts_), pair);
    return found != nullptr ? std::optional(found->hit) : std::nullopt;
}

template class World<2>;
template class World<3>;

}  // namespace abut
