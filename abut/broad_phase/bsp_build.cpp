// Planes where the surface area heuristic finds them cheapest: MacDonald, Booth, "Heuristics for ray tracing using
// space subdivision", 1990. A box is counted on each side that it reaches, so that no list of events is needed but the
// two ends of each.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bsp_node.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {
namespace {

constexpr std::uint32_t few_items = 16;  ///< so few are tried at each face of each box, more at the borders of bins
constexpr std::uint32_t leaf_items = 2;
constexpr std::uint32_t sampled_items = 1024;  ///< of more than so many, about so many are looked at for a plane
constexpr int bins = 32;
constexpr int cheapest_levels = 32;  ///< below, the middle of the items: 32 more would do for 2^32 of them
constexpr double step_cost = 3.0;    ///< of going into a node, where looking at an item is 1

/// What a subtree may use up.
struct Room {
    std::uint64_t copies, splits;

    Room share(std::uint64_t part, std::uint64_t whole) const { return {copies * part / whole, splits * part / whole}; }
    Room operator-(const Room& other) const { return {copies - other.copies, splits - other.splits}; }
};

struct Split {
    int axis = -1;
    float plane = 0;
    double cost = std::numeric_limits<double>::infinity();
};

/// How many reach below a plane, to it or above it, and how many wide ones do both.
struct Sides {
    std::uint32_t below = 0, above = 0, wide = 0;
};

template <int D>
class Builder {
public:
    explicit Builder(BspTree<D>& tree) : tree_(tree), words_(tree.words) {}

    /// The items that hold something, from the front of the tree's.
    void build(std::uint32_t count) {
        top_ = static_cast<std::uint32_t>(words_.size()) - count;
        std::uint32_t next = top_;
        for (std::uint32_t i = 0; i < tree_.items.size(); ++i)
            if (!is_empty(tree_.items[i].box)) words_[next++] = i;
        words_[0] = 0;
        tree_.used = 1;
        grow(count, tree_.frame, {count, count / 2}, 0);
    }

private:
    const Aabb<D>& box(std::uint32_t word) const { return tree_.items[words_[word]].box; }

    /// The node of the `count` items at the top of what is still to do, and all below it.
    void grow(std::uint32_t count, const Aabb<D>& cell, const Room& room, int depth) {
        const std::size_t node = tree_.nodes.size();
        tree_.nodes.emplace_back();
        const Split split = choose(count, cell, room, depth);
        if (split.axis < 0) return keep(node, count);

        // 1. To the front what the node keeps, then what is below the plane alone, on both sides, and above.
        const auto below = [&](std::uint32_t w) { return box(w).min[split.axis] < split.plane; };
        const auto above = [&](std::uint32_t w) { return box(w).max[split.axis] >= split.plane; };
        const auto wide = [&](std::uint32_t w) { return is_wide(box(w), cell, split.axis); };
        const std::uint32_t end = top_ + count;
        std::uint32_t kept = part(top_, end, [&](std::uint32_t w) { return below(w) && above(w) && wide(w); });
        std::uint32_t both = part(kept, end, [&](std::uint32_t w) { return below(w) && above(w); });
        if (both - kept > room.copies) kept = both;
        const std::uint32_t only_below = part(both, end, below);
        const std::uint32_t copies = both - kept;
        keep(node, kept - top_);

        // 2. Those on both sides: once more before what is below, and last of it, next to what is above.
        const std::uint32_t count_below = only_below - kept, count_above = end - only_below + copies;
        std::rotate(words_.begin() + kept, words_.begin() + both, words_.begin() + only_below);
        std::copy_n(words_.begin() + (only_below - copies), copies, words_.begin() + (kept - copies));
        top_ = kept - copies;
        const Room rest = room - Room{copies, 1};
        const Room room_below = rest.share(count_below, std::max(1u, count_below + count_above));
        const auto [cell_below, cell_above] = cut(cell, split.axis, split.plane);
        grow(count_below, cell_below, room_below, depth + 1);
        tree_.nodes[node].plane = split.plane;
        tree_.nodes[node].above_and_axis =
            static_cast<std::uint32_t>(tree_.nodes.size()) << 2 | static_cast<std::uint32_t>(split.axis);
        grow(count_above, cell_above, rest - room_below, depth + 1);
    }

    /// Takes the items at the top into the list of the node, in the order of their numbers.
    void keep(std::size_t node, std::uint32_t count) {
        BspNode& result = tree_.nodes[node];
        if (count == 0) return;
        std::sort(words_.begin() + top_, words_.begin() + top_ + count);
        words_[tree_.used] = count + 1;
        result.first = tree_.used + 1;
        result.count = count;
        std::copy_n(words_.begin() + top_, count, words_.begin() + result.first);
        top_ += count;
        tree_.used = result.first + count + 1;
    }

    /// Moves those to the front of which `first` is true; returns where the others begin.
    template <class First>
    std::uint32_t part(std::uint32_t begin, std::uint32_t end, First first) {
        std::uint32_t middle = begin;
        for (std::uint32_t w = begin; w < end; ++w)
            if (first(w)) std::swap(words_[w], words_[middle++]);
        return middle;
    }

    /// No axis where it is best to split no more.
    Split choose(std::uint32_t count, const Aabb<D>& cell, const Room& room, int depth) {
        Split best;
        if (count <= leaf_items || room.splits == 0 || depth == bsp_depth) return best;
        if (depth >= cheapest_levels) return middle(count, cell);
        measure(cell);
        stride_ = count / sampled_items | 1u;
        count_ = (count + stride_ - 1) / stride_;
        copies_ = room.copies / stride_;
        best.cost = area() * (count_ - step_cost / stride_);
        for (int axis = 0; axis < D; ++axis) {
            if (!(cell.min[axis] < cell.max[axis])) continue;
            if (count <= few_items)
                try_faces(cell, axis, best);
            else
                try_bins(cell, axis, best);
        }
        return best;
    }

    /// The sides of the cell; a side of nothing is a thousandth of the longest, that lines and planes have costs too.
    void measure(const Aabb<D>& cell) {
        for (int i = 0; i < D; ++i) side_[i] = static_cast<double>(cell.max[i]) - static_cast<double>(cell.min[i]);
        double longest = 0;
        for (int i = 0; i < D; ++i) longest = std::max(longest, side_[i]);
        for (int i = 0; i < D; ++i) side_[i] = std::max(side_[i], 1e-3 * longest);
    }
    double area() const {
        return D == 2 ? side_[0] + side_[1] : side_[0] * (side_[1] + side_[D - 1]) + side_[1] * side_[D - 1];
    }
    /// Of the cell with the given side along an axis.
    double area(int axis, double side) const {
        const int other = (axis + 1) % D, last = (axis + 2) % D;
        return D == 2 ? side + side_[other] : side * (side_[other] + side_[last]) + side_[other] * side_[last];
    }

    void consider(const Aabb<D>& cell, int axis, float plane, const Sides& sides, Split& best) const {
        if (!(cell.min[axis] < plane && plane <= cell.max[axis])) return;
        const std::uint32_t both = sides.below + sides.above - count_;
        const std::uint32_t kept = both - sides.wide > copies_ ? both : sides.wide;
        const double below = static_cast<double>(plane) - static_cast<double>(cell.min[axis]);
        const double cost = kept * area() + (sides.below - kept) * area(axis, below) +
                            (sides.above - kept) * area(axis, side_[axis] - below);
        if (cost < best.cost) best = {axis, plane, cost};
    }

    void try_faces(const Aabb<D>& cell, int axis, Split& best) const {
        std::array<float, few_items> low, high;
        std::array<std::uint32_t, few_items> wide;
        for (std::uint32_t i = 0; i < count_; ++i) {
            low[i] = box(top_ + i).min[axis];
            high[i] = box(top_ + i).max[axis];
            wide[i] = is_wide(box(top_ + i), cell, axis) ? 1 : 0;
        }
        for (std::uint32_t candidate = 0; candidate < 2 * count_; ++candidate) {
            const float face = candidate < count_ ? low[candidate] : high[candidate - count_];
            // Just above a box, that it isn't on that side.
            const float plane = candidate < count_ || face >= cell.max[axis] ? face : -float_before(-face);
            Sides sides;
            for (std::uint32_t i = 0; i < count_; ++i) {
                const std::uint32_t below = low[i] < plane ? 1 : 0, above = high[i] >= plane ? 1 : 0;
                sides.below += below;
                sides.above += above;
                sides.wide += below & above & wide[i];
            }
            consider(cell, axis, plane, sides, best);
        }
    }

