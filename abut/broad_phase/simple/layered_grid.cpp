#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/sweep_pieces.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/next_float.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>

namespace abut {
namespace {

constexpr std::size_t max_levels = 129;
constexpr double largest_float = std::numeric_limits<float>::max();

double finite(float x) {
    return std::clamp(static_cast<double>(x), -largest_float, largest_float);
}

/// The least even l with side < 2^l for every side of the box, so that it reaches at most one cell further; and with
/// |x| < 2^(l + 30) for every coordinate, so that a cell's coordinates fit in 31 bits.
template <int D>
int level_of(const Aabb<D>& box) {
    double size = 0x1p-127;
    for (int i = 0; i < D; ++i) {
        const double min = finite(box.min[i]), max = finite(box.max[i]);
        size = std::max({size, max - min, 0x1p-30 * std::abs(min), 0x1p-30 * std::abs(max)});
    }
    int exponent = 0;
    std::frexp(size, &exponent);  // size = m 2^exponent with 0.5 <= m < 1
    return exponent + (exponent & 1);
}

template <int D>
glm::vec<D, std::int32_t> cell_at(const Vec<D>& point, int level) {
    constexpr double limit = 1 << 30;
    const double cells_per_length = std::ldexp(1.0, -level);
    glm::vec<D, std::int32_t> cell;
    for (int i = 0; i < D; ++i)
        cell[i] =
            static_cast<std::int32_t>(std::clamp(std::floor(finite(point[i]) * cells_per_length), -limit - 1, limit));
    return cell;
}

}  // namespace

template <int D>
void LayeredGrid<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() < std::size_t{1} << 31);
    size_ = boxes.size();
    bounds_ = Aabb<D>::empty();
    bucket_begin_.assign(std::bit_ceil(size_ + 1) + 1, 0);
    unsorted_.clear();
    unsorted_.reserve(size_);
    entries_.reserve(size_);
    levels_.clear();
    levels_.reserve(max_levels);
    for (std::uint32_t item = 0; item < size_; ++item) {
        const Aabb<D> box = usable(boxes[item]);
        if (is_empty(box)) continue;
        const int exponent = level_of(box);
        const Cell cell = cell_at<D>(box.min, exponent);
        unsorted_.push_back({box, cell, exponent, item});
        ++bucket_begin_[bucket_of(cell, exponent)];
        bounds_ = merged(bounds_, box);

        auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.level == exponent; });
        if (level == levels_.end()) level = levels_.insert(level, {exponent, {cell, cell}});
        level->home_cells = {glm::min(level->home_cells.low, cell), glm::max(level->home_cells.high, cell)};
    }

    // A counting sort. Placed from the back, the entries turn the ends of the buckets into their beginnings.
    std::partial_sum(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin());
    entries_.resize(unsorted_.size());
    for (std::size_t i = unsorted_.size(); i-- > 0;)
        entries_[--bucket_begin_[bucket_of(unsorted_[i].cell, unsorted_[i].level)]] = unsorted_[i];
}

template <int D>
void LayeredGrid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    build(boxes, executor);
}

template <int D>
std::uint32_t LayeredGrid<D>::bucket_of(const Cell& cell, int level) const {
    std::uint32_t hash = static_cast<std::uint32_t>(level);
    for (int i = 0; i < D; ++i) hash = (hash ^ static_cast<std::uint32_t>(cell[i])) * 0x9E3779B1u;
    return (hash ^ hash >> 16) & static_cast<std::uint32_t>(bucket_begin_.size() - 2);
}

/// Those cells of the level that can hold a box that overlaps this one. Empty if low > high on some axis.
template <int D>
auto LayeredGrid<D>::range_of(const Level& level, const Aabb<D>& box) const -> CellRange {
    // A box from the cell before may reach into the first.
    return {glm::max(level.home_cells.low, cell_at<D>(box.min, level.level) - 1),
            glm::min(level.home_cells.high, cell_at<D>(box.max, level.level))};
}

/// Calls visit(entry) for the boxes stored in some cells of a level. Returns false as soon as the visitor does.
template <int D>
template <class Visit>
bool LayeredGrid<D>::visit_cells(const CellRange& range, int level, const Visit& visit) const {
    for (int i = 0; i < D; ++i)
        if (range.low[i] > range.high[i]) return true;
    for (Cell cell = range.low;;) {
        const std::uint32_t bucket = bucket_of(cell, level);
        for (std::uint32_t at = bucket_begin_[bucket]; at < bucket_begin_[bucket + 1]; ++at) {
            // The bucket may hold boxes of other cells as well.
            const Entry& entry = entries_[at];
            if (entry.cell == cell && entry.level == level && !visit(entry)) return false;
        }
        int axis = 0;
        for (; axis < D && cell[axis] == range.high[axis]; ++axis) cell[axis] = range.low[axis];
        if (axis == D) return true;
        ++cell[axis];
    }
}

/// True if the cells that may hold a box that overlaps this one are fewer than the boxes.
template <int D>
bool LayeredGrid<D>::covers_few_cells(const Aabb<D>& box) const {
    double cells = 0;
    for (const Level& level : levels_) {
        const CellRange range = range_of(level, box);
        double covered = 1;
        for (int i = 0; i < D; ++i) covered *= std::max(0.0, static_cast<double>(range.high[i]) - range.low[i] + 1);
        cells += covered;
    }
    return cells < static_cast<double>(entries_.size());
}

