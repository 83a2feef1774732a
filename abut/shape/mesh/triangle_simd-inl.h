// The triangles of a mesh leaf in SIMD vectors. Included once for each Highway target.

#if defined(ABUT_MESH_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MESH_LANES
#undef ABUT_MESH_LANES
#else
#define ABUT_MESH_LANES
#endif

#include <abut/broad_phase/bvh/traversal-inl.h>
#include <abut/shape/mesh/tree.hpp>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

using namespace detail;
using namespace detail::HWY_NAMESPACE;

using V = BvhVector;

struct V3 {
    V x, y, z;
};
HWY_INLINE V3 minus(const V3& a, const V3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

struct V2 {
    V x, y;
};
HWY_INLINE V2 minus(const V2& a, const V2& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)};
}

/// Rows of numbers of a leaf's vertices: in registers where one holds a row, else in memory.
template <int count>
class LeafRows {
public:
    HWY_INLINE void set(int row, std::uint32_t lane, V numbers) {
        if constexpr (bvh_step == mesh_lanes)
            registers_[row] = numbers;
        else
            hn::Store(numbers, bvh_tag, memory_[row] + lane);
    }
    template <class Indices>
    HWY_INLINE V lookup(int row, Indices indices) const {
        if constexpr (bvh_step == mesh_lanes)
            return hn::TableLookupLanes(registers_[row], hn::IndicesFromVec(bvh_tag, indices));
        else
            return hn::GatherIndex(bvh_tag, memory_[row], indices);
    }

private:
    V registers_[bvh_step == mesh_lanes ? count : 1];
    HWY_ALIGN float memory_[bvh_step == mesh_lanes ? 1 : count][mesh_lanes];
};

/// The vertex indices of consecutive triangles of a leaf, one triangle a lane.
class LeafNumbers {
public:
    LeafNumbers(const MeshLeaf& leaf, std::uint32_t lane) {
        const hn::Rebind<std::uint16_t, BvhVectorTag> narrow;
        numbers_ = hn::PromoteTo(tag, hn::LoadU(narrow, leaf.triangle + lane));
    }

    /// The first, second or third corner of each triangle, from the rows of all vertices.
    template <int which>
    HWY_INLINE V3 pick(const float (&rows)[3][mesh_lanes]) const {
        const auto indices = numbers<which>();
        return {lookup(rows[0], indices), lookup(rows[1], indices), lookup(rows[2], indices)};
    }
    template <int which>
    HWY_INLINE V2 pick(const LeafRows<3>& rows) const {
        const auto indices = numbers<which>();
        return {rows.lookup(0, indices), rows.lookup(1, indices)};
    }

    template <int which>
    HWY_INLINE V pick_row(const LeafRows<3>& rows, int row) const {
        return rows.lookup(row, numbers<which>());
    }

private:
    static constexpr hn::RebindToSigned<BvhVectorTag> tag{};
    using Numbers = hn::Vec<hn::RebindToSigned<BvhVectorTag>>;

    template <int which>
    HWY_INLINE Numbers numbers() const {
        Numbers indices = numbers_;
        if constexpr (which > 0) indices = hn::ShiftRight<3 * which>(numbers_);
        return hn::And(indices, hn::Set(tag, 7));
    }
    static HWY_INLINE V lookup(const float* row, Numbers indices) {
        if constexpr (bvh_step == mesh_lanes)
            return hn::TableLookupLanes(hn::Load(bvh_tag, row), hn::IndicesFromVec(bvh_tag, indices));
        else
            return hn::GatherIndex(bvh_tag, row, indices);
    }

    Numbers numbers_;
};

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
