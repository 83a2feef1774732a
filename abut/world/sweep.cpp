// Sweeps through a world: the broad phases visit the items in the order in which the mover's box reaches them.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/sweep.hpp>
#include <abut/world/world.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
detail::SweptBox<D> swept_box_of_shape(const View<D>& shape, const Motion<D>& motion) {
    return detail::swept_box(detail::bounding_ball(shape), bounds(moved(shape, affine(motion.from))), motion);
}

template <int D>
MoverAtHit<D> mover_of(const View<D>& shape, const RigidPath<D>& path, const Hit<D>& hit) {
    return rotating_mover_at_hit(shape, path, static_cast<double>(hit.fraction), DVec<D>(hit.point));
}

}  // namespace

/// The first hit on a path; `sweep_at(slot)` returns the hit on one item.
template <int D>
template <class F>
std::optional<WorldHit<D>> World<D>::first_on_path(const View<D>& shape, const detail::SweptBox<D>& path,
                                                   const Query& query, F&& sweep_at) const {
    std::optional<WorldHit<D>> first;
    if (is_empty(path.box)) return first;
    query_count_.add(detail::ray_weight);
    MovingBox<D> moving = moving_box(path);
    if (positions_.are_used()) moving = positions_.about_origin(moving, query.origin);
    // This test rejects the items that a broad phase visits by rounding, so that no kind of broad phase tests more.
    const RayReach<D> whole = RayReach<D>::of_box(moving);
    float reach = 1;
    const auto visit = [&](std::uint32_t slot) -> float {
        const Item& item = items_[slot];
        double enters = 0;
        if (!passes(slot, query.filter) || (!whole.is_exhausted() && !whole.measure(box(slot), enters))) return reach;
        if (std::holds_alternative<HalfSpaceView<D>>(shape) && item.type == ShapeType::half_space) return reach;
        const std::optional<Hit<D>> hit = sweep_at(slot);
        if (!hit || hit->fraction > reach) return reach;
        const Id id = id_of(slot);
        if (!first || hit->fraction < reach || id < first->id) first = WorldHit<D>{id, *hit};
        return reach = first->hit.fraction;
    };
    for (const detail::ItemBoxes<D>* items : {&moving_, &fixed_}) {
        if (whole.is_exhausted()) {
            // The path is unbounded, such as that of a half-space.
            constexpr float far = std::numeric_limits<float>::infinity();
            items->each_overlapping(Aabb<D>{Vec<D>(-far), Vec<D>(far)}, [&](std::uint32_t slot) {
                visit(slot);
                return true;
            });
        } else {
            items->sweep(moving, visit);
        }
    }
    return first;
}

/// Whether another item may be as near to a hit as the filter of its normal looks: twice as far as the mover's centre.
template <int D>
bool World<D>::has_other_item_near(const MoverAtHit<D>& mover, const Query& query, const WorldHit<D>& hit) const {
    if (!std::isfinite(mover.size)) return false;
    const DVec<D> place(hit.hit.point);
    const double reach = 2.01 * length(mover.center - place) + 4 * surface_probe_scale * mover.size;
    bool result = false;
    visit_in_box(box_around(place, reach), query, [&](Id id, const View<D>&) {
        result = id != hit.id;
        return !result;
    });
    return result;
}

/// Replaces the hit's normal by a surface normal of the union of all items, without internal edges (docs/ghosts.md).
template <int D>
void World<D>::filter_normal(const MoverAtHit<D>& mover, const Query& query, WorldHit<D>& hit) const {
    const auto beside_hit = [&](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
        visit_in_box(box_around(from, within), query, [&](Id id, const View<D>& item) {
            if (id != hit.id)
                each_closest_point_on<D>(item, from, within,
                                         [&](const ClosestPoint<D>& closest) { return within = visit(closest); });
            return within > stop_visiting;
        });
    };
    const EachClosestPoint<D> neighbours(beside_hit);
    filter_hit_normal<D>(mover, placed(hit.id.index - 1, query.origin), &neighbours, hit.hit);
}

template <int D>
std::optional<WorldHit<D>> World<D>::sweep_linear(const View<D>& shape, const Vec<D>& motion,
                                                  const Query& query) const {
    if (!detail::is_valid_query(shape, motion)) return std::nullopt;
    std::optional<WorldHit<D>> first =
        first_on_path(shape, detail::swept_box(bounds(shape), motion), query,
                      [&](std::uint32_t slot) { return sweep_unfiltered(shape, motion, placed(slot, query.origin)); });
    if (!first) return first;
    const MoverAtHit<D> mover =
        linear_mover_at_hit<D>(shape, DVec<D>(motion) * static_cast<double>(first->hit.fraction));
    // A composite shape is a surface of its own first, which mostly has no other item near it.
    const std::uint32_t slot = first->id.index - 1;
    if (std::holds_alternative<Composite<D>>(items_[slot].stored.view())) {
        filter_hit_normal<D>(mover, placed(slot, query.origin), nullptr, first->hit);
        if (!has_other_item_near(mover, query, *first)) return first;
    }
    filter_normal(mover, query, *first);
    return first;
}

template <int D>
std::optional<WorldHit<D>> World<D>::sweep_rotating(const View<D>& shape, const Motion<D>& motion,
                                                    const Query& query) const {
    if (!detail::is_valid_query(shape, motion)) return std::nullopt;
    std::optional<WorldHit<D>> first =
        first_on_path(shape, swept_box_of_shape(shape, motion), query, [&](std::uint32_t slot) {
            const Motion<D> at_rest{.from = pose_about(slot, query.origin)};
            return abut::sweep(shape, motion, items_[slot].stored.view(), at_rest);
        });
    if (first) filter_normal(mover_of(shape, rigid_path(motion), first->hit), query, *first);
    return first;
}

template <int D>
std::optional<WorldHit<D>> World<D>::sweep_between(const View<D>& shape, const Pose<D>& from, const Pose<D>& to,
                                                   const Query& query) const {
    if (!detail::is_valid_query(shape, from, to)) return std::nullopt;
    std::optional<WorldHit<D>> first =
        first_on_path(shape, swept_box_of_shape(shape, Motion<D>::between(from, to)), query, [&](std::uint32_t slot) {
            const Pose<D> there = pose_about(slot, query.origin);
            return abut::sweep(shape, from, to, items_[slot].stored.view(), there, there);
        });
    if (first) filter_normal(mover_of(shape, rigid_path(from, to), first->hit), query, *first);
    return first;
}

template class World<2>;
template class World<3>;

}  // namespace abut
