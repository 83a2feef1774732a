// Distance fields of the C API.

#include <abut/bake.hpp>
#include <abut/c/detail/answers.hpp>
#include <abut/c/detail/rings.hpp>

#include <span>

using namespace abut::detail;

namespace {

template <int D>
using COf = CTypes<D>;

template <int D>
abut::FieldOptions<D> field_options(const abut_field_options* options) {
    abut::FieldOptions<D> result;
    if (options == nullptr) return result;
    result.cell = options->cell;
    result.padding = options->padding;
    result.band = options->band;
    result.store = options->dense != 0 ? abut::FieldStore::dense : abut::FieldStore::sparse;
    result.lookup = options->gradients != 0 ? abut::FieldLookup::gradient : abut::FieldLookup::linear;
    result.quantised = options->quantised != 0;
    result.closest_points = options->closest_points != 0;
    return result;
}

template <int D>
abut_code give_field(const abut::Result<abut::Field<D>>& baked, typename COf<D>::Field** out) {
    if (!baked) return report(baked.problem());
    *out = new typename COf<D>::Field{{.field = *baked}};
    return ABUT_OK;
}

template <int D>
abut_code bake(const ShapeHandle<D>* shape, const abut_field_options* options, typename COf<D>::Field** out) {
    return entry({present(shape, "shape"), present(out, "out")}, [&] {
        if constexpr (D == 3) {
            if (const auto* mesh = std::get_if<abut::Mesh>(&shape->source))
                return give_field<D>(abut::bake_field(*mesh, field_options<D>(options)), out);
        }
        return give_field<D>(abut::bake_field(shape->shape, field_options<D>(options)), out);
    });
}

/// Writes an answer of a field at a point.
template <int D, class T, class Question>
abut_code at_point(const FieldHandle<D>* field, const typename COf<D>::Vec& point, T* out, const Question& question,
                   const Fault& more = {}) {
    return entry({present(field, "field"), finite(point, "point"), more, present(out, "out")},
                 [&] { *out = question(field->field, same_bytes<abut::Vec<D>>(point)); });
}

/// Writes the answers of a field at many points.
template <int D, class T, class Question>
abut_code at_points(const FieldHandle<D>* field, Strided<typename COf<D>::Vec> points, T* out, const Question& question,
                    const Fault& more = {}) {
    return entry({present(field, "field"), points.fault_of_elements(), more, array(out, points.size(), "out")}, [&] {
        const auto copied = points.template copied<abut::Vec<D>>();
        question(field->field, std::span(copied));
    });
}

template <int D>
Fault valid_light(const typename COf<D>::Vec& light, float softness) {
    if (const Fault fault = finite(light, "light"); fault.code != ABUT_OK) return fault;
    return not_below_zero(softness, "softness");
}

template <int D>
typename COf<D>::FieldSample sample_to_c(const abut::FieldSample<D>& sample) {
    return {sample.distance, to_c<D>(sample.normal)};
}

template <int D>
abut_code sample_many(const FieldHandle<D>* field, Strided<typename COf<D>::Vec> points,
                      typename COf<D>::FieldSample* out) {
    return at_points<D>(field, points, out, [&](const auto& own, std::span<const abut::Vec<D>> all) {
        std::vector<abut::FieldSample<D>> samples(all.size());
        own.sample(all, std::span(samples));
        std::transform(samples.begin(), samples.end(), out, sample_to_c<D>);
    });
}

template <int D>
abut_code closest_many(const FieldHandle<D>* field, Strided<typename COf<D>::Vec> points, typename COf<D>::Vec* out) {
    return at_points<D>(field, points, out, [&](const auto& own, std::span<const abut::Vec<D>> all) {
        std::transform(all.begin(), all.end(), out,
                       [&](const abut::Vec<D>& point) { return to_c<D>(own.closest(point)); });
    });
}

template <int D>
abut_code load(const uint8_t* bytes, size_t size, typename COf<D>::Field** out) {
    return entry({array(bytes, size, "bytes"), present(out, "out")}, [&] {
        return give_field<D>(abut::load_field<D>({reinterpret_cast<const std::byte*>(bytes), size}), out);
    });
}

}  // namespace

abut_code abut_field_options_default(abut_field_options* out) {
    return entry({present(out, "out")}, [&] {
        const abut::FieldOptions<3> options;
        *out = {options.cell, options.padding, options.band, 0, 0, 0, 0};
    });
}

abut_code abut_field2_bake_outline(const abut_vec2* points, uint32_t stride, uint32_t point_count, const uint32_t* ends,
                                   uint32_t ring_count, const abut_field_options* options, abut_field2** out) {
    const Strided points_of(points, stride, point_count, "points");
    return entry({points_of.fault(), fault_of_ends(ends, ring_count, point_count), present(out, "out")}, [&] {
        const auto rings = rings_of(points_of, ends, ring_count);
        const std::span<const std::vector<abut::Vec2>> holes(rings.data() + 1, rings.size() - 1);
        return give_field<2>(abut::bake_field(rings[0], holes, field_options<2>(options)), out);
    });
}

