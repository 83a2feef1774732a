// The cells, columns, nodes and planes of the broad phases.

#include "broad_phase_insides.hpp"

#include "private_member.hpp"
#include <abut/broad_phase/bvh/topology.hpp>

#include <algorithm>
#include <cmath>

namespace abut::play {

using namespace detail;

ABUT_PLAY_PRIVATE(CellsOfGrid, Grid<2>::cells_)
ABUT_PLAY_PRIVATE(StoreOfGrid, Grid<2>::store_)
ABUT_PLAY_PRIVATE(LargeOfGrid, Grid<2>::large_)
ABUT_PLAY_PRIVATE(EntriesOfLayeredGrid, LayeredGrid<2>::entries_)
ABUT_PLAY_PRIVATE(ColumnsOfSweep, SweepAndPrune<2>::columns_)
ABUT_PLAY_PRIVATE(ItemsOfSweep, SweepAndPrune<2>::items_)
ABUT_PLAY_PRIVATE(BoxesOfSweep, SweepAndPrune<2>::boxes_)
ABUT_PLAY_PRIVATE(NodesOfBsp, Bsp<2>::nodes_)
ABUT_PLAY_PRIVATE(EntriesOfBsp, Bsp<2>::entries_)
ABUT_PLAY_PRIVATE(CoreOfTemporal, TemporalGrid::core_)
ABUT_PLAY_PRIVATE(BlocksOfCore, TemporalCore<2>::blocks_)
ABUT_PLAY_PRIVATE(ItemsOfCore, TemporalCore<2>::items_)
ABUT_PLAY_PRIVATE(NowOfCore, TemporalCore<2>::now_)
ABUT_PLAY_PRIVATE(EndOfCore, TemporalCore<2>::end_)

namespace {

void add_box(Lines& lines, float level, const Aabb2& box) {
    const Vec2 corners[] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (std::size_t i = 0; i < 4; ++i) lines.push_back({level, corners[i], corners[(i + 1) % 4]});
}

/// An item of a sweep without the bits that mark copies.
std::uint32_t item_of(std::uint32_t copy) {
    return copy & ~(3u << 30);
}

/// The edge of the cells of a level of a LayeredGrid.
float layer_edge(std::uint32_t level) {
    return std::ldexp(1.0f, 2 * static_cast<int>(level) - 126);
}
std::int32_t layer_cell(float coordinate, std::uint32_t level) {
    return static_cast<std::int32_t>(std::floor(coordinate / layer_edge(level)));
}

}  // namespace

Lines lines_of(const Grid<2>& phase) {
    const GridCells<2>& cells = phase.*member_of(CellsOfGrid());
    Lines lines;
    if (phase.empty()) return lines;
    const Vec2 low{cells.origin[0], cells.origin[1]};
    const Vec2 high = low + cells.edge * Vec2(cells.count[0], cells.count[1]);
    for (int axis = 0; axis < 2; ++axis)
        for (std::uint32_t i = 0; i <= cells.count[static_cast<std::size_t>(axis)]; ++i) {
            Vec2 from = low, to = high;
            from[axis] = to[axis] = low[axis] + cells.edge * static_cast<float>(i);
            lines.push_back({0, from, to});
        }
    return lines;
}

Lines lines_of(const LayeredGrid<2>& phase) {
    const auto& entries = phase.*member_of(EntriesOfLayeredGrid());
    struct Cell {
        std::uint32_t level;
        std::int32_t x, y;
        auto operator<=>(const Cell&) const = default;
    };
    std::vector<Cell> cells;
    for (const auto& entry : entries) cells.push_back({entry.level, entry.cell[0], entry.cell[1]});
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    Lines lines;
    float level = -1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i == 0 || cells[i].level != cells[i - 1].level) ++level;
        const float edge = layer_edge(cells[i].level);
        const Vec2 low = edge * Vec2(cells[i].x, cells[i].y);
        add_box(lines, level, {low, low + edge});
    }
    return lines;
}

