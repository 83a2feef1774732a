// Box queries of a mesh's tree: overlap and nearest first on the boxes of its triangles, and a moving box also on the
// triangles themselves. Compiled for each SIMD target by Highway, which selects one at run time.

#include <abut/shape/mesh/tree.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh/box_queries.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/triangle_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// The boxes of a leaf's triangles, with their indices in the mesh.
struct TriangleBoxes : BvhLeaf<3> {
    const MeshLeaf* triangles;
};

/// Computes the boxes of a leaf.
struct LeafBoxes {
    const MeshTree& tree;

    TriangleBoxes operator()(std::uint32_t ref) const {
        const MeshLeaf& leaf = tree.leaf(ref);
        TriangleBoxes result;
        result.triangles = &leaf;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V3 a = numbers.pick<0>(leaf.corner), b = numbers.pick<1>(leaf.corner),
                     c = numbers.pick<2>(leaf.corner);
            hn::Store(hn::Min(hn::Min(a.x, b.x), c.x), bvh_tag, result.min[0] + lane);
            hn::Store(hn::Min(hn::Min(a.y, b.y), c.y), bvh_tag, result.min[1] + lane);
            hn::Store(hn::Min(hn::Min(a.z, b.z), c.z), bvh_tag, result.min[2] + lane);
            hn::Store(hn::Max(hn::Max(a.x, b.x), c.x), bvh_tag, result.max[0] + lane);
            hn::Store(hn::Max(hn::Max(a.y, b.y), c.y), bvh_tag, result.max[1] + lane);
            hn::Store(hn::Max(hn::Max(a.z, b.z), c.z), bvh_tag, result.max[2] + lane);
        }
        const std::uint32_t count = leaf.count();
        for (std::uint32_t lane = 0; lane < count; ++lane) result.index[lane] = tree.order[leaf.first + lane];
        for (std::uint32_t lane = count; lane < mesh_lanes; ++lane) {
            result.clear(lane);
            result.index[lane] = detail::bvh_none;
        }
        return result;
    }
};

/// Which triangles a moving box may touch, by separating axes over the time of the motion: after the boxes of the
/// triangles their planes, which give a later time of entry, and the three axes across an edge and the motion. The
/// latter are tested in a projection along the motion, as in RayTriangleTest.
class MovingBoxTest {
public:
    explicit MovingBoxTest(const RayReach<3>& reach) : boxes_(reach) {
        const DVec<3> center = (reach.low() + reach.high()) * 0.5, half = (reach.high() - reach.low()) * 0.5;
        const DVec<3>& direction = reach.direction();
        const int dominant = longest_axis<3>(direction);
        const double across = half.x + half.y + half.z;
        // It exceeds the tolerances of sweeps, and the rounding of the center.
        padding_ = static_cast<float>(1e-6 * across +
                                      0x1p-23 * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z)));
        across_ = rounded_up(across) + padding_;
        for (int i = 0; i < 3; ++i) {
            const int axis = (dominant + 1 + i) % 3;
            axes_[i] = axis;
            center_[i] = static_cast<float>(center[axis]);
            half_[i] = rounded_up(half[axis]) + padding_;
            direction_[i] = static_cast<float>(direction[axis]);
            slope_[i] = static_cast<float>(direction[axis] / direction[dominant]);
        }
    }

    HWY_INLINE std::uint32_t operator()(const BvhRows<3>& rows, float max_measure, float (&measures)[bvh_lanes]) const {
        return boxes_(rows, max_measure, measures);
    }
    HWY_INLINE std::uint32_t operator()(const TriangleBoxes& leaf, float max_measure,
                                        float (&measures)[bvh_lanes]) const {
        const std::uint32_t bits = boxes_(leaf, max_measure, measures);
        return bits == 0 ? 0 : bits & touched(*leaf.triangles, max_measure, measures);
    }

