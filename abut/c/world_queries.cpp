// The questions of the C API about worlds, one by one and many at once.

#include <abut/c/detail/world_arguments.hpp>

#include <algorithm>
#include <span>
#include <tuple>

using namespace abut::detail;

namespace {

template <int D>
using COf = CTypes<D>;

/// Answers a question about a world: `question(world, filter)`.
template <int D, class Question>
abut_code answer(const WorldHandle<D>* world, const abut_filter* filter, std::initializer_list<Fault> faults,
                 const Question& question) {
    for (const Fault& fault : {present(world, "world"), valid(filter)})
        if (fault.code != ABUT_OK) return report(fault);
    return entry(faults, [&] {
        const FilterArgument own(filter);
        question(world->world, *own);
    });
}

constexpr auto as_c = [](const auto& element) { return to_c(element); };

template <int D>
abut_code raycast_of(const WorldHandle<D>* world, typename COf<D>::Ray ray, const abut_filter* filter,
                     typename COf<D>::WorldHit* out) {
    return answer<D>(world, filter, {finite(ray, "ray"), present(out, "out")}, [&](const auto& own, const auto& by) {
        *out = to_c(own.raycast(same_bytes<abut::Ray<D>>(ray), by));
    });
}

template <int D>
abut_code raycast_any_of(const WorldHandle<D>* world, typename COf<D>::Ray ray, const abut_filter* filter, bool* out) {
    return answer<D>(world, filter, {finite(ray, "ray"), present(out, "out")}, [&](const auto& own, const auto& by) {
        *out = own.raycast_any(same_bytes<abut::Ray<D>>(ray), by);
    });
}

template <int D>
abut_code raycast_all_of(const WorldHandle<D>* world, typename COf<D>::Ray ray, const abut_filter* filter,
                         List<typename COf<D>::WorldHit> list) {
    return answer<D>(world, filter, {finite(ray, "ray"), list.fault()}, [&](const auto& own, const auto& by) {
        list.assign(own.raycast_all(same_bytes<abut::Ray<D>>(ray), by), as_c);
    });
}

template <int D>
abut_code sweep_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, typename COf<D>::Vec motion,
                   const abut_filter* filter, typename COf<D>::WorldHit* out) {
    return answer<D>(world, filter, {present(shape, "shape"), finite(motion, "motion"), present(out, "out")},
                     [&](const auto& own, const auto& by) {
                         *out = to_c(own.sweep(shape->shape, same_bytes<abut::Vec<D>>(motion), by));
                     });
}

template <int D>
abut_code sweep_motion_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, typename COf<D>::Motion motion,
                          const abut_filter* filter, typename COf<D>::WorldHit* out) {
    return answer<D>(world, filter, {present(shape, "shape"), finite(motion, "motion"), present(out, "out")},
                     [&](const auto& own, const auto& by) {
                         *out = to_c(own.sweep(shape->shape, same_bytes<abut::Motion<D>>(motion), by));
                     });
}

template <int D>
abut_code closest_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, const abut_filter* filter,
                     typename COf<D>::WorldClosest* out) {
    return answer<D>(world, filter, {present(shape, "shape"), present(out, "out")},
                     [&](const auto& own, const auto& by) { *out = to_c(own.closest(shape->shape, by)); });
}

template <int D>
abut_code closest_to_point(const WorldHandle<D>* world, typename COf<D>::Vec point, const abut_filter* filter,
                           typename COf<D>::WorldClosest* out) {
    return answer<D>(
        world, filter, {finite(point, "point"), present(out, "out")},
        [&](const auto& own, const auto& by) { *out = to_c(own.closest(same_bytes<abut::Vec<D>>(point), by)); });
}

template <int D>
abut_code k_nearest_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, const abut_filter* filter,
                       std::uint32_t capacity, List<typename COf<D>::WorldClosest> list) {
    return answer<D>(world, filter, {present(shape, "shape"), list.fault()}, [&](const auto& own, const auto& by) {
        list.assign(own.k_nearest(shape->shape, std::min<std::size_t>(capacity, own.size()), by), as_c);
    });
}

template <int D>
abut_code overlapping_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, const abut_filter* filter,
                         List<abut_id> list) {
    return answer<D>(world, filter, {present(shape, "shape"), list.fault()},
                     [&](const auto& own, const auto& by) { list.assign(own.overlapping(shape->shape, by), as_c); });
}

template <int D>
abut_code each_overlapping_of(const WorldHandle<D>* world, const ShapeHandle<D>* shape, const abut_filter* filter,
                              abut_accepts visit, void* context) {
    const Fault fault = visit == nullptr ? Fault{ABUT_NULL_ARGUMENT, "visit", "is null"} : Fault();
    return answer<D>(world, filter, {present(shape, "shape"), fault}, [&](const auto& own, const auto& by) {
        own.each_overlapping(
            shape->shape, [&](abut::Id id) -> bool { return visit(context, to_c(id)); }, by);
    });
}