Lines lines_of(const SweepAndPrune<2>& phase) {
    const SweepPlan<2>& plan = phase.plan();
    const Parts& parts = plan.parts[0];
    const int axis = plan.axis, across = 1 - axis;
    Lines lines;
    if (phase.empty()) return lines;
    const Aabb2 bounds = phase.bounds();
    for (std::uint32_t i = 1; i < parts.count; ++i) {
        Vec2 from = bounds.min, to = bounds.max;
        from[across] = to[across] = parts.low + static_cast<float>(i) / parts.scale;
        lines.push_back({0, from, to});
    }
    phase.each_box([&](std::uint32_t, const Aabb2& box) {
        Vec2 from = center(box), to = from;
        from[axis] = box.min[axis];
        to[axis] = box.max[axis];
        lines.push_back({1, from, to});
    });
    return lines;
}

namespace {

void add_node(const BvhTree<2>& tree, std::uint32_t ref, float level, Lines& lines) {
    if (is_leaf(ref)) return;
    const BvhNode<2>& node = tree.node(ref);
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
        if (node.child[lane] != bvh_none) {
            add_box(lines, level + 1, node.box(lane));
            add_node(tree, node.child[lane], level + 1, lines);
        }
}

void add_leaf_items(const BvhTree<2>& tree, std::uint32_t ref, const Aabb2& box, Items& out) {
    if (is_leaf(ref)) {
        for (const std::uint32_t item : tree.leaf(ref).index)
            if (item != bvh_none) out.push_back(item);
        return;
    }
    const BvhNode<2>& node = tree.node(ref);
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
        if (node.child[lane] != bvh_none && overlaps(node.box(lane), box))
            add_leaf_items(tree, node.child[lane], box, out);
}

template <class Nodes>
void add_planes(const Nodes& nodes, std::uint32_t index, const Aabb2& cell, float level, Lines& lines) {
    const auto& node = nodes[index];
    if (node.below == 0) return;
    Aabb2 below = cell, above = cell, middle = cell;
    below.max[node.axis] = above.min[node.axis] = node.plane;
    middle.min[node.axis] = node.low;
    middle.max[node.axis] = node.high;
    Vec2 from = cell.min, to = cell.max;
    from[node.axis] = to[node.axis] = node.plane;
    lines.push_back({level, from, to});
    add_planes(nodes, node.below, below, level + 1, lines);
    add_planes(nodes, node.above, above, level + 1, lines);
    if (node.straddles != 0) add_planes(nodes, node.straddles, middle, level + 1, lines);
}

template <class Nodes, class Entries>
void add_side_items(const Nodes& nodes, const Entries& entries, std::uint32_t index, const Aabb2& box, Items& out) {
    const auto& node = nodes[index];
    if (node.below == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) out.push_back(entries[i].item);
        return;
    }
    const float low = box.min[node.axis], high = box.max[node.axis];
    if (node.straddles != 0 && low <= node.high && high >= node.low)
        add_side_items(nodes, entries, node.straddles, box, out);
    if (low < node.plane) add_side_items(nodes, entries, node.below, box, out);
    if (high >= node.plane) add_side_items(nodes, entries, node.above, box, out);
}

}  // namespace

Lines lines_of(const Bvh<2>& phase) {
    const BvhTree<2>& tree = BvhAccess::tree(phase);
    Lines lines;
    if (tree.root(0).ref == bvh_none) return lines;
    add_box(lines, 0, tree.root(0).box);
    add_node(tree, tree.root(0).ref, 0, lines);
    return lines;
}

Lines lines_of(const Bsp<2>& phase) {
    Lines lines;
    if (!phase.empty()) add_planes(phase.*member_of(NodesOfBsp()), 0, phase.bounds(), 0, lines);
    return lines;
}

Candidates<Grid<2>>::Candidates(const Grid<2>& phase) : phase_(phase), seen_in_(phase.size()) {}