private:
    HWY_INLINE std::uint32_t touched(const MeshLeaf& leaf, float max_measure, float (&measures)[bvh_lanes]) const {
        const float reach = leaf.extent + across_, padding = padding_ + 1e-6f * leaf.extent;
        const float corner_error =
            0x1p-21f * std::abs(leaf.corner[axes_[2]][0] - center_[2]) + 0x1p-20f * reach + padding;
        const V area_error = hn::Set(bvh_tag, 16 * corner_error * (reach + corner_error));
        LeafRows<3> places, projected;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V along = from_center(leaf, 2, lane);
            places.set(2, lane, along);
            for (int i = 0; i < 2; ++i) {
                const V across = from_center(leaf, i, lane);
                places.set(i, lane, across);
                projected.set(i, lane, hn::Sub(across, hn::Mul(along, hn::Set(bvh_tag, slope_[i]))));
            }
        }
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V2 corners[3] = {numbers.pick<0>(projected), numbers.pick<1>(projected), numbers.pick<2>(projected)};
            const V2 ab = minus(corners[1], corners[0]), ac = minus(corners[2], corners[0]);
            const V area = hn::Sub(hn::Mul(ab.x, ac.y), hn::Mul(ab.y, ac.x));
            BvhMask misses = misses_edge(corners[0], ab, area, area_error);
            misses = hn::Or(misses, misses_edge(corners[1], minus(corners[2], corners[1]), area, area_error));
            misses = hn::Or(misses, misses_edge(corners[0], minus(corners[0], corners[2]), area, area_error));

            const V entry =
                plane_entry(pick<0>(numbers, places), pick<1>(numbers, places), pick<2>(numbers, places), padding);
            misses = hn::Or(misses, hn::Gt(entry, hn::Set(bvh_tag, max_measure)));
            const V of_box = hn::LoadU(bvh_tag, measures + lane);
            hn::StoreU(hn::IfThenElse(hn::Gt(entry, of_box), entry, of_box), bvh_tag, measures + lane);
            result |= (~bits_of(misses) & ((1u << bvh_step) - 1)) << lane;
        }
        return result;
    }
    HWY_INLINE V from_center(const MeshLeaf& leaf, int i, std::uint32_t lane) const {
        return hn::Sub(hn::Load(bvh_tag, leaf.corner[axes_[i]] + lane), hn::Set(bvh_tag, center_[i]));
    }
    template <int which>
    static HWY_INLINE V3 pick(const LeafNumbers& numbers, const LeafRows<3>& rows) {
        return {numbers.pick_row<which>(rows, 0), numbers.pick_row<which>(rows, 1), numbers.pick_row<which>(rows, 2)};
    }

    /// Whether box and triangle are disjoint in projection along the edge, which leads on from the corner.
    HWY_INLINE BvhMask misses_edge(const V2& corner, const V2& edge, V area, V area_error) const {
        const V at_edge = hn::Sub(hn::Mul(edge.y, corner.x), hn::Mul(edge.x, corner.y)),
                opposite = hn::Sub(at_edge, area);
        const V sheared =
            hn::Sub(hn::Mul(edge.y, hn::Set(bvh_tag, slope_[0])), hn::Mul(edge.x, hn::Set(bvh_tag, slope_[1])));
        const V box = hn::Add(hn::Add(hn::Mul(hn::Abs(edge.y), hn::Set(bvh_tag, half_[0])),
                                      hn::Mul(hn::Abs(edge.x), hn::Set(bvh_tag, half_[1]))),
                              hn::Add(hn::Mul(hn::Abs(sheared), hn::Set(bvh_tag, half_[2])), area_error));
        return hn::Or(hn::Gt(hn::Min(at_edge, opposite), box), hn::Gt(hn::Neg(hn::Max(at_edge, opposite)), box));
    }

    /// A lower bound of the time at which the box enters the triangle's plane; infinite or NaN if there is none.
    HWY_INLINE V plane_entry(const V3& a, const V3& b, const V3& c, float padding) const {
        const V3 ab = minus(b, a), ac = minus(c, a), normal = cross(ab, ac);
        const V product = hn::Mul(size(ab), size(ac));
        const V error = hn::Mul(product, hn::Set(bvh_tag, 0x1p-20f));
        const V3 direction{hn::Set(bvh_tag, direction_[0]), hn::Set(bvh_tag, direction_[1]),
                           hn::Set(bvh_tag, direction_[2])};
        const V height = dot(normal, a), speed = dot(normal, direction);
        const V box = hn::Add(hn::Add(hn::Mul(hn::Abs(normal.x), hn::Set(bvh_tag, half_[0])),
                                      hn::Mul(hn::Abs(normal.y), hn::Set(bvh_tag, half_[1]))),
                              hn::Add(hn::Mul(hn::Abs(normal.z), hn::Set(bvh_tag, half_[2])),
                                      hn::Add(hn::Mul(error, hn::Add(size(a), hn::Set(bvh_tag, across_))),
                                              hn::Mul(product, hn::Set(bvh_tag, padding)))));
        const V gap = hn::Sub(hn::Abs(height), box);
        const V closing = hn::Max(hn::CopySign(speed, hn::Mul(speed, height)), hn::Zero(bvh_tag));
        return hn::Div(gap, hn::Add(closing, hn::Mul(error, size(direction))));
    }
    static HWY_INLINE V size(const V3& v) { return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z)); }

    RayLanes<3, true> boxes_;
    int axes_[3];  ///< two across the motion, and last the dominant one; the other numbers are in this order
    float center_[3], half_[3], direction_[3], slope_[3];
    float across_, padding_;
};

void overlapping_boxes(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    visit_overlapping<3>(tree, LeafBoxes{tree}, box, visit);
}
void along_boxes(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    RayReach<3> remaining = reach;
    if (RayLanes<3, true>::is_in_range(reach))
        visit_within<3>(tree, LeafBoxes{tree}, remaining, MovingBoxTest(reach), visit);
    else
        visit_within<3>(tree, LeafBoxes{tree}, remaining, ScalarLanes<3, RayReach<3>>(remaining), visit);
}
void near_boxes(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    visit_near<3>(tree, LeafBoxes{tree}, reach, visit);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(overlapping_boxes);
HWY_EXPORT(along_boxes);
HWY_EXPORT(near_boxes);

void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    const Aabb3 query = usable(box);
    if (!is_empty(query)) HWY_DYNAMIC_DISPATCH(overlapping_boxes)(tree, query, visit);
}
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_boxes)(tree, reach, visit);
}
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_boxes)(tree, reach, visit);
}

}  // namespace abut::detail
#endif
