// Worlds of the C API: items, updates and snapshots.

#include <abut/c/detail/world_arguments.hpp>

#include <span>

using namespace abut::detail;

namespace {

template <int D>
using COf = CTypes<D>;

std::span<const std::byte> bytes_of(const uint8_t* bytes, size_t size) {
    return {reinterpret_cast<const std::byte*>(bytes), size};
}

template <int D>
abut_code create(const abut_world_options* options, typename COf<D>::World** out) {
    return entry({present(out, "out")},
                 [&] { *out = new typename COf<D>::World{{.world = abut::World<D>(world_options(options))}}; });
}

template <int D>
abut_code copy(const WorldHandle<D>* world, typename COf<D>::World** out) {
    return entry({present(world, "world"), present(out, "out")},
                 [&] { *out = new typename COf<D>::World{{.world = world->world}}; });
}

template <int D>
abut_code add(WorldHandle<D>* world, const ShapeHandle<D>* shape, const typename COf<D>::ItemOptions* options,
              abut_id* out) {
    return entry({present(world, "world"), present(shape, "shape"), valid<D>(options), present(out, "out")},
                 [&] { *out = to_c(world->world.add(shape->shape, item_options<D>(options))); });
}

template <int D>
abut_code add_many(WorldHandle<D>* world, const ShapeHandle<D>* shape, Strided<typename COf<D>::ItemOptions> options,
                   abut_id* out) {
    return entry({present(world, "world"), present(shape, "shape"), options.fault(), array(out, options.size(), "out")},
                 [&] {
                     std::vector<abut::ItemOptions<D>> own;
                     own.reserve(options.size());
                     for (std::uint32_t i = 0; i < options.size(); ++i) {
                         const auto one = options[i];
                         if (!all_finite(one.pose))
                             return report(Fault{ABUT_NOT_FINITE, "options", "has a pose that is not finite", i});
                         own.push_back(item_options<D>(&one));
                     }
                     std::vector<abut::Id> ids(own.size());
                     world->world.add(shape->shape, std::span<const abut::ItemOptions<D>>(own), std::span(ids));
                     std::transform(ids.begin(), ids.end(), out, [](const abut::Id& id) { return to_c(id); });
                     return ABUT_OK;
                 });
}

/// The first id that is stale, if any.
template <int D>
Fault items_of(const WorldHandle<D>& world, const Strided<abut_id>& ids) {
    for (std::uint32_t i = 0; i < ids.size(); ++i) {
        Fault fault = item_of(&world, ids[i], "ids");
        fault.index = i;
        if (fault.code != ABUT_OK) return fault;
    }
    return {};
}

template <int D>
abut_code move_many(WorldHandle<D>* world, Strided<abut_id> ids, Strided<typename COf<D>::Pose> poses) {
    return entry({present(world, "world"), ids.fault(), poses.fault_of_elements()}, [&] {
        if (const Fault fault = items_of(*world, ids); fault.code != ABUT_OK) return report(fault);
        const auto own_ids = ids.copied<abut::Id>();
        const auto own_poses = poses.template copied<abut::Pose<D>>();
        world->world.move(std::span(own_ids), std::span(own_poses));
        return ABUT_OK;
    });
}

template <int D>
abut_code remove_many(WorldHandle<D>* world, Strided<abut_id> ids) {
    return entry({present(world, "world"), ids.fault()}, [&] {
        if (const Fault fault = items_of(*world, ids); fault.code != ABUT_OK) return report(fault);
        for (std::uint32_t i = 0; i < ids.size(); ++i) {
            const abut::Id id = from_c(ids[i]);
            if (world->world.contains(id)) world->world.remove(id);  // an id may be there twice
        }
        return ABUT_OK;
    });
}

/// Changes an item.
template <int D, class Change>
abut_code change(WorldHandle<D>* world, abut_id id, const Change& change, const Fault& fault = {}) {
    return entry({present(world, "world"), fault, item_of(world, id)}, [&] { change(world->world, from_c(id)); });
}

template <int D>
abut_code set_pair_filter(WorldHandle<D>* world, abut_accepts_pair accepts, void* context) {
    return entry({present(world, "world")}, [&] {
        if (accepts == nullptr)
            world->world.set_pair_filter({});
        else
            world->world.set_pair_filter(
                [accepts, context](abut::Id a, abut::Id b) { return accepts(context, to_c(a), to_c(b)); });
    });
}

/// Writes a property of a world.
template <int D, class T, class Get>
abut_code get(const WorldHandle<D>* world, T* out, const Get& get, const Fault& fault = {}) {
    return entry({present(world, "world"), present(out, "out"), fault}, [&] { *out = get(world->world); });
}

template <int D>
abut_code shape_of(const WorldHandle<D>* world, abut_id id, typename COf<D>::Shape** out) {
    return entry({present(world, "world"), item_of(world, id), present(out, "out")},
                 [&] { return give_shape<D>(world->world.any_shape(from_c(id)), out); });
}

template <int D>
abut_code save(WorldHandle<D>* world, abut_buffer* out) {
    return entry({present(world, "world"), present(out, "out")}, [&] { world->world.save(out->bytes); });
}

template <int D>
abut_code restore(WorldHandle<D>* world, const uint8_t* bytes, size_t size) {
    return entry({present(world, "world"), array(bytes, size, "bytes")}, [&] {
        const auto problem = world->world.restore(bytes_of(bytes, size));
        return problem ? report(*problem) : ABUT_OK;
    });
}

template <int D>
abut_code save_with_shapes(WorldHandle<D>* world, abut_buffer* out) {
    return entry({present(world, "world"), present(out, "out")}, [&] {
        auto bytes = abut::save_with_shapes(world->world);
        if (!bytes) return report(bytes.problem());
        out->bytes = std::move(*bytes);
        return ABUT_OK;
    });
}

template <int D>
abut_code load(const uint8_t* bytes, size_t size, const abut_world_options* options, typename COf<D>::World** out) {
    return entry({array(bytes, size, "bytes"), present(out, "out")}, [&] {
        auto world = abut::load_world<D>(bytes_of(bytes, size), world_options(options));
        if (!world) return report(world.problem());
        *out = new typename COf<D>::World{{.world = std::move(*world)}};
        return ABUT_OK;
    });
}

template <int D>
abut_code update(WorldHandle<D>* world, abut_thread_pool* pool, abut_events* out) {
    return entry({present(world, "world"), present_or_null(pool, "pool"), present(out, "out")}, [&] {
        const abut::Events events = pool == nullptr ? world->world.update() : world->world.update(pool->pool);
        static_assert(sizeof(abut::IdPair) == sizeof(abut_id_pair));
        const auto pairs = [](std::span<const abut::IdPair> list) {
            return reinterpret_cast<const abut_id_pair*>(list.data());
        };
        const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
        *out = {pairs(events.began), events.fractions.data(), pairs(events.stayed), pairs(events.ended),
                count(events.began), count(events.stayed),    count(events.ended)};
    });
}

template <int D, class T, class Range>
abut_code write_list(const WorldHandle<D>* world, List<T> list, const Range& range, const Fault& fault = {}) {
    return entry({present(world, "world"), fault, list.fault()},
                 [&] { list.assign(range(world->world), [](const auto& element) { return to_c(element); }); });
}

template <int D>
abut_code contact_of_pair(const WorldHandle<D>* world, abut_id_pair pair, typename COf<D>::Contact* out) {
    return entry({present(world, "world"), item_of(world, pair.a, "pair.a"), item_of(world, pair.b, "pair.b"),
                  present(out, "out")},
                 [&] {
                     *out = to_c(world->world.contact({from_c(pair.a), from_c(pair.b)}));
                 });
}

template <int D>
std::vector<abut::Id> items(const abut::World<D>& world) {
    std::vector<abut::Id> result;
    result.reserve(world.size());
    world.each_item([&](abut::Id id) { result.push_back(id); });
    return result;
}

}  // namespace

