#pragma once

// What takes the place of a removed child of a Compound. For .cpp files.

#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// A shape without parts, which no query finds.
template <int D>
struct RemovedChild {};

template <int D>
Aabb<D> bounds(const RemovedChild<D>&) {
    return Aabb<D>::empty();
}
template <int D>
void each_part(const RemovedChild<D>&, const Aabb<D>&, std::type_identity_t<PartVisitor<D>>) {}

template <int D>
inline constexpr CompositeKind composite_kind<RemovedChild<D>> = CompositeKind::removed_child;

template <int D>
bool is_removed_child(const View<D>& child) {
    const auto* composite = std::get_if<Composite<D>>(&child);
    return composite != nullptr && composite->kind == CompositeKind::removed_child;
}

}  // namespace abut::detail
