#pragma once

// What the handles of the C API hold. For .cpp files.

#include <abut/abut.hpp>
#include <abut/c/abut.h>
#include <abut/c/detail/fault.hpp>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace abut::detail {

/// The first bytes of a handle, so that one of another type is found out.
enum class HandleTag : std::uint32_t {
    released = 0,
    shape2 = 0xAB070012,
    shape3 = 0xAB070013,
    world2 = 0xAB070022,
    world3 = 0xAB070023,
    field2 = 0xAB070032,
    field3 = 0xAB070033,
    shapes2 = 0xAB070042,
    shapes3 = 0xAB070043,
    walk_mesh = 0xAB070050,
    buffer = 0xAB070060,
    thread_pool = 0xAB070070,
};

/// What a question needs to know of a shape that an AnyShape doesn't tell.
template <int D>
using ShapeSource =
    std::variant<std::monostate, Aabb<D>, PolytopeOf<D>, SolidBsp<D>, std::conditional_t<D == 2, Chain, Mesh>>;

template <int D>
struct ShapeHandle {
    static constexpr HandleTag own_tag = D == 2 ? HandleTag::shape2 : HandleTag::shape3;

    HandleTag tag = own_tag;
    AnyShape<D> shape;
    ShapeSource<D> source{};
    bool is_half_space = false;
    bool was_stretched = false;
    bool was_rounded_after_stretching = false;
};

template <int D>
struct WorldHandle {
    static constexpr HandleTag own_tag = D == 2 ? HandleTag::world2 : HandleTag::world3;

    HandleTag tag = own_tag;
    World<D> world;
};

template <int D>
struct FieldHandle {
    static constexpr HandleTag own_tag = D == 2 ? HandleTag::field2 : HandleTag::field3;

    HandleTag tag = own_tag;
    Field<D> field;
};

template <int D>
struct ShapesHandle {
    static constexpr HandleTag own_tag = D == 2 ? HandleTag::shapes2 : HandleTag::shapes3;

    HandleTag tag = own_tag;
    std::vector<PolytopeOf<D>> shapes;
};

}  // namespace abut::detail

struct abut_shape2 : abut::detail::ShapeHandle<2> {};
struct abut_shape3 : abut::detail::ShapeHandle<3> {};
struct abut_world2 : abut::detail::WorldHandle<2> {};
struct abut_world3 : abut::detail::WorldHandle<3> {};
struct abut_field2 : abut::detail::FieldHandle<2> {};
struct abut_field3 : abut::detail::FieldHandle<3> {};
struct abut_shapes2 : abut::detail::ShapesHandle<2> {};
struct abut_shapes3 : abut::detail::ShapesHandle<3> {};

struct abut_buffer {
    static constexpr auto own_tag = abut::detail::HandleTag::buffer;

    abut::detail::HandleTag tag = own_tag;
    std::vector<std::byte> bytes{};
};

struct abut_thread_pool {
    static constexpr auto own_tag = abut::detail::HandleTag::thread_pool;

    explicit abut_thread_pool(std::uint32_t workers) : pool(workers) {}

    abut::detail::HandleTag tag = own_tag;
    abut::ThreadPool pool;
};

struct abut_walk_mesh {
    static constexpr auto own_tag = abut::detail::HandleTag::walk_mesh;

    abut::detail::HandleTag tag = own_tag;
    abut::WalkMesh mesh;
};

namespace abut::detail {

/// The types of the C API by dimension.
template <int D>
struct CTypes;
#define ABUT_C_TYPES(D)                             \
    template <>                                     \
    struct CTypes<D> {                              \
        using Vec = abut_vec##D;                    \
        using Pose = abut_pose##D;                  \
        using Aabb = abut_aabb##D;                  \
        using Ray = abut_ray##D;                    \
        using Motion = abut_motion##D;              \
        using Shape = abut_shape##D;                \
        using Shapes = abut_shapes##D;              \
        using Measures = abut_measures##D;          \
        using HalfSpace = abut_half_space##D;       \
        using Closest = abut_closest##D;            \
        using ContactPoint = abut_contact_point##D; \
        using Contact = abut_contact##D;            \
        using Hit = abut_hit##D;                    \
        using Certificate = abut_certificate##D;    \
        using World = abut_world##D;                \
        using ItemOptions = abut_item_options##D;   \
        using WorldContact = abut_world_contact##D; \
        using WorldImpact = abut_world_impact##D;   \
        using WorldHit = abut_world_hit##D;         \
        using WorldClosest = abut_world_closest##D; \
        using Field = abut_field##D;                \
        using FieldSample = abut_field_sample##D;   \
    };
ABUT_C_TYPES(2)
ABUT_C_TYPES(3)
#undef ABUT_C_TYPES

/// Two half-spaces are no pair.
template <int D>
Fault pair_of(const ShapeHandle<D>* a, const ShapeHandle<D>* b) {
    for (const ShapeHandle<D>* shape : {a, b})
        if (present(shape, "").code != ABUT_OK || !shape->is_half_space) return {};  // another fault, or a pair
    return {ABUT_WRONG_SHAPE, "b", "is a half-space as a is, and two half-spaces are no pair"};
}

/// A shape of the library at a pose, as a World places its items.
template <int D>
struct PlacedShape {
    AnyShape<D> shape;
    Pose<D> pose;
};
template <int D>
View<D> view(const PlacedShape<D>& placed) {
    return placed.shape.placed(placed.pose);
}
template <int D>
Aabb<D> bounds(const PlacedShape<D>& placed) {
    return placed.shape.bounds(placed.pose);
}

/// Writes a new handle of a shape that is finite.
template <int D, class S>
abut_code give_shape(const S& shape, typename CTypes<D>::Shape** out, ShapeSource<D> source = {}) {
    AnyShape<D> any(shape);
    const View<D> own = any.view();
    if (!is_finite(own)) return report(Fault{ABUT_NOT_FINITE, "the shape", "is not finite"});
    *out = new typename CTypes<D>::Shape{{.shape = std::move(any), .source = std::move(source)}};
    (*out)->is_half_space = std::holds_alternative<HalfSpaceView<D>>(own);
    return ABUT_OK;
}
/// Of a builder's result.
template <int D, class S>
abut_code give_built(const Result<S>& built, typename CTypes<D>::Shape** out) {
    if (!built) return report(built.problem());
    if constexpr (std::is_constructible_v<ShapeSource<D>, S>)
        return give_shape<D>(*built, out, *built);
    else
        return give_shape<D>(*built, out);
}

}  // namespace abut::detail
