// The options of an item: reading and changing them.

#include <abut/world/world.hpp>

namespace abut {

template <int D>
ItemOptions<D> World<D>::options(Id id) const {
    const Item* item = expected(id);
    if (item == nullptr) return {.layers = 0, .mask = 0, .enabled = false};
    return item->options();
}

template <int D>
std::uint64_t World<D>::layers(Id id) const {
    return options(id).layers;
}
template <int D>
std::uint64_t World<D>::mask(Id id) const {
    return options(id).mask;
}
template <int D>
std::int32_t World<D>::group(Id id) const {
    return options(id).group;
}
template <int D>
bool World<D>::is_fixed(Id id) const {
    return options(id).fixed;
}
template <int D>
bool World<D>::is_sensor(Id id) const {
    return options(id).sensor;
}
template <int D>
bool World<D>::is_continuous(Id id) const {
    return options(id).continuous;
}
template <int D>
bool World<D>::is_enabled(Id id) const {
    return options(id).enabled;
}

template <int D>
void World<D>::set_user(Id id, std::uint64_t user) {
    Item* item = expected(id);
    if (item != nullptr) item->user = user;
}

template <int D>
void World<D>::set_fixed(Id id, bool fixed) {
    Item* item = expected(id);
    if (item == nullptr || item->fixed == fixed) return;
    const Aabb<D> own = box(id.index - 1);
    boxes_of(*item).remove(item->place);
    item->fixed = fixed;
    add_to_boxes(id.index - 1);
    boxes_of(*item).set(item->place, own);
    mark_pending(id.index - 1);
}

template <int D>
void World<D>::set_sensor(Id id, bool sensor) {
    Item* item = expected(id);
    if (item == nullptr || item->sensor == sensor) return;
    item->sensor = sensor;
    mark_pending(id.index - 1);
}

template <int D>
void World<D>::set_continuous(Id id, bool continuous) {
    Item* item = expected(id);
    if (item == nullptr || item->continuous == continuous) return;
    item->continuous = continuous;
    if (continuous)
        ++continuous_;
    else
        --continuous_;
}

template <int D>
void World<D>::set_group(Id id, std::int32_t group) {
    Item* item = expected(id);
    if (item == nullptr || item->group == group) return;
    item->group = group;
    mark_pending(id.index - 1);
}

template <int D>
void World<D>::set_enabled(Id id, bool enabled) {
    Item* item = expected(id);
    if (item == nullptr || item->enabled == enabled) return;
    item->enabled = enabled;
    reset_item(id.index - 1);
}

template <int D>
void World<D>::visit_items(FunctionRef<bool(Id)> visit) const {
    for (std::uint32_t slot = 0; slot < items_.size(); ++slot)
        if (const Id id = id_of(slot); find(id) != nullptr && !visit(id)) return;
}

template class World<2>;
template class World<3>;

}  // namespace abut
