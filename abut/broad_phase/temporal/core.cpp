#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/temporal/core.hpp>
#include <abut/broad_phase/temporal/reach-inl.h>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

namespace abut::detail {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();
constexpr double endless = std::numeric_limits<double>::infinity();

float usable_speed(float speed) {
    ABUT_ASSERT(speed >= 0);
    return speed >= 0 ? speed : unbounded;
}

ItemPair sorted_pair(std::uint32_t i, std::uint32_t j) {
    return {std::min(i, j), std::max(i, j)};
}

/// The mean edge, or about the distance to a neighbour, whichever is larger. Ignores huge boxes.
template <int D>
double spacing_of(std::span<const Aabb<D>> boxes) {
    const Aabb<D> near{Vec<D>(-1e18f), Vec<D>(1e18f)};
    double edges = 0, count = 0;
    Aabb<D> bounds = Aabb<D>::empty();
    for (const Aabb<D>& given : boxes) {
        const Aabb<D> box = usable(given);
        if (is_empty(box) || !contains(near, box)) continue;
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
    return count > 0 ? sum / count : 0;
}

/// t = |g| / (v + w), from a time on; `never` if the next search comes first.
template <int D>
TimedPairs::Look look_at(const BoxLanes<D>& a, const BoxLanes<D>& b, float speed, double now, double next_search) {
    const Reach reach = reach_of(a, b);
    const double due = speed > 0 ? now + static_cast<double>(reach.travel / speed) : endless;
    return {due < next_search ? no_later(due) : TimedPairs::never, reach.touching};
}

}  // namespace

template <int D>
void TemporalCore<D>::build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds) {
    enter_library();
    ABUT_ASSERT(boxes.size() == top_speeds.size());
    wanted_.assign(boxes.size(), unbounded);
    const auto given = top_speeds.first(std::min(boxes.size(), top_speeds.size()));
    std::transform(given.begin(), given.end(), wanted_.begin(), usable_speed);
    counts_ = {};
    start(boxes);
}

template <int D>
void TemporalCore<D>::start(std::span<const Aabb<D>> boxes) {
    wanted_.resize(boxes.size(), unbounded);
    items_.assign(boxes.size(), {Aabb<D>::empty(), unbounded, true});
    found_in_.reserve(boxes.size());
    now_ = 0;
    spacing_ = spacing_of(boxes);
    window_.begin(endless);
    slow_due_ = true;
    grow_slow(boxes);
}

template <int D>
void TemporalCore<D>::update(std::span<const Aabb<D>> boxes, double time) {
    enter_library();
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return start(boxes);
    ++counts_.updates;
    counts_.plain_searches += size();
    window_.count_update();
    waited_ += left_count_;
    slow_due_ = waited_ > 0 && waited_ >= static_cast<double>(size());
    advance(time);
    if (window_.rests() ? window_.has_rested() : !(now_ < end_)) {
        window_.close(step_);
        slow_due_ = true;
    }
    if (slow_due_) return grow_slow(boxes);
    remove_left();
    test_due(boxes);
    remove_left();
}

/// Rounds up, so that the elapsed time is never too short. Restarts the time with a search if the sum can no longer
/// distinguish two updates, or if the given time is not a number.
template <int D>
void TemporalCore<D>::advance(double time) {
    ABUT_ASSERT(time >= 0);
    if (time == 0) return;
    now_ = std::nextafter(now_ + time, endless);
    elapsed_ = no_earlier(now_ - start_);
    if (time > 0 && now_ < std::numeric_limits<double>::max() && now_ < 0x1p50 * time) {
        step_ = time;
    } else {
        now_ = 0;
        elapsed_ = unbounded;
        slow_due_ = true;
    }
}

template <int D>
void TemporalCore<D>::set_top_speed(std::uint32_t item, float speed) {
    enter_library();
    ABUT_ASSERT(item < size());
    wanted_[item] = usable_speed(speed);
    if (wanted_[item] > items_[item].speed) leave(item);
}

template <int D>
void TemporalCore<D>::jumped(std::uint32_t item) {
    ABUT_ASSERT(item < size());
    leave(item);
}

/// Makes an item fast until the slow ones are searched next.
template <int D>
void TemporalCore<D>::leave(std::uint32_t item) {
    if (items_[item].is_fast) return;
    items_[item].is_fast = has_left_ = true;
    fast_.push_back(item);
    ++left_count_;
}

template <int D>
void TemporalCore<D>::remove_left() {
    if (has_left_)
        slow_pairs_.retain_if(
            [&](const ItemPair& pair) { return !items_[pair.first].is_fast && !items_[pair.second].is_fast; });
    has_left_ = false;
}

template <int D>
bool TemporalCore<D>::is_too_fast(const Item& item, const BoxLanes<D>& box) {
    const bool too_fast = !item.is_fast && !within_travel(BoxLanes<D>(item.box), box, item.speed * elapsed_);
    ABUT_ASSERT(!too_fast);
    counts_.too_fast += too_fast ? 1 : 0;
    return too_fast;
}

