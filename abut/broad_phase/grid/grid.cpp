// The functions of the uniform grid. Its cells are an array over a bounded region, so it needs no spatial hash;
// LayeredGrid has one.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/detail/reserve_one_more.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/grid/cell_size.hpp>
#include <abut/broad_phase/grid/parallel_parts.hpp>
#include <abut/broad_phase/grid/queries.hpp>
#include <abut/broad_phase/sweep_pieces.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace abut {

using namespace detail;

namespace {

/// The capacity suffices for two or three copies of each box. If it doesn't, the cells are enlarged.
std::uint32_t max_page_count(std::size_t boxes) {
    return static_cast<std::uint32_t>(boxes / 6) + (detail::GridStore::pages_per_cell + 1) * 64;
}

}  // namespace

template <int D>
double Grid<D>::Cost::time() const {
    return 12.0 * static_cast<double>(tiles) + 3.0 * static_cast<double>(copies) + static_cast<double>(large);
}

template <int D>
typename Grid<D>::Cost Grid<D>::cost(Executor* executor) const {
    std::array<Cost, detail::part_count> parts;
    detail::run_parts(executor, boxes_.size(), [&](std::uint32_t part) {
        const auto [begin, end] = detail::range_of_part(cells_.total, part);
        Cost cost;
        for (auto cell = static_cast<std::uint32_t>(begin); cell < end; ++cell) {
            std::uint64_t pages = 0;
            store_.each_page(cell, [&](std::uint32_t, std::uint32_t count) {
                cost.copies += count;
                cost.tiles += ++pages;
                return true;
            });
        }
        parts[part] = cost;
    });
    Cost result;
    for (const Cost& part : parts) {
        result.copies += part.copies;
        result.tiles += part.tiles;
    }
    result.large = std::uint64_t{large_.size()} * boxes_.size();
    return result;
}

template <int D>
void Grid<D>::reserve(std::size_t count) {
    if (count <= capacity_) return;
    capacity_ = count;
    large_.reserve(count);
    store_.reserve(max_page_count(count), detail::grid_max_cells(count));
}

template <int D>
void Grid<D>::set_edge(float edge) {
    cells_ = detail::make_cells(region_, edge, detail::grid_max_cells(boxes_.size()));
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
    detail::enter_library();
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 27);
    boxes_.resize(boxes.size());
    free_.clear();
    choose_cells_and_fill(boxes, executor);
}

template <int D>
void Grid<D>::choose_cells_and_fill(std::span<const Aabb<D>> boxes, Executor* executor) {
    reserve(boxes.size());
    const detail::GridStatistics<D> statistics = detail::statistics_of(boxes, executor);
    region_ = statistics.region;
    set_edge(requested_edge_ > 0
                 ? requested_edge_
                 : choose_cell_edge(statistics, detail::grid_boxes_per_cell, detail::grid_min_edge_ratio));
    fill_cells(boxes, executor);
    chosen_cost_ = cost_;
}

template <int D>
void Grid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    free_.remove_used(boxes);
    fill_cells(boxes, executor);
    if (cost_.time() > 1.5 * chosen_cost_.time()) choose_cells_and_fill(boxes, executor);
}

template <int D>
bool Grid<D>::insert_into_cells(std::uint32_t index) {
    const detail::QuantisedBox<D> quantised = cells_.quantised(boxes_[index]);
    const detail::CellRange<D> range = cells_.range(quantised);
    if (!detail::fits_in_cells(range)) {
        large_.insert(std::lower_bound(large_.begin(), large_.end(), index), index);
        return true;
    }
    return each_cell<D>(range, [&](const std::array<std::uint32_t, D>& at) {
        const detail::PackedBox<D> packed(quantised, at);
        const std::uint32_t cell = cells_.index(at);
        store_.add(cell, packed.low, packed.high, index);
        ++cost_.copies;
        if (store_.has_new_page(cell)) cost_.tiles += store_.page_count(cell);
        return !store_.is_full();
    });
}

