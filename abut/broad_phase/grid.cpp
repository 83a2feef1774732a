#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/grid_jobs.hpp>
#include <abut/broad_phase/grid_pairs.hpp>
#include <abut/broad_phase/grid_plan.hpp>
#include <abut/broad_phase/grid_queries.hpp>
#include <abut/broad_phase/pair_buffer.hpp>
#include <abut/broad_phase/room_for_one.hpp>
#include <abut/broad_phase/sweep_pieces.hpp>
#include <abut/broad_phase/tell_together.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace abut {
namespace {

/// Room for two copies or three of each box. Where that doesn't do, cells are made larger.
std::uint32_t most_pages(std::size_t boxes) {
    return static_cast<std::uint32_t>(boxes / 6) + (GridStore::own_pages + 1) * 64;
}

}  // namespace

template <int D>
double Grid<D>::Cost::time() const {
    return 12.0 * static_cast<double>(tiles) + 3.0 * static_cast<double>(copies) + static_cast<double>(single);
}

template <int D>
typename Grid<D>::Cost Grid<D>::cost(Executor* executor) const {
    std::array<Cost, parts_of_job> parts;
    run_parts(executor, boxes_.size(), [&](std::uint32_t part) {
        const auto [begin, end] = part_of(cells_.total, part);
        Cost own;
        for (auto cell = static_cast<std::uint32_t>(begin); cell < end; ++cell) {
            std::uint64_t pages = 0;
            store_.each_page(cell, [&](std::uint32_t, std::uint32_t count) {
                own.copies += count;
                own.tiles += ++pages;
                return true;
            });
        }
        parts[part] = own;
    });
    Cost result;
    for (const Cost& part : parts) {
        result.copies += part.copies;
        result.tiles += part.tiles;
    }
    result.single = std::uint64_t{large_.size()} * boxes_.size();
    return result;
}

template <int D>
void Grid<D>::reserve(std::size_t count) {
    if (count <= reserved_) return;
    reserved_ = count;
    large_.reserve(count);
    store_.reserve(most_pages(count), grid_most_cells(count), GridWords<D>::guards);
}

template <int D>
void Grid<D>::set_edge(float edge) {
    cells_ = cells_in(block_, edge, grid_most_cells(boxes_.size()));
}

template <int D>
void Grid<D>::fill_cells(std::span<const Aabb<D>> boxes, Executor* executor) {
    if (executor != nullptr) marks_.resize(boxes.size());
    for (;;) {
        store_.clear(cells_.total);
        large_.clear();
        fill(cells_, boxes, boxes_.data(), store_, large_, marks_.data(), executor);
        if (!store_.is_full()) break;
        set_edge(cells_.edge * 1.25f);
    }
    cost_ = cost(executor);
}

template <int D>
void Grid<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 27);
    boxes_.resize(boxes.size());
    free_.clear();
    plan(boxes, executor);
}

template <int D>
void Grid<D>::plan(std::span<const Aabb<D>> boxes, Executor* executor) {
    reserve(boxes.size());
    const GridScene<D> scene = scene_of(boxes, executor);
    block_ = scene.block;
    set_edge(wanted_edge_ > 0 ? wanted_edge_ : edge_for(scene, grid_boxes_a_cell, grid_edges_a_cell));
    fill_cells(boxes, executor);
    planned_ = cost_;
}

template <int D>
void Grid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    free_.keep_empty(boxes);
    fill_cells(boxes, executor);
    if (cost_.time() > 1.5 * planned_.time()) plan(boxes, executor);
}

template <int D>
bool Grid<D>::put(std::uint32_t index) {
    const GridSteps<D> steps = cells_.steps(boxes_[index]);
    const CellRange<D> range = cells_.range(steps);
    if (!fits_in_cells(range)) {
        large_.insert(std::lower_bound(large_.begin(), large_.end(), index), index);
        return true;
    }
    return each_cell<D>(range, [&](const std::array<std::uint32_t, D>& at) {
        const WordsInCell<D> words(steps, at);
        const std::uint32_t cell = cells_.index(at);
        store_.add(cell, words.low, words.high, index);
        ++cost_.copies;
        if (store_.has_new_page(cell)) cost_.tiles += store_.page_count(cell);
        return !store_.is_full();
    });
}

template <int D>
void Grid<D>::take_out(std::uint32_t index) {
    const CellRange<D> range = cells_.range(boxes_[index]);
    if (!fits_in_cells(range)) {
        large_.erase(std::lower_bound(large_.begin(), large_.end(), index));
        return;
    }
    each_cell<D>(range, [&](const std::array<std::uint32_t, D>& at) {
        const std::uint32_t cell = cells_.index(at);
        if (store_.has_new_page(cell)) cost_.tiles -= store_.page_count(cell);
        --cost_.copies;
        store_.remove(cell, index);
        return true;
    });
}

