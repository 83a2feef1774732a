// Highway compiles this file once for each instruction set and chooses the best one at run time.
//
// A block of samples first gathers the leaves of the bounding volume hierarchy that may be nearest to any of its
// samples: the distance of a sample exceeds that of the block's center by at most its distance from the center. The
// boxes of these leaves are stored as arrays, relative to the center. Each sample tests the boxes in float, eight at a
// time, and measures the primitives of the near ones in double. If there are too many leaves, each sample traverses the
// tree instead. Neighbouring samples mostly have the same nearest primitive: each starts with the leaf of the one
// before (a warm start).

#include <abut/bake/field/nearest_primitive.hpp>
#include <abut/math/simd/dispatch-inl.h>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/bake/field/nearest_primitive.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, primitive_lanes>;
using HalfFloats = hn::Rebind<float, Doubles>;
using Floats = hn::CappedTag<float, primitive_lanes>;
using V = hn::Vec<Doubles>;

inline V row(const PrimitiveRow& numbers, std::size_t lane) {
    return hn::Load(Doubles(), numbers.data() + lane);
}
inline V between(V number, V low, V high) {
    return hn::Min(hn::Max(number, low), high);
}
template <class Tag>
inline std::uint32_t bits_of(Tag tag, hn::Mask<Tag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(tag, mask, bytes);
    return bytes[0];
}

/// The squared distances of a point from the primitives of a leaf, for some of its lanes.
inline V squared_distances(const PrimitiveLeaf<2>& leaf, std::size_t lane, const DVec<2>& point) {
    const Doubles d;
    const V x = hn::Sub(hn::Set(d, point.x), row(leaf.from[0], lane));
    const V y = hn::Sub(hn::Set(d, point.y), row(leaf.from[1], lane));
    const V ax = row(leaf.along[0], lane), ay = row(leaf.along[1], lane);
    const V along = hn::Mul(hn::Add(hn::Mul(x, ax), hn::Mul(y, ay)), row(leaf.inverse, lane));
    const V t = between(along, hn::Zero(d), hn::Set(d, 1.0));
    const V u = hn::Sub(x, hn::Mul(t, ax)), v = hn::Sub(y, hn::Mul(t, ay));
    return hn::Add(hn::Mul(u, u), hn::Mul(v, v));
}
inline V squared_distances(const PrimitiveLeaf<3>& leaf, std::size_t lane, const DVec<3>& point) {
    const Doubles d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const V px = hn::Sub(hn::Set(d, point.x), row(leaf.corner[0], lane));
    const V py = hn::Sub(hn::Set(d, point.y), row(leaf.corner[1], lane));
    const V pz = hn::Sub(hn::Set(d, point.z), row(leaf.corner[2], lane));
    const auto along = [&](const std::array<PrimitiveRow, 3>& axis) {
        const V xy = hn::Add(hn::Mul(px, row(axis[0], lane)), hn::Mul(py, row(axis[1], lane)));
        return hn::Add(xy, hn::Mul(pz, row(axis[2], lane)));
    };
    const V u = along(leaf.axis[0]), v = along(leaf.axis[1]), height = along(leaf.axis[2]);
    // The Voronoi regions in the plane of the triangle: the distances from its sides, and on which side of each the
    // point lies.
    const V length = row(leaf.length, lane), cx = row(leaf.x, lane), cy = row(leaf.y, lane);
    const V beside = hn::Sub(u, between(u, zero, length));
    V flat = hn::Add(hn::Mul(beside, beside), hn::Mul(v, v));
    const auto from_side = [&](V from, V x, V inverse) {
        const V t = between(hn::Mul(hn::Add(hn::Mul(from, x), hn::Mul(v, cy)), inverse), zero, one);
        const V a = hn::Sub(from, hn::Mul(t, x)), b = hn::Sub(v, hn::Mul(t, cy));
        return hn::Add(hn::Mul(a, a), hn::Mul(b, b));
    };
    const V w = hn::Sub(u, length), x = hn::Sub(cx, length);
    flat = hn::Min(flat, from_side(u, cx, row(leaf.inverse_first, lane)));
    flat = hn::Min(flat, from_side(w, x, row(leaf.inverse_second, lane)));
    const auto inside = hn::And(hn::And(hn::Ge(v, zero), hn::Le(hn::Mul(cx, v), hn::Mul(cy, u))),
                                hn::Ge(hn::Mul(x, v), hn::Mul(cy, w)));
    return hn::Add(hn::Mul(height, height), hn::IfThenElse(inside, zero, flat));
}

