#pragma once

// Branch and bound over boxes, the most promising first, shared by the searches of minimum.hpp. For .cpp files.

#include <abut/query/detail/sdf/minimum.hpp>

#include <algorithm>

namespace abut::detail {

/// The limits on steps of one descent, on halvings of one step, and on evaluations along one line.
inline constexpr int search_max_descent_steps = 24, search_max_halvings = 10, search_max_line_steps = 8;

/// In boxes bounded by estimates values count as lower only by this fraction of the size.
inline constexpr double estimate_tolerance = 1e-4;

template <int D>
struct SearchBox {
    DVec<D> center, half;
    double lower_bound;  ///< of the function in the box

    static SearchBox between(const DVec<D>& low, const DVec<D>& high) {
        return {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
    }
};

/// The plane that splits a box in two.
struct Cut {
    int axis;  ///< -1: any
    double at;
};

/// A search processes boxes until none is left that may improve the best point. The box with the lowest bound comes
/// first; of equals, the earlier one.
template <int D>
class BoxSearch {
protected:
    explicit BoxSearch(const MinimumOptions<D>& options) : options_(options) {}
    BoxSearch(const BoxSearch&) = delete;
    ~BoxSearch() = default;

    /// Bounds a box, and pushes it if it may improve the best point.
    virtual void process(SearchBox<D> box) = 0;
    /// Whether the rest of the boxes isn't worth the time.
    virtual bool is_enough() const { return false; }

    void run(const SearchBox<D>& all, int max_boxes) {
        if (options_.max_boxes > 0) max_boxes = options_.max_boxes;
        process(all);
        while (count_ > 0 && best_.distance > options_.sufficient && may_improve(entries_[0].box.lower_bound)) {
            if (is_enough() || best_.boxes >= max_boxes) break;
            std::pop_heap(entries_.data(), entries_.data() + count_, is_later);
            const auto [box, cut, number] = entries_[--count_];
            DVec<D> low = box.center - box.half, high = box.center + box.half;
            if (!(low[cut.axis] < cut.at && cut.at < high[cut.axis])) continue;
            for (const bool is_upper : {false, true}) {
                SearchBox<D> half = box;
                const double from = is_upper ? cut.at : low[cut.axis], until = is_upper ? high[cut.axis] : cut.at;
                half.center[cut.axis] = 0.5 * (from + until);
                half.half[cut.axis] = 0.5 * (until - from);
                process(half);
            }
        }
        best_.lower_bound = std::min(lowest_bound(), limit());
        best_.uncertainty = std::max(0.0, best_.distance - lowest_bound());
        if (best_.distance > options_.reach) best_.distance = std::numeric_limits<double>::infinity();
    }

    /// If the queue is full, the box with the highest bound is left out.
    void push(const SearchBox<D>& box, Cut cut) {
        if (cut.axis < 0) cut = {longest_axis(box.half), 0};
        if (!(std::abs(cut.at - box.center[cut.axis]) < (1 - 1e-9) * box.half[cut.axis])) cut.at = box.center[cut.axis];
        const Entry entry{box, cut, number_++};
        std::size_t place = count_;
        if (count_ == entries_.size()) {
            // The last one is in the lower half of the heap.
            const auto last = std::min_element(entries_.begin() + count_ / 2, entries_.end(), is_later);
            left_out_ = std::min(left_out_, std::max(last->box.lower_bound, box.lower_bound));
            if (!is_later(*last, entry)) return;
            place = static_cast<std::size_t>(last - entries_.begin());
        } else {
            ++count_;
        }
        entries_[place] = entry;
        std::push_heap(entries_.data(), entries_.data() + place + 1, is_later);
    }

    bool may_improve(double lower_bound) const {
        return lower_bound < best_.distance - options_.tolerance && lower_bound <= options_.reach;
    }
    /// Boxes of a higher bound can't improve the answer.
    double limit() const { return std::min(best_.distance - options_.tolerance, options_.reach); }
    /// The lowest bound of the boxes that are left.
    double lowest_bound() const { return count_ > 0 ? std::min(entries_[0].box.lower_bound, left_out_) : left_out_; }

    MinimumOptions<D> options_;
    Minimum<D> best_;

private:
    struct Entry {
        SearchBox<D> box;
        Cut cut;
        std::uint32_t number;
    };
    static bool is_later(const Entry& a, const Entry& b) {
        return a.box.lower_bound != b.box.lower_bound ? a.box.lower_bound > b.box.lower_bound : a.number > b.number;
    }

    std::array<Entry, 256> entries_;
    std::size_t count_ = 0;
    std::uint32_t number_ = 0;
    double left_out_ = std::numeric_limits<double>::infinity();  ///< the lowest bound of the boxes left out
};

}  // namespace abut::detail