template <int D>
std::uint32_t Grid<D>::insert(const Aabb<D>& box) {
    const std::uint32_t index = free_.take(static_cast<std::uint32_t>(size()));
    if (index == size()) {
        ABUT_ASSERT(size() < std::size_t{1} << 27);
        make_room_for_one(boxes_);
        boxes_.emplace_back();
    }
    boxes_[index] = usable(box);
    if (is_empty(boxes_[index])) {
        if (size() > reserved_) reserve(size() + size() / 4);
        return index;
    }
    const bool found_room = cells_.total > 0 && put(index);
    cost_.single = std::uint64_t{large_.size()} * boxes_.size();
    // While there are a few boxes only, any cells do.
    constexpr double little = 1000;
    if (!found_room || cost_.time() > 1.5 * planned_.time() + little) {
        reserve(size() + size() / 4);
        plan(boxes_, nullptr);
    }
    return index;
}

template <int D>
void Grid<D>::erase(std::uint32_t index) {
    ABUT_ASSERT(index < size());
    if (index >= size() || free_.contains(index)) return;
    if (!is_empty(boxes_[index])) take_out(index);
    cost_.single = std::uint64_t{large_.size()} * boxes_.size();
    boxes_[index] = Aabb<D>::empty();
    free_.add(index);
}

template <int D>
bool Grid<D>::set(std::uint32_t index, const Aabb<D>& box) {
    ABUT_ASSERT(index < size() && !free_.contains(index));
    if (index >= size() || store_.is_full()) return false;
    if (!is_empty(boxes_[index])) take_out(index);
    boxes_[index] = usable(box);
    const bool found_room = is_empty(boxes_[index]) || (cells_.total > 0 && put(index));
    cost_.single = std::uint64_t{large_.size()} * boxes_.size();
    return found_room;
}

template <int D>
Aabb<D> Grid<D>::bounds() const {
    Aabb<D> result = Aabb<D>::empty();
    for (const Aabb<D>& box : boxes_) result = merged(result, box);
    return result;
}

template <int D>
bool Grid<D>::visit_large(PairsCall visit) const {
    PairBuffer pairs(visit);
    for (const std::uint32_t large : large_)
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
            if (!overlaps(boxes_[large], boxes_[i]) || i == large) continue;
            // Of two large ones, the lesser tells.
            if (i < large && std::binary_search(large_.begin(), large_.end(), i)) continue;
            if (!pairs.add_sorted(large, i)) return false;
        }
    return pairs.flush();
}

template <int D>
void Grid<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    if (size() == 0) return;
    if (executor == nullptr || size() < 1000) {
        if (visit_large(visit)) visit_cells(store_, boxes_.data(), 0, cells_.total, visit);
        return;
    }
    const std::uint32_t parts = std::min(4 * executor->workers(), cells_.total);
    tell_together(*executor, parts + 1, visit, [&](std::uint32_t part, PairsCall told) {
        const auto cell = [&](std::uint64_t i) { return static_cast<std::uint32_t>(i * cells_.total / parts); };
        if (part == 0)
            visit_large(told);
        else
            visit_cells(store_, boxes_.data(), cell(part - 1), cell(part), told);
    });
}

template <int D>
void Grid<D>::visit_pairs(const Grid& other, PairsCall visit) const {
    PairBuffer pairs(visit);
    bool more = true;
    for (std::uint32_t j = 0; j < other.size() && more; ++j)
        this->each_overlapping(other.boxes_[j], [&](std::uint32_t i) { return more = pairs.add(i, j); });
    if (more) pairs.flush();
}

template <int D>
void Grid<D>::visit_boxes(BoxCall<D> visit) const {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        if (!is_empty(boxes_[i]) && !visit(i, boxes_[i])) return;
}

template <int D>
void Grid<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (size() == 0 || is_empty(query)) return;
    for (const std::uint32_t large : large_)
        if (overlaps(boxes_[large], query) && !visit(large)) return;
    find_overlapping<D>({cells_, store_, boxes_.data()}, query, visit);
}

template <int D>
template <class Reach>
void Grid<D>::visit_within(Reach reach, ReachCall visit) const {
    if (size() == 0) return;
    for (std::size_t i = 0; i < large_.size() && !reach.over(); ++i) {
        double measure = 0;
        if (reach.measure(boxes_[large_[i]], measure)) reach.shrink(visit(large_[i]));
    }
    if (!reach.over()) find_within<D>({cells_, store_, boxes_.data()}, reach, visit);
}

template <int D>
void Grid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    visit_within(RayReach<D>(ray), visit);
}

template <int D>
void Grid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    // It takes a look at all boxes to know their bounds.
    constexpr float far = std::numeric_limits<float>::infinity();
    WayPieces<D> pieces(box, {Vec<D>(-far), Vec<D>(far)}, static_cast<double>(cells_.edge));
    pieces.each(visit, [&](const Aabb<D>& piece, auto told) {
        visit_overlapping(piece, [&](std::uint32_t index) { return told(index, boxes_[index]); });
    });
}

template <int D>
void Grid<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(BoxReach<D>(box, reach), visit);
}

template class Grid<2>;
template class Grid<3>;
static_assert(BroadPhase<Grid<2>, 2> && BroadPhase<Grid<3>, 3>);

}  // namespace abut