void Candidates<Grid<2>>::of(const Aabb2& box, Items& out) {
    const GridCells<2>& cells = phase_.*member_of(CellsOfGrid());
    const GridStore& store = phase_.*member_of(StoreOfGrid());
    out = phase_.*member_of(LargeOfGrid());
    if (phase_.empty()) return;
    ++call_;
    each_cell<2>(cells.range(box), [&](const std::array<std::uint32_t, 2>& cell) {
        store.each_page(cells.index(cell), [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i) {
                const std::uint32_t item = store.records[i].item;
                if (seen_in_[item] == call_) continue;
                seen_in_[item] = call_;
                out.push_back(item);
            }
            return true;
        });
        return true;
    });
}

Candidates<LayeredGrid<2>>::Candidates(const LayeredGrid<2>& phase) {
    for (const auto& entry : phase.*member_of(EntriesOfLayeredGrid()))
        places_.push_back({entry.level, entry.cell[1], entry.cell[0], entry.item});
    std::sort(places_.begin(), places_.end());
    for (const Place& place : places_)
        if (levels_.empty() || levels_.back() != place.level) levels_.push_back(place.level);
}

void Candidates<LayeredGrid<2>>::of(const Aabb2& box, Items& out) const {
    out.clear();
    for (const std::uint32_t level : levels_) {
        // A box stored in the cell before may reach into the next one.
        const std::int32_t first_row = layer_cell(box.min.y, level) - 1, last_row = layer_cell(box.max.y, level);
        const std::int32_t first = layer_cell(box.min.x, level) - 1, last = layer_cell(box.max.x, level);
        for (std::int32_t row = first_row; row <= last_row; ++row) {
            auto place = std::lower_bound(places_.begin(), places_.end(), Place{level, row, first, 0});
            for (; place != places_.end() && place->level == level && place->row == row && place->column <= last;
                 ++place)
                out.push_back(place->item);
        }
    }
}

void Candidates<SweepAndPrune<2>>::of(const Aabb2& box, Items& out) {
    const std::vector<std::uint32_t>& ends = phase_.*member_of(ColumnsOfSweep());
    const std::vector<std::uint32_t>& items = phase_.*member_of(ItemsOfSweep());
    const BoxSoaView<2> boxes = (phase_.*member_of(BoxesOfSweep())).view();
    out.clear();
    if (phase_.empty()) return;
    ++call_;
    const Aabb2 turned_box = turned<2>(box, phase_.plan().axis);
    const ColumnSpan span = phase_.plan().span(turned_box);
    for (std::uint32_t column = span.first; column <= span.first + span.more_rows; ++column)
        for (std::uint32_t i = column == 0 ? 0 : ends[column - 1] + 1; i < ends[column]; ++i) {
            if (boxes.min[0][i] > turned_box.max.x) break;
            const std::uint32_t item = item_of(items[i]);
            if (boxes.max[0][i] < turned_box.min.x || seen_in_[item] == call_) continue;
            seen_in_[item] = call_;
            out.push_back(item);
        }
}

void Candidates<Bvh<2>>::of(const Aabb2& box, Items& out) const {
    const BvhTree<2>& tree = BvhAccess::tree(phase_);
    out.clear();
    if (tree.root(0).ref != bvh_none) add_leaf_items(tree, tree.root(0).ref, box, out);
}

void Candidates<Bsp<2>>::of(const Aabb2& box, Items& out) const {
    out.clear();
    if (!phase_.empty())
        add_side_items(phase_.*member_of(NodesOfBsp()), phase_.*member_of(EntriesOfBsp()), 0, box, out);
}

std::vector<float> not_before(const TemporalGrid& phase) {
    const TemporalCore<2>& core = phase.*member_of(CoreOfTemporal());
    const auto& items = core.*member_of(ItemsOfCore());
    const float now = core.*member_of(NowOfCore());
    std::vector<float> result(items.size(), static_cast<float>(core.*member_of(EndOfCore())));
    for (const PairBlock& block : core.*member_of(BlocksOfCore()))
        for (std::size_t i = 0; i < block.count; ++i)
            for (const std::uint32_t item : {block.pairs[i].first, block.pairs[i].second})
                result[item] = std::min(result[item], block.due[i]);
    for (std::size_t i = 0; i < items.size(); ++i) result[i] = items[i].is_fast() ? 0 : std::max(result[i] - now, 0.0f);
    return result;
}

}  // namespace abut::play