/// Calls visit(entry) for all boxes that overlap this one, and for some others. Returns false as soon as the visitor
/// does.
template <int D>
template <class Visit>
bool LayeredGrid<D>::visit_region(const Aabb<D>& box, const Visit& visit) const {
    if (!covers_few_cells(box)) return std::all_of(entries_.begin(), entries_.end(), visit);
    return std::all_of(levels_.begin(), levels_.end(),
                       [&](const Level& level) { return visit_cells(range_of(level, box), level.level, visit); });
}

/// Adds the pairs of a box with those of its level that follow it, and with all of coarser levels. Boxes of a level are
/// ordered by their cell on axis 0, then by their index.
template <int D>
bool LayeredGrid<D>::visit_pairs_of(const Entry& entry, detail::PairBuffer& pairs) const {
    for (const Level& level : levels_) {
        if (level.level < entry.level) continue;
        CellRange range = range_of(level, entry.box);
        const bool own_level = level.level == entry.level;
        if (own_level) range.low[0] = entry.cell[0];
        const auto add = [&](const Entry& other) {
            const bool precedes = own_level && other.cell[0] == entry.cell[0] && other.item <= entry.item;
            return precedes || !overlaps(entry.box, other.box) || pairs.add_sorted(entry.item, other.item);
        };
        if (!visit_cells(range, level.level, add)) return false;
    }
    return true;
}

template <int D>
void LayeredGrid<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto add_pairs = [&](std::size_t begin, std::size_t end, detail::PairBuffer& pairs) {
        for (std::size_t i = begin; i < end; ++i)
            if (!visit_pairs_of(entries_[i], pairs)) return false;
        return true;
    };
    detail::report_ranges(executor, entries_.size(), 512, visit, add_pairs);
}

template <int D>
void LayeredGrid<D>::visit_pairs(const LayeredGrid& other, PairsCall visit) const {
    detail::report_between(*this, other, visit);
}

template <int D>
void LayeredGrid<D>::visit_boxes(BoxCall<D> visit) const {
    for (const Entry& entry : entries_)
        if (!visit(entry.item, entry.box)) return;
}

template <int D>
void LayeredGrid<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (is_empty(query)) return;
    visit_region(query, [&](const Entry& entry) { return !overlaps(query, entry.box) || visit(entry.item); });
}

template <int D>
void LayeredGrid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    const DVec<D> origin(ray.origin);
    visit_along(MovingBox<D>{origin, DVec<D>(0.0), DVec<D>(ray.direction), static_cast<double>(ray.length)}, visit);
}

/// Searches regions one after the other, each twice as large as the last: around pieces of a path, or around a box.
/// region_of(begin, end) contains all boxes at distances from `begin` to `end`; `measure_of` maps a distance to a
/// measure of `reach`. A box is visited in the region in which it is at such a distance, so that none is visited twice.
template <int D>
template <class Reach, class Region, class Measure>
void LayeredGrid<D>::visit_within(Reach reach, double begin, double step, const Region& region_of,
                                  const Measure& measure_of, ReachCall visit) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double visited = 0;
    for (double end = begin + step;; end += step) {
        const Aabb<D> region = region_of(begin, end);
        if (!overlaps(region, bounds_)) return;
        // Returns false if nothing is left to search.
        const auto visit_until = [&](double until) {
            const bool go_on = visit_region(region, [&](const Entry& entry) {
                double at = 0;
                if (!reach.measure(entry.box, at) || at < visited || at >= until) return true;
                reach.shrink(visit(entry.item));
                return !reach.is_exhausted();
            });
            visited = until;
            return go_on && reach.within(until);
        };
        const bool is_last = !covers_few_cells(region) || contains(region, bounds_);
        if (is_last) {
            // All that are left, the nearest first.
            double least = infinity;
            for (const Entry& entry : entries_)
                if (double at = 0; reach.measure(entry.box, at) && at >= visited) least = std::min(least, at);
            if (visit_until(std::nextafter(least, infinity))) visit_until(infinity);
            return;
        }
        if (!visit_until(measure_of(end))) return;
        begin = end;
        step *= 2;
    }
}

template <int D>
void LayeredGrid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    const auto reach = RayReach<D>::of_box(box);
    double begin = 0, speed = 0;
    if (reach.is_exhausted() || entries_.empty() || !reach.measure(bounds_, begin)) return;
    for (int i = 0; i < D; ++i) speed = std::max(speed, std::abs(box.direction[i]));
    const auto piece = [&](double from, double to) {
        return box_around_path<D>(reach, from, std::min(to, reach.reach()));
    };
    visit_within(
        reach, begin, typical_edge() / speed, piece, [](double distance) { return distance; }, visit);
}

template <int D>
void LayeredGrid<D>::visit_near(const Aabb<D>& box, float max_distance, ReachCall visit) const {
    const BoxReach<D> reach(box, max_distance);
    double squared = 0;
    if (reach.is_exhausted() || entries_.empty() || !reach.measure(bounds_, squared)) return;
    const auto around = [&](double, double to) {
        return grown(reach.box(), next_up(static_cast<float>(std::min(to, largest_float))));
    };
    visit_within(
        reach, std::sqrt(squared), typical_edge(), around, [](double to) { return to * to; }, visit);
}

template class LayeredGrid<2>;
template class LayeredGrid<3>;
static_assert(BroadPhase<LayeredGrid<2>, 2> && BroadPhase<LayeredGrid<3>, 3>);

}  // namespace abut
