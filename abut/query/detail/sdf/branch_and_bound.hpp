#pragma once

// Branch and bound over boxes, shared by the searches of minimum.hpp. For .cpp files.

#include <abut/convex/gjk/gjk.hpp>
#include <abut/query/detail/sdf/core_simplices.hpp>
#include <abut/query/detail/sdf/minimum.hpp>

namespace abut::detail {

/// A function that gives no bounds but its slope is estimated from samples in the centre and at the sides of cells of
/// this fraction of the size, down to the second fraction.
inline constexpr double estimated_cell_fraction = 1.0 / 8, min_estimated_cell_fraction = 1e-3;

/// An estimate counts as lower only by this fraction of the size.
inline constexpr double estimate_tolerance = 1e-4;

/// The limits on steps of one descent, and on halvings of one step.
inline constexpr int search_max_descent_steps = 24, search_max_halvings = 10;

/// The limit on descents, each of which costs as much as many boxes.
inline constexpr int search_max_descents = 32;

/// The limit on evaluations along one line.
inline constexpr int search_max_line_steps = 8;

/// A stack of boxes, the last first: each split leaves one box behind, and the capacity exceeds the number of splits of
/// a box.
template <int D>
class SearchStack {
public:
    bool empty() const { return count_ == 0; }
    bool full() const { return count_ + 2 > boxes_.size(); }
    void push(const SearchBox<D>& box) { boxes_[count_++] = box; }
    SearchBox<D> pop() { return boxes_[--count_]; }
    double lower_bound() const {
        double result = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count_; ++i) result = std::min(result, boxes_[i].lower_bound);
        return result;
    }

private:
    std::array<SearchBox<D>, 160> boxes_;
    std::size_t count_ = 0;
};

template <int D>
int longest_axis(const DVec<D>& half) {
    int result = 0;
    for (int i = 1; i < D; ++i)
        if (half[i] > half[result]) result = i;
    return result;
}

template <int D>
double sum_along(const DVec<D>& gradient, const DVec<D>& half) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += std::abs(gradient[i]) * half[i];
    return result;
}

/// The largest distance from a point to a point of a box.
template <int D>
double farthest(const DVec<D>& from, const SearchBox<D>& box) {
    double squares = 0;
    for (int i = 0; i < D; ++i) {
        const double reach = std::abs(box.center[i] - from[i]) + box.half[i];
        squares += reach * reach;
    }
    return std::sqrt(squares);
}

/// Processes boxes until none is left. `Search` gives the lower bound of a box, and improves the best point.
template <int D, class Search>
void branch_and_bound(Search& search, const SearchBox<D>& all, const MinimumOptions<D>& options) {
    SearchStack<D> stack;
    Minimum<D>& best = search.best;
    const auto may_improve = [&](double lower_bound) {
        return lower_bound < best.distance - options.tolerance && lower_bound <= options.reach;
    };
    stack.push(all);
    while (!stack.empty() && best.distance > options.sufficient) {
        SearchBox<D> box = stack.pop();
        if (!may_improve(box.lower_bound)) continue;
        if (best.boxes == options.max_boxes || stack.full()) {
            best.uncertainty = std::max(0.0, best.distance - std::min(box.lower_bound, stack.lower_bound()));
            return;
        }
        ++best.boxes;
        bool is_smallest = false;
        box.lower_bound = std::max(box.lower_bound, search.lower_bound_in(box, is_smallest));
        if (is_smallest || !may_improve(box.lower_bound)) continue;
        const int axis = longest_axis(box.half);
        box.half[axis] *= 0.5;
        if (!(box.center[axis] + box.half[axis] > box.center[axis])) continue;
        SearchBox<D> low = box, high = box;
        low.center[axis] -= box.half[axis];
        high.center[axis] += box.half[axis];
        const bool low_first = best.point[axis] <= box.center[axis];
        stack.push(low_first ? high : low);
        stack.push(low_first ? low : high);
    }
}

/// The size of the smallest detail, for a function that gives no lower bounds, such as a field outside of its samples.
template <int D>
double estimated_cell_size(const PlacedFunction<D>& function, double size) {
    const bool fine = function.resolution() > 0 && function.function().bound == nullptr;
    return fine ? function.resolution() : estimated_cell_fraction * size;
}

template <int D>
MinimumOptions<D> with_box_limit(MinimumOptions<D> options, bool has_bounds) {
    if (options.max_boxes == 0) options.max_boxes = has_bounds ? max_boxes_with_bounds : max_boxes_without_bounds;
    return options;
}

/// The point of a convex shape's core nearest to a point, by GJK.
template <int D>
DVec<D> nearest_in_core(const Convex<D>& convex, const DVec<D>& point) {
    Convex<D> as_set;
    as_set.place.offset = point;
    const CoreDifference<D> difference(convex, as_set);
    const GjkResult<D> walk = gjk(difference);
    if (walk.exit == GjkExit::overlapping || walk.exit == GjkExit::touching) return point;
    return difference.origin() + walk.simplex.combine(&DifferencePoint<D>::on_a);
}

}  // namespace abut::detail
