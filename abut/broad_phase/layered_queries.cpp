// Questions to a LayeredGrid about what is where: down the trees over the layers, all of them side by side.

#include <abut/broad_phase/box_sides.hpp>
#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/layered_pairs.hpp>
#include <abut/broad_phase/reach.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

/// Level by level, a node waits with its brothers.
constexpr std::size_t most_waiting = BoxRuns::most_levels * (BoxRuns::width - 1) + 1;

/// The places of the boxes of a tree that meet this one. Calls visit(place); returns false where that does.
template <int D, class Visit>
bool each_meeting(const LayeredItems<D>& items, const BoxRuns& tree, const BoxSides<D>& box, const Visit& visit) {
    struct Waiting {
        std::uint32_t node;
        int level;
    };
    std::array<Waiting, most_waiting> stack;
    std::size_t waiting = 0;
    if (tree.levels > 0 && box.meets(BoxSides<D>::of(*items.row(tree, tree.levels - 1))))
        stack[waiting++] = {0, tree.levels - 1};
    while (waiting > 0) {
        const Waiting top = stack[--waiting];
        if (top.level == 0) {
            if (!visit(tree.first[0] + top.node)) return false;
            continue;
        }
        const int level = top.level - 1;
        const Aabb<D>* below = items.row(tree, level);
        const std::uint32_t begin = top.node * BoxRuns::width;
        const std::uint32_t end = std::min(begin + BoxRuns::width, tree.count_at(level));
        for (std::uint32_t i = end; i-- > begin;) {
            stack[waiting] = {i, level};
            waiting += box.meets(BoxSides<D>::of(below[i])) ? 1 : 0;
        }
    }
    return true;
}

template <int D, class Visit>
bool each_meeting(const LayeredItems<D>& items, const Aabb<D>& box, const Visit& visit) {
    return std::all_of(items.runs.begin(), items.runs.end(),
                       [&](const BoxRuns& tree) { return each_meeting(items, tree, BoxSides<D>::of(box), visit); });
}

/// What is within reach, down all trees side by side: the next step is taken where the nearest waits.
template <int D, class Reach>
class NearestFirst {
public:
    NearestFirst(const LayeredItems<D>& items, const Reach& reach) : items_(items), reach_(reach) {}

    void run(ReachCall visit) {
        if (reach_.is_exhausted()) return;
        for (const BoxRuns& tree : items_.runs) start(tree);
        while (descents_ > 0) {
            Descent* nearest = &descent_[0];
            for (std::size_t i = 1; i < descents_; ++i)
                if (descent_[i].top().measure < nearest->top().measure) nearest = &descent_[i];
            const Waiting next = nearest->stack[--nearest->waiting];
            if (reach_.within(next.measure)) {
                if (next.level > 0)
                    open(*nearest, next);
                else
                    reach_.shrink(visit(items_.index[nearest->tree->first[0] + next.node]));
                if (reach_.is_exhausted()) return;
            }
            if (nearest->waiting == 0) end(*nearest);
        }
    }

private:
    struct Waiting {
        double measure;
        std::uint32_t node;
        int level;
    };
    struct Descent {
        const BoxRuns* tree;
        std::size_t waiting;
        std::array<Waiting, most_waiting> stack;
        const Waiting& top() const { return stack[waiting - 1]; }
    };

    void start(const BoxRuns& tree) {
        double measure = 0;
        if (tree.levels == 0 || !reach_.measure(BoxSides<D>::of(*items_.row(tree, tree.levels - 1)), measure)) return;
        Descent& descent = descent_[descents_++];
        descent.tree = &tree;
        descent.waiting = 1;
        descent.stack[0] = {measure, 0, tree.levels - 1};
    }

    /// Puts what is below a node on the stack, the nearest on top.
    void open(Descent& descent, const Waiting& node) {
        const int level = node.level - 1;
        const Aabb<D>* below = items_.row(*descent.tree, level);
        const std::uint32_t begin = node.node * BoxRuns::width;
        const std::uint32_t end = std::min(begin + BoxRuns::width, descent.tree->count_at(level));
        const std::size_t bottom = descent.waiting;
        for (std::uint32_t i = begin; i < end; ++i) {
            Waiting waiting{0, i, level};
            if (!reach_.measure(BoxSides<D>::of(below[i]), waiting.measure)) continue;
            std::size_t at = descent.waiting++;
            for (; at > bottom && descent.stack[at - 1].measure < waiting.measure; --at)
                descent.stack[at] = descent.stack[at - 1];
            descent.stack[at] = waiting;
        }
    }

    /// The last takes its room.
    void end(Descent& descent) {
        const Descent& last = descent_[--descents_];
        if (&last == &descent) return;
        descent.tree = last.tree;
        descent.waiting = last.waiting;
        std::copy_n(last.stack.begin(), last.waiting, descent.stack.begin());
    }

    const LayeredItems<D>& items_;
    Reach reach_;
    std::size_t descents_ = 0;
    std::array<Descent, most_layers + 1> descent_;
};

