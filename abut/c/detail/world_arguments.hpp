#pragma once

// Ids, options and filters of the C API as those of a World. For .cpp files.

#include <abut/c/detail/answers.hpp>

namespace abut::detail {

/// An item that the world has.
template <int D>
Fault item_of(const WorldHandle<D>* world, const abut_id& id, const char* name = "id") {
    if (world == nullptr || world->tag != WorldHandle<D>::own_tag) return {};  // another fault
    return world->world.contains(from_c(id)) ? Fault() : Fault{ABUT_STALE_ID, name, "is of no item of the world"};
}

template <int D>
Fault valid(const typename CTypes<D>::ItemOptions* options) {
    return options == nullptr ? Fault() : finite(options->pose, "options->pose");
}
template <int D>
ItemOptions<D> item_options(const typename CTypes<D>::ItemOptions* options) {
    ItemOptions<D> result;
    if (options == nullptr) return result;
    result.pose = same_bytes<Pose<D>>(options->pose);
    result.user = options->user;
    result.layers = options->layers;
    result.mask = options->mask;
    result.fixed = options->fixed != 0;
    result.sensor = options->sensor != 0;
    result.continuous = options->continuous != 0;
    result.group = options->group;
    result.enabled = options->enabled != 0;
    return result;
}
template <int D>
typename CTypes<D>::ItemOptions to_c(const ItemOptions<D>& options) {
    return {same_bytes<typename CTypes<D>::Pose>(options.pose),
            options.user,
            options.layers,
            options.mask,
            options.fixed ? 1u : 0u,
            options.sensor ? 1u : 0u,
            options.continuous ? 1u : 0u,
            options.group,
            options.enabled ? 1u : 0u};
}

inline WorldOptions world_options(const abut_world_options* options) {
    WorldOptions result;
    if (options != nullptr) result.filter_edges = options->filter_edges != 0;
    return result;
}

inline Fault valid(const abut_filter* filter) {
    return filter == nullptr ? Fault() : array(filter->ignore_ids, filter->ignore_count, "filter->ignore_ids");
}

/// A filter, which refers to that of the caller.
class FilterArgument {
public:
    explicit FilterArgument(const abut_filter* filter) {
        if (filter == nullptr) return;
        filter_.layers = filter->layers;
        filter_.mask = filter->mask;
        filter_.sensors = filter->sensors != 0;
        filter_.ignore = from_c(filter->ignore);
        static_assert(sizeof(Id) == sizeof(abut_id));
        filter_.ignore_ids = {reinterpret_cast<const Id*>(filter->ignore_ids), filter->ignore_count};
        if (filter->accepts == nullptr) return;
        call_ = {filter->accepts, filter->context};
        filter_.accepts = FunctionRef<bool(Id)>(call_);
    }
    FilterArgument(const FilterArgument&) = delete;
    FilterArgument& operator=(const FilterArgument&) = delete;

    const Filter& operator*() const { return filter_; }

private:
    struct Call {
        abut_accepts accepts = nullptr;
        void* context = nullptr;
        bool operator()(Id id) const { return accepts(context, to_c(id)); }
    };

    Call call_;
    Filter filter_;
};

}  // namespace abut::detail
