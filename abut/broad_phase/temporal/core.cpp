// Between two moments t apart a face moves by at most v t (1 + 1e-6), and then two ulp for rounding its coordinate to a
// float. The arithmetic is in float as well; the bounds allow for four times the former and twice the latter.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/temporal/core.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/lanes-inl.h>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace abut::detail {
namespace {

using lanes::Floats4;

constexpr float unbounded = std::numeric_limits<float>::infinity();
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double largest_time = std::numeric_limits<float>::max();
/// Twice two ulp of the largest coordinate that a face may have after it has moved by `travel`.
template <int D>
float tolerance_of(const Aabb<D>& box, double travel) {
    float largest = 0;
    for (int i = 0; i < D; ++i)
        for (const float x : {std::abs(box.min[i]), std::abs(box.max[i])})
            if (x < unbounded) largest = std::max(largest, x);
    return 0x1p-21f * (largest + static_cast<float>(travel));
}

/// Each axis has two gaps between opposite faces, below zero where the boxes overlap. The widest gap is the last to
/// close, and the first to open. It is infinite if a box is empty or has a NaN.
template <int D>
float widest_gap(const Aabb<D>& a, const Aabb<D>& b) {
    float result = -unbounded;
    bool is_valid = true;
    for (int i = 0; i < D; ++i) {
        is_valid = is_valid && a.min[i] <= a.max[i] && b.min[i] <= b.max[i];
        // The gap between faces at infinity is NaN and never changes: `max` ignores a second operand that is NaN.
        result = std::max(std::max(result, a.min[i] - b.max[i]), b.min[i] - a.max[i]);
    }
    return is_valid ? result : unbounded;
}

/// The mean edge, or about the distance to a neighbour, whichever is larger. Ignores huge boxes.
template <int D>
double spacing_of(std::span<const Aabb<D>> boxes) {
    const Aabb<D> near{Vec<D>(-1e18f), Vec<D>(1e18f)};
    double edges = 0, count = 0;
    Aabb<D> bounds = Aabb<D>::empty();
    for (const Aabb<D>& given : boxes) {
        const Aabb<D> box = usable(given);
        if (!contains(near, box)) continue;
        bounds = merged(bounds, box);
        for (int i = 0; i < D; ++i) edges += static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
        ++count;
    }
    if (count == 0) return 0;
    double volume = 1 / count;
    for (int i = 0; i < D; ++i) volume *= static_cast<double>(bounds.max[i]) - static_cast<double>(bounds.min[i]);
    // A power of two approximates the root well enough.
    int exponent = 0;
    std::frexp(volume, &exponent);
    return std::max(edges / (D * count), volume > 0 ? std::ldexp(0.5, exponent / D) : 0);
}

/// Of those that move and have a limit; 0 if none does.
double mean_speed(std::span<const float> speeds) {
    double sum = 0, count = 0;
    for (const float speed : speeds) {
        if (!(speed > 0 && speed < unbounded)) continue;
        sum += static_cast<double>(speed);
        ++count;
    }
    return sum / std::max(count, 1.0);
}

float usable_speed(float speed) {
    ABUT_ASSERT(speed >= 0);
    return speed >= 0 ? speed : unbounded;
}

/// Returns the pairs of a block that are due, one bit each, and leaves the earliest of the others in `next_due`.
std::uint64_t take_due(PairBlock& block, float now) {
    const Floats4 never = PairBlock::never;
    Floats4 earliest = never;
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < PairBlock::capacity; i += 4) {
        const Floats4 due = lanes::at(&block.due[i]);
        const lanes::Mask4 is_due = due <= now;
        result |= std::uint64_t{lanes::bits(is_due)} << i;
        earliest = lanes::lesser(earliest, lanes::select(is_due, never, due));
    }
    block.next_due = lanes::least_lane(earliest);
    return result;
}

std::size_t lowest_bit(std::uint64_t bits) {
    return static_cast<std::size_t>(std::countr_zero(bits));
}

}  // namespace

template <int D>
void TemporalCore<D>::build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds) {
    enter_library();
    ABUT_ASSERT(boxes.size() == top_speeds.size());
    wanted_.assign(top_speeds.begin(), top_speeds.end());
    wanted_.resize(boxes.size(), unbounded);
    for (float& speed : wanted_) speed = usable_speed(speed);
    items_.assign(boxes.size(), {Aabb<D>::empty(), unbounded, 0});
    counts_ = {};
    window_ = {};
    spacing_ = spacing_of(boxes);
    grow_slow(boxes);
}

template <int D>
void TemporalCore<D>::update(std::span<const Aabb<D>> boxes, double time) {
    enter_library();
    ABUT_ASSERT(boxes.size() == size() && time >= 0);
    if (boxes.size() != size()) return build(boxes, std::vector<float>(boxes.size(), unbounded));
    ++counts_.updates;
    counts_.plain_searches += size();
    for (const PairBlock& block : blocks_) counts_.plain_looks += block.count;
    blocks_.resize(slow_blocks_);
    // The clock rounds up, so that the time is never too short.
    const double later = (static_cast<double>(now_) + (time >= 0 ? time : endless)) * (1 + 0x1p-23);
    now_ = static_cast<float>(std::min(later, largest_time));
    waited_ += left_count_;
    slow_due_ = waited_ > 0 && waited_ >= size();
    if (window_.rests() ? window_.has_rested(counts_.updates) : !(later < end_)) {
        window_.close(counts_, time);
        slow_due_ = true;
    }
    if (slow_due_) grow_slow(boxes);
}

