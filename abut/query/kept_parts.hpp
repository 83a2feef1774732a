#pragma once

// The parts of a composite shape that are near another, found once for many questions. For .cpp files.

#include <abut/query/felt_normal.hpp>

#include <cstddef>
#include <new>
#include <type_traits>

namespace abut {

/// Kept on the stack: there is room for as many as a thing of a level's own size meets. Where there are more, or they
/// are made up by the shape while it shows them, the shape has to be asked again.
template <int D>
class KeptParts {
public:
    static constexpr std::uint32_t capacity = 64;

    /// Takes all that the shape shows within a box, in the order in which it does. False, and nothing is kept, where
    /// they can't be.
    bool keep(const Composite<D>& shape, const Aabb<D>& box);

    std::uint32_t size() const { return count_; }
    const Convex<D>& part(std::uint32_t i) const { return kept(i).part; }
    /// Its number in the shape.
    std::uint32_t index(std::uint32_t i) const { return kept(i).index; }
    const Aabb<D>& box(std::uint32_t i) const { return boxes_[i]; }

    /// As each_foot_on tells them. False, and nothing was told, where it is asked of places beyond the box.
    bool each_foot(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;

private:
    struct Kept {
        Convex<D> part;
        std::uint32_t index;
    };
    static_assert(std::is_trivially_destructible_v<Kept>);

    const Kept& kept(std::uint32_t i) const { return *std::launder(reinterpret_cast<const Kept*>(room_) + i); }

    Aabb<D> box_ = Aabb<D>::empty();
    std::uint32_t count_ = 0;
    Aabb<D> boxes_[capacity];
    /// To make all of them at once would take longer than to ask.
    alignas(Kept) std::byte room_[capacity * sizeof(Kept)];
};

extern template class KeptParts<2>;
extern template class KeptParts<3>;

}  // namespace abut
