#pragma once

// A closed mesh as a solid: the adapter `solid(mesh)`.

#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>

#include <type_traits>
#include <utility>

namespace abut {

/// A closed mesh with everything inside it, for every query of overlap, distance and contact.
template <class S>
struct Solid {
    S mesh;
};

/// `mesh` as a solid. Its distance to another solid or a convex shape is below zero exactly where a point of one is in
/// the interior of the other. The depth is a move that parts the two. Rays and sweeps hit it where they enter it. The
/// view refers to an lvalue and owns an rvalue, and composes with `at` and `stretched`. A mesh that isn't closed stays
/// the union of its triangles, and so does a solid that is `rounded` or in a Compound.
template <class S>
requires std::is_same_v<std::remove_cvref_t<S>, Mesh> Solid<S> solid(S&& mesh) {
    return {std::forward<S>(mesh)};
}

template <class S>
detail::Composite<3> view(const Solid<S>& shape) {
    detail::Composite<3> result = view(std::as_const(shape.mesh));
    if (shape.mesh.closed()) result.solid = &mesh_surface(shape.mesh);
    return result;
}

template <class S>
Aabb3 bounds(const Solid<S>& shape) {
    return bounds(shape.mesh);
}

namespace detail {

template <class S>
struct Owned<Solid<S>> {
    using type = Solid<Mesh>;
};

}  // namespace detail

template <class S>
requires Ownable<std::remove_cvref_t<S>> Solid<Mesh> owned(const Solid<S>& shape) {
    return {shape.mesh};
}

}  // namespace abut