/// Of the strays from `begin` up to `end` with all that has a cell, and with the strays behind them.
template <int D>
bool pairs_of_strays(const LayeredItems<D>& items, std::uint32_t begin, std::uint32_t end, PairBuffer& pairs) {
    for (std::uint32_t stray = begin; stray < end; ++stray) {
        const std::uint32_t index = items.index[stray];
        const auto tell = [&](std::uint32_t place) {
            const bool twice = place >= items.with_cell && place <= stray;
            return twice || pairs.add_sorted(index, items.index[place]);
        };
        if (!each_meeting(items, items.boxes[stray], tell)) return false;
    }
    return true;
}

}  // namespace

template <int D>
void LayeredGrid<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto cells = static_cast<std::uint32_t>(items_.cells.size());
    const auto places = static_cast<std::uint32_t>(items_.index.size());
    const std::uint32_t strays = places - items_.with_cell;
    // Enough parts for all to end at about the same time, none so small that its start costs more than its work.
    const std::uint32_t parts = executor == nullptr ? 1 : std::clamp(places / 512, 1u, 16 * executor->workers());
    const auto share = [parts](std::uint32_t of, std::uint32_t part) {
        return static_cast<std::uint32_t>(std::uint64_t{of} * part / parts);
    };
    const auto run = [&](std::uint32_t part, PairsCall told) {
        PairBuffer pairs(told);
        if (pairs_of_cells(items_, plan_, share(cells, part), share(cells, part + 1), pairs) &&
            pairs_of_strays(items_, items_.with_cell + share(strays, part), items_.with_cell + share(strays, part + 1),
                            pairs))
            pairs.flush();
    };
    if (parts == 1)
        run(0, visit);
    else
        report_in_parallel(*executor, parts, visit, run);
}

template <int D>
void LayeredGrid<D>::visit_pairs(const LayeredGrid& other, PairsCall visit) const {
    PairBuffer pairs(visit);
    // Eight of the other at a time, as they lie below a node of its trees.
    for (const BoxRuns& tree : other.items_.runs)
        for (std::uint32_t begin = 0; begin < tree.count; begin += BoxRuns::width) {
            const std::uint32_t first = tree.first[0] + begin;
            const std::uint32_t last = tree.first[0] + std::min(begin + BoxRuns::width, tree.count);
            const Aabb<D> all = around(other.items_.boxes.data() + first, other.items_.boxes.data() + last);
            const auto tell = [&](std::uint32_t place) {
                for (std::uint32_t i = first; i < last; ++i)
                    if (overlaps(items_.boxes[place], other.items_.boxes[i]) &&
                        !pairs.add(items_.index[place], other.items_.index[i]))
                        return false;
                return true;
            };
            if (!each_meeting(items_, all, tell)) return;
        }
    pairs.flush();
}

template <int D>
void LayeredGrid<D>::visit_boxes(BoxCall<D> visit) const {
    for (std::size_t place = 0; place < items_.index.size(); ++place)
        if (!visit(items_.index[place], items_.boxes[place])) return;
}

template <int D>
void LayeredGrid<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (is_empty(query)) return;
    each_meeting(items_, query, [&](std::uint32_t place) { return visit(items_.index[place]); });
}

template <int D>
void LayeredGrid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    NearestFirst<D, RayReach<D>>(items_, RayReach<D>(ray)).run(visit);
}

template <int D>
void LayeredGrid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    NearestFirst<D, RayReach<D>>(items_, RayReach<D>::of_box(box)).run(visit);
}

template <int D>
void LayeredGrid<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    NearestFirst<D, BoxReach<D>>(items_, BoxReach<D>(box, reach)).run(visit);
}

template void LayeredGrid<2>::visit_pairs(PairsCall, Executor*) const;
template void LayeredGrid<3>::visit_pairs(PairsCall, Executor*) const;
template void LayeredGrid<2>::visit_pairs(const LayeredGrid&, PairsCall) const;
template void LayeredGrid<3>::visit_pairs(const LayeredGrid&, PairsCall) const;
template void LayeredGrid<2>::visit_boxes(BoxCall<2>) const;
template void LayeredGrid<3>::visit_boxes(BoxCall<3>) const;
template void LayeredGrid<2>::visit_overlapping(const Aabb<2>&, ItemCall) const;
template void LayeredGrid<3>::visit_overlapping(const Aabb<3>&, ItemCall) const;
template void LayeredGrid<2>::visit_along(const Ray<2>&, ReachCall) const;
template void LayeredGrid<2>::visit_along(const MovingBox<2>&, ReachCall) const;
template void LayeredGrid<3>::visit_along(const Ray<3>&, ReachCall) const;
template void LayeredGrid<3>::visit_along(const MovingBox<3>&, ReachCall) const;
template void LayeredGrid<2>::visit_near(const Aabb<2>&, float, ReachCall) const;
template void LayeredGrid<3>::visit_near(const Aabb<3>&, float, ReachCall) const;

}  // namespace abut
