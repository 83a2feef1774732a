// The questions of the C API, one by one.

#include <abut/c/detail/answers.hpp>

using namespace abut::detail;

namespace {

template <int D>
using COf = CTypes<D>;

template <int D>
std::optional<abut::Hit<D>> hit_of(const ShapeHandle<D>& shape, const abut::Ray<D>& ray,
                                   const abut_query_options* options) {
    const auto level = std::get_if<abut::SolidBsp<D>>(&shape.source);
    if (level != nullptr) return raycast(ray, *level, from_c<D>(options));
    return raycast(ray, shape.shape.view(), from_c<D>(options));
}

template <int D>
abut_code overlaps_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b, bool* out) {
    return entry({present(a, "a"), present(b, "b"), present(out, "out"), pair_of(a, b)},
                 [&] { *out = overlaps(a->shape.view(), b->shape.view()); });
}

template <int D>
abut_code closest_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b, typename COf<D>::Closest* out) {
    return entry({present(a, "a"), present(b, "b"), present(out, "out"), pair_of(a, b)},
                 [&] { *out = to_c(closest(a->shape.view(), b->shape.view())); });
}

template <int D>
abut_code closest_to_point(const ShapeHandle<D>* a, typename COf<D>::Vec point, typename COf<D>::Closest* out) {
    return entry({present(a, "a"), finite(point, "point"), present(out, "out")},
                 [&] { *out = to_c(closest(a->shape, same_bytes<abut::Vec<D>>(point))); });
}

template <int D>
abut_code contact_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b, const abut_query_options* options,
                     typename COf<D>::Contact* out) {
    return entry({present(a, "a"), present(b, "b"), valid(options), present(out, "out"), pair_of(a, b)},
                 [&] { *out = to_c(contact(a->shape.view(), b->shape.view(), from_c<D>(options))); });
}

template <int D>
abut_code contacts_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b, const abut_query_options* options,
                      List<typename COf<D>::Contact> list) {
    return entry({present(a, "a"), present(b, "b"), valid(options), list.fault(), pair_of(a, b)}, [&] {
        list.clear();
        each_contact(
            a->shape, b->shape, [&](const abut::Contact<D>& contact) { list.add(to_c(contact)); }, from_c<D>(options));
    });
}

template <int D>
abut_code sweep_of(const ShapeHandle<D>* a, typename COf<D>::Vec motion_a, const ShapeHandle<D>* b,
                   typename COf<D>::Vec motion_b, typename COf<D>::Hit* out) {
    return entry({present(a, "a"), finite(motion_a, "motion_a"), present(b, "b"), finite(motion_b, "motion_b"),
                  present(out, "out"), pair_of(a, b)},
                 [&] {
                     using V = abut::Vec<D>;
                     *out = to_c(sweep(a->shape, same_bytes<V>(motion_a), b->shape, same_bytes<V>(motion_b)));
                 });
}

template <int D>
abut_code sweep_motion_of(const ShapeHandle<D>* a, typename COf<D>::Motion motion_a, const ShapeHandle<D>* b,
                          typename COf<D>::Motion motion_b, typename COf<D>::Hit* out) {
    return entry({present(a, "a"), finite(motion_a, "motion_a"), present(b, "b"), finite(motion_b, "motion_b"),
                  present(out, "out"), pair_of(a, b)},
                 [&] {
                     using M = abut::Motion<D>;
                     *out = to_c(sweep(a->shape, same_bytes<M>(motion_a), b->shape, same_bytes<M>(motion_b)));
                 });
}

template <int D>
abut_code raycast_of(const ShapeHandle<D>* shape, typename COf<D>::Ray ray, const abut_query_options* options,
                     typename COf<D>::Hit* out) {
    return entry({present(shape, "shape"), finite(ray, "ray"), valid(options), present(out, "out")},
                 [&] { *out = to_c(hit_of<D>(*shape, same_bytes<abut::Ray<D>>(ray), options)); });
}

