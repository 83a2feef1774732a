// The hierarchical hash grid. All levels share one spatial hash, whose buckets are slices of a sorted array.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/sweep_pieces.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/detail/next_float.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {

using namespace detail;

namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
constexpr std::uint32_t level_count = 129;

/// The edge of the cells of a level: 4^-63 to 4^65.
double edge_of(std::uint32_t level) {
    return std::ldexp(1.0, 2 * static_cast<int>(level) - 126);
}

double finite(float x) {
    return std::clamp(static_cast<double>(x), -largest_float, largest_float);
}

/// The finest level whose cells are larger than the box on each axis and whose coordinates here fit in 31 bits.
template <int D>
std::uint32_t level_of(const Aabb<D>& box) {
    double size = 0x1p-127;
    for (int i = 0; i < D; ++i) {
        const double min = finite(box.min[i]), max = finite(box.max[i]);
        size = std::max({size, max - min, 0x1p-30 * std::abs(min), 0x1p-30 * std::abs(max)});
    }
    return static_cast<std::uint32_t>((std::ilogb(size) + 128) / 2);
}

template <int D>
std::array<std::int32_t, D> cell_at(const Vec<D>& corner, std::uint32_t level) {
    constexpr double limit = 1 << 30;
    const double cells_per_length = 1 / edge_of(level);
    std::array<std::int32_t, D> cell;
    for (int i = 0; i < D; ++i) {
        const double place = std::floor(finite(corner[i]) * cells_per_length);
        cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::clamp(place, -limit, limit));
    }
    return cell;
}

}  // namespace

template <int D>
void LayeredGrid<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    enter_library();
    ABUT_ASSERT(boxes.size() < std::size_t{1} << 31);
    size_ = boxes.size();
    bounds_ = Aabb<D>::empty();
    unsorted_.clear();
    unsorted_.reserve(size_);
    entries_.reserve(size_);
    bucket_begin_.reserve(2 * size_ + level_count + 1);
    levels_.assign(level_count, {});
    for (std::uint32_t item = 0; item < size_; ++item) {
        const Aabb<D> box = usable(boxes[item]);
        if (is_empty(box)) continue;
        const std::uint32_t level = level_of(box);
        unsorted_.push_back({box, cell_at(box.min, level), level, item});
        levels_[level] = {level, levels_[level].count + 1};
        bounds_ = merged(bounds_, box);
    }
    std::uint32_t buckets = 0;
    for (Level& level : levels_) {
        level.first_bucket = buckets;
        buckets += std::bit_ceil(level.count);
    }

    // A counting sort. Placed from the back, the entries turn the ends of the buckets into their beginnings.
    bucket_begin_.assign(buckets + 1, 0);
    const auto bucket_begin = [&](const Entry& entry) -> std::uint32_t& {
        return bucket_begin_[bucket_of(levels_[entry.level], entry.cell)];
    };
    for (const Entry& entry : unsorted_) ++bucket_begin(entry);
    std::partial_sum(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin());
    entries_.resize(unsorted_.size());
    for (std::size_t i = unsorted_.size(); i-- > 0;) entries_[--bucket_begin(unsorted_[i])] = unsorted_[i];
    std::erase_if(levels_, [](const Level& level) { return level.count == 0; });
}

template <int D>
void LayeredGrid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    ABUT_ASSERT(boxes.size() == size());
    build(boxes, executor);
}

/// Each row of cells along axis 0 has a hash. Its cells are consecutive buckets, and wrap at the last one.
template <int D>
std::uint32_t LayeredGrid<D>::bucket_of(const Level& level, const Cell& cell) {
    std::uint32_t hash = 0;
    for (std::size_t i = 1; i < D; ++i) hash = (hash ^ hash >> 15 ^ static_cast<std::uint32_t>(cell[i])) * 0x9E3779B1;
    hash ^= hash >> 15;
    return level.first_bucket + ((hash + static_cast<std::uint32_t>(cell[0])) & (std::bit_ceil(level.count) - 1));
}

/// Calls visit(entry) for the boxes of a level that overlap this one, and for some others. Returns false as soon as the
/// visitor does.
template <int D>
template <class Visit>
bool LayeredGrid<D>::visit_level(const Level& level, const Aabb<D>& box, const Visit& visit) const {
    Cell low = cell_at(box.min, level.level);
    const Cell high = cell_at(box.max, level.level);
    double cells = 1;
    for (std::size_t i = 0; i < D; ++i) {
        --low[i];  // a box stored in the cell before may reach into this one
        cells *= static_cast<double>(high[i]) - low[i] + 1;
    }
    if (cells >= level.count) {
        const Entry* first = &entries_[bucket_begin_[level.first_bucket]];
        return std::all_of(first, first + level.count, visit);
    }
    const std::uint32_t end_bucket = level.first_bucket + std::bit_ceil(level.count);
    for (Cell row = low;;) {
        std::uint32_t bucket = bucket_of(level, row), remaining = static_cast<std::uint32_t>(high[0] - low[0]) + 1;
        while (remaining > 0) {
            const std::uint32_t buckets = std::min(remaining, end_bucket - bucket);
            for (std::uint32_t i = bucket_begin_[bucket]; i < bucket_begin_[bucket + buckets]; ++i) {
                // The buckets may hold boxes of other cells as well.
                const Cell& cell = entries_[i].cell;
                bool is_in_row = low[0] <= cell[0];
                is_in_row &= cell[0] <= high[0];
                for (std::size_t axis = 1; axis < D; ++axis) is_in_row &= cell[axis] == row[axis];
                if (is_in_row && !visit(entries_[i])) return false;
            }
            remaining -= buckets;
            bucket = level.first_bucket;
        }
        std::size_t axis = 1;
        for (; axis < D && row[axis] == high[axis]; ++axis) row[axis] = low[axis];
        if (axis == D) return true;
        ++row[axis];
    }
}

template <int D>
void LayeredGrid<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto add_pairs = [&](std::size_t begin, std::size_t end, PairBuffer& pairs) {
        for (std::size_t i = begin; i < end; ++i) {
            const Entry& entry = entries_[i];
            // Two boxes of one level find each other: only the one with the lower index reports them. The comparisons
            // have no branches, because no predictor could guess them.
            const auto add = [&](const Entry& other) {
                bool is_pair = other.level != entry.level || entry.item < other.item;
                for (int axis = 0; axis < D; ++axis) {
                    is_pair &= entry.box.min[axis] <= other.box.max[axis];
                    is_pair &= other.box.min[axis] <= entry.box.max[axis];
                }
                return !is_pair || pairs.add_sorted(entry.item, other.item);
            };
            for (const Level& level : levels_)
                if (level.level >= entry.level && !visit_level(level, entry.box, add)) return false;
        }
        return true;
    };
    report_ranges(executor, entries_.size(), 512, visit, add_pairs);
}

template <int D>
void LayeredGrid<D>::visit_pairs(const LayeredGrid& other, PairsCall visit) const {
    report_between(*this, other, visit);
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
    const auto test = [&](const Entry& entry) { return !overlaps(query, entry.box) || visit(entry.item); };
    for (const Level& level : levels_)
        if (!visit_level(level, query, test)) return;
}

template <int D>
double LayeredGrid<D>::common_edge() const {
    return edge_of(std::ranges::max_element(levels_, {}, &Level::count)->level);
}

template <int D>
void LayeredGrid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    if (entries_.empty()) return;
    WayPieces<D> pieces(box, bounds_, common_edge());
    pieces.each(visit, [&](const Aabb<D>& piece, auto report) {
        const auto test = [&](const Entry& entry) { return report(entry.item, entry.box); };
        for (const Level& level : levels_)
            if (!visit_level(level, piece, test)) return;
    });
}

/// Searches regions one after the other, each twice as large as the one before, and visits the boxes that are beyond
/// the last region and not beyond this one. The search ends at the latest when its distance is infinite.
template <int D>
void LayeredGrid<D>::visit_near(const Aabb<D>& box, float max_distance, ReachCall visit) const {
    BoxReach<D> reach(box, max_distance);
    double nearest = 0, visited = -1;
    if (reach.is_exhausted() || entries_.empty() || !reach.measure(bounds_, nearest)) return;
    double step = 0.25 * common_edge();
    for (double distance = square_root(nearest) + step;;) {
        const double end = distance * distance;
        const Aabb<D> region = grown(reach.box(), next_up(static_cast<float>(std::min(distance, largest_float))));
        std::size_t tested = 0;
        double next = std::numeric_limits<double>::infinity();  // the least squared distance beyond the region
        const auto test = [&](const Entry& entry) {
            ++tested;
            double measure = 0;
            if (!reach.measure(entry.box, measure)) return true;
            if (measure > end)
                next = std::min(next, measure);
            else if (measure > visited)
                reach.shrink(visit(entry.item));
            return !reach.is_exhausted();
        };
        for (const Level& level : levels_)
            if (!visit_level(level, region, test)) return;
        if (end >= reach.max_measure()) return;
        visited = end;
        step *= 2;
        distance += step;
        if (tested == entries_.size()) distance = std::max(distance, square_root(next));
    }
}

template class LayeredGrid<2>;
template class LayeredGrid<3>;
static_assert(BroadPhase<LayeredGrid<2>, 2> && BroadPhase<LayeredGrid<3>, 3>);

}  // namespace abut