template <int D>
abut_code each_contact_of_shape(const WorldHandle<D>* world, const ShapeHandle<D>* shape, const abut_filter* filter,
                                const abut_query_options* options, List<typename COf<D>::WorldContact> list) {
    return answer<D>(
        world, filter, {present(shape, "shape"), valid(options), list.fault()}, [&](const auto& own, const auto& by) {
            std::vector<abut::WorldContact<D>> found;
            own.each_contact(
                shape->shape,
                [&](abut::Id id, const abut::Contact<D>& contact) {
                    found.push_back({{}, id, contact});
                },
                by, from_c<D>(options));
            const auto key = [](const auto& entry) {
                const auto& [a, b, contact] = entry;
                return std::tuple(b, -contact.depth, contact.feature_a.part, contact.feature_b.part);
            };
            std::stable_sort(found.begin(), found.end(), [&](const auto& x, const auto& y) { return key(x) < key(y); });
            list.assign(found, as_c);
        });
}

template <int D>
abut_code containing_of(const WorldHandle<D>* world, typename COf<D>::Vec point, const abut_filter* filter,
                        List<abut_id> list) {
    return answer<D>(world, filter, {finite(point, "point"), list.fault()}, [&](const auto& own, const auto& by) {
        list.assign(own.containing(same_bytes<abut::Vec<D>>(point), by), as_c);
    });
}

/// Many questions: Own is the library's type of each, `batch(world, questions, answers, executor, filter)` calls the
/// world.
template <int D, class Own, class Answer, class C, class COut, class Batch>
abut_code many(const WorldHandle<D>* world, Strided<C> questions, const abut_filter* filter, abut_thread_pool* pool,
               COut* out, const Batch& batch, const Fault& fault = {}) {
    return answer<D>(
        world, filter,
        {fault, questions.fault_of_elements(), array(out, questions.size(), "out"), present_or_null(pool, "pool")},
        [&](const auto& own, const auto& by) {
            const auto copied = questions.template copied<Own>();
            std::vector<std::optional<Answer>> answers(copied.size());
            const std::span<const Own> all(copied);
            const std::span<std::optional<Answer>> places(answers);
            if (pool == nullptr)
                batch(own, all, places, by);
            else
                batch(own, all, places, pool->pool, by);
            std::transform(answers.begin(), answers.end(), out, as_c);
        });
}

template <int D>
abut_code overlapping_many(const WorldHandle<D>* world, const ShapeHandle<D>* shape,
                           Strided<typename COf<D>::Pose> poses, const abut_filter* filter, abut_thread_pool* pool,
                           std::uint32_t* ends, List<abut_id> list) {
    return answer<D>(world, filter,
                     {present(shape, "shape"), poses.fault_of_elements(), array(ends, poses.size(), "ends"),
                      present_or_null(pool, "pool"), list.fault()},
                     [&](const auto& own, const auto& by) {
                         const auto copied = poses.template copied<abut::Pose<D>>();
                         abut::IdLists lists;
                         if (pool == nullptr)
                             own.overlapping(shape->shape, std::span(copied), lists, by);
                         else
                             own.overlapping(shape->shape, std::span(copied), lists, pool->pool, by);
                         std::uint32_t end = 0;
                         for (std::size_t i = 0; i < lists.size(); ++i)
                             ends[i] = end += static_cast<std::uint32_t>(lists[i].size());
                         list.assign(lists.all(), as_c);
                     });
}

}  // namespace

