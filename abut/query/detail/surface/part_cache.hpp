#pragma once

// A cache of the parts of a composite shape near another shape, found once for many queries. For .cpp files.

#include <abut/query/detail/surface/surface_normal.hpp>

#include <cstddef>
#include <new>
#include <type_traits>

namespace abut::detail {

/// The cache lives on the stack and has capacity for the parts that an object of a tile's size touches. It stays empty
/// if there are more, or if the shape creates its parts during a visit; then the shape is queried again.
template <int D>
class PartCache {
public:
    static constexpr std::uint32_t capacity = 64;

    /// Copies all parts within a box, in the order of the visit. Returns false, and stays empty, if it can't hold them.
    bool fill(const Composite<D>& shape, const Aabb<D>& box);

    std::uint32_t size() const { return count_; }
    const Convex<D>& part(std::uint32_t i) const { return entry(i).part; }
    /// The index of the part in its shape.
    std::uint32_t index(std::uint32_t i) const { return entry(i).index; }
    const Aabb<D>& box(std::uint32_t i) const { return boxes_[i]; }

    /// Like each_closest_point_on. Returns false, and visits nothing, for a query beyond the box.
    bool each_closest_point(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;

private:
    struct Entry {
        Convex<D> part;
        std::uint32_t index;
    };
    static_assert(std::is_trivially_destructible_v<Entry>);

    const Entry& entry(std::uint32_t i) const { return *std::launder(reinterpret_cast<const Entry*>(storage_) + i); }

    Aabb<D> box_ = Aabb<D>::empty();
    std::uint32_t count_ = 0;
    Aabb<D> boxes_[capacity];
    /// Uninitialised, because constructing all entries would cost more than a query.
    alignas(Entry) std::byte storage_[capacity * sizeof(Entry)];
};

extern template class PartCache<2>;
extern template class PartCache<3>;

}  // namespace abut::detail
