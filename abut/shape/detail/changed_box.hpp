#pragma once

// Where a shape has changed, so that World::update tests again what is near there alone.

#include <abut/shape/view/mapped_box.hpp>

#include <concepts>
#include <utility>

namespace abut::detail {

/// The box outside of which no answer of a shape has changed since the last take(): everywhere at first, and after a
/// copy or an assignment, since the shape may then be another one.
template <int D>
class ChangedBox {
public:
    ChangedBox() = default;
    ChangedBox(const ChangedBox&) noexcept {}
    ChangedBox& operator=(const ChangedBox&) noexcept {
        box_ = everywhere<D>();
        return *this;
    }

    void add(const Aabb<D>& box) { box_ = merged(box_, box); }
    Aabb<D> take() { return std::exchange(box_, Aabb<D>::empty()); }

private:
    Aabb<D> box_ = everywhere<D>();
};

template <class S, int D>
concept RemembersChanges = requires(S& shape) {
    { take_changed(shape) } -> std::same_as<Aabb<D>>;
};

/// Calls edit(shape), and returns the box outside of which that changed no answer.
template <int D, class S, class F>
Aabb<D> edit_and_take_changed(S& shape, F&& edit) {
    constexpr bool remembers = RemembersChanges<S, D>;
    if constexpr (remembers) take_changed(shape);
    edit(shape);
    if constexpr (remembers)
        return take_changed(shape);
    else
        return everywhere<D>();
}

}  // namespace abut::detail
