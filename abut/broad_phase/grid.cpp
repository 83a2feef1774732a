#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/grid_pairs.hpp>
#include <abut/broad_phase/grid_plan.hpp>
#include <abut/broad_phase/grid_queries.hpp>
#include <abut/broad_phase/pair_buffer.hpp>
#include <abut/broad_phase/tell_together.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>

namespace abut {
namespace {

/// Room for two copies or three of each box. Where that doesn't do, cells are made larger.
std::uint32_t most_pages(std::size_t boxes) {
    return static_cast<std::uint32_t>(boxes / 6) + (GridStore::own_pages + 1) * 64;
}

}  // namespace

template <int D>
double Grid<D>::Cost::time() const {
    return 12.0 * static_cast<double>(tiles) + 3.0 * static_cast<double>(copies);
}

template <int D>
typename Grid<D>::Cost Grid<D>::cost() const {
    Cost result;
    for (std::uint32_t cell = 0; cell < cells_.total; ++cell) {
        std::uint64_t pages = 0;
        store_.each_page(cell, [&](std::uint32_t, std::uint32_t count) {
            result.copies += count;
            result.tiles += ++pages;
            return true;
        });
    }
    return result;
}

template <int D>
void Grid<D>::set_edge(float edge) {
    cells_ = cells_in(block_, edge, grid_most_cells(boxes_.size()));
}

template <int D>
void Grid<D>::fill_cells(std::span<const Aabb<D>> boxes) {
    for (;;) {
        store_.clear(cells_.total);
        large_.clear();
        fill(cells_, boxes, boxes_.data(), store_, large_);
        if (!store_.is_full) return;
        set_edge(cells_.edge * 1.25f);
    }
}

template <int D>
void Grid<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 27);
    boxes_.resize(boxes.size());
    large_.reserve(boxes.size());
    store_.reserve(most_pages(boxes.size()), grid_most_cells(boxes.size()), GridWords<D>::guards);
    plan(boxes);
}

template <int D>
void Grid<D>::plan(std::span<const Aabb<D>> boxes) {
    const GridScene<D> scene = scene_of(boxes);
    block_ = scene.block;
    set_edge(wanted_edge_ > 0 ? wanted_edge_ : edge_for(scene, grid_boxes_a_cell, grid_edges_a_cell));
    fill_cells(boxes);
    planned_ = cost();
}

template <int D>
void Grid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    fill_cells(boxes);
    if (cost().time() > 1.5 * planned_.time()) plan(boxes);
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
void Grid<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(BoxReach<D>(box, reach), visit);
}

template class Grid<2>;
template class Grid<3>;
static_assert(BroadPhase<Grid<2>, 2> && BroadPhase<Grid<3>, 3>);

}  // namespace abut
