// Pairs: the lists of a node with one another, and what a node keeps with what is below it. The pair is told where the
// lower corner of its overlap is; that corner is in some cell with both boxes, and in no other. So are regions, and the
// ways of boxes in pieces.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/sweep_pieces.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

/// Whether two boxes, neither of them empty, overlap and the lower corner of that isn't below the cell. Both reach the
/// cell, so that it isn't above it either.
template <int D>
bool meet_in(const Aabb<D>& a, const Aabb<D>& b, const Vec<D>& low) {
    int apart = 0;
    for (int i = 0; i < D; ++i)
        apart += static_cast<int>(a.min[i] > b.max[i]) + static_cast<int>(b.min[i] > a.max[i]) +
                 static_cast<int>(std::max(a.min[i], b.min[i]) < low[i]);
    return apart == 0;
}

template <int D>
Vec<D> low_above(const Vec<D>& low, const BspNode& node) {
    Vec<D> result = low;
    result[node.axis()] = node.plane;
    return result;
}

/// Calls `told(item)` for those at and below a node that overlap the box; false where that has returned false.
template <int D, class Told>
bool each_below(const BspTree<D>& tree, std::uint32_t from, const Vec<D>& from_low, const Aabb<D>& box,
                const Told& told) {
    struct Waiting {
        std::uint32_t node;
        Vec<D> low;
    };
    std::array<Waiting, bsp_depth + 1> stack;
    stack[0] = {from, from_low};
    for (std::size_t waiting = 1; waiting > 0;) {
        auto [at, low] = stack[--waiting];
        for (;;) {
            const BspNode& node = tree.nodes[at];
            for (std::uint32_t w = node.first; w < node.first + node.count; ++w) {
                const BspItem<D>& item = tree.items[tree.words[w]];
                if (meet_in(item.box, box, low) && !told(item)) return false;
            }
            if (node.is_leaf()) break;
            const bool above = box.max[node.axis()] >= node.plane;
            if (box.min[node.axis()] < node.plane) {
                if (above) stack[waiting++] = {node.above(), low_above(low, node)};
                at = at + 1;
            } else {
                low[node.axis()] = node.plane;
                at = node.above();
            }
        }
    }
    return true;
}

template <int D>
class PairWalk {
public:
    PairWalk(const BspTree<D>& tree, PairBuffer& pairs) : tree_(tree), pairs_(pairs) {}

    /// All pairs below a node; false where the visitor has had enough.
    bool below(std::uint32_t index, const Vec<D>& low) const {
        const BspNode& node = tree_.nodes[index];
        return of_its_own(index, low) &&
               (node.is_leaf() || (below(index + 1, low) && below(node.above(), low_above(low, node))));
    }

    /// Those of the list of a node, with one another and with what is below it.
    bool of_its_own(std::uint32_t index, const Vec<D>& low) const {
        const BspNode& node = tree_.nodes[index];
        const std::uint32_t end = node.first + node.count;
        for (std::uint32_t w = node.first; w < end; ++w) {
            const BspItem<D>& a = item(w);
            for (std::uint32_t v = w + 1; v < end; ++v)
                if (meet_in(a.box, item(v).box, low) && !pairs_.add_sorted(a.index, item(v).index)) return false;
            if (node.is_leaf()) continue;
            const auto tell = [&](const BspItem<D>& b) { return pairs_.add_sorted(a.index, b.index); };
            if (!each_below(tree_, index + 1, low, a.box, tell) ||
                !each_below(tree_, node.above(), low_above(low, node), a.box, tell))
                return false;
        }
        return true;
    }

private:
    const BspItem<D>& item(std::uint32_t word) const { return tree_.items[tree_.words[word]]; }

    const BspTree<D>& tree_;
    PairBuffer& pairs_;
};

/// The pairs below a node, or of its own list alone.
template <int D>
struct Task {
    std::uint32_t node;
    bool alone;
    Vec<D> low;
};

/// About as many tasks as asked for, that are all pairs together.
template <int D>
class Tasks {
public:
    static constexpr std::uint32_t most = 256;

    Tasks(const BspTree<D>& tree, std::uint32_t wanted, const Vec<D>& low) {
        task_[count_++] = {0, false, low};
        for (std::uint32_t next = 0; next < count_ && count_ < std::min(wanted, most - 2); ++next) {
            Task<D>& task = task_[next];
            const BspNode& node = tree.nodes[task.node];
            if (node.is_leaf() || task.alone) continue;
            task.alone = true;
            task_[count_++] = {task.node + 1, false, task.low};
            task_[count_++] = {node.above(), false, low_above(task.low, node)};
        }
    }

    std::uint32_t count() const { return count_; }
    const Task<D>& operator[](std::uint32_t i) const { return task_[i]; }

private:
    std::array<Task<D>, most> task_;
    std::uint32_t count_ = 0;
};

}  // namespace

template <int D>
void Bsp<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (is_empty(query) || !overlaps(query, bounds_)) return;
    each_below(tree_, 0, bounds_.min, query, [&](const BspItem<D>& item) { return visit(item.index); });
}

template <int D>
void Bsp<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    // No cell is of a size that is like that of others.
    double widest = 0;
    for (int i = 0; i < D; ++i)
        widest = std::max(widest, static_cast<double>(bounds_.max[i]) - static_cast<double>(bounds_.min[i]));
    WayPieces<D>(box, bounds_, widest / 32).each(visit, [&](const Aabb<D>& piece, auto told) {
        each_below(tree_, 0, bounds_.min, piece, [&](const BspItem<D>& item) { return told(item.index, item.box); });
    });
}

template <int D>
void Bsp<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    if (is_empty(bounds_)) return;
    if (executor == nullptr || executor->workers() < 2) {
        PairBuffer pairs(visit);
        if (PairWalk<D>(tree_, pairs).below(0, bounds_.min)) pairs.flush();
        return;
    }
    const Tasks<D> tasks(tree_, 16 * executor->workers(), bounds_.min);
    report_in_parallel(*executor, tasks.count(), visit, [&](std::uint32_t i, PairsCall told) {
        PairBuffer pairs(told);
        const PairWalk<D> walk(tree_, pairs);
        const Task<D>& task = tasks[i];
        if (task.alone ? walk.of_its_own(task.node, task.low) : walk.below(task.node, task.low)) pairs.flush();
    });
}

template <int D>
void Bsp<D>::visit_pairs(const Bsp& other, PairsCall visit) const {
    PairBuffer pairs(visit);
    for (const BspItem<D>& theirs : other.tree_.items) {
        if (!overlaps(theirs.box, bounds_)) continue;
        const auto tell = [&](const BspItem<D>& ours) { return pairs.add(ours.index, theirs.index); };
        if (!each_below(tree_, 0, bounds_.min, theirs.box, tell)) return;
    }
    pairs.flush();
}

template <int D>
void Bsp<D>::visit_boxes(BoxCall<D> visit) const {
    for (const BspItem<D>& item : tree_.items)
        if (!is_empty(item.box) && !visit(item.index, item.box)) return;
}

#define ABUT_INSTANTIATE(D)                                                  \
    template void Bsp<D>::visit_overlapping(const Aabb<D>&, ItemCall) const; \
    template void Bsp<D>::visit_along(const MovingBox<D>&, ReachCall) const; \
    template void Bsp<D>::visit_pairs(PairsCall, Executor*) const;           \
    template void Bsp<D>::visit_pairs(const Bsp&, PairsCall) const;          \
    template void Bsp<D>::visit_boxes(BoxCall<D>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