    void try_bins(const Aabb<D>& cell, int axis, Split& best) const {
        const double low = static_cast<double>(cell.min[axis]);
        const double width = (static_cast<double>(cell.max[axis]) - low) / bins, scale = 1 / width;
        if (!std::isfinite(scale)) return;
        const auto bin_of = [&](float x) {
            const double bin = (static_cast<double>(x) - low) * scale;
            return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)));
        };
        struct Ends {
            std::uint32_t low = 0, high = 0, wide_low = 0, wide_high = 0;
        };
        std::array<Ends, bins> ends;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Aabb<D>& item = box(top_ + i * stride_);
            Ends& first = ends[bin_of(item.min[axis])];
            Ends& last = ends[bin_of(item.max[axis])];
            const std::uint32_t wide = is_wide(item, cell, axis) ? 1 : 0;
            ++first.low;
            ++last.high;
            first.wide_low += wide;
            last.wide_high += wide;
        }
        Sides sides{0, count_, 0};
        for (std::size_t i = 1; i < bins; ++i) {
            sides.below += ends[i - 1].low;
            sides.above -= ends[i - 1].high;
            sides.wide += ends[i - 1].wide_low - ends[i - 1].wide_high;
            consider(cell, axis, static_cast<float>(low + static_cast<double>(i) * width), sides, best);
        }
    }

    /// Where half of the items begin below, along the axis on which their beginnings lie farthest apart.
    Split middle(std::uint32_t count, const Aabb<D>& cell) {
        int axis = 0;
        double most = 0;
        for (int i = 0; i < D; ++i) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (std::uint32_t w = top_; w < top_ + count; ++w) {
                low = std::min(low, static_cast<double>(std::max(box(w).min[i], cell.min[i])));
                high = std::max(high, static_cast<double>(std::max(box(w).min[i], cell.min[i])));
            }
            if (high - low > most) {
                most = high - low;
                axis = i;
            }
        }
        const auto begin = words_.begin() + top_;
        std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            const float p = tree_.items[a].box.min[axis], q = tree_.items[b].box.min[axis];
            return p != q ? p < q : a < b;
        });
        const float plane = box(top_ + count / 2).min[axis];
        const bool useful = most > 0 && cell.min[axis] < plane && plane <= cell.max[axis];
        return {useful ? axis : -1, plane, 0};
    }

    BspTree<D>& tree_;
    std::vector<std::uint32_t>& words_;
    std::uint32_t top_ = 0;  ///< what is still to do lies at the end of the words, what is done at their beginning
    // Of the node at hand, and of those of its items that are looked at:
    DVec<D> side_{0.0};
    std::uint32_t stride_ = 1, count_ = 0;
    std::uint64_t copies_ = 0;
};

/// The span of all faces that are not infinite.
template <int D>
Aabb<D> frame_of(const std::vector<BspItem<D>>& items) {
    Aabb<D> result = Aabb<D>::empty();
    for (const BspItem<D>& item : items) {
        if (is_empty(item.box)) continue;
        for (int i = 0; i < D; ++i)
            for (const float face : {item.box.min[i], item.box.max[i]}) {
                if (!std::isfinite(face)) continue;
                result.min[i] = std::min(result.min[i], face);
                result.max[i] = std::max(result.max[i], face);
            }
    }
    for (int i = 0; i < D; ++i)
        if (!(result.min[i] <= result.max[i])) result.min[i] = result.max[i] = 0;
    return result;
}

/// Numbers the items as the tree comes upon them.
template <int D>
void reorder(BspTree<D>& tree) {
    constexpr std::uint32_t nowhere = 0xffffffffu;
    const auto count = static_cast<std::uint32_t>(tree.items.size());
    tree.place.assign(count, nowhere);
    std::uint32_t next = 0;
    for (const BspNode& node : tree.nodes)
        for (std::uint32_t w = node.first; w < node.first + node.count; ++w) {
            std::uint32_t& place = tree.place[tree.words[w]];
            if (place == nowhere) place = next++;
            tree.words[w] = place;
        }
    for (std::uint32_t& place : tree.place)
        if (place == nowhere) place = next++;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t there = tree.place[tree.items[i].index]; there != i; there = tree.place[tree.items[i].index])
            std::swap(tree.items[i], tree.items[there]);
}

}  // namespace

template <int D>
void build_tree(BspTree<D>& tree) {
    tree.nodes.clear();
    tree.nodes.reserve(tree.items.size() + 1);
    tree.words.resize(bsp_words(tree.items.size()));
    tree.frame = frame_of(tree.items);
    const auto count =
        std::count_if(tree.items.begin(), tree.items.end(), [](const BspItem<D>& item) { return !is_empty(item.box); });
    Builder<D>(tree).build(static_cast<std::uint32_t>(count));
    reorder(tree);
}

template void build_tree(BspTree<2>&);
template void build_tree(BspTree<3>&);

}  // namespace abut
