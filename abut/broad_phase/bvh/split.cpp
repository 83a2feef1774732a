// The binned surface area heuristic: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
// Highway compiles this file once for each SIMD target and dispatches at run time. Every operation rounds alike on all
// targets, so that the tree is the same.

#include <abut/broad_phase/bvh/split.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/bvh/split.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 4>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes d;
constexpr std::size_t lanes = hn::MaxLanes(d), vectors = 4 / lanes;

constexpr float max_float = std::numeric_limits<float>::max();

/// A box as two vectors of four floats. The lanes beyond the dimension are unspecified.
struct Bounds {
    Vector min[vectors], max[vectors];

    Bounds() {
        for (std::size_t k = 0; k < vectors; ++k) {
            min[k] = hn::Set(d, std::numeric_limits<float>::infinity());
            max[k] = hn::Set(d, -std::numeric_limits<float>::infinity());
        }
    }
    explicit Bounds(const BvhItem& item) {
        for (std::size_t k = 0; k < vectors; ++k) {
            min[k] = hn::Load(d, &item.min[0] + k * lanes);
            max[k] = hn::Load(d, &item.max[0] + k * lanes);
        }
    }
    Bounds(const BvhItem* items, std::uint32_t begin, std::uint32_t end) : Bounds() {
        for (std::uint32_t i = begin; i < end; ++i) add(Bounds(items[i]));
    }

    void store(BvhItem& item) const {
        for (std::size_t k = 0; k < vectors; ++k) {
            hn::Store(min[k], d, &item.min[0] + k * lanes);
            hn::Store(max[k], d, &item.max[0] + k * lanes);
        }
    }

    void add(const Bounds& other) {
        for (std::size_t k = 0; k < vectors; ++k) {
            min[k] = hn::Min(min[k], other.min[k]);
            max[k] = hn::Max(max[k], other.max[k]);
        }
    }
    template <int D>
    Aabb<D> box() const {
        alignas(16) float low[4], high[4];
        for (std::size_t k = 0; k < vectors; ++k) {
            hn::Store(min[k], d, low + k * lanes);
            hn::Store(max[k], d, high + k * lanes);
        }
        Aabb<D> result;
        for (int i = 0; i < D; ++i) {
            result.min[i] = low[i];
            result.max[i] = high[i];
        }
        return result;
    }
};

/// The position of an item along an axis, for a bounded box: twice its centre.
struct TwiceCenter {
    float operator()(const BvhItem& item, int axis) const { return item.min[axis] + item.max[axis]; }
};

/// The position of an item along an axis, for any box: the centre of the clamped box.
struct ClampedCenter {
    float operator()(const BvhItem& item, int axis) const {
        return 0.5f * std::clamp(item.min[axis], -max_float, max_float) +
               0.5f * std::clamp(item.max[axis], -max_float, max_float);
    }
};

struct CenterRange {
    int axis;
    float min, max;
};

/// The axis along which the range of the centres is longest, and that range.
template <int D, class Center>
CenterRange longest_center_range(const BvhItem* items, std::uint32_t begin, std::uint32_t end, Center center) {
    std::array<float, D> low_center, high_center;
    if constexpr (std::is_same_v<Center, TwiceCenter>) {
        Bounds centers;
        for (std::uint32_t i = begin; i < end; ++i) {
            Bounds center_of(items[i]);
            // The last lane holds an index, which may be a denormal float, and those are slow to add.
            for (std::size_t k = 0; k < vectors; ++k) {
                const auto used = hn::FirstN(d, std::min(lanes, D - std::min<std::size_t>(D, k * lanes)));
                const Vector min = hn::IfThenElseZero(used, center_of.min[k]);
                const Vector max = hn::IfThenElseZero(used, center_of.max[k]);
                center_of.min[k] = center_of.max[k] = hn::Add(min, max);
            }
            centers.add(center_of);
        }
        const Aabb<D> box = centers.box<D>();
        for (int i = 0; i < D; ++i) {
            low_center[static_cast<std::size_t>(i)] = box.min[i];
            high_center[static_cast<std::size_t>(i)] = box.max[i];
        }
    } else {
        for (int axis = 0; axis < D; ++axis) {
            float& low = low_center[static_cast<std::size_t>(axis)] = std::numeric_limits<float>::infinity();
            float& high = high_center[static_cast<std::size_t>(axis)] = -low;
            for (std::uint32_t i = begin; i < end; ++i) {
                low = std::min(low, center(items[i], axis));
                high = std::max(high, center(items[i], axis));
            }
        }
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < D; ++axis)
        if (high_center[axis] - low_center[axis] > high_center[longest] - low_center[longest]) longest = axis;
    return {static_cast<int>(longest), low_center[longest], high_center[longest]};
}