template <int D>
void Grid<D>::remove_from_cells(std::uint32_t index) {
    const detail::CellRange<D> range = cells_.range(boxes_[index]);
    if (!detail::fits_in_cells(range)) {
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
    detail::enter_library();
    const std::uint32_t index = free_.take(static_cast<std::uint32_t>(size()));
    if (index == size()) {
        ABUT_ASSERT(size() < std::size_t{1} << 27);
        detail::reserve_one_more(boxes_);
        boxes_.emplace_back();
    }
    boxes_[index] = usable(box);
    if (is_empty(boxes_[index])) {
        if (size() > capacity_) reserve(size() + size() / 4);
        return index;
    }
    const bool is_stored = cells_.total > 0 && insert_into_cells(index);
    cost_.large = std::uint64_t{large_.size()} * boxes_.size();
    // Any cells suit a few boxes.
    constexpr double max_neglected_cost = 1000;
    if (!is_stored || cost_.time() > 1.5 * chosen_cost_.time() + max_neglected_cost) {
        reserve(size() + size() / 4);
        choose_cells_and_fill(boxes_, nullptr);
    }
    return index;
}

template <int D>
void Grid<D>::erase(std::uint32_t index) {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    if (index >= size() || free_.contains(index)) return;
    if (!is_empty(boxes_[index])) remove_from_cells(index);
    cost_.large = std::uint64_t{large_.size()} * boxes_.size();
    boxes_[index] = Aabb<D>::empty();
    free_.add(index);
}

template <int D>
bool Grid<D>::set(std::uint32_t index, const Aabb<D>& box) {
    detail::enter_library();
    ABUT_ASSERT(index < size() && !free_.contains(index));
    if (index >= size() || store_.is_full()) return false;
    if (!is_empty(boxes_[index])) remove_from_cells(index);
    boxes_[index] = usable(box);
    const bool is_stored = is_empty(boxes_[index]) || (cells_.total > 0 && insert_into_cells(index));
    cost_.large = std::uint64_t{large_.size()} * boxes_.size();
    return is_stored;
}

template <int D>
Aabb<D> Grid<D>::bounds() const {
    detail::enter_library();
    Aabb<D> result = Aabb<D>::empty();
    for (const Aabb<D>& box : boxes_) result = merged(result, box);
    return result;
}

template <int D>
bool Grid<D>::visit_large(PairsCall visit) const {
    detail::PairBuffer pairs(visit);
    for (const std::uint32_t large : large_)
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
            if (!overlaps(boxes_[large], boxes_[i]) || i == large) continue;
            // The lower index reports a pair of two large boxes.
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
    detail::report_in_parallel(*executor, parts + 1, visit, [&](std::uint32_t part, PairsCall report) {
        const auto cell = [&](std::uint64_t i) { return static_cast<std::uint32_t>(i * cells_.total / parts); };
        if (part == 0)
            visit_large(report);
        else
            visit_cells(store_, boxes_.data(), cell(part - 1), cell(part), report);
    });
}

template <int D>
void Grid<D>::visit_pairs(const Grid& other, PairsCall visit) const {
    detail::report_between(other, *this, visit, true);
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
    detail::find_overlapping<D>({cells_, store_, boxes_.data()}, query, visit);
}

template <int D>
template <class Reach>
void Grid<D>::visit_within(Reach reach, ReachCall visit) const {
    if (size() == 0) return;
    for (std::size_t i = 0; i < large_.size() && !reach.is_exhausted(); ++i) {
        double measure = 0;
        if (reach.measure(boxes_[large_[i]], measure)) reach.shrink(visit(large_[i]));
    }
    if (!reach.is_exhausted()) detail::find_within<D>({cells_, store_, boxes_.data()}, reach, visit);
}

template <int D>
void Grid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    visit_within(RayReach<D>(ray), visit);
}

template <int D>
void Grid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    // The sweep is not clipped to the bounds, for these take O(n) to compute.
    constexpr float far = std::numeric_limits<float>::infinity();
    WayPieces<D> pieces(box, {Vec<D>(-far), Vec<D>(far)}, static_cast<double>(cells_.edge));
    pieces.each(visit, [&](const Aabb<D>& piece, auto report) {
        visit_overlapping(piece, [&](std::uint32_t index) { return report(index, boxes_[index]); });
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