template <int D>
abut_code raycast_any_of(const ShapeHandle<D>* shape, typename COf<D>::Ray ray, const abut_query_options* options,
                         bool* out) {
    return entry({present(shape, "shape"), finite(ray, "ray"), valid(options), present(out, "out")}, [&] {
        const auto own = same_bytes<abut::Ray<D>>(ray);
        if (const auto* level = std::get_if<abut::SolidBsp<D>>(&shape->source))
            *out = raycast_any(own, *level, from_c<D>(options));
        else
            *out = raycast_any(own, shape->shape.view(), from_c<D>(options));
    });
}

template <int D>
abut_code raycast_all_of(const ShapeHandle<D>* shape, typename COf<D>::Ray ray, const abut_query_options* options,
                         List<typename COf<D>::Hit> list) {
    return entry({present(shape, "shape"), finite(ray, "ray"), valid(options), list.fault()}, [&] {
        std::vector<abut::Hit<D>> hits;
        raycast_all(same_bytes<abut::Ray<D>>(ray), shape->shape, hits, from_c<D>(options));
        list.assign(hits, [](const abut::Hit<D>& hit) { return to_c(hit); });
    });
}

template <int D>
abut_code contains_of(const ShapeHandle<D>* shape, typename COf<D>::Vec point, bool* out) {
    return entry({present(shape, "shape"), finite(point, "point"), present(out, "out")},
                 [&] { *out = contains(shape->shape, same_bytes<abut::Vec<D>>(point)); });
}

template <int D>
abut_code certify_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b, const typename COf<D>::Closest& answer,
                     typename COf<D>::Certificate* out) {
    return entry({present(a, "a"), present(b, "b"), present(out, "out"), pair_of(a, b)}, [&] {
        using V = abut::Vec<D>;
        abut::Closest<D> closest;
        closest.distance = answer.distance;
        closest.normal = same_bytes<V>(answer.normal);
        closest.on_a = same_bytes<V>(answer.on_a);
        closest.on_b = same_bytes<V>(answer.on_b);
        closest.feature_a = from_c(answer.feature_a);
        closest.feature_b = from_c(answer.feature_b);
        const abut::Certificate<D> found = certify(a->shape, b->shape, closest);
        *out = {found.margin, found.plane,      found.off_a,           found.off_b,
                found.across, found.off_common, to_c<D>(found.common), found.holds ? 1u : 0u};
    });
}

template <int D>
abut_code reflect_of(typename COf<D>::Ray ray, const typename COf<D>::Hit& hit, typename COf<D>::Ray* out) {
    return entry({finite(ray, "ray"), finite(hit.point, "hit.point"), finite(hit.normal, "hit.normal"),
                  finite(hit.distance, "hit.distance"), present(out, "out")},
                 [&] {
                     if (hit.found == 0) return report(Fault{ABUT_BAD_ARGUMENT, "hit", "is none"});
                     abut::Hit<D> own;
                     own.fraction = hit.fraction;
                     own.distance = hit.distance;
                     own.point = same_bytes<abut::Vec<D>>(hit.point);
                     own.normal = same_bytes<abut::Vec<D>>(hit.normal);
                     *out = same_bytes<typename COf<D>::Ray>(reflect(same_bytes<abut::Ray<D>>(ray), own));
                     return ABUT_OK;
                 });
}

/// Answers for B at each of many poses.
template <int D, class T, class Question>
abut_code at_poses(const ShapeHandle<D>* a, const ShapeHandle<D>* b, Strided<typename COf<D>::Pose> poses, T* out,
                   const Question& question, const Fault& more = {}) {
    return entry({present(a, "a"), present(b, "b"), poses.fault_of_elements(), array(out, poses.size(), "out"),
                  pair_of(a, b), more},
                 [&] {
                     const abut::View<D> own = a->shape.view();
                     for (std::uint32_t i = 0; i < poses.size(); ++i)
                         out[i] = question(own, b->shape.placed(same_bytes<abut::Pose<D>>(poses[i])));
                 });
}

