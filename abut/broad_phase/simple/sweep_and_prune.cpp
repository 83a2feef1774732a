// Sweep and prune along one axis, in columns along the others.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/detail/radix_sort.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace abut {

using namespace detail;

namespace {

constexpr std::size_t fan = detail::box_lanes;

/// A stored item has one of these bits for each axis on which its box began before the column of this copy.
constexpr std::uint32_t copy_bits = 3u << 30;

constexpr std::size_t whole_blocks(std::size_t count) {
    return (count + fan - 1) / fan;
}

/// An estimate of the time a box takes, in nanoseconds, for its copies in columns and its comparisons. Fitted to
/// measurements of moving boxes.
double sweep_cost(double copies, double comparisons) {
    return 16 * copies + 0.3 * comparisons;
}

/// Equal parts; a single one if the count is too large for the range.
detail::Parts parts_of(std::uint32_t count, float low, float high) {
    const float scale = static_cast<float>(count) / (high - low);
    return count <= 1u << 16 && high > low && std::isfinite(scale) ? detail::Parts{count, low, high, scale}
                                                                   : detail::Parts{};
}

constexpr std::size_t max_sample = 1024, max_overlaps = 4096;

/// Part of the boxes, and an estimate of the cost of a plan.
template <int D>
class Sample {
public:
    /// About sqrt(2 n) boxes, because they have n pairs.
    explicit Sample(std::span<const Aabb<D>> boxes) : others_(0.5 * static_cast<double>(boxes.size())) {
        std::size_t wanted = 32;
        while (wanted < max_sample && wanted * wanted < 2 * boxes.size()) wanted += wanted / 4;
        wanted = std::min({wanted, boxes.size(), max_sample});
        for (std::uint64_t i = 0; i < wanted; ++i) {
            // At a pseudorandom place in each stretch of the boxes.
            const std::uint64_t begin = boxes.size() * i / wanted, end = boxes.size() * (i + 1) / wanted;
            const Aabb<D> box = usable(boxes[begin + ((i * 0x9E3779B97F4A7C15u) >> 32) % (end - begin)]);
            if (!is_empty(box)) boxes_[count_++] = box;
        }
    }

    /// The axis on which the fewest pairs overlap.
    int best_axis() const {
        std::array<std::size_t, D> overlapping{};
        for (std::size_t axis = 0; axis < D; ++axis)
            for (std::size_t i = 0; i < count_; ++i)
                for (std::size_t k = 0; k < i; ++k)
                    overlapping[axis] += overlap_on(static_cast<int>(axis), boxes_[i], boxes_[k]) ? 1 : 0;
        return static_cast<int>(std::min_element(overlapping.begin(), overlapping.end()) - overlapping.begin());
    }

    /// Turns the boxes, and collects intersections of some pairs that overlap on axis 0 then.
    void turn(int axis) {
        for (std::size_t i = 0; i < count_; ++i) boxes_[i] = detail::turned<D>(boxes_[i], axis);
        for (std::size_t step = 1; step < count_ && overlap_count_ < max_overlaps; ++step)
            for (std::size_t i = step; i < count_ && overlap_count_ < max_overlaps; ++i, ++tested_) {
                const Aabb<D>&a = boxes_[i - step], &b = boxes_[i];
                if (overlap_on(0, a, b)) overlaps_[overlap_count_++] = {glm::max(a.min, b.min), glm::min(a.max, b.max)};
            }
    }

    /// The mean number of columns that a box is in.
    double copies(const detail::SweepPlan<D>& plan) const {
        return count_ == 0 ? 0 : columns_of(plan, {boxes_.data(), count_}) / static_cast<double>(count_);
    }
    /// The mean number of comparisons of a box.
    double comparisons(const detail::SweepPlan<D>& plan) const {
        const double columns = columns_of(plan, {overlaps_.data(), overlap_count_});
        return tested_ == 0 ? 0 : others_ * columns / static_cast<double>(tested_);
    }

    /// The range of the lower bounds without a 32nd of the boxes at either end, on an axis as turned.
    detail::Parts range(int axis) const {
        if (count_ == 0) return {};
        std::array<float, max_sample> places;
        for (std::size_t i = 0; i < count_; ++i) places[i] = std::clamp(boxes_[i].min[axis], -1e37f, 1e37f);
        std::sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count_));
        return {1, places[count_ / 32], places[count_ - 1 - count_ / 32]};
    }

private:
    static bool overlap_on(int axis, const Aabb<D>& a, const Aabb<D>& b) {
        // Without a branch, because no predictor could guess it.
        return (static_cast<int>(a.min[axis] <= b.max[axis]) & static_cast<int>(b.min[axis] <= a.max[axis])) != 0;
    }
    /// The sum over boxes, or over intersections of boxes, which may be empty on the other axes.
    static double columns_of(const detail::SweepPlan<D>& plan, std::span<const Aabb<D>> boxes) {
        std::uint64_t sum = 0;
        for (const Aabb<D>& box : boxes) {
            std::uint32_t columns = 1;
            for (int k = 1; k < D; ++k) {
                const detail::Parts& parts = plan.parts[static_cast<std::size_t>(k - 1)];
                const std::uint32_t first = parts.at(box.min[k]), end = parts.at(box.max[k]) + 1;
                columns *= end - std::min(first, end);
            }
            sum += columns;
        }
        return static_cast<double>(sum);
    }

    std::size_t count_ = 0, overlap_count_ = 0, tested_ = 0;
    double others_;
    std::array<Aabb<D>, max_sample> boxes_;
    std::array<Aabb<D>, max_overlaps> overlaps_;
};

/// Chooses by a sample of the boxes, with at most `max_columns` and an estimate of at most 1.4 copies a box.
template <int D>
detail::SweepPlan<D> plan_sweep(std::span<const Aabb<D>> boxes, std::uint32_t max_columns) {
    Sample<D> sample(boxes);
    detail::SweepPlan<D> best;
    best.axis = sample.best_axis();
    sample.turn(best.axis);
    double least = sweep_cost(1, sample.comparisons(best));
    // Stops if columns that copy a tenth of the boxes could not pay even without any comparison.
    if (least < sweep_cost(1.1, 0)) return best;
    for (int k = 1; k < D; ++k) best.parts[static_cast<std::size_t>(k - 1)] = sample.range(k);
    // Doubles the columns along the axis where that saves most, as long as it saves anything.
    for (bool better = true; better;) {
        better = false;
        const detail::SweepPlan<D> last = best;
        for (std::size_t k = 0; k < D - 1; ++k) {
            detail::SweepPlan<D> next = last;
            next.parts[k] = parts_of(2 * last.parts[k].count, last.parts[k].low, last.parts[k].high);
            const double copies = sample.copies(next);
            if (next.columns() <= last.columns() || next.columns() > max_columns || copies > 1.4) continue;
            const double cost = sweep_cost(copies, sample.comparisons(next));
            if (cost >= least) continue;
            least = cost;
            best = next;
            better = true;
        }
    }
    return best;
}

/// visit(column, the copy bits of a box there)
template <class F>
void each_column(const detail::ColumnSpan& span, std::uint32_t row, F&& visit) {
    for (std::uint32_t i = 0; i <= span.more_rows; ++i)
        for (std::uint32_t k = 0; k <= span.more; ++k)
            visit(span.first + i * row + k, (k > 0 ? 1u << 30 : 0u) | (i > 0 ? 1u << 31 : 0u));
}

/// Adds the pairs of which this is the first column: in any other, both boxes began before it on some axis. Returns
/// false as soon as the visitor does.
bool add_hits(std::span<const detail::BoxOverlaps> hits, const std::uint32_t* items, detail::PairBuffer& pairs) {
    for (const detail::BoxOverlaps& hit : hits)
        for (std::uint32_t bits = hit.bits; bits != 0; bits &= bits - 1) {
            const std::uint32_t item = items[hit.box];
            const std::uint32_t other = items[hit.first + static_cast<std::uint32_t>(std::countr_zero(bits))];
            if ((item & other & copy_bits) == 0 && !pairs.add_sorted(item & ~copy_bits, other & ~copy_bits))
                return false;
        }
    return true;
}

}  // namespace

template <int D>
void SweepAndPrune<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 30);
    size_ = boxes.size();
    order_.resize(size_);
    scratch_.resize(size_);
    spans_.resize(size_);
    columns_.reserve(2 * max_columns(size_) + 2);
    const std::size_t rows = max_copies(size_) + max_columns(size_);
    boxes_.reserve(rows + fan);
    items_.resize(std::max(items_.size(), rows + fan));
    tree_.reserve(rows / 15 + 18 * levels_.size());  // each level has a 16th of the one below, in whole blocks
    plan_anew(boxes);
}

template <int D>
void SweepAndPrune<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size_);
    if (boxes.size() != size_) return build(boxes);
    sort(boxes);
    place(boxes);
    if (cost() > 1.3 * planned_cost_) plan_anew(boxes);
}

template <int D>
void SweepAndPrune<D>::plan_anew(std::span<const Aabb<D>> boxes) {
    plan_ = plan_sweep(boxes, max_columns(size_));
    sort(boxes);
    place(boxes);
    planned_cost_ = cost();
}

template <int D>
void SweepAndPrune<D>::sort(std::span<const Aabb<D>> boxes) {
    filled_ = 0;
    for (std::uint32_t i = 0; i < size_; ++i)
        if (const Aabb<D> box = usable(boxes[i]); !is_empty(box)) order_[filled_++] = {key_of(box.min[plan_.axis]), i};
    const Place* sorted =
        detail::radix_sort(order_.data(), scratch_.data(), filled_, 32, [](const Place& p) { return p.key; });
    if (sorted != order_.data()) order_.swap(scratch_);
}

template <int D>
void SweepAndPrune<D>::place(std::span<const Aabb<D>> boxes) {
    if (plan_.axis == 0)
        place_along<0>(boxes);
    else if (plan_.axis == 1)
        place_along<1>(boxes);
    else
        place_along<D - 1>(boxes);
    build_tree();
}

/// Copies the boxes into their columns, in their order.
template <int D>
template <int axis>
void SweepAndPrune<D>::place_along(std::span<const Aabb<D>> boxes) {
    // Large boxes may have more copies than there is capacity for.
    while (count_copies<axis>(boxes) > max_copies(size_)) {
        detail::Parts& most =
            *std::max_element(plan_.parts.begin(), plan_.parts.end(),
                              [](const detail::Parts& a, const detail::Parts& b) { return a.count < b.count; });
        most = parts_of(most.count / 2, most.low, most.high);
    }
    for (std::size_t i = 0; i < filled_; ++i) {
        const std::uint32_t item = order_[i].item;
        each_column(spans_[item], plan_.row(),
                    [&](std::uint32_t column, std::uint32_t bits) { items_[columns_[column]++] = item | bits; });
    }
    std::uint32_t i = 0;
    for (const std::uint32_t end : columns_) {
        for (; i < end; ++i) boxes_.set(i, detail::turned<D>(boxes[items_[i] & ~copy_bits], axis));
        end_column(i++);
    }
    count_ = size_ == 0 ? 0 : i;
}

/// Finds the columns of each box, and where each column begins. Returns the number of copies, or some number above
/// max_copies.
template <int D>
template <int axis>
std::size_t SweepAndPrune<D>::count_copies(std::span<const Aabb<D>> boxes) {
    const std::uint32_t count = plan_.columns(), row = plan_.row();
    columns_.assign(count + row + 2, 0);
    std::size_t copies = 0;
    for (std::size_t item = 0; item < size_ && copies <= max_copies(size_); ++item) {
        if (is_empty(usable(boxes[item]))) continue;
        const detail::ColumnSpan span = plan_.span(detail::turned<D>(boxes[item], axis));
        spans_[item] = span;
        copies += (std::size_t{span.more_rows} + 1) * (std::size_t{span.more} + 1);
        if (span.more_rows <= 1 && span.more <= 1) {
            // Without a branch, because no predictor could guess it.
            std::uint32_t* column = columns_.data() + span.first;
            column[0] += 1;
            column[1] += span.more;
            column[row] += span.more_rows;
            column[row + 1] += static_cast<std::uint32_t>(span.more_rows & span.more);
        } else if (copies <= max_copies(size_)) {
            each_column(span, row, [&](std::uint32_t column, std::uint32_t) { ++columns_[column]; });
        }
    }
    columns_.resize(count);
    std::uint32_t begin = 0;
    for (std::uint32_t& column : columns_) begin += std::exchange(column, begin) + 1;
    return copies;
}

template <int D>
void SweepAndPrune<D>::end_column(std::size_t i) {
    items_[i] = ~0u;
    boxes_.set(i, detail::nan_box<D>());
}

/// Level 0 of the tree has the common boxes of 16 boxes each, of those that begin in their column. The next level has
/// those of 16 of level 0, and so on up to a level of 16 or fewer.
template <int D>
void SweepAndPrune<D>::build_tree() {
    level_count_ = 0;
    bounds_ = Aabb<D>::empty();
    if (count_ == 0) return;
    std::size_t begin = 0, blocks = whole_blocks(count_);
    for (std::size_t i = count_; i < blocks * fan; ++i) end_column(i);
    block_bounds(boxes_.view(), items_.data(), copy_bits, blocks, 0, tree_);
    for (;;) {
        const std::size_t end = begin + whole_blocks(blocks) * fan;
        for (std::size_t i = begin + blocks; i < end; ++i) tree_.set(i, detail::nan_box<D>());
        levels_[++level_count_] = end;
        if (blocks <= fan) break;
        blocks = whole_blocks(blocks);
        block_bounds(tree_.view(begin), items_.data(), 0, blocks, end, tree_);
        begin = end;
    }
    for (std::size_t i = begin; i < levels_[level_count_]; ++i)
        if (const Aabb<D> box = tree_.view()[i]; !is_empty(box)) bounds_ = merged(bounds_, box);
    bounds_ = detail::turned_back<D>(bounds_, plan_.axis);
}

/// Estimates the time for pairs by the comparisons of some boxes.
template <int D>
double SweepAndPrune<D>::cost() const {
    const std::size_t step = std::max<std::size_t>(64, count_ / 512);
    const detail::BoxSoaView<D> boxes = boxes_.view();
    std::size_t tested = 0, comparisons = 0;
    for (std::size_t i = step / 2; i < count_; i += step, ++tested) {
        const std::size_t end = *std::lower_bound(columns_.begin(), columns_.end(), i);
        if (i == end) continue;
        const float* behind = std::upper_bound(boxes.min[0] + i, boxes.min[0] + end, boxes.max[0][i]);
        comparisons += static_cast<std::size_t>(behind - boxes.min[0]) - i;
    }
    if (tested == 0) return 0;
    const double copies = static_cast<double>(count_) / static_cast<double>(size_);
    return sweep_cost(copies, copies * static_cast<double>(comparisons) / static_cast<double>(tested));
}

template <int D>
void SweepAndPrune<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto add_pairs = [&](std::size_t begin, std::size_t end, detail::PairBuffer& pairs) {
        bool go_on = true;
        const auto add = [&](auto hits) { return go_on = add_hits(hits, items_.data(), pairs); };
        each_sorted_overlap(boxes_.view(), begin, end, add);
        return go_on;
    };
    detail::report_ranges(executor, count_, 1024, visit, add_pairs);
}

template <int D>
void SweepAndPrune<D>::visit_pairs(const SweepAndPrune& other, PairsCall visit) const {
    detail::report_between(*this, other, visit);
}

template <int D>
void SweepAndPrune<D>::visit_boxes(BoxCall<D> visit) const {
    for (std::size_t i = 0; i < count_; ++i)
        if ((items_[i] & copy_bits) == 0 && !visit(items_[i], detail::turned_back<D>(boxes_.view()[i], plan_.axis)))
            return;
}

template <int D>
void SweepAndPrune<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (level_count_ > 0 && !is_empty(query))
        visit_overlapping_below(level_count_, 0, detail::turned<D>(query, plan_.axis), visit);
}

/// Searches 16 neighbours, at level 0 boxes and above that nodes of the tree. Returns false as soon as the visitor
/// does.
template <int D>
bool SweepAndPrune<D>::visit_overlapping_below(std::size_t level, std::size_t first, const Aabb<D>& box,
                                               ItemCall visit) const {
    const detail::BoxSoaView<D> rows = level == 0 ? boxes_.view() : tree_.view(levels_[level - 1]);
    for (auto bits = overlap_bits(rows, first, fan, box); bits != 0; bits &= bits - 1) {
        const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
        if (level > 0 ? !visit_overlapping_below(level - 1, i * fan, box, visit)
                      : (items_[i] & copy_bits) == 0 && !visit(items_[i]))
            return false;
    }
    return true;
}

template <int D>
void SweepAndPrune<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    const auto turn = [axis = plan_.axis](const DVec<D>& v) { return detail::turned<D>(v, axis); };
    visit_within(RayReach<D>::of_box({turn(box.center), turn(box.half), turn(box.direction), box.length}), visit);
}

template <int D>
void SweepAndPrune<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(BoxReach<D>(detail::turned<D>(box, plan_.axis), reach), visit);
}

template <int D>
template <class Reach>
void SweepAndPrune<D>::visit_within(Reach reach, ReachCall visit) const {
    if (level_count_ > 0 && !reach.is_exhausted()) visit_within_below(level_count_, 0, reach, visit);
}

/// Searches 16 neighbours, at level 0 boxes and above that nodes of the tree, the nearest first.
template <int D>
template <class Reach>
void SweepAndPrune<D>::visit_within_below(std::size_t level, std::size_t first, Reach& reach, ReachCall visit) const {
    const detail::BoxSoaView<D> rows = level == 0 ? boxes_.view() : tree_.view(levels_[level - 1]);
    std::array<std::pair<double, std::size_t>, fan> found;
    std::size_t count = 0;
    for (std::size_t i = first; i < first + fan; ++i) {
        if (level == 0 && (items_[i] & copy_bits) != 0) continue;
        const Aabb<D> box = rows[i];
        double distance = 0;
        if (!is_empty(box) && reach.measure(box, distance)) found[count++] = {distance, i};
    }
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count && !reach.is_exhausted() && reach.within(found[k].first); ++k) {
        if (level == 0)
            reach.shrink(visit(items_[found[k].second]));
        else
            visit_within_below(level - 1, found[k].second * fan, reach, visit);
    }
}

template class SweepAndPrune<2>;
template class SweepAndPrune<3>;
static_assert(BroadPhase<SweepAndPrune<2>, 2> && BroadPhase<SweepAndPrune<3>, 3>);

}  // namespace abut