// The entries of both dimensions.
#define ABUT_C_ENTRIES(D)                                                                                              \
    abut_code abut_world##D##_raycast(const abut_world##D* world, abut_ray##D ray, const abut_filter* filter,          \
                                      abut_world_hit##D* out) {                                                        \
        return raycast_of<D>(world, ray, filter, out);                                                                 \
    }                                                                                                                  \
    abut_code abut_world##D##_raycast_any(const abut_world##D* world, abut_ray##D ray, const abut_filter* filter,      \
                                          bool* out) {                                                                 \
        return raycast_any_of<D>(world, ray, filter, out);                                                             \
    }                                                                                                                  \
    abut_code abut_world##D##_raycast_all(const abut_world##D* world, abut_ray##D ray, const abut_filter* filter,      \
                                          abut_world_hit##D* out, uint32_t capacity, uint32_t* count) {                \
        return raycast_all_of<D>(world, ray, filter, {out, capacity, count});                                          \
    }                                                                                                                  \
    abut_code abut_world##D##_sweep(const abut_world##D* world, const abut_shape##D* shape, abut_vec##D motion,        \
                                    const abut_filter* filter, abut_world_hit##D* out) {                               \
        return sweep_of<D>(world, shape, motion, filter, out);                                                         \
    }                                                                                                                  \
    abut_code abut_world##D##_sweep_motion(const abut_world##D* world, const abut_shape##D* shape,                     \
                                           abut_motion##D motion, const abut_filter* filter, abut_world_hit##D* out) { \
        return sweep_motion_of<D>(world, shape, motion, filter, out);                                                  \
    }                                                                                                                  \
    abut_code abut_world##D##_closest(const abut_world##D* world, const abut_shape##D* shape,                          \
                                      const abut_filter* filter, abut_world_closest##D* out) {                         \
        return closest_of<D>(world, shape, filter, out);                                                               \
    }                                                                                                                  \
    abut_code abut_world##D##_closest_to_point(const abut_world##D* world, abut_vec##D point,                          \
                                               const abut_filter* filter, abut_world_closest##D* out) {                \
        return closest_to_point<D>(world, point, filter, out);                                                         \
    }                                                                                                                  \
    abut_code abut_world##D##_k_nearest(const abut_world##D* world, const abut_shape##D* shape,                        \
                                        const abut_filter* filter, abut_world_closest##D* out, uint32_t capacity,      \
                                        uint32_t* count) {                                                             \
        return k_nearest_of<D>(world, shape, filter, capacity, {out, capacity, count});                                \
    }                                                                                                                  \
    abut_code abut_world##D##_overlapping(const abut_world##D* world, const abut_shape##D* shape,                      \
                                          const abut_filter* filter, abut_id* out, uint32_t capacity,                  \
                                          uint32_t* count) {                                                           \
        return overlapping_of<D>(world, shape, filter, {out, capacity, count});                                        \
    }                                                                                                                  \
    abut_code abut_world##D##_each_overlapping(const abut_world##D* world, const abut_shape##D* shape,                 \
                                               const abut_filter* filter, abut_accepts visit, void* context) {         \
        return each_overlapping_of<D>(world, shape, filter, visit, context);                                           \
    }                                                                                                                  \
    abut_code abut_world##D##_each_contact(const abut_world##D* world, const abut_shape##D* shape,                     \
                                           const abut_filter* filter, const abut_query_options* options,               \
                                           abut_world_contact##D* out, uint32_t capacity, uint32_t* count) {           \
        return each_contact_of_shape<D>(world, shape, filter, options, {out, capacity, count});                        \
    }                                                                                                                  \
    abut_code abut_world##D##_containing(const abut_world##D* world, abut_vec##D point, const abut_filter* filter,     \
                                         abut_id* out, uint32_t capacity, uint32_t* count) {                           \
        return containing_of<D>(world, point, filter, {out, capacity, count});                                         \
    }                                                                                                                  \
    abut_code abut_world##D##_raycast_many(const abut_world##D* world, const abut_ray##D* rays, uint32_t stride,       \
                                           uint32_t count, const abut_filter* filter, abut_thread_pool* pool,          \
                                           abut_world_hit##D* out) {                                                   \
        return many<D, abut::Ray<D>, abut::WorldHit<D>, abut_ray##D>(                                                  \
            world, {rays, stride, count, "rays"}, filter, pool, out,                                                   \
            [](const auto& own, auto&&... arguments) { own.raycast(arguments...); });                                  \
    }                                                                                                                  \
    abut_code abut_world##D##_sweep_many(const abut_world##D* world, const abut_shape##D* shape,                       \
                                         const abut_motion##D* motions, uint32_t stride, uint32_t count,               \
                                         const abut_filter* filter, abut_thread_pool* pool, abut_world_hit##D* out) {  \
        return many<D, abut::Motion<D>, abut::WorldHit<D>, abut_motion##D>(                                            \
            world, {motions, stride, count, "motions"}, filter, pool, out,                                             \
            [&](const auto& own, auto&&... arguments) { own.sweep(shape->shape, arguments...); },                      \
            present(shape, "shape"));                                                                                  \
    }                                                                                                                  \
    abut_code abut_world##D##_closest_to_points(const abut_world##D* world, const abut_vec##D* points,                 \
                                                uint32_t stride, uint32_t count, const abut_filter* filter,            \
                                                abut_thread_pool* pool, abut_world_closest##D* out) {                  \
        return many<D, abut::Vec<D>, abut::WorldClosest<D>, abut_vec##D>(                                              \
            world, {points, stride, count, "points"}, filter, pool, out,                                               \
            [](const auto& own, auto&&... arguments) { own.closest(arguments...); });                                  \
    }                                                                                                                  \
    abut_code abut_world##D##_closest_many(                                                                            \
        const abut_world##D* world, const abut_shape##D* shape, const abut_pose##D* poses, uint32_t stride,            \
        uint32_t count, const abut_filter* filter, abut_thread_pool* pool, abut_world_closest##D* out) {               \
        return many<D, abut::Pose<D>, abut::WorldClosest<D>, abut_pose##D>(                                            \
            world, {poses, stride, count, "poses"}, filter, pool, out,                                                 \
            [&](const auto& own, auto&&... arguments) { own.closest(shape->shape, arguments...); },                    \
            present(shape, "shape"));                                                                                  \
    }                                                                                                                  \
    abut_code abut_world##D##_overlapping_many(const abut_world##D* world, const abut_shape##D* shape,                 \
                                               const abut_pose##D* poses, uint32_t stride, uint32_t count,             \
                                               const abut_filter* filter, abut_thread_pool* pool, uint32_t* ends,      \
                                               abut_id* out, uint32_t capacity, uint32_t* id_count) {                  \
        return overlapping_many<D>(world, shape, {poses, stride, count, "poses"}, filter, pool, ends,                  \
                                   {out, capacity, id_count});                                                         \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES
