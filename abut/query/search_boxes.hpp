#pragma once

// Branch and bound over boxes, as the searches of least_distance.hpp share it. For .cpp files.

#include <abut/convex/gjk/gjk.hpp>
#include <abut/query/core_simplices.hpp>
#include <abut/query/least_distance.hpp>

namespace abut {

/// Where a function tells nothing of itself but its slope, it is taken to be about as it is in the middle and at the
/// sides of a piece that is this part of what it is asked about; and none smaller than the least is looked at.
inline constexpr double guessed_piece = 1.0 / 8, least_guessed_piece = 1e-3;

/// What is guessed is worth looking at where it is less by this part of the size.
inline constexpr double guess_tolerance = 1e-4;

/// The bound on steps down from one place, and on halvings of one of them.
inline constexpr int search_most_steps_down = 24, search_most_halvings = 10;

/// The bound on ways down, each of which costs as much as many boxes.
inline constexpr int search_most_ways_down = 32;

/// The bounds on looks along a step down, and along a line on which a lower bound grows.
inline constexpr int search_most_turns = 8, search_most_secants = 4;

/// Boxes that are still to be looked at, the last first: each leaves no more than one behind, and none is cut in two
/// more often than there is room for.
template <int D>
class SearchStack {
public:
    bool empty() const { return count_ == 0; }
    bool full() const { return count_ + 2 > boxes_.size(); }
    void push(const SearchBox<D>& box) { boxes_[count_++] = box; }
    SearchBox<D> pop() { return boxes_[--count_]; }
    double least() const {
        double result = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count_; ++i) result = std::min(result, boxes_[i].least);
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

/// The farthest a point of a box is from another.
template <int D>
double farthest(const DVec<D>& from, const SearchBox<D>& box) {
    double squares = 0;
    for (int i = 0; i < D; ++i) {
        const double way = std::abs(box.center[i] - from[i]) + box.half[i];
        squares += way * way;
    }
    return std::sqrt(squares);
}

/// Looks at boxes until there are none left. `Search` tells of one box what it holds at least, and finds places.
template <int D, class Search>
void look_at_boxes(Search& search, const SearchBox<D>& all, const LeastOptions<D>& options) {
    SearchStack<D> stack;
    Least<D>& best = search.best;
    const auto wanted = [&](double least) {
        return least < best.distance - options.tolerance && least <= options.reach;
    };
    stack.push(all);
    while (!stack.empty() && best.distance > options.enough) {
        SearchBox<D> box = stack.pop();
        if (!wanted(box.least)) continue;
        if (best.boxes == options.most_boxes || stack.full()) {
            best.doubt = std::max(0.0, best.distance - std::min(box.least, stack.least()));
            return;
        }
        ++best.boxes;
        bool is_piece = false;
        box.least = std::max(box.least, search.least_in(box, is_piece));
        if (is_piece || !wanted(box.least)) continue;
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

/// As small as the details that are looked for, where the function can't tell what it is at least: a field outside of
/// its samples.
template <int D>
double piece_of(const FunctionThere<D>& function, double size) {
    const bool fine = function.resolution() > 0 && function.function().bound == nullptr;
    return fine ? function.resolution() : guessed_piece * size;
}

template <int D>
LeastOptions<D> bounded(LeastOptions<D> options, bool tells) {
    if (options.most_boxes == 0) options.most_boxes = tells ? least_distance_most_boxes : least_distance_most_guesses;
    return options;
}

/// The point of a convex shape's core that is nearest to a point, by GJK.
template <int D>
DVec<D> nearest_in_core(const Convex<D>& convex, const DVec<D>& point) {
    Convex<D> as_set;
    as_set.place.offset = point;
    const CoreDifference<D> difference(convex, as_set);
    const GjkResult<D> walk = gjk(difference);
    if (walk.exit == GjkExit::overlapping || walk.exit == GjkExit::touching) return point;
    return difference.origin() + walk.simplex.combine(&DifferencePoint<D>::on_a);
}

}  // namespace abut