template <int D>
class Splitter {
public:
    Splitter(BvhItem* items, const BvhRange<D>& range, BvhRange<D>& left, BvhRange<D>& right)
        : items_(items), range_(range), left_(left), right_(right) {
        // Splits of a few items off a large range would degenerate the tree to a list, with many small nodes.
        if (range.count() > bvh_node_items) min_side_count_ = std::max(24u, range.count() / 32);
    }

    /// Splits at the median of the centres. Equal centres are ordered by index.
    template <class Center>
    void at_median(Center center) {
        // The left side fills whole leaves, so that the number of leaves stays minimal.
        const std::uint32_t half = std::max(range_.count() / 2 + bvh_lanes / 2, 2 * bvh_lanes - 1);
        const std::uint32_t middle = range_.begin + std::min(half, range_.count() - 1) / bvh_lanes * bvh_lanes;
        const int axis = longest_center_range<D>(items_, range_.begin, range_.end, center).axis;
        std::nth_element(items_ + range_.begin, items_ + middle, items_ + range_.end,
                         [axis, center](const BvhItem& a, const BvhItem& b) {
                             const float p = center(a, axis), q = center(b, axis);
                             return p != q ? p < q : a.index < b.index;
                         });
        split_at(middle, Bounds(items_, range_.begin, middle), Bounds(items_, middle, range_.end));
    }

    /// Splits by binned SAH. Returns false if no boundary between bins allows a split.
    template <std::size_t bins>
    bool by_bins() {
        const CenterRange centers = longest_center_range<D>(items_, range_.begin, range_.end, TwiceCenter());
        const float scale = static_cast<float>(bins) / (centers.max - centers.min);
        if (!std::isfinite(scale)) return false;
        if (centers.axis == 0) return along<0, bins>(centers.min, scale);
        if (centers.axis == 1) return along<1, bins>(centers.min, scale);
        return along<D - 1, bins>(centers.min, scale);
    }

private:
    /// Items with the lowest centre are in the first bin, items with the highest in the last.
    template <int axis, std::size_t bins>
    bool along(float lowest, float scale) {
        const auto bin_of = [lowest, scale](const BvhItem& item) {
            return static_cast<std::size_t>(
                std::min(static_cast<int>((TwiceCenter()(item, axis) - lowest) * scale), static_cast<int>(bins) - 1));
        };
        std::array<Bounds, bins> bin;
        std::array<std::uint32_t, bins> count{};
        for (std::uint32_t i = range_.begin; i < range_.end; ++i) {
            const std::size_t b = bin_of(items_[i]);
            bin[b].add(Bounds(items_[i]));
            ++count[b];
        }
        const std::size_t split = best_split(bin, count);
        if (split == 0) return false;
        Bounds left, right;
        for (std::size_t b = 0; b < split; ++b) left.add(bin[b]);
        for (std::size_t b = split; b < bins; ++b) right.add(bin[b]);
        // The swap is unconditional, for the branch would be unpredictable.
        std::uint32_t middle = range_.begin;
        for (std::uint32_t i = range_.begin; i < range_.end; ++i) {
            const bool goes_left = bin_of(items_[i]) < split;
            swap(items_[i], items_[middle]);
            middle += goes_left ? 1 : 0;
        }
        split_at(middle, left, right);
        return true;
    }

    /// Swaps by whole registers: a load that spans several smaller stores would stall.
    static void swap(BvhItem& a, BvhItem& b) {
        const Bounds of_a(a), of_b(b);
        of_a.store(b);
        of_b.store(a);
    }

    /// The number of bins on the left that minimises the SAH cost: the sum over both sides of area times weight. 0 if
    /// no split is allowed.
    template <std::size_t bins>
    std::size_t best_split(const std::array<Bounds, bins>& bin, const std::array<std::uint32_t, bins>& count) const {
        std::array<float, bins> right_area;
        Bounds right, left;
        for (std::size_t i = bins - 1; i > 0; --i) {
            right.add(bin[i]);
            right_area[i] = count[i] > 0 ? area(right) : 0;
        }
        std::size_t best = 0;
        float min_cost = std::numeric_limits<float>::infinity();
        std::uint32_t on_left = 0;
        for (std::size_t i = 1; i < bins; ++i) {
            left.add(bin[i - 1]);
            on_left += count[i - 1];
            if (count[i] == 0 || !may_split(on_left)) continue;
            const std::uint32_t on_right = range_.count() - on_left;
            const float cost = area(left) * weight(on_left) + right_area[i] * weight(on_right);
            if (cost < min_cost) {
                min_cost = cost;
                best = i;
            }
        }
        return best;
    }

    /// The weight of a side in the SAH cost: its items, or its leaves near the bottom of the tree.
    float weight(std::uint32_t items) const {
        return static_cast<float>(range_.count() > bvh_node_items ? items : bvh_min_leaves(items));
    }

    bool may_split(std::uint32_t on_left) const {
        const std::uint32_t on_right = range_.count() - on_left;
        return std::min(on_left, on_right) >= min_side_count_ &&
               bvh_min_leaves(on_left) + bvh_min_leaves(on_right) <= range_.leaves;
    }

    /// Half the surface area, or half the perimeter, in units of the longest edge of the range.
    float area(const Bounds& bounds) const {
        alignas(16) float extent[4];
        for (std::size_t k = 0; k < vectors; ++k)
            hn::Store(hn::Mul(hn::Sub(bounds.max[k], bounds.min[k]), hn::Set(d, scale_)), d, extent + k * lanes);
        if constexpr (D == 2) return extent[0] + extent[1];
        return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
    }

    static float widest(const Aabb<D>& box) {
        float result = 0;
        for (int i = 0; i < D; ++i) result = std::max(result, box.max[i] - box.min[i]);
        return result;
    }

    void split_at(std::uint32_t middle, const Bounds& left, const Bounds& right) {
        const std::uint32_t on_left = middle - range_.begin, on_right = range_.end - middle;
        const auto share =
            static_cast<std::uint32_t>((std::uint64_t{range_.leaves} * on_left + range_.count() / 2) / range_.count());
        const std::uint32_t leaves =
            std::clamp(share, bvh_min_leaves(on_left), range_.leaves - bvh_min_leaves(on_right));
        left_ = {range_.begin, middle, leaves, range_.depth + 1, left.template box<D>()};
        right_ = {middle, range_.end, range_.leaves - leaves, range_.depth + 1, right.template box<D>()};
    }

    BvhItem* items_;
    const BvhRange<D> range_;  // a copy, for the caller may pass it as `left` or `right`
    BvhRange<D>&left_, &right_;
    std::uint32_t min_side_count_ = 1;
    float scale_ = 1 / widest(range_.box);
};

template <int D>
void split_range(BvhItem* items, bool bounded, const BvhRange<D>& range, BvhRange<D>& left, BvhRange<D>& right) {
    Splitter<D> splitter(items, range, left, right);
    if (!bounded) return splitter.at_median(ClampedCenter());
    const bool is_split =
        range.depth < bvh_binned_depth &&
        (range.count() > bvh_node_items ? splitter.template by_bins<16>() : splitter.template by_bins<8>());
    if (!is_split) splitter.at_median(TwiceCenter());
}

template <int D>
Aabb<D> box_of_all(const BvhItem* items, std::uint32_t begin, std::uint32_t end) {
    return Bounds(items, begin, end).box<D>();
}

ABUT_NAME_DIMENSIONS(split_range);
ABUT_NAME_DIMENSIONS(box_of_all);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(split_range);
ABUT_EXPORT_DIMENSIONS(box_of_all);

template <int D>
BvhRange<D> whole_range(const BvhItem* items, std::uint32_t begin, std::uint32_t end, int depth) {
    return {begin, end, bvh_max_leaves(end - begin), depth, dispatched_box_of_all<D>()(items, begin, end)};
}
template <int D>
void split(BvhItem* items, bool bounded, const BvhRange<D>& range, BvhRange<D>& left, BvhRange<D>& right) {
    dispatched_split_range<D>()(items, bounded, range, left, right);
}

template BvhRange<2> whole_range(const BvhItem*, std::uint32_t, std::uint32_t, int);
template BvhRange<3> whole_range(const BvhItem*, std::uint32_t, std::uint32_t, int);
template void split(BvhItem*, bool, const BvhRange<2>&, BvhRange<2>&, BvhRange<2>&);
template void split(BvhItem*, bool, const BvhRange<3>&, BvhRange<3>&, BvhRange<3>&);

}  // namespace abut::detail
#endif
