#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/radix_sort.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace abut {
namespace {

constexpr std::uint32_t empty_key = ~0u;

/// False where a box holds nothing or has a NaN: by arithmetic, where `usable` asks axis by axis.
template <int D>
bool holds(const Aabb<D>& box) {
    std::uint32_t result = 1;
    for (int i = 0; i < D; ++i) {
        ABUT_ASSERT(!std::isnan(box.min[i]) && !std::isnan(box.max[i]));
        result &= static_cast<std::uint32_t>(box.min[i] <= box.max[i]);
    }
    return result != 0;
}

/// Where the box begins, as a whole number of the same order; of an empty box more than of any other.
template <int D>
std::uint32_t key_of(const Aabb<D>& box, int axis) {
    const auto bits = std::bit_cast<std::uint32_t>(box.min[axis]);
    const std::uint32_t key = bits ^ (static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 31) | 1u << 31);
    return holds(box) ? key : empty_key;
}

constexpr std::size_t most_columns(std::size_t boxes) {
    return boxes / 16 + 1;
}
constexpr std::size_t most_copies(std::size_t boxes) {
    return boxes + boxes / 2;
}

}  // namespace

template <int D>
void SweepAndPrune<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 30);
    size_ = boxes.size();
    order_.resize(size_);
    scratch_.resize(size_);
    columns_.reserve(2 * most_columns(size_) + 2);
    rows_.reserve(most_copies(size_) + most_columns(size_));
    place_by_new_plan(boxes);
}

template <int D>
void SweepAndPrune<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() == size_);
    if (boxes.size() != size_) return build(boxes);
    if (!sort_again(boxes)) sort_anew(boxes);
    place(boxes);
    if (cost() > 1.3 * built_cost_) place_by_new_plan(boxes);
}

template <int D>
void SweepAndPrune<D>::place_by_new_plan(std::span<const Aabb<D>> boxes) {
    plan_ = plan_sweep(boxes, most_columns(size_), 1.4);
    sort_anew(boxes);
    place(boxes);
    built_cost_ = cost();
}

/// From the last order, where few boxes have overtaken others since. False where it is not worth the while.
template <int D>
bool SweepAndPrune<D>::sort_again(std::span<const Aabb<D>> boxes) {
    const auto key_at = [&](std::size_t i) { return key_of(boxes[order_[i].item], plan_.axis); };
    const std::size_t step = size_ / 256 + 1;
    std::size_t looks = 0, wrong = 0;
    for (std::size_t i = 1; i < size_; i += step, ++looks) wrong += key_at(i) < key_at(i - 1) ? 1 : 0;
    if (8 * wrong > looks) return false;

    const auto before = [](const Place& a, const Place& b) { return a.key != b.key ? a.key < b.key : a.item < b.item; };
    for (std::size_t i = 0; i < size_; ++i) order_[i].key = key_at(i);
    std::size_t moves_left = 2 * size_;
    for (std::size_t i = 1; i < size_; ++i) {
        const Place moved = order_[i];
        std::size_t k = i;
        for (; k > 0 && before(moved, order_[k - 1]); --k) {
            order_[k] = order_[k - 1];
            if (moves_left-- == 0) {
                order_[k - 1] = moved;
                return false;
            }
        }
        order_[k] = moved;
    }
    while (filled_ < size_ && order_[filled_].key != empty_key) ++filled_;
    while (filled_ > 0 && order_[filled_ - 1].key == empty_key) --filled_;
    return true;
}

template <int D>
void SweepAndPrune<D>::sort_anew(std::span<const Aabb<D>> boxes) {
    filled_ = 0;
    for (std::size_t i = 0; i < size_; ++i) {
        const std::uint32_t key = key_of(boxes[i], plan_.axis);
        filled_ += key != empty_key ? 1 : 0;
        order_[i] = {key, static_cast<std::uint32_t>(i)};
    }
    const Place* sorted = radix_sort(order_.data(), scratch_.data(), size_, 32, [](const Place& p) { return p.key; });
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
    bounds_ = turned_back<D>(rows_.bounds(), plan_.axis);
}

template <int D>
template <int axis>
void SweepAndPrune<D>::place_along(std::span<const Aabb<D>> boxes) {
    // What is large may be in more columns than there is room for.
    while (count_copies<axis>(boxes) > most_copies(size_)) {
        Parts& most = *std::max_element(plan_.parts.begin(), plan_.parts.end(),
                                        [](const Parts& a, const Parts& b) { return a.count < b.count; });
        most = Parts(most.count / 2, most.low, most.high);
    }
    copy_items();
    copy_boxes<axis>(boxes);
}

/// Sets where each column begins, and in scratch_, which are those of each item. Returns how many boxes they hold
/// together, or some number above most_copies.
template <int D>
template <int axis>
std::size_t SweepAndPrune<D>::count_copies(std::span<const Aabb<D>> boxes) {
    const std::uint32_t count = plan_.columns(), row = plan_.row();
    columns_.assign(count + row + 2, 0);
    std::size_t copies = 0;
    for (std::size_t item = 0; item < size_; ++item) {
        if (!holds(boxes[item])) continue;
        const ColumnSpan span = plan_.span(turned<D>(boxes[item], axis));
        scratch_[item] = {span.first, span.packed()};
        copies += std::size_t{span.more_rows + 1} * (span.more + 1);
        if (span.more_rows <= 1 && span.more <= 1) {
            // Added without asking: which of them it is nobody can guess.
            std::uint32_t* column = columns_.data() + span.first;
            column[0] += 1;
            column[1] += span.more;
            column[row] += span.more_rows;
            column[row + 1] += span.more_rows & span.more;
        } else if (copies <= most_copies(size_)) {
            span.each(row, [&](std::uint32_t column, std::uint32_t) { ++columns_[column]; });
        } else {
            return copies;
        }
    }
    columns_.resize(count);
    std::uint32_t begin = 0;
    for (std::uint32_t& column : columns_) begin += std::exchange(column, begin) + 1;
    return copies;
}

/// After this, columns_ are where each column ends.
template <int D>
void SweepAndPrune<D>::copy_items() {
    const std::uint32_t row = plan_.row();
    for (std::size_t i = 0; i < filled_; ++i) {
        const std::uint32_t item = order_[i].item;
        const ColumnSpan span(scratch_[item].key, scratch_[item].item);
        span.each(row, [&](std::uint32_t column, std::uint32_t began_before) {
            rows_.set_item(columns_[column]++, item | began_before);
        });
    }
}

template <int D>
template <int axis>
void SweepAndPrune<D>::copy_boxes(std::span<const Aabb<D>> boxes) {
    std::uint32_t i = 0;
    for (const std::uint32_t end : columns_) {
        for (; i < end; ++i) rows_.set_box(i, turned<D>(boxes[rows_.items()[i] & ~copy_bits], axis));
        rows_.end_column(i++);
    }
    rows_.make_blocks(size_ == 0 ? 0 : i);
}

/// By what a few of the boxes would be compared with.
template <int D>
double SweepAndPrune<D>::cost() const {
    const std::size_t count = rows_.count(), step = std::max<std::size_t>(64, count / 512);
    const BoxSoaView<D> boxes = rows_.boxes();
    std::size_t looks = 0, comparisons = 0;
    for (std::size_t i = step / 2; i < count; i += step, ++looks) {
        const std::size_t end = *std::lower_bound(columns_.begin(), columns_.end(), i);
        if (i == end) continue;
        const float* behind = std::upper_bound(boxes.min[0] + i, boxes.min[0] + end, boxes.max[0][i]);
        comparisons += static_cast<std::size_t>(behind - boxes.min[0]) - i;
    }
    if (looks == 0) return 0;
    const double copies = static_cast<double>(count) / static_cast<double>(size_);
    return sweep_cost(copies, copies * static_cast<double>(comparisons) / static_cast<double>(looks));
}

template class SweepAndPrune<2>;
template class SweepAndPrune<3>;
static_assert(BroadPhase<SweepAndPrune<2>, 2> && BroadPhase<SweepAndPrune<3>, 3>);

}  // namespace abut
