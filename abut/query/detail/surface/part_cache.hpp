#pragma once

// A cache of the parts of a composite shape near another shape, found once for many queries. For .cpp files.

#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/query/detail/surface/closest_points.hpp>

#include <bit>
#include <cstddef>
#include <new>
#include <type_traits>

namespace abut::detail {

/// Elements are written before they are read. Constructing all elements would cost more than a query that needs few.
template <class T, std::size_t N>
class UninitializedArray {
public:
    static_assert(std::is_trivially_copyable_v<T>);

    T* data() { return std::launder(reinterpret_cast<T*>(storage_)); }
    const T* data() const { return std::launder(reinterpret_cast<const T*>(storage_)); }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& operator[](std::size_t i) const { return data()[i]; }
    static constexpr std::size_t size() { return N; }

private:
    alignas(T) std::byte storage_[N * sizeof(T)];
};

/// The cache lives on the stack and has capacity for the parts that an object of a tile's size touches. It stays empty
/// if there are more, or if the shape creates its parts during a visit; then the shape is queried again.
template <int D>
class PartCache {
public:
    static constexpr std::uint32_t capacity = 64;

    /// Copies all parts within a box, in the order of the visit. Returns false, and stays empty, if it can't hold them.
    bool fill(const Composite<D>& shape, const Aabb<D>& box);

    std::uint32_t size() const { return count_; }
    const Convex<D>& part(std::uint32_t i) const { return entries_[i].part; }
    /// The index of the part in its shape.
    std::uint32_t index(std::uint32_t i) const { return entries_[i].index; }

    /// Calls visit(i) for the parts whose boxes overlap a box, until it returns false.
    template <class Visit>
    void each_overlapping(const Aabb<D>& box, const Visit& visit) const {
        for (std::uint64_t left = overlap_bits(boxes_view(), 0, count_, box); left != 0; left &= left - 1)
            if (!visit(static_cast<std::uint32_t>(std::countr_zero(left)))) return;
    }

    /// Like each_closest_point_on. Returns false, and visits nothing, for a query beyond the box.
    bool each_closest_point(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;

private:
    struct Entry {
        Convex<D> part;
        std::uint32_t index;
    };
    BoxSoaView<D> boxes_view() const {
        BoxSoaView<D> result;
        for (std::size_t axis = 0; axis < D; ++axis) {
            result.min[axis] = min_[axis];
            result.max[axis] = max_[axis];
        }
        return result;
    }

    Aabb<D> box_ = Aabb<D>::empty();
    std::uint32_t count_ = 0;
    /// The boxes of the parts.
    float min_[D][capacity], max_[D][capacity];
    UninitializedArray<Entry, capacity> entries_;
};

/// The closest points on the parts of a composite shape, and on the shapes that continue its surface. A shape of one
/// part is left out: EdgeFilter has its closest point.
template <int D>
struct Surface {
    const View<D>& shape;
    const EachClosestPoint<D>* neighbours = nullptr;  ///< null: there are none
    const PartCache<D>* cache = nullptr;              ///< parts of the shape, or null

    bool is_composite() const { return std::holds_alternative<Composite<D>>(shape); }
    void operator()(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;
};

extern template struct Surface<2>;
extern template struct Surface<3>;
extern template class PartCache<2>;
extern template class PartCache<3>;

}  // namespace abut::detail