/// Answers for each of many values: points, rays or motions.
template <int D, class C, class T, class Question>
abut_code for_each(const ShapeHandle<D>* shape, Strided<C> values, T* out, const Question& question,
                   const Fault& more = {}) {
    return entry({present(shape, "shape"), values.fault_of_elements(), array(out, values.size(), "out"), more}, [&] {
        for (std::uint32_t i = 0; i < values.size(); ++i) out[i] = question(values[i]);
    });
}

template <int D>
abut_code sweep_many(const ShapeHandle<D>* a, Strided<typename COf<D>::Motion> motions, const ShapeHandle<D>* b,
                     typename COf<D>::Hit* out) {
    return entry({present(a, "a"), motions.fault_of_elements(), present(b, "b"), array(out, motions.size(), "out"),
                  pair_of(a, b)},
                 [&] {
                     for (std::uint32_t i = 0; i < motions.size(); ++i)
                         out[i] = to_c(sweep(a->shape, same_bytes<abut::Motion<D>>(motions[i]), b->shape));
                 });
}

}  // namespace

abut_code abut_query_options_default(abut_query_options* out) {
    return entry({present(out, "out")}, [&] { *out = {0, 1}; });
}

// The entries of both dimensions.
#define ABUT_C_ENTRIES(D)                                                                                              \
    abut_code abut_shape##D##_overlaps(const abut_shape##D* a, const abut_shape##D* b, bool* out) {                    \
        return overlaps_of<D>(a, b, out);                                                                              \
    }                                                                                                                  \
    abut_code abut_shape##D##_closest(const abut_shape##D* a, const abut_shape##D* b, abut_closest##D* out) {          \
        return closest_of<D>(a, b, out);                                                                               \
    }                                                                                                                  \
    abut_code abut_shape##D##_closest_to_point(const abut_shape##D* a, abut_vec##D point, abut_closest##D* out) {      \
        return closest_to_point<D>(a, point, out);                                                                     \
    }                                                                                                                  \
    abut_code abut_shape##D##_contact(const abut_shape##D* a, const abut_shape##D* b,                                  \
                                      const abut_query_options* options, abut_contact##D* out) {                       \
        return contact_of<D>(a, b, options, out);                                                                      \
    }                                                                                                                  \
    abut_code abut_shape##D##_each_contact(const abut_shape##D* a, const abut_shape##D* b,                             \
                                           const abut_query_options* options, abut_contact##D* out, uint32_t capacity, \
                                           uint32_t* count) {                                                          \
        return contacts_of<D>(a, b, options, {out, capacity, count});                                                  \
    }                                                                                                                  \
    abut_code abut_shape##D##_sweep(const abut_shape##D* a, abut_vec##D motion_a, const abut_shape##D* b,              \
                                    abut_vec##D motion_b, abut_hit##D* out) {                                          \
        return sweep_of<D>(a, motion_a, b, motion_b, out);                                                             \
    }                                                                                                                  \
    abut_code abut_shape##D##_sweep_motion(const abut_shape##D* a, abut_motion##D motion_a, const abut_shape##D* b,    \
                                           abut_motion##D motion_b, abut_hit##D* out) {                                \
        return sweep_motion_of<D>(a, motion_a, b, motion_b, out);                                                      \
    }                                                                                                                  \
    abut_code abut_shape##D##_raycast(const abut_shape##D* shape, abut_ray##D ray, const abut_query_options* options,  \
                                      abut_hit##D* out) {                                                              \
        return raycast_of<D>(shape, ray, options, out);                                                                \
    }                                                                                                                  \
    abut_code abut_shape##D##_raycast_any(const abut_shape##D* shape, abut_ray##D ray,                                 \
                                          const abut_query_options* options, bool* out) {                              \
        return raycast_any_of<D>(shape, ray, options, out);                                                            \
    }                                                                                                                  \
    abut_code abut_shape##D##_raycast_all(const abut_shape##D* shape, abut_ray##D ray,                                 \
                                          const abut_query_options* options, abut_hit##D* out, uint32_t capacity,      \
                                          uint32_t* count) {                                                           \
        return raycast_all_of<D>(shape, ray, options, {out, capacity, count});                                         \
    }                                                                                                                  \
    abut_code abut_shape##D##_contains(const abut_shape##D* shape, abut_vec##D point, bool* out) {                     \
        return contains_of<D>(shape, point, out);                                                                      \
    }                                                                                                                  \
    abut_code abut_shape##D##_certify(const abut_shape##D* a, const abut_shape##D* b, abut_closest##D answer,          \
                                      abut_certificate##D* out) {                                                      \
        return certify_of<D>(a, b, answer, out);                                                                       \
    }                                                                                                                  \
    abut_code abut_ray##D##_reflect(abut_ray##D ray, abut_hit##D hit, abut_ray##D* out) {                              \
        return reflect_of<D>(ray, hit, out);                                                                           \
    }                                                                                                                  \
    abut_code abut_shape##D##_overlaps_many(const abut_shape##D* a, const abut_shape##D* b, const abut_pose##D* poses, \
                                            uint32_t stride, uint32_t count, bool* out) {                              \
        return at_poses<D>(a, b, {poses, stride, count, "poses"}, out,                                                 \
                           [](const auto& x, const auto& y) { return overlaps(x, y); });                               \
    }                                                                                                                  \
    abut_code abut_shape##D##_closest_many(const abut_shape##D* a, const abut_shape##D* b, const abut_pose##D* poses,  \
                                           uint32_t stride, uint32_t count, abut_closest##D* out) {                    \
        return at_poses<D>(a, b, {poses, stride, count, "poses"}, out,                                                 \
                           [](const auto& x, const auto& y) { return to_c(closest(x, y)); });                          \
    }                                                                                                                  \
    abut_code abut_shape##D##_contact_many(const abut_shape##D* a, const abut_shape##D* b,                             \
                                           const abut_query_options* options, const abut_pose##D* poses,               \
                                           uint32_t stride, uint32_t count, abut_contact##D* out) {                    \
        return at_poses<D>(                                                                                            \
            a, b, {poses, stride, count, "poses"}, out,                                                                \
            [&](const auto& x, const auto& y) { return to_c(contact(x, y, from_c<D>(options))); }, valid(options));    \
    }                                                                                                                  \
    abut_code abut_shape##D##_closest_to_points(const abut_shape##D* a, const abut_vec##D* points, uint32_t stride,    \
                                                uint32_t count, abut_closest##D* out) {                                \
        return for_each<D, abut_vec##D>(a, {points, stride, count, "points"}, out, [&](const abut_vec##D& point) {     \
            return to_c(closest(a->shape, same_bytes<abut::Vec<D>>(point)));                                           \
        });                                                                                                            \
    }                                                                                                                  \
    abut_code abut_shape##D##_contains_many(const abut_shape##D* shape, const abut_vec##D* points, uint32_t stride,    \
                                            uint32_t count, bool* out) {                                               \
        return for_each<D, abut_vec##D>(shape, {points, stride, count, "points"}, out, [&](const abut_vec##D& point) { \
            return contains(shape->shape, same_bytes<abut::Vec<D>>(point));                                            \
        });                                                                                                            \
    }                                                                                                                  \
    abut_code abut_shape##D##_raycast_many(const abut_shape##D* shape, const abut_query_options* options,              \
                                           const abut_ray##D* rays, uint32_t stride, uint32_t count,                   \
                                           abut_hit##D* out) {                                                         \
        return for_each<D, abut_ray##D>(                                                                               \
            shape, {rays, stride, count, "rays"}, out,                                                                 \
            [&](const abut_ray##D& ray) { return to_c(hit_of<D>(*shape, same_bytes<abut::Ray<D>>(ray), options)); },   \
            valid(options));                                                                                           \
    }                                                                                                                  \
    abut_code abut_shape##D##_sweep_many(const abut_shape##D* a, const abut_motion##D* motions, uint32_t stride,       \
                                         uint32_t count, const abut_shape##D* b, abut_hit##D* out) {                   \
        return sweep_many<D>(a, {motions, stride, count, "motions"}, b, out);                                          \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES
