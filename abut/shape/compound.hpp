#pragma once

// Compound: several shapes as one.

#include <abut/math/result.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/detail/changed_box.hpp>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace abut {

template <int D>
class Compound;

}  // namespace abut

namespace abut::detail {

template <int D>
Result<Compound<D>> load_nested(std::span<const std::byte> bytes, int nesting);

}  // namespace abut::detail

namespace abut {

/// The union of its children, each placed by `at`. A child may be any shape but a half-space or a distance function
/// (such as a field). Answers report the index of the child as the part, also if the child is composite. A child that
/// is solid in `contains`, such as a closed mesh, is solid here. Copies share the data until one of them changes, and
/// meshes are shared too. Memory: about 350 bytes for each child, and a Bvh.
///
/// Children can be added, removed, replaced and moved; all answers are then those of a compound that is built of the
/// children there are. It takes about a microsecond, and the time of a copy if another compound shares the data. Now
/// and then, at most once in as many changes as there are children, the Bvh is updated. In a World: World::edit_shape.
template <int D>
class Compound {
public:
    /// Returns a Problem if there are no children, or if a child isn't finite or is of a kind that is not allowed
    /// (index: the child).
    static Result<Compound> build(std::span<const AnyShape<D>> children);
    static Result<Compound> build(std::initializer_list<AnyShape<D>> children) {
        return build(std::span<const AnyShape<D>>(children.begin(), children.size()));
    }

    /// Adds a child at a pose and returns its index: the smallest one of a removed child, or else size(), which grows
    /// by one. The indices of the others stay. Returns a Problem as `build` does; the compound is then unchanged.
    Result<std::uint32_t> add(const AnyShape<D>& child, const Pose<D>& pose = {});
    /// Replaces a child, or puts one where a child was removed: so a part is switched off and on. Returns a Problem as
    /// `build` does; the compound is then unchanged.
    std::optional<Problem> set(std::uint32_t index, const AnyShape<D>& child, const Pose<D>& pose = {});
    /// Sets the pose of a child, in place of the one it was added with. The pose is applied after the position that the
    /// shape had when it was given to `build`, `add`, `set` or a file. Returns a Problem if the child is then not
    /// finite; the compound is unchanged.
    std::optional<Problem> move(std::uint32_t index, const Pose<D>& pose);
    /// Removes a child. `add` may reuse its index. All of them may be removed.
    void remove(std::uint32_t index);

    std::uint32_t size() const;                 ///< number of children, with those that were removed and not replaced
    bool has_child(std::uint32_t index) const;  ///< false if the child was removed
    /// It is valid until the compound changes; of a removed child it has no parts.
    const View<D>& child(std::uint32_t index) const;

    Aabb<D> bounds() const;
    void each_part(const Aabb<D>& box, detail::PartVisitor<D> visit) const;
    void each_part_along(const MovingBox<D>& box, detail::PartReachVisitor<D> visit) const;
    void each_part_near(const Aabb<D>& box, detail::PartReachVisitor<D> visit) const;
    bool solid_contains(const Vec<D>& point) const;
    /// The box outside of which no answer has changed since the last call.
    Aabb<D> take_changed() { return changed_.take(); }

private:
    template <int E>
    friend Result<std::vector<std::byte>> save(const Compound<E>& compound);
    template <int E>
    friend Result<Compound<E>> detail::load_nested(std::span<const std::byte> bytes, int nesting);

    struct Data;
    explicit Compound(std::shared_ptr<Data> data) : data_(std::move(data)) {}
    Data& own_data();
    void put(std::uint32_t index, const AnyShape<D>& child, const View<D>& placed, const Aabb<D>& box);

    std::shared_ptr<Data> data_;  // of this compound alone before it changes
    detail::ChangedBox<D> changed_;
};

extern template class Compound<2>;
extern template class Compound<3>;
using Compound2 = Compound<2>;
using Compound3 = Compound<3>;

/// The box around all children.
template <int D>
Aabb<D> bounds(const Compound<D>& compound) {
    return compound.bounds();
}

/// The box outside of which no answer has changed since the last call, for World::edit_shape.
template <int D>
Aabb<D> take_changed(Compound<D>& compound) {
    return compound.take_changed();
}

/// Visits the convex children and the parts of composite children whose boxes overlap `box`. The visitor returns false
/// to stop.
template <int D>
void each_part(const Compound<D>& compound, const Aabb<D>& box, std::type_identity_t<detail::PartVisitor<D>> visit) {
    compound.each_part(box, visit);
}

/// Visits the parts whose boxes the moving box overlaps, roughly front to back. The visitor returns the new, shorter
/// reach.
template <int D>
void each_part_along(const Compound<D>& compound, const MovingBox<D>& box,
                     std::type_identity_t<detail::PartReachVisitor<D>> visit) {
    compound.each_part_along(box, visit);
}

/// Visits the parts, roughly nearest first by the distance of their boxes to `box`. The visitor returns the new,
/// shorter reach.
template <int D>
void each_part_near(const Compound<D>& compound, const Aabb<D>& box,
                    std::type_identity_t<detail::PartReachVisitor<D>> visit) {
    compound.each_part_near(box, visit);
}

/// True if the point is inside a solid child. The surface parts of the child are not tested.
template <int D>
bool solid_contains(const Compound<D>& compound, const Vec<D>& point) {
    return compound.solid_contains(point);
}

namespace detail {

template <int D>
inline constexpr CompositeKind composite_kind<Compound<D>> = CompositeKind::compound;

}  // namespace detail

}  // namespace abut