/// The boxes whose squared distance from another box is at most `reach`, as a bit mask, and the squared distances.
template <int D>
inline std::uint32_t boxes_near(const PrimitiveBoxes<D>& boxes, const DVec<D>& low, const DVec<D>& high, double reach,
                                double* squares) {
    const Doubles d;
    const HalfFloats half;
    std::uint32_t result = 0;
    for (std::size_t lane = 0; lane < primitive_lanes; lane += hn::Lanes(d)) {
        V sum = hn::Zero(d);
        for (std::size_t i = 0; i < D; ++i) {
            const int k = static_cast<int>(i);
            const V below = hn::Sub(hn::PromoteTo(d, hn::LoadU(half, boxes.min[i].data() + lane)), hn::Set(d, high[k]));
            const V above = hn::Sub(hn::Set(d, low[k]), hn::PromoteTo(d, hn::LoadU(half, boxes.max[i].data() + lane)));
            const V gap = hn::Max(hn::Max(below, above), hn::Zero(d));
            sum = hn::Add(sum, hn::Mul(gap, gap));
        }
        hn::Store(sum, d, squares + lane);
        result |= bits_of(d, hn::Le(sum, hn::Set(d, reach))) << lane;
    }
    return result;
}

/// Searches for the nearest primitive of one point.
template <int D>
class Search {
public:
    Search(const PrimitiveBvh<D>& tree, const DVec<D>& point)
        : tree_(tree), point_(point), rounding_(0x1p-40 * tree.diameter_bound) {}

    std::uint32_t leaf() const { return leaf_; }
    double squared() const { return squared_; }
    /// The squared distance beyond which nothing can be nearest, rounding included.
    double reach() const { return reach_; }
    NearestPrimitive nearest() const { return {squared_, piece_}; }

    void test_leaf(std::uint32_t leaf_number) {
        const Doubles d;
        const PrimitiveLeaf<D>& leaf = tree_.leaves[leaf_number];
        const V closest = hn::Set(d, squared_);
        for (std::size_t lane = 0; lane < primitive_lanes; lane += hn::Lanes(d)) {
            const V squares = squared_distances(leaf, lane, point_);
            if (hn::AllFalse(d, hn::Le(squares, closest))) continue;
            HWY_ALIGN double numbers[hn::MaxLanes(d)];
            hn::Store(squares, d, numbers);
            for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
                const std::uint32_t primitive = leaf.primitive[lane + i];
                if (numbers[i] > squared_ || (numbers[i] == squared_ && primitive >= piece_)) continue;
                squared_ = numbers[i];
                piece_ = primitive;
                leaf_ = leaf_number;
            }
        }
        const double reach = square_root(squared_) * (1 + 0x1p-40) + rounding_;
        reach_ = reach * reach;
    }

    /// Traverses the tree from the root, nearest first.
    void traverse() {
        struct StackEntry {
            double squared;
            std::uint32_t level, group;
        };
        std::array<StackEntry, 7 * 11 + 1> stack;
        std::size_t stack_size = 0;
        stack[stack_size++] = {0, static_cast<std::uint32_t>(tree_.levels.size() - 1), 0};
        while (stack_size > 0) {
            const StackEntry next = stack[--stack_size];
            if (next.squared > reach_) continue;
            HWY_ALIGN double squares[primitive_lanes];
            std::uint32_t bits = boxes_near(tree_.levels[next.level][next.group], point_, point_, reach_, squares);
            std::array<StackEntry, primitive_lanes> found;
            std::size_t count = 0;
            for (; bits != 0; bits &= bits - 1) {
                const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
                std::size_t place = count++;
                for (; place > 0 && found[place - 1].squared < squares[lane]; --place) found[place] = found[place - 1];
                found[place] = {squares[lane], next.level - 1, next.group * primitive_lanes + lane};
            }
            if (next.level > 0) {
                for (std::size_t i = 0; i < count; ++i) stack[stack_size++] = found[i];
            } else {
                while (count-- > 0)
                    if (found[count].squared <= reach_) test_leaf(found[count].group);
            }
        }
    }

private:
    const PrimitiveBvh<D>& tree_;
    DVec<D> point_;
    double rounding_;
    double squared_ = std::numeric_limits<double>::infinity(), reach_ = squared_;
    std::uint32_t piece_ = 0xffffffff, leaf_ = 0;
};

/// The candidate leaves of a block, with their boxes as arrays.
template <int D>
class CandidateLeaves {
public:
    static constexpr std::uint32_t capacity = 256;

    /// Gathers the leaves within reach of a box. Returns false if there are too many. `middle` lies in the box.
    bool gather(const PrimitiveBvh<D>& tree, const DVec<D>& low, const DVec<D>& high, double reach,
                const DVec<D>& middle) {
        count_ = 0;
        const double size = reach + 2 * length(high - low);
        to_unit_ = size > 0 && 1 / size < 1e300 ? 1 / size : 0;
        struct StackEntry {
            std::uint32_t level, group;
        };
        std::array<StackEntry, 7 * 11 + 1> stack;
        std::size_t stack_size = 0;
        stack[stack_size++] = {static_cast<std::uint32_t>(tree.levels.size() - 1), 0};
        while (stack_size > 0) {
            const StackEntry next = stack[--stack_size];
            const PrimitiveBoxes<D>& boxes = tree.levels[next.level][next.group];
            HWY_ALIGN double squares[primitive_lanes];
            std::uint32_t bits = boxes_near(boxes, low, high, reach * reach, squares);
            if (next.level > 0) {
                for (; bits != 0; bits &= bits - 1)
                    stack[stack_size++] = {next.level - 1, next.group * primitive_lanes + lowest(bits)};
                continue;
            }
            for (; bits != 0; bits &= bits - 1) {
                if (count_ == capacity) return false;
                add(boxes, next.group, lowest(bits), middle);
            }
        }
        for (std::uint32_t i = count_; i % primitive_lanes != 0; ++i)
            for (std::size_t k = 0; k < D; ++k) {
                min_[k][i] = std::numeric_limits<float>::infinity();
                max_[k][i] = -std::numeric_limits<float>::infinity();
            }
        return true;
    }

    /// Tests all leaves within reach of a sample. `offset` is the sample's position relative to the middle.
    void search(Search<D>& search, const DVec<D>& offset) const {
        const Floats f;
        std::array<hn::Vec<Floats>, D> at;
        for (std::size_t k = 0; k < D; ++k)
            at[k] = hn::Set(f, static_cast<float>(offset[static_cast<int>(k)] * to_unit_));
        hn::Vec<Floats> reach = hn::Set(f, in_float(search.reach()));
        for (std::uint32_t first = 0; first < count_; first += primitive_lanes) {
            std::uint32_t bits = 0;
            for (std::uint32_t lane = 0; lane < primitive_lanes; lane += static_cast<std::uint32_t>(hn::Lanes(f))) {
                hn::Vec<Floats> sum = hn::Zero(f);
                for (std::size_t k = 0; k < D; ++k) {
                    const auto below = hn::Sub(hn::Load(f, min_[k] + first + lane), at[k]);
                    const auto above = hn::Sub(at[k], hn::Load(f, max_[k] + first + lane));
                    const auto gap = hn::Max(hn::Max(below, above), hn::Zero(f));
                    sum = hn::Add(sum, hn::Mul(gap, gap));
                }
                bits |= bits_of(f, hn::Le(sum, reach)) << lane;
            }
            if (bits == 0) continue;
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t leaf = leaf_[first + lowest(bits)];
                if (leaf != search.leaf()) search.test_leaf(leaf);
            }
            reach = hn::Set(f, in_float(search.reach()));
        }
    }

private:
    static std::uint32_t lowest(std::uint32_t bits) { return static_cast<std::uint32_t>(std::countr_zero(bits)); }
    /// An upper bound of a squared distance in units of the gathered region's size.
    float in_float(double squared) const {
        return static_cast<float>(squared * to_unit_ * to_unit_) * (1 + 0x1p-20f) + 0x1p-100f;
    }

    /// Adds a box relative to the middle, scaled to unit size and widened for rounding. Parts farther away than the
    /// size are clamped.
    void add(const PrimitiveBoxes<D>& boxes, std::uint32_t group, std::uint32_t lane, const DVec<D>& middle) {
        constexpr double wider = 0x1p-20;
        for (std::size_t k = 0; k < D; ++k) {
            const double at = middle[static_cast<int>(k)];
            const double min = (static_cast<double>(boxes.min[k][lane]) - at) * to_unit_;
            const double max = (static_cast<double>(boxes.max[k][lane]) - at) * to_unit_;
            min_[k][count_] = static_cast<float>(std::max(min, -1.0) - wider);
            max_[k][count_] = static_cast<float>(std::min(max, 1.0) + wider);
        }
        leaf_[count_++] = group * primitive_lanes + lane;
    }

    std::uint32_t count_ = 0;
    double to_unit_ = 1;
    HWY_ALIGN float min_[D][capacity];
    HWY_ALIGN float max_[D][capacity];
    std::uint32_t leaf_[capacity];
};

template <int D>
NearestPrimitive nearest_to_point(const PrimitiveBvh<D>& tree, const DVec<D>& point) {
    Search<D> search(tree, point);
    search.traverse();
    return search.nearest();
}

template <int D>
void nearest_to_block(const PrimitiveBvh<D>& tree, const SampleLattice<D>& lattice, const SampleBlock<D>& block,
                      NearestPrimitive* nearest) {
    using Counts = glm::vec<D, std::uint32_t>;
    const auto at = [&](const Counts& local) { return lattice.at(block.first + local * block.stride); };
    const DVec<D> low = at(Counts(0u)), high = at(block.count - 1u), middle = (low + high) * 0.5;
    Search<D> first(tree, middle);
    first.traverse();
    const double reach = square_root(first.reach()) + 0.5 * length(high - low) * (1 + 0x1p-40);
    CandidateLeaves<D> candidates;
    const bool fits = candidates.gather(tree, low, high, reach, middle);

    // Samples are visited in serpentine order, so that each is a neighbour of the one before.
    std::uint32_t leaf = first.leaf();
    Counts local(0u);
    glm::vec<D, bool> back(false);
    for (;;) {
        Search<D> search(tree, at(local));
        search.test_leaf(leaf);
        if (fits)
            candidates.search(search, at(local) - middle);
        else
            search.traverse();
        std::size_t place = local[D - 1];
        for (int i = D - 2; i >= 0; --i) place = place * block.count[i] + local[i];
        nearest[place] = search.nearest();
        leaf = search.leaf();
        int axis = 0;
        for (; axis < D; ++axis) {
            if (back[axis] ? local[axis] > 0 : local[axis] + 1 < block.count[axis]) break;
            back[axis] = !back[axis];
        }
        if (axis == D) return;
        local[axis] += back[axis] ? 0xffffffffu : 1u;
    }
}

ABUT_NAME_DIMENSIONS(nearest_to_point);
ABUT_NAME_DIMENSIONS(nearest_to_block);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(nearest_to_point);
ABUT_EXPORT_DIMENSIONS(nearest_to_block);

template <int D>
NearestPrimitive nearest_primitive(const PrimitiveBvh<D>& tree, const DVec<D>& point) {
    return dispatched_nearest_to_point<D>()(tree, point);
}
template <int D>
void nearest_primitives(const PrimitiveBvh<D>& tree, const SampleLattice<D>& lattice, const SampleBlock<D>& block,
                        NearestPrimitive* nearest) {
    dispatched_nearest_to_block<D>()(tree, lattice, block, nearest);
}

#define ABUT_INSTANTIATE(D)                                                                                  \
    template NearestPrimitive nearest_primitive(const PrimitiveBvh<D>&, const DVec<D>&);                     \
    template void nearest_primitives(const PrimitiveBvh<D>&, const SampleLattice<D>&, const SampleBlock<D>&, \
                                     NearestPrimitive*);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
#endif