template <int D>
void TemporalCore<D>::set_top_speed(std::uint32_t item, float speed) {
    enter_library();
    ABUT_ASSERT(item < size());
    wanted_[item] = usable_speed(speed);
    if (wanted_[item] > items_[item].speed) leave(item);
}

template <int D>
void TemporalCore<D>::leave(std::uint32_t item) {
    ABUT_ASSERT(item < size());
    if (items_[item].is_fast()) return;
    items_[item].speed = unbounded;
    fast_.push_back(item);
    ++left_count_;
    has_left_ = true;
}

template <int D>
bool TemporalCore<D>::is_too_fast(const Item& item, const Aabb<D>& box) {
    const float limit = item.margin(static_cast<double>(now_));
    bool result = false;
    // Between two faces at infinity there is no number, which is not greater than any.
    for (int i = 0; i < D; ++i)
        result |= std::abs(box.min[i] - item.box.min[i]) > limit || std::abs(box.max[i] - item.box.max[i]) > limit;
    result = result && !item.is_fast();
    ABUT_ASSERT(!result);
    counts_.too_fast += result ? 1 : 0;
    return result;
}

/// An item is slow if it moves by at most the spacing in the time T of the window. The boxes of slow items are grown by
/// how far each may move.
template <int D>
void TemporalCore<D>::grow_slow(std::span<const Aabb<D>> boxes) {
    if (!(window_.length() < endless)) window_.begin(0.15 * spacing_ / mean_speed(wanted_));
    search_boxes_.resize(boxes.size());
    fast_.clear();
    blocks_.clear();
    slow_blocks_ = 0;
    end_ = endless;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Aabb<D> box = usable(boxes[i]);
        is_too_fast(items_[i], box);
        const float speed = wanted_[i];
        const double travel = speed > 0 ? static_cast<double>(speed) * window_.length() : 0;
        const bool is_fast = speed > 0 && (window_.rests() || !(travel <= spacing_));
        items_[i] = {box, is_fast ? unbounded : speed, tolerance_of(box, travel)};
        const float margin = items_[i].margin(window_.length());
        search_boxes_[i] = is_fast ? Aabb<D>::empty() : Aabb<D>{box.min - margin, box.max + margin};
        if (is_fast)
            fast_.push_back(i);
        else if (speed > 0)
            end_ = window_.length();
    }
    now_ = 0;
    left_count_ = waited_ = 0;
    has_left_ = false;
    slow_due_ = true;
    counts_.searches += size() - fast_.size();
}

/// Tests the pairs that a search has just found, and those that are due. A pair is due again after t = |g| / (v + w),
/// unless the next search comes first, or neither box moves. Items that turn out to be too fast leave the slow ones.
template <int D>
void TemporalCore<D>::test_due(std::span<const Aabb<D>> boxes) {
    for (PairBlock& block : blocks_) {
        if (block.next_due > now_) continue;
        for (std::uint64_t bits = take_due(block, now_); bits != 0; bits &= bits - 1) {
            const std::size_t k = lowest_bit(bits);
            const auto& [i, j] = block.pairs[k];
            const Item &first = items_[i], &second = items_[j];
            if (is_too_fast(first, boxes[i])) leave(i);
            if (is_too_fast(second, boxes[j])) leave(j);
            const float gap = widest_gap(boxes[i], boxes[j]);
            const float travel =
                std::max(std::abs(gap) - first.tolerance - second.tolerance, 0.0f) * (1 - temporal_leeway);
            // The sum rounds down, so that the test is never too late.
            const double due =
                (static_cast<double>(now_) + static_cast<double>(travel / (first.speed + second.speed))) *
                (1 - 0x1p-23);
            block.set(k, due < end_ ? static_cast<float>(std::min(due, largest_time)) : PairBlock::never, gap <= 0);
            ++counts_.looks;
        }
    }
    if (has_left_) remove_left();
}

/// Removes the pairs of items that have become fast.
template <int D>
void TemporalCore<D>::remove_left() {
    for (PairBlock& block : blocks_)
        for (std::size_t k = 0; k < block.count; ++k)
            if (items_[block.pairs[k].first].is_fast() || items_[block.pairs[k].second].is_fast())
                block.set(k, PairBlock::never, false);
    has_left_ = false;
}

template <int D>
std::span<const Aabb<D>> TemporalCore<D>::fast_boxes(std::span<const Aabb<D>> boxes) {
    slow_blocks_ = blocks_.size();
    search_boxes_.clear();
    for (const std::uint32_t item : fast_) search_boxes_.push_back(usable(boxes[item]));
    counts_.searches += fast_.size();
    return search_boxes_;
}

template <int D>
void TemporalCore<D>::add_mixed(std::span<const Aabb<D>> boxes, std::uint32_t slow, std::uint32_t fast) {
    ++counts_.looks;
    // A slow item that has left is found among the fast ones.
    if (!items_[slow].is_fast() && overlaps(boxes[slow], boxes[fast_[fast]]))
        add({slow, fast_[fast]}, PairBlock::never, true);
}

template <int D>
void TemporalCore<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    enter_library();
    const auto add_pairs = [&](std::size_t begin, std::size_t end, PairBuffer& out) {
        for (std::size_t k = begin; k < end; ++k)
            for (std::uint64_t bits = blocks_[k].touching; bits != 0; bits &= bits - 1) {
                const ItemPair& pair = blocks_[k].pairs[lowest_bit(bits)];
                if (!out.add(pair.first, pair.second)) return false;
            }
        return true;
    };
    report_ranges(executor, blocks_.size(), 16, visit, add_pairs);
}

template class TemporalCore<2>;
template class TemporalCore<3>;

}  // namespace abut::detail
