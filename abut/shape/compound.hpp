#pragma once

// Several shapes as one.

#include <abut/math/result.hpp>
#include <abut/shape/any_shape.hpp>

#include <initializer_list>
#include <memory>
#include <span>

namespace abut {

/// The union of its children: any shapes but half-spaces and distance functions, fields among them, each where `at`
/// puts it. Every answer tells the child, by its number in the order given, as its part; of a child that is composite
/// itself, the child all the same. A child that is solid in `contains`, such as a closed mesh, is so here. Immutable:
/// copies share the data, and a mesh that is a child is shared too. Memory: the children, about 350 bytes for each, and
/// the tree of a Bvh.
template <int D>
class Compound {
public:
    /// A Problem where there are no children, or where one isn't finite, or is no such shape; its index is the child's.
    static Result<Compound> build(std::span<const AnyShape<D>> children);
    static Result<Compound> build(std::initializer_list<AnyShape<D>> children) {
        return build(std::span<const AnyShape<D>>(children.begin(), children.size()));
    }

    std::uint32_t size() const;  ///< of children
    const View<D>& child(std::uint32_t index) const;

    Aabb<D> bounds() const;
    void each_part(const Aabb<D>& box, PartVisitor<D> visit) const;
    void each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const;
    void each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const;
    bool solid_contains(const Vec<D>& point) const;

private:
    struct Data;
    explicit Compound(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    std::shared_ptr<const Data> data_;
};

extern template class Compound<2>;
extern template class Compound<3>;
using Compound2 = Compound<2>;
using Compound3 = Compound<3>;

/// Of all children together.
template <int D>
Aabb<D> bounds(const Compound<D>& compound) {
    return compound.bounds();
}

/// Visits the children, or the parts of those that have some, whose boxes overlap `box`; the visitor returns false to
/// stop.
template <int D>
void each_part(const Compound<D>& compound, const Aabb<D>& box, std::type_identity_t<PartVisitor<D>> visit) {
    compound.each_part(box, visit);
}

/// Visits those that the moving box meets, roughly in the order in which it does; the visitor returns the new, shorter
/// reach.
template <int D>
void each_part_along(const Compound<D>& compound, const MovingBox<D>& box,
                     std::type_identity_t<PartReachVisitor<D>> visit) {
    compound.each_part_along(box, visit);
}

/// Visits them, roughly those first whose boxes are nearest to `box`; the visitor returns the new, shorter reach.
template <int D>
void each_part_near(const Compound<D>& compound, const Aabb<D>& box, std::type_identity_t<PartReachVisitor<D>> visit) {
    compound.each_part_near(box, visit);
}

/// Whether the point is inside of a child that is solid, without its parts.
template <int D>
bool solid_contains(const Compound<D>& compound, const Vec<D>& point) {
    return compound.solid_contains(point);
}

}  // namespace abut