template <int D>
void TemporalCore<D>::test_due(std::span<const Aabb<D>> boxes) {
    const double elapsed = now_ - start_;
    const auto fetch = [&](const ItemPair& pair) {
        for (const std::uint32_t item : {pair.first, pair.second}) {
            hwy::Prefetch(&items_[item]);
            hwy::Prefetch(&boxes[item]);
        }
    };
    const auto look = [&](const ItemPair& pair) {
        const BoxLanes<D> first(boxes[pair.first]), second(boxes[pair.second]);
        if (is_too_fast(items_[pair.first], first)) leave(pair.first);
        if (is_too_fast(items_[pair.second], second)) leave(pair.second);
        const float speed = items_[pair.first].speed + items_[pair.second].speed;
        return look_at(first, second, speed, elapsed, end_ - start_);
    };
    const std::size_t looks = slow_pairs_.test_due(no_earlier(elapsed), fetch, look);
    counts_.looks += looks;
    window_.spend(SearchWindow::look_cost * static_cast<double>(looks));
}

/// An item is slow if it moves by at most the spacing in the time T of the window. The boxes of slow items are grown by
/// how far each may move.
template <int D>
void TemporalCore<D>::grow_slow(std::span<const Aabb<D>> boxes) {
    if (!(window_.length() < endless)) {
        const double speed = mean_speed(wanted_);
        window_.begin(speed > 0 ? 0.15 * spacing_ / speed : endless);
    }
    slow_.clear();
    fast_.clear();
    found_in_.clear();
    slow_pairs_.clear();
    float fastest = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        Item& item = items_[i];
        const Aabb<D> box = usable(boxes[i]);
        is_too_fast(item, BoxLanes<D>(box));
        const float speed = wanted_[i];
        const double travel = speed > 0 ? static_cast<double>(speed) * window_.length() : 0;
        item = {box, speed, speed > 0 && (window_.rests() || !(travel <= spacing_))};
        (item.is_fast ? fast_ : slow_).push_back(i);
        if (item.is_fast) continue;
        fastest = std::max(fastest, speed);
        found_in_.push_back(speed > 0 ? grown_by_travel(box, static_cast<float>(travel)) : box);
    }
    start_ = now_;
    end_ = fastest > 0 ? std::nextafter(now_ + window_.length() * (1 - 1e-6), 0.0) : endless;
    elapsed_ = 0;
    left_count_ = waited_ = 0;
    has_left_ = false;
    counts_.searches += slow_.size();
    window_.spend(SearchWindow::item_cost * static_cast<double>(slow_.size()));
}

template <int D>
void TemporalCore<D>::add_slow(std::uint32_t i, std::uint32_t j) {
    const Item &a = items_[slow_[i]], &b = items_[slow_[j]];
    const TimedPairs::Look look = look_at(BoxLanes<D>(a.box), BoxLanes<D>(b.box), a.speed + b.speed, 0, end_ - start_);
    if (look.due < TimedPairs::never || look.touching) slow_pairs_.add(sorted_pair(slow_[i], slow_[j]), look);
    ++found_;
}

template <int D>
std::span<const Aabb<D>> TemporalCore<D>::fast_boxes(std::span<const Aabb<D>> boxes) {
    found_in_.clear();
    fast_pairs_.clear();
    for (const std::uint32_t item : fast_) found_in_.push_back(usable(boxes[item]));
    counts_.searches += fast_.size();
    window_.spend(SearchWindow::item_cost * static_cast<double>(fast_.size()));
    return found_in_;
}

template <int D>
void TemporalCore<D>::add_fast(std::uint32_t i, std::uint32_t j) {
    fast_pairs_.push_back(sorted_pair(fast_[i], fast_[j]));
    ++found_;
}

template <int D>
void TemporalCore<D>::add_mixed(std::span<const Aabb<D>> boxes, std::uint32_t slow, std::uint32_t fast) {
    const std::uint32_t i = slow_[slow], j = fast_[fast];
    if (items_[i].is_fast) return;  // it has left
    if (overlaps(boxes[i], boxes[j])) fast_pairs_.push_back(sorted_pair(i, j));
    ++found_;
}

template <int D>
void TemporalCore<D>::end_search() {
    const std::size_t held = slow_pairs_.size() + fast_pairs_.size();
    counts_.plain_looks += held;
    counts_.looks += found_;
    window_.spend(SearchWindow::held_cost * static_cast<double>(held) +
                  SearchWindow::pair_cost * static_cast<double>(found_));
    found_ = 0;
}

template <int D>
void TemporalCore<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    enter_library();
    // The blocks of slow pairs, and then as many for the fast ones.
    constexpr std::size_t fast_block = 64;
    const std::size_t blocks = slow_pairs_.blocks(), fast_blocks = (fast_pairs_.size() + fast_block - 1) / fast_block;
    const auto add_pairs = [&](std::size_t begin, std::size_t end, PairBuffer& out) {
        for (std::size_t k = begin; k < std::min(end, blocks); ++k)
            if (!slow_pairs_.add_touching(k, out)) return false;
        for (std::size_t k = std::max(begin, blocks); k < end; ++k)
            for (std::size_t i = (k - blocks) * fast_block;
                 i < std::min((k - blocks + 1) * fast_block, fast_pairs_.size()); ++i)
                if (!out.add(fast_pairs_[i].first, fast_pairs_[i].second)) return false;
        return true;
    };
    report_ranges(executor, blocks + fast_blocks, 16, visit, add_pairs);
}

template class TemporalCore<2>;
template class TemporalCore<3>;

}  // namespace abut::detail
