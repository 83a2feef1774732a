// Pairs of the last update: the items that touch an item, and the contact and impact of a pair.

#include <abut/math/assert.hpp>
#include <abut/world/world.hpp>

namespace abut {
using detail::entries_of;

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
void World<D>::visit_contacts_of(Id id, FunctionRef<bool(const WorldContact<D>&)> visit) const {
    bool go_on = true;
    visit_touching(id, [&](Id other) {
        for (const WorldContact<D>& found : entries_of(contacts(), {id, other}))
            if (go_on = visit(found); !go_on) break;
        return go_on;
    });
}

template <int D>
Contact<D> World<D>::contact(const IdPair& pair) const {
    const auto found = entries_of(contacts(), pair);
    return found.empty() ? Contact<D>{} : found.front().contact;
}

template <int D>
std::optional<Hit<D>> World<D>::impact(const IdPair& pair) const {
    const auto found = entries_of(std::span<const WorldImpact<D>>(results_.impacts), pair);
    return found.empty() ? std::nullopt : std::optional(found.front().hit);
}

template class World<2>;
template class World<3>;

}  // namespace abut