abut_code abut_world_options_default(abut_world_options* out) {
    return entry({present(out, "out")}, [&] { *out = {1}; });
}

abut_code abut_filter_default(abut_filter* out) {
    return entry({present(out, "out")}, [&] {
        const abut::Filter filter;
        *out = {filter.layers, filter.mask, 0, {0, 0}, 0, nullptr, nullptr, nullptr};
    });
}

// The entries of both dimensions.
#define ABUT_C_SETTER(D, name, Type)                                                                 \
    abut_code abut_world##D##_set_##name(abut_world##D* world, abut_id id, Type value) {             \
        return change<D>(world, id, [&](auto& own, abut::Id item) { own.set_##name(item, value); }); \
    }
#define ABUT_C_ENTRIES(D)                                                                                              \
    abut_code abut_item_options##D##_default(abut_item_options##D* out) {                                              \
        return entry({present(out, "out")}, [&] { *out = to_c(abut::ItemOptions<D>()); });                             \
    }                                                                                                                  \
    abut_code abut_world##D##_create(const abut_world_options* options, abut_world##D** out) {                         \
        return create<D>(options, out);                                                                                \
    }                                                                                                                  \
    abut_code abut_world##D##_copy(const abut_world##D* world, abut_world##D** out) {                                  \
        return copy<D>(world, out);                                                                                    \
    }                                                                                                                  \
    void abut_world##D##_release(abut_world##D* world) {                                                               \
        release(world);                                                                                                \
    }                                                                                                                  \
    abut_code abut_world##D##_add(abut_world##D* world, const abut_shape##D* shape,                                    \
                                  const abut_item_options##D* options, abut_id* out) {                                 \
        return add<D>(world, shape, options, out);                                                                     \
    }                                                                                                                  \
    abut_code abut_world##D##_add_many(abut_world##D* world, const abut_shape##D* shape,                               \
                                       const abut_item_options##D* options, uint32_t stride, uint32_t count,           \
                                       abut_id* out) {                                                                 \
        return add_many<D>(world, shape, {options, stride, count, "options"}, out);                                    \
    }                                                                                                                  \
    abut_code abut_world##D##_move(abut_world##D* world, abut_id id, abut_pose##D pose) {                              \
        const auto move = [&](auto& own, abut::Id item) { own.move(item, same_bytes<abut::Pose<D>>(pose)); };          \
        return change<D>(world, id, move, finite(pose, "pose"));                                                       \
    }                                                                                                                  \
    abut_code abut_world##D##_move_many(abut_world##D* world, const abut_id* ids, uint32_t id_stride,                  \
                                        const abut_pose##D* poses, uint32_t pose_stride, uint32_t count) {             \
        return move_many<D>(world, {ids, id_stride, count, "ids"}, {poses, pose_stride, count, "poses"});              \
    }                                                                                                                  \
    abut_code abut_world##D##_set_shape(abut_world##D* world, abut_id id, const abut_shape##D* shape) {                \
        const auto set = [&](auto& own, abut::Id item) { own.set_shape(item, shape->shape); };                         \
        return change<D>(world, id, set, present(shape, "shape"));                                                     \
    }                                                                                                                  \
    abut_code abut_world##D##_set_filter(abut_world##D* world, abut_id id, abut_layers layers) {                       \
        return change<D>(world, id,                                                                                    \
                         [&](auto& own, abut::Id item) { own.set_filter(item, layers.layers, layers.mask); });         \
    }                                                                                                                  \
    ABUT_C_SETTER(D, user, uint64_t)                                                                                   \
    ABUT_C_SETTER(D, fixed, bool)                                                                                      \
    ABUT_C_SETTER(D, sensor, bool)                                                                                     \
    ABUT_C_SETTER(D, continuous, bool)                                                                                 \
    ABUT_C_SETTER(D, group, int32_t)                                                                                   \
    ABUT_C_SETTER(D, enabled, bool)                                                                                    \
    abut_code abut_world##D##_set_pair_filter(abut_world##D* world, abut_accepts_pair accepts, void* context) {        \
        return set_pair_filter<D>(world, accepts, context);                                                            \
    }                                                                                                                  \
    abut_code abut_world##D##_remove(abut_world##D* world, abut_id id) {                                               \
        return change<D>(world, id, [](auto& own, abut::Id item) { own.remove(item); });                               \
    }                                                                                                                  \
    abut_code abut_world##D##_remove_many(abut_world##D* world, const abut_id* ids, uint32_t stride, uint32_t count) { \
        return remove_many<D>(world, {ids, stride, count, "ids"});                                                     \
    }                                                                                                                  \
    abut_code abut_world##D##_contains(const abut_world##D* world, abut_id id, bool* out) {                            \
        return get<D>(world, out, [&](const auto& own) { return own.contains(from_c(id)); });                          \
    }                                                                                                                  \
    abut_code abut_world##D##_size(const abut_world##D* world, uint32_t* out) {                                        \
        return get<D>(world, out, [](const auto& own) { return static_cast<uint32_t>(own.size()); });                  \
    }                                                                                                                  \
    abut_code abut_world##D##_items(const abut_world##D* world, abut_id* out, uint32_t capacity, uint32_t* count) {    \
        return write_list<D, abut_id>(world, {out, capacity, count}, [](const auto& own) { return items<D>(own); });   \
    }                                                                                                                  \
    abut_code abut_world##D##_options(const abut_world##D* world, abut_id id, abut_item_options##D* out) {             \
        return get<D>(                                                                                                 \
            world, out, [&](const auto& own) { return to_c(own.options(from_c(id))); }, item_of<D>(world, id));        \
    }                                                                                                                  \
    abut_code abut_world##D##_shape(const abut_world##D* world, abut_id id, abut_shape##D** out) {                     \
        return shape_of<D>(world, id, out);                                                                            \
    }                                                                                                                  \
    abut_code abut_world##D##_save(abut_world##D* world, abut_buffer* out) {                                           \
        return save<D>(world, out);                                                                                    \
    }                                                                                                                  \
    abut_code abut_world##D##_restore(abut_world##D* world, const uint8_t* bytes, size_t size) {                       \
        return restore<D>(world, bytes, size);                                                                         \
    }                                                                                                                  \
    abut_code abut_world##D##_save_with_shapes(abut_world##D* world, abut_buffer* out) {                               \
        return save_with_shapes<D>(world, out);                                                                        \
    }                                                                                                                  \
    abut_code abut_world##D##_load(const uint8_t* bytes, size_t size, const abut_world_options* options,               \
                                   abut_world##D** out) {                                                              \
        return load<D>(bytes, size, options, out);                                                                     \
    }                                                                                                                  \
    abut_code abut_world##D##_update(abut_world##D* world, abut_thread_pool* pool, abut_events* out) {                 \
        return update<D>(world, pool, out);                                                                            \
    }                                                                                                                  \
    abut_code abut_world##D##_refresh(abut_world##D* world) {                                                          \
        return entry({present(world, "world")}, [&] { world->world.refresh(); });                                      \
    }                                                                                                                  \
    abut_code abut_world##D##_contacts(const abut_world##D* world, abut_world_contact##D* out, uint32_t capacity,      \
                                       uint32_t* count) {                                                              \
        return write_list<D, abut_world_contact##D>(world, {out, capacity, count},                                     \
                                                    [](const auto& own) { return own.contacts(); });                   \
    }                                                                                                                  \
    abut_code abut_world##D##_impacts(const abut_world##D* world, abut_world_impact##D* out, uint32_t capacity,        \
                                      uint32_t* count) {                                                               \
        return write_list<D, abut_world_impact##D>(world, {out, capacity, count},                                      \
                                                   [](const auto& own) { return own.impacts(); });                     \
    }                                                                                                                  \
    abut_code abut_world##D##_contact(const abut_world##D* world, abut_id_pair pair, abut_contact##D* out) {           \
        return contact_of_pair<D>(world, pair, out);                                                                   \
    }                                                                                                                  \
    abut_code abut_world##D##_touching(const abut_world##D* world, abut_id id, abut_id* out, uint32_t capacity,        \
                                       uint32_t* count) {                                                              \
        return write_list<D, abut_id>(                                                                                 \
            world, {out, capacity, count}, [&](const auto& own) { return own.touching(from_c(id)); },                  \
            item_of<D>(world, id));                                                                                    \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES
#undef ABUT_C_SETTER