// The entries of both dimensions.
#define ABUT_C_ENTRIES(D)                                                                                              \
    abut_code abut_field##D##_bake(const abut_shape##D* shape, const abut_field_options* options,                      \
                                   abut_field##D** out) {                                                              \
        return bake<D>(shape, options, out);                                                                           \
    }                                                                                                                  \
    void abut_field##D##_release(abut_field##D* field) {                                                               \
        release(field);                                                                                                \
    }                                                                                                                  \
    abut_code abut_field##D##_distance(const abut_field##D* field, abut_vec##D point, float* out) {                    \
        return at_point<D>(field, point, out, [](const auto& own, const auto& p) { return own.distance(p); });         \
    }                                                                                                                  \
    abut_code abut_field##D##_sample(const abut_field##D* field, abut_vec##D point, abut_field_sample##D* out) {       \
        return at_point<D>(field, point, out,                                                                          \
                           [](const auto& own, const auto& p) { return sample_to_c<D>(own.sample(p)); });              \
    }                                                                                                                  \
    abut_code abut_field##D##_closest(const abut_field##D* field, abut_vec##D point, abut_vec##D* out) {               \
        return at_point<D>(field, point, out, [](const auto& own, const auto& p) { return to_c<D>(own.closest(p)); }); \
    }                                                                                                                  \
    abut_code abut_field##D##_shadow(const abut_field##D* field, abut_vec##D point, abut_vec##D light, float softness, \
                                     float* out) {                                                                     \
        const auto shadow = [&](const auto& own, const auto& p) {                                                      \
            return own.shadow(p, same_bytes<abut::Vec<D>>(light), softness);                                           \
        };                                                                                                             \
        return at_point<D>(field, point, out, shadow, valid_light<D>(light, softness));                                \
    }                                                                                                                  \
    abut_code abut_field##D##_ambient_occlusion(const abut_field##D* field, abut_vec##D point, abut_vec##D normal,     \
                                                float reach, float* out) {                                             \
        const auto occlusion = [&](const auto& own, const auto& p) {                                                   \
            return own.ambient_occlusion(p, same_bytes<abut::Vec<D>>(normal), reach);                                  \
        };                                                                                                             \
        const Fault fault = finite(normal, "normal");                                                                  \
        return at_point<D>(field, point, out, occlusion,                                                               \
                           fault.code != ABUT_OK ? fault : not_below_zero(reach, "reach"));                            \
    }                                                                                                                  \
    abut_code abut_field##D##_distance_many(const abut_field##D* field, const abut_vec##D* points, uint32_t stride,    \
                                            uint32_t count, float* out) {                                              \
        return at_points<D>(field, {points, stride, count, "points"}, out,                                             \
                            [&](const auto& own, auto all) { own.distance(all, std::span(out, count)); });             \
    }                                                                                                                  \
    abut_code abut_field##D##_sample_many(const abut_field##D* field, const abut_vec##D* points, uint32_t stride,      \
                                          uint32_t count, abut_field_sample##D* out) {                                 \
        return sample_many<D>(field, {points, stride, count, "points"}, out);                                          \
    }                                                                                                                  \
    abut_code abut_field##D##_closest_many(const abut_field##D* field, const abut_vec##D* points, uint32_t stride,     \
                                           uint32_t count, abut_vec##D* out) {                                         \
        return closest_many<D>(field, {points, stride, count, "points"}, out);                                         \
    }                                                                                                                  \
    abut_code abut_field##D##_shadow_many(const abut_field##D* field, const abut_vec##D* points, uint32_t stride,      \
                                          uint32_t count, abut_vec##D light, float softness, float* out) {             \
        const auto shadow = [&](const auto& own, auto all) {                                                           \
            own.shadow(all, same_bytes<abut::Vec<D>>(light), softness, std::span(out, count));                         \
        };                                                                                                             \
        return at_points<D>(field, {points, stride, count, "points"}, out, shadow, valid_light<D>(light, softness));   \
    }                                                                                                                  \
    abut_code abut_field##D##_volume(const abut_field##D* field, abut_aabb##D* out) {                                  \
        return entry({present(field, "field"), present(out, "out")},                                                   \
                     [&] { *out = same_bytes<abut_aabb##D>(field->field.volume()); });                                 \
    }                                                                                                                  \
    abut_code abut_field##D##_cell(const abut_field##D* field, float* out) {                                           \
        return entry({present(field, "field"), present(out, "out")}, [&] { *out = field->field.cell(); });             \
    }                                                                                                                  \
    abut_code abut_field##D##_shape(const abut_field##D* field, abut_shape##D** out) {                                 \
        return entry({present(field, "field"), present(out, "out")},                                                   \
                     [&] { return give_shape<D>(field->field, out); });                                                \
    }                                                                                                                  \
    abut_code abut_field##D##_save(const abut_field##D* field, abut_buffer* out) {                                     \
        return entry({present(field, "field"), present(out, "out")}, [&] { out->bytes = save(field->field); });        \
    }                                                                                                                  \
    abut_code abut_field##D##_load(const uint8_t* bytes, size_t size, abut_field##D** out) {                           \
        return load<D>(bytes, size, out);                                                                              \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES
