// The binned surface area heuristic: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/bvh_size.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace abut {
namespace {

constexpr std::uint32_t leaf_items = 4;
constexpr int binned_levels = 64;
constexpr int bins = 16;

/// Where an item is along an axis: twice its middle, for a box with bounds.
struct TwiceMiddle {
    template <int D>
    float operator()(const BvhItem<D>& item, int axis) const {
        return item.box.min[axis] + item.box.max[axis];
    }
};

/// The same for any box.
struct SomeMiddle {
    template <int D>
    float operator()(const BvhItem<D>& item, int axis) const {
        return center(item.box)[axis];
    }
};

template <int D>
class Builder {
public:
    Builder(std::vector<BvhItem<D>>& items, std::vector<BvhNode<D>>& nodes) : items_(items), nodes_(nodes) {}

    void grow(std::uint32_t begin, std::uint32_t end, int depth, bool bounded) {
        if (end - begin <= leaf_items) {
            // The order of the items is that of their indices, whatever the partitions of the C++ library do.
            std::sort(at(begin), at(end), [](const auto& a, const auto& b) { return a.index < b.index; });
            nodes_.push_back({{}, begin, {}, end - begin});
            return;
        }
        const std::uint32_t middle = !bounded                ? split_in_half(begin, end, SomeMiddle())
                                     : depth < binned_levels ? split_by_bins(begin, end)
                                                             : split_in_half(begin, end, TwiceMiddle());
        join(begin, middle, end, depth, bounded, bounded);
    }

    void join(std::uint32_t begin, std::uint32_t middle, std::uint32_t end, int depth, bool left_bounded,
              bool right_bounded) {
        const std::size_t node = nodes_.size();
        nodes_.push_back({{}, 0, {}, 0});
        grow(begin, middle, depth + 1, left_bounded);
        nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
        grow(middle, end, depth + 1, right_bounded);
    }

private:
    struct Spread {
        int axis;
        float least, most;
    };
    struct Bin {
        Aabb<D> box = Aabb<D>::empty();
        std::uint32_t count = 0;

        void add(const Aabb<D>& other, std::uint32_t others) {
            for (int i = 0; i < D; ++i) {
                box.min[i] = std::min(box.min[i], other.min[i]);
                box.max[i] = std::max(box.max[i], other.max[i]);
            }
            count += others;
        }
        double cost() const { return half_area(box) * count; }
    };

    auto at(std::uint32_t i) { return items_.begin() + i; }

    /// The axis along which the items lie farthest apart.
    template <class Place>
    Spread spread(std::uint32_t begin, std::uint32_t end, Place place) const {
        Aabb<D> places = Aabb<D>::empty();
        for (std::uint32_t i = begin; i < end; ++i)
            for (int axis = 0; axis < D; ++axis) {
                const float p = place(items_[i], axis);
                places.min[axis] = std::min(places.min[axis], p);
                places.max[axis] = std::max(places.max[axis], p);
            }
        int longest = 0;
        for (int axis = 1; axis < D; ++axis)
            if (places.max[axis] - places.min[axis] > places.max[longest] - places.min[longest]) longest = axis;
        return {longest, places.min[longest], places.max[longest]};
    }

    /// Where boxes coincide, their indices part them.
    template <class Place>
    std::uint32_t split_in_half(std::uint32_t begin, std::uint32_t end, Place place) {
        const int axis = spread(begin, end, place).axis;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(at(begin), at(middle), at(end), [axis, place](const auto& a, const auto& b) {
            const float p = place(a, axis), q = place(b, axis);
            return p != q ? p < q : a.index < b.index;
        });
        return middle;
    }

    std::uint32_t split_by_bins(std::uint32_t begin, std::uint32_t end) {
        const Spread s = spread(begin, end, TwiceMiddle());
        const float scale = static_cast<float>(bins) / (s.most - s.least);
        if (!std::isfinite(scale)) return split_in_half(begin, end, TwiceMiddle());
        if (s.axis == 0) return split_along<0>(begin, end, s.least, scale);
        if (s.axis == 1) return split_along<1>(begin, end, s.least, scale);
        return split_along<D - 1>(begin, end, s.least, scale);
    }

    /// The least lands in the first bin and the most in the last, so that no split leaves a side empty.
    template <int axis>
    std::uint32_t split_along(std::uint32_t begin, std::uint32_t end, float least, float scale) {
        const auto bin_of = [least, scale](const BvhItem<D>& item) {
            return static_cast<std::size_t>(
                std::min(static_cast<int>((TwiceMiddle()(item, axis) - least) * scale), bins - 1));
        };
        std::array<Bin, bins> bin;
        for (std::uint32_t i = begin; i < end; ++i) bin[bin_of(items_[i])].add(items_[i].box, 1);
        const std::size_t split = best_split(bin);
        // Swaps without asking: a branch that nobody can foresee costs more.
        std::uint32_t middle = begin;
        for (std::uint32_t i = begin; i < end; ++i) {
            const bool left = bin_of(items_[i]) < split;
            std::swap(items_[i], items_[middle]);
            middle += left ? 1 : 0;
        }
        return middle;
    }

    /// How many bins go to the left, so that the areas of the two sides, each times its items, are least.
    static std::size_t best_split(const std::array<Bin, bins>& bin) {
        std::array<double, bins> right_cost;
        Bin right, left;
        for (std::size_t i = bins - 1; i > 0; --i) {
            if (bin[i].count == 0) continue;
            right.add(bin[i].box, bin[i].count);
            right_cost[i] = right.cost();
        }
        std::size_t best = 1;
        double least = std::numeric_limits<double>::infinity();
        left = bin[0];
        for (std::size_t i = 1; i < bins; ++i) {
            if (bin[i].count == 0) continue;
            const double cost = left.cost() + right_cost[i];
            if (cost < least) {
                least = cost;
                best = i;
            }
            left.add(bin[i].box, bin[i].count);
        }
        return best;
    }

    std::vector<BvhItem<D>>& items_;
    std::vector<BvhNode<D>>& nodes_;
};

}  // namespace

template <int D>
void build_nodes(std::vector<BvhItem<D>>& items, std::size_t bounded, std::vector<BvhNode<D>>& nodes) {
    nodes.clear();
    if (items.empty()) return;
    const auto middle = static_cast<std::uint32_t>(bounded), end = static_cast<std::uint32_t>(items.size());
    Builder<D> builder(items, nodes);
    // What has no bound would reach into every split of the others.
    if (middle > 0 && middle < end)
        builder.join(0, middle, end, 0, true, false);
    else
        builder.grow(0, end, 0, middle > 0);
}

template void build_nodes(std::vector<BvhItem<2>>&, std::size_t, std::vector<BvhNode<2>>&);
template void build_nodes(std::vector<BvhItem<3>>&, std::size_t, std::vector<BvhNode<3>>&);

}  // namespace abut
