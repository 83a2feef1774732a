// The stacks of ray traversals of a mesh's tree, one for each order of descent. Included once for each Highway target.

#if defined(ABUT_MESH_TRAVERSAL_STACK) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MESH_TRAVERSAL_STACK
#undef ABUT_MESH_TRAVERSAL_STACK
#else
#define ABUT_MESH_TRAVERSAL_STACK
#endif

#include <abut/math/simd/compiler-inl.h>
#include <abut/shape/mesh/triangle_simd-inl.h>

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// The addresses of the nodes and leaves of a tree.
class TreeAddresses {
public:
    explicit HWY_INLINE TreeAddresses(const MeshTree& tree)
        : arrays_{{reinterpret_cast<std::uintptr_t>(tree.nodes.data()), sizeof(MeshNode)},
                  {reinterpret_cast<std::uintptr_t>(tree.leaves.data()), sizeof(MeshLeaf)}} {}

    HWY_INLINE const MeshNode& node(std::uint32_t ref) const {
        return reinterpret_cast<const MeshNode*>(arrays_[0].begin)[ref];
    }
    HWY_INLINE const MeshLeaf& leaf(std::uint32_t ref) const {
        return reinterpret_cast<const MeshLeaf*>(arrays_[1].begin)[ref & ~bvh_leaf_bit];
    }
    /// Prefetches a node or leaf that is likely to be visited soon, or nothing for bvh_none. Without a branch, since
    /// the kind is unpredictable: the size of a node is taken for both.
    HWY_INLINE void prefetch(std::uint32_t ref) const {
        const Array& array = arrays_[ref / bvh_leaf_bit];
        const std::uintptr_t begin = array.begin + array.stride * (ref & ~bvh_leaf_bit);
        for (std::uintptr_t line = 0; line < sizeof(MeshNode); line += 64)
            detail::prefetch(reinterpret_cast<const void*>(begin + line));
    }

private:
    struct Array {
        std::uintptr_t begin;
        std::size_t stride;
    };
    Array arrays_[2];
};

/// Visits the nearest child first.
class NearestFirstStack {
public:
    HWY_INLINE NearestFirstStack() { entries_[0] = entries_[1] = entry(0, bvh_none); }

    /// The nearest of a node's children that are hit; pushes the others, nearest on top. The next entry if there is
    /// none.
    HWY_INLINE std::uint32_t descend(const TreeAddresses& addresses, const MeshNode& node, std::uint64_t bits,
                                     const float (&times)[mesh_lanes], float max_time) {
        if (bits == 0) return pop(addresses, max_time);
        const auto next = [&] {
            const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
            bits &= bits - 1;
            return entry(times[lane], node.child[lane]);
        };
        Entry first = next();
        if (bits == 0) return static_cast<std::uint32_t>(first);
        Entry second = next();
        order(first, second);
        if (bits != 0) {
            Entry third = next();
            order(first, third);
            order(second, third);
            Entry* const bottom = top_;
            *top_++ = third;
            while (bits != 0) {
                Entry other = next();
                order(first, other);
                order(second, other);
                Entry* place = top_++;
                for (; place > bottom && place[-1] < other; --place) *place = place[-1];
                *place = other;
            }
        }
        addresses.prefetch(static_cast<std::uint32_t>(second));
        *top_++ = second;
        return static_cast<std::uint32_t>(first);
    }

    /// The next entry up to a time; bvh_none if there is none.
    HWY_INLINE std::uint32_t pop(const TreeAddresses& addresses, float max_time) {
        const Entry limit = entry(max_time, bvh_none);
        while (*--top_ > limit) {
        }
        addresses.prefetch(static_cast<std::uint32_t>(top_[-1]));
        return static_cast<std::uint32_t>(*top_);
    }

private:
    /// The time in the upper half, since bits of non-negative floats are ordered, without the sign of -0; the reference
    /// in the lower half.
    using Entry = std::uint64_t;

    static HWY_INLINE Entry entry(float time, std::uint32_t ref) {
        return Entry{std::bit_cast<std::uint32_t>(time)} << 33 | ref;
    }
    /// By arithmetic: the order is unpredictable, and compilers turn a choice into a branch.
    static HWY_INLINE void order(Entry& first, Entry& second) {
        const Entry differ = (first ^ second) & (0 - static_cast<Entry>(second < first));
        first ^= differ;
        second ^= differ;
    }

    Entry entries_[max_stack_size + 2];  ///< the first two are no child; one more is prefetched than visited
    Entry* top_ = entries_ + 2;
};

/// For each set of lanes, their count and the lanes but for the first.
struct LaneSets {
    constexpr LaneSets() {
        for (std::uint32_t bits = 1; bits < count; ++bits) {
            std::size_t place = 0;
            for (std::uint32_t rest = bits & (bits - 1); rest != 0; rest &= rest - 1)
                others[bits][place++] = static_cast<std::uint8_t>(std::countr_zero(rest));
            sizes[bits] = static_cast<std::uint8_t>(place + 1);
        }
    }

    static constexpr std::uint32_t count = 1u << mesh_lanes;
    std::uint8_t others[count][mesh_lanes]{};
    std::uint8_t sizes[count]{};
};
inline constexpr LaneSets lane_sets;

/// Visits the children in the order of their lanes. Without branches, since the number of children that are hit is
/// unpredictable.
class LaneOrderStack {
public:
    HWY_INLINE LaneOrderStack() { entries_[0] = entries_[1] = bvh_none; }

    /// The first of a node's children that are hit; pushes the others. The next entry if there is none.
    HWY_INLINE std::uint32_t descend(const TreeAddresses& addresses, const MeshNode& node, std::uint32_t bits,
                                     const float (&)[mesh_lanes], float) {
        const std::uint32_t first = node.child[std::countr_zero(std::uint64_t{bits} | 1u << (mesh_lanes - 1))];
        const std::uint32_t result = bits != 0 ? first : top_[-1];
        const auto& others = lane_sets.others[bits];
        if constexpr (bvh_step == mesh_lanes) {
            constexpr hn::RebindToUnsigned<BvhVectorTag> tag;
            const auto bytes = hn::LoadU(hn::Rebind<std::uint8_t, BvhVectorTag>(), others);
            const auto lanes = hn::IndicesFromVec(tag, hn::PromoteTo(hn::RebindToSigned<BvhVectorTag>(), bytes));
            hn::StoreU(hn::TableLookupLanes(hn::Load(tag, node.child), lanes), tag, top_);
        } else {
            for (std::size_t i = 0; i < mesh_lanes; ++i) top_[i] = node.child[others[i]];
        }
        top_ += static_cast<std::ptrdiff_t>(lane_sets.sizes[bits]) - 1;
        addresses.prefetch(top_[-1]);
        return result;
    }

    HWY_INLINE std::uint32_t pop(const TreeAddresses& addresses, float) {
        addresses.prefetch(top_[-2]);
        return *--top_;
    }

private:
    /// The first two are no child; one more is prefetched than visited. Eight are written at a time.
    std::uint32_t entries_[max_stack_size + 2 + mesh_lanes];
    std::uint32_t* top_ = entries_ + 2;
};

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
