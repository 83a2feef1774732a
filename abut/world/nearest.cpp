// Queries for the nearest items of a world. The broad phases visit the items front to back.

#include <abut/query/detail/valid_query.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {
namespace {

/// A strict total order: by distance, then by id.
template <int D>
bool is_nearer(const WorldClosest<D>& a, const WorldClosest<D>& b) {
    return a.closest.distance != b.closest.distance ? a.closest.distance < b.closest.distance : a.id < b.id;
}

}  // namespace

template <int D>
std::size_t World<D>::nearest_to(const View<D>& shape, std::span<WorldClosest<D>> out, const Query& query) const {
    if (!detail::is_valid_query(shape) || out.empty()) return 0;
    query_count_.add(detail::ray_weight);
    // `out` is a heap with the farthest item at its front.
    std::size_t count = 0;
    const auto heap = [&] { return out.first(count); };
    float reach = std::numeric_limits<float>::infinity();
    const auto visit = [&](std::uint32_t slot) -> float {
        const Item& item = items_[slot];
        if (!passes(slot, query.filter) ||
            (std::holds_alternative<detail::HalfSpaceView<D>>(shape) && item.type == detail::ShapeType::half_space))
            return reach;
        const WorldClosest<D> found{id_of(slot), abut::closest(shape, placed(slot, query.origin))};
        if (std::isinf(found.closest.distance)) return reach;
        if (count == out.size()) {
            if (!is_nearer(found, out.front())) return reach;
            std::pop_heap(heap().begin(), heap().end(), is_nearer<D>);
            --count;
        }
        out[count++] = found;
        std::push_heap(heap().begin(), heap().end(), is_nearer<D>);
        if (count == out.size()) reach = std::max(out.front().closest.distance, 0.0f);
        return reach;
    };
    Aabb<D> box = bounds(shape);
    if (positions_.are_used()) box = positions_.about_origin(box, query.origin);
    moving_.closest(box, visit, reach);
    fixed_.closest(box, visit, reach);
    std::sort_heap(heap().begin(), heap().end(), is_nearer<D>);
    return count;
}

template <int D>
std::optional<WorldClosest<D>> World<D>::closest_to(const View<D>& shape, const Query& query) const {
    WorldClosest<D> nearest;
    if (nearest_to(shape, {&nearest, 1}, query) == 0) return std::nullopt;
    return nearest;
}

template <int D>
std::vector<WorldClosest<D>> World<D>::list_of_nearest(const View<D>& shape, std::size_t k, const Query& query) const {
    std::vector<WorldClosest<D>> result(std::min(k, count_));
    result.resize(nearest_to(shape, result, query));
    return result;
}

template class World<2>;
template class World<3>;

}  // namespace abut
