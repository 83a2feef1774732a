// Decomposition by the C API.

#include <abut/bake.hpp>
#include <abut/c/detail/handles.hpp>
#include <abut/c/detail/rings.hpp>

#include <cmath>
#include <span>

using namespace abut::detail;

namespace {

template <int D, class Parts>
abut_code give_shapes(abut::Result<Parts>&& parts, typename CTypes<D>::Shapes** out) {
    if (!parts) return report(parts.problem());
    *out = new typename CTypes<D>::Shapes{{.shapes = std::move(*parts)}};
    return ABUT_OK;
}

template <int D>
abut_code shape_at(const ShapesHandle<D>* shapes, std::uint32_t index, typename CTypes<D>::Shape** out) {
    return entry({present(shapes, "shapes"), present(out, "out")}, [&] {
        if (index >= shapes->shapes.size())
            return report(Fault{ABUT_INDEX_OUT_OF_RANGE, "index", "is not below the number of shapes"});
        const auto& shape = shapes->shapes[index];
        return give_shape<D>(shape, out, shape);
    });
}

template <int D>
abut_code compound_of(const ShapesHandle<D>* shapes, typename CTypes<D>::Shape** out) {
    return entry({present(shapes, "shapes"), present(out, "out")}, [&] {
        const std::vector<abut::AnyShape<D>> children(shapes->shapes.begin(), shapes->shapes.end());
        return give_built<D>(abut::Compound<D>::build(std::span(children)), out);
    });
}

}  // namespace

abut_code abut_decompose_options_default(abut_decompose_options* out) {
    return entry({present(out, "out")}, [&] {
        const abut::DecomposeOptions options;
        *out = {options.max_parts, options.max_vertices, options.concavity};
    });
}

abut_code abut_decompose_outline(const abut_vec2* points, uint32_t stride, uint32_t point_count, const uint32_t* ends,
                                 uint32_t ring_count, double concavity, abut_shapes2** out) {
    const Strided points_of(points, stride, point_count, "points");
    return entry({points_of.fault(), fault_of_ends(ends, ring_count, point_count), present(out, "out")}, [&] {
        const auto rings = rings_of(points_of, ends, ring_count);
        const std::span<const std::vector<abut::Vec2>> holes(rings.data() + 1, rings.size() - 1);
        return give_shapes<2>(abut::decompose(rings[0], holes, {.concavity = concavity}), out);
    });
}

abut_code abut_decompose_mesh(const abut_shape3* mesh, const abut_decompose_options* options, abut_shapes3** out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] {
        const auto* surface = std::get_if<abut::Mesh>(&mesh->source);
        if (surface == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "mesh", "is no mesh"});
        abut::DecomposeOptions own;
        if (options != nullptr) {
            own.max_parts = options->max_parts;
            own.max_vertices = options->max_vertices;
            own.concavity = options->concavity;
        }
        return give_shapes<3>(abut::decompose(*surface, own), out);
    });
}

// The entries of both dimensions.
#define ABUT_C_ENTRIES(D)                                                                               \
    abut_code abut_shapes##D##_size(const abut_shapes##D* shapes, uint32_t* out) {                      \
        return entry({present(shapes, "shapes"), present(out, "out")},                                  \
                     [&] { *out = static_cast<uint32_t>(shapes->shapes.size()); });                     \
    }                                                                                                   \
    abut_code abut_shapes##D##_get(const abut_shapes##D* shapes, uint32_t index, abut_shape##D** out) { \
        return shape_at<D>(shapes, index, out);                                                         \
    }                                                                                                   \
    abut_code abut_shapes##D##_compound(const abut_shapes##D* shapes, abut_shape##D** out) {            \
        return compound_of<D>(shapes, out);                                                             \
    }                                                                                                   \
    void abut_shapes##D##_release(abut_shapes##D* shapes) {                                             \
        release(shapes);                                                                                \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES
