// The hierarchical hash grid. All levels share one spatial hash, whose buckets are slices of a sorted array.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/detail/next_float.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {

using namespace detail;

namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
constexpr int min_level = -126, max_level = 130;

double finite(float x) {
    return std::clamp(static_cast<double>(x), -largest_float, largest_float);
}

/// The least exponent with x < 2^exponent, for x >= 0; the minimum level for 0.
int exponent_above(double x) {
    int exponent = min_level;
    if (x > 0) std::frexp(x, &exponent);
    return exponent;
}

/// The finest level whose cells are larger than the box on each axis and whose coordinates here fit in 31 bits.
template <int D>
int level_of(const Aabb<D>& box) {
    double side = 0, distance = 0;
    for (int i = 0; i < D; ++i) {
        const double min = finite(box.min[i]), max = finite(box.max[i]);
        side = std::max(side, max - min);
        distance = std::max({distance, std::abs(min), std::abs(max)});
    }
    const int exponent = std::max({exponent_above(side), exponent_above(distance) - 30, min_level});
    return exponent + (exponent & 1);
}

template <int D>
std::array<std::int32_t, D> cell_at(const Vec<D>& corner, double cells_per_length) {
    constexpr double limit = 1 << 30;
    std::array<std::int32_t, D> cell;
    for (int i = 0; i < D; ++i) {
        const double place = std::floor(finite(corner[i]) * cells_per_length);
        cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::clamp(place, -limit - 1, limit));
    }
    return cell;
}

/// Those of the level's cells that can hold a box that overlaps this one. Empty if low > high on some axis.
template <class Level, int D>
auto range_of(const Level& level, const Aabb<D>& box) {
    const double cells_per_length = std::ldexp(1.0, -level.level);
    auto range = level.home_cells;
    const auto low = cell_at<D>(box.min, cells_per_length), high = cell_at<D>(box.max, cells_per_length);
    for (std::size_t i = 0; i < D; ++i) {
        // A box from the cell before may reach into this one.
        range.low[i] = std::max(range.low[i], low[i] - 1);
        range.high[i] = std::min(range.high[i], high[i]);
    }
    return range;
}

/// The least box of floats that contains a box of doubles.
template <int D>
Aabb<D> rounded_outwards(const DVec<D>& min, const DVec<D>& max) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = next_down(static_cast<float>(std::clamp(min[i], -largest_float, largest_float)));
        result.max[i] = next_up(static_cast<float>(std::clamp(max[i], -largest_float, largest_float)));
    }
    return result;
}

/// For boxes that are not empty. Compares without branches, because no predictor could guess them.
template <int D>
bool both_overlap(const Aabb<D>& a, const Aabb<D>& b) {
    int gaps = 0;
    for (int i = 0; i < D; ++i) gaps += static_cast<int>(a.min[i] > b.max[i]) + static_cast<int>(b.min[i] > a.max[i]);
    return gaps == 0;
}

/// A box around the path of a moving box between two distances, larger than any rounding.
template <int D>
Aabb<D> path_bounds(const RayReach<D>& path, double from, double to) {
    DVec<D> min = path.low(), max = path.high();
    for (int i = 0; i < D; ++i) {
        const double speed = path.direction()[i];
        const double first = speed == 0 ? 0 : speed * from, last = speed == 0 ? 0 : speed * to;
        const double size = std::abs(min[i]) + std::abs(max[i]) + std::abs(first);
        const double tolerance = 1e-12 * std::min(size, largest_float);
        min[i] += std::min(first, last) - tolerance;
        max[i] += std::max(first, last) + tolerance;
    }
    return rounded_outwards<D>(min, max);
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
    std::array<Level, max_level - min_level + 1> levels{};
    for (std::uint32_t item = 0; item < size_; ++item) {
        const Aabb<D> box = usable(boxes[item]);
        if (is_empty(box)) continue;
        const int exponent = level_of(box);
        const Cell cell = cell_at<D>(box.min, std::ldexp(1.0, -exponent));
        unsorted_.push_back({box, cell, exponent, item});
        ++bucket_begin_[bucket_of(cell, exponent)];
        bounds_ = merged(bounds_, box);

        Level& level = levels[static_cast<std::size_t>(exponent - min_level)];
        if (level.count++ == 0) level = {exponent, 1, {cell, cell}};
        for (std::size_t i = 0; i < D; ++i) {
            level.home_cells.low[i] = std::min(level.home_cells.low[i], cell[i]);
            level.home_cells.high[i] = std::max(level.home_cells.high[i], cell[i]);
        }
    }
    levels_.clear();
    levels_.reserve(levels.size());
    for (const Level& level : levels)
        if (level.count > 0) levels_.push_back(level);

    // A counting sort. Placed from the back, the entries turn the ends of the buckets into their beginnings.
    std::partial_sum(bucket_begin_.begin(), bucket_begin_.end(), bucket_begin_.begin());
    entries_.resize(unsorted_.size());
    for (std::size_t i = unsorted_.size(); i-- > 0;)
        entries_[--bucket_begin_[bucket_of(unsorted_[i].cell, unsorted_[i].level)]] = unsorted_[i];
}

template <int D>
void LayeredGrid<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size());
    build(boxes, executor);
}

template <int D>
std::uint32_t LayeredGrid<D>::bucket_of(const Cell& cell, int level) const {
    std::uint32_t hash = static_cast<std::uint32_t>(level);
    for (const std::int32_t coordinate : cell) hash = (hash ^ static_cast<std::uint32_t>(coordinate)) * 0x9E3779B1u;
    return (hash ^ hash >> 16) & static_cast<std::uint32_t>(bucket_begin_.size() - 2);
}

/// Calls visit(entry) for the boxes stored in some cells of a level. Returns false as soon as the visitor does.
template <int D>
template <class Visit>
bool LayeredGrid<D>::visit_cells(const CellRange& range, int level, const Visit& visit) const {
    for (std::size_t i = 0; i < D; ++i)
        if (range.low[i] > range.high[i]) return true;
    for (Cell cell = range.low;;) {
        const std::uint32_t bucket = bucket_of(cell, level);
        for (std::uint32_t at = bucket_begin_[bucket]; at < bucket_begin_[bucket + 1]; ++at) {
            // The bucket may hold boxes of other cells as well.
            const Entry& entry = entries_[at];
            if (entry.cell == cell && entry.level == level && !visit(entry)) return false;
        }
        std::size_t axis = 0;
        for (; axis < D && cell[axis] == range.high[axis]; ++axis) cell[axis] = range.low[axis];
        if (axis == D) return true;
        ++cell[axis];
    }
}

/// False if it is cheaper to test all boxes than the cells that may hold a box that overlaps this one, and if those are
/// all cells.
template <int D>
bool LayeredGrid<D>::covers_few_cells(const Aabb<D>& box) const {
    double cells = 0, all_cells = 0;
    for (const Level& level : levels_) {
        const CellRange range = range_of(level, box);
        double covered = 1, all = 1;
        for (std::size_t i = 0; i < D; ++i) {
            covered *= std::max(0.0, static_cast<double>(range.high[i]) - range.low[i] + 1);
            all *= static_cast<double>(level.home_cells.high[i]) - level.home_cells.low[i] + 1;
        }
        cells += covered;
        all_cells += all;
    }
    return cells < static_cast<double>(entries_.size()) && cells < all_cells;
}

/// Calls visit(entry) for all boxes that overlap this one, and for some others: for all if it covers many cells.
/// Returns false as soon as the visitor does.
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
            return precedes || !both_overlap(entry.box, other.box) || pairs.add_sorted(entry.item, other.item);
        };
        if (!visit_cells(range, level.level, add)) return false;
    }
    return true;
}

/// The edge of the cells of the level that holds most boxes.
template <int D>
double LayeredGrid<D>::common_edge() const {
    const auto most = std::max_element(levels_.begin(), levels_.end(),
                                       [](const Level& a, const Level& b) { return a.count < b.count; });
    return most == levels_.end() ? 1 : std::ldexp(1.0, most->level);
}

template <int D>
void LayeredGrid<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const std::size_t count = entries_.size();
    // Each part has enough boxes to be worth a thread.
    const std::size_t parts =
        executor == nullptr ? 1 : std::clamp<std::size_t>(count / 512, 1, 4 * std::size_t{executor->workers()});
    const auto visit_part = [&](std::size_t part, PairsCall report) {
        detail::PairBuffer pairs(report);
        for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i)
            if (!visit_pairs_of(entries_[i], pairs)) return;
        pairs.flush();
    };
    if (parts == 1) return visit_part(0, visit);
    detail::report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit, visit_part);
}

template <int D>
void LayeredGrid<D>::visit_pairs(const LayeredGrid& other, PairsCall visit) const {
    detail::PairBuffer pairs(visit);
    for (const Entry& theirs : other.entries_) {
        const auto add = [&](const Entry& ours) {
            return !both_overlap(ours.box, theirs.box) || pairs.add(ours.item, theirs.item);
        };
        if (!visit_region(theirs.box, add)) return;
    }
    pairs.flush();
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
    visit_region(query, [&](const Entry& entry) { return !both_overlap(query, entry.box) || visit(entry.item); });
}

template <int D>
void LayeredGrid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    const DVec<D> origin(ray.origin);
    visit_along(MovingBox<D>{origin, DVec<D>(0.0), DVec<D>(ray.direction), static_cast<double>(ray.length)}, visit);
}

/// Queries regions around pieces of the path, each twice as long as the one before, and visits the items that the
/// moving box enters in the piece.
template <int D>
void LayeredGrid<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto reach = RayReach<D>::of_box(box);
    double begin = 0;
    if (reach.is_exhausted() || entries_.empty() || !reach.measure(bounds_, begin)) return;
    double visited = 0, speed = 0;
    for (int i = 0; i < D; ++i) speed = std::max(speed, std::abs(box.direction[i]));
    for (double step = common_edge() / speed, end = begin + step;; step *= 2) {
        const Aabb<D> region = path_bounds(reach, begin, std::min(end, reach.reach()));
        if (!overlaps(region, bounds_)) return;
        if (!covers_few_cells(region)) end = infinity;
        const bool go_on = visit_region(region, [&](const Entry& entry) {
            double enters = 0;
            if (!reach.measure(entry.box, enters) || enters < visited) return true;
            if (enters >= end && end < infinity) return true;
            reach.shrink(visit(entry.item));
            return !reach.is_exhausted();
        });
        if (!go_on || end == infinity || !reach.within(end)) return;
        visited = begin = end;
        end += step;
    }
}

/// Queries ever larger regions around the box, and visits the items whose distance lies between the last two radii.
template <int D>
void LayeredGrid<D>::visit_near(const Aabb<D>& box, float max_distance, ReachCall visit) const {
    BoxReach<D> reach(box, max_distance);
    double distance_squared = 0, visited_squared = -1;
    if (reach.is_exhausted() || entries_.empty() || !reach.measure(bounds_, distance_squared)) return;
    double radius = std::sqrt(distance_squared) + common_edge();
    while (reach.within(visited_squared)) {
        const Aabb<D> region =
            rounded_outwards<D>(DVec<D>(reach.box().min) - radius, DVec<D>(reach.box().max) + radius);
        double nearest_beyond = std::numeric_limits<double>::infinity();
        bool beyond = covers_few_cells(region);
        const bool go_on = visit_region(region, [&](const Entry& entry) {
            if (!reach.measure(entry.box, distance_squared) || distance_squared <= visited_squared) return true;
            if (distance_squared <= radius * radius) {
                reach.shrink(visit(entry.item));
            } else {
                nearest_beyond = std::min(nearest_beyond, distance_squared);
                beyond = true;
            }
            return !reach.is_exhausted();
        });
        if (!go_on || !beyond) return;
        visited_squared = radius * radius;
        radius *= 2;
        if (!covers_few_cells(region)) radius = std::max(radius, std::sqrt(nearest_beyond));
    }
}

template class LayeredGrid<2>;
template class LayeredGrid<3>;
static_assert(BroadPhase<LayeredGrid<2>, 2> && BroadPhase<LayeredGrid<3>, 3>);

}  // namespace abut
