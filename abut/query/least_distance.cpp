#include <abut/convex/gjk.hpp>
#include <abut/query/core_simplices.hpp>
#include <abut/query/least_distance.hpp>

#include <array>

namespace abut {
namespace {

/// Where a function tells nothing of itself but its slope, it is taken to be about as it is in the middle and at the
/// sides of a piece that is this part of what it is asked about; and none smaller than the least is looked at.
constexpr double piece = 1.0 / 8, least_piece = 1e-3;

/// What is guessed is worth looking at where it is less by this part of the size.
constexpr double guess_tolerance = 1e-4;

/// The bound on steps down from one place, and on halvings of one of them.
constexpr int most_steps_down = 24, most_halvings = 10;

/// The bound on ways down, each of which costs as much as many boxes.
constexpr int most_ways_down = 32;

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

/// Looks at boxes until there are none left. `Problem` tells of one box what it holds at least, and finds places.
template <int D, class Problem>
void look_at_boxes(Problem& problem, const SearchBox<D>& all, const LeastOptions<D>& options) {
    SearchStack<D> stack;
    Least<D>& best = problem.best;
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
        box.least = std::max(box.least, problem.least_in(box, is_piece));
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

/// Where a point is nearest to in a core.
template <int D>
class NearestInCore {
public:
    explicit NearestInCore(const Convex<D>& convex) : convex_(convex) {
        convex_.radius = 0;
        if (convex.inner_radius > 0) return;
        if (convex.core == Core::points && convex.count <= 2) {
            first_ = convex.place.point(DVec<D>(convex.vertices()[0]));
            way_ = convex.count == 2 ? convex.place.point(DVec<D>(convex.vertices()[1])) - first_ : DVec<D>(0.0);
            kind_ = Kind::segment;
        } else if (is_plain_box(convex)) {
            kind_ = Kind::box;
        }
    }

    DVec<D> nearest(const DVec<D>& point) const {
        if (kind_ == Kind::segment) {
            const double square = length_squared(way_);
            return square > 0 ? first_ + way_ * std::clamp(dot(point - first_, way_) / square, 0.0, 1.0) : first_;
        }
        if (kind_ == Kind::box) {
            const DVec<D> own =
                convex_.place.transposed(point - convex_.place.offset) / (convex_.scale * convex_.scale);
            DVec<D> clamped;
            for (int i = 0; i < D; ++i) {
                const auto half = static_cast<double>(convex_.own[0][i]);
                clamped[i] = std::clamp(own[i], -half, half);
            }
            return clamped == own ? point : convex_.place.point(clamped);
        }
        Convex<D> as_set;
        as_set.place.offset = point;
        const CoreDifference<D> difference(convex_, as_set);
        const GjkResult<D> walk = gjk(difference);
        if (walk.exit == GjkExit::overlapping || walk.exit == GjkExit::touching) return point;
        return difference.origin() + walk.simplex.combine(&DifferencePoint<D>::on_a);
    }

    DVec<D> lowest(const DVec<D>& gradient) const { return core_support(convex_, -gradient).position; }

private:
    enum class Kind : std::uint8_t { any, segment, box };

    Convex<D> convex_;
    Kind kind_ = Kind::any;
    DVec<D> first_, way_;
};

/// As small as the details that are looked for, where the function can't tell what it is at least: a field outside of
/// its samples.
template <int D>
double piece_of(const FunctionThere<D>& function, double size) {
    const bool fine = function.resolution() > 0 && function.function().bound == nullptr;
    return fine ? function.resolution() : piece * size;
}

template <int D>
LeastOptions<D> bounded(LeastOptions<D> options, bool tells) {
    if (options.most_boxes == 0) options.most_boxes = tells ? least_distance_most_boxes : least_distance_most_guesses;
    return options;
}

template <int D>
class InConvex {
public:
    InConvex(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options)
        : function_(function),
          convex_(convex),
          core_(convex),
          options_(bounded(options, function.function().bound != nullptr)) {
        DVec<D> low, high;
        for (int i = 0; i < D; ++i) {
            low[i] = core_support(convex, axis<D>(i, -1)).position[i];
            high[i] = core_support(convex, axis<D>(i, 1)).position[i];
        }
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        piece_ = piece_of(function, size_);
        step_ = function.step(all_.center, size_);
    }

    void run(const DVec<D>& middle_of_function) {
        const DVec<D> first = core_.nearest(all_.center);
        found(first);
        if (size_ == 0) return;
        go_down(first);
        const DVec<D> second = core_.nearest(middle_of_function);
        found(second);
        if (second != first && best.point == second) go_down(second);
        bool is_piece = false;
        all_.least = least_in(all_, is_piece);
        // First roughly, so that what is exact need look at little.
        const double finest = options_.tolerance;
        const int most = options_.most_boxes;
        for (const double rough : {1e-3, 1e-4, 0.0}) {
            const bool is_told = function_.function().bound != nullptr;
            if (rough > 0 && !is_told) continue;
            options_.tolerance = std::max(rough * size_, finest);
            if (!wanted(all_.least, options_.tolerance)) continue;
            if (rough == 0 && is_told) options_.most_boxes = std::min(most, least_distance_most_fine_boxes);
            ways_down_ = 0;
            const int before = best.boxes;
            best.boxes = 0;
            best.doubt = 0;
            if (has_simplices(convex_) && !(is_plain_box(convex_) && is_told))
                each_simplex(convex_, [&](const CoreSimplex<D>& simplex) { look_at(simplex); });
            else
                look_at_boxes(*this, all_, options_);
            best.boxes += before;
        }
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        // Seen from its middle, whether or not that is in the core, most boxes are out of the question.
        const double around = function_.at(box.center) - function_.slope() * length(box.half);
        if (!(around < best.distance - options_.tolerance && around <= options_.reach)) return around;
        const DVec<D> near = core_.nearest(box.center), way = box.center - near;
        const double gap_squared = length_squared(way);
        constexpr double nothing = std::numeric_limits<double>::infinity();
        if (gap_squared > sum_along(way, box.half) * (1 + 1e-12) && gap_squared > 0) return nothing;
        const double here = found(near);
        const double least = std::max(around, here - function_.slope() * farthest(near, box));
        if (!(least < best.distance - options_.tolerance && least <= options_.reach)) return least;
        DistanceBound<D> bound;
        const DistanceKnown known = function_.bound(box.center, box.half, bound);
        if (known == DistanceKnown::bound) {
            const DVec<D> lowest = core_.lowest(bound.gradient);
            const double bounded =
                bound.value + std::max(dot(bound.gradient, lowest - box.center), -sum_along(bound.gradient, box.half));
            if (std::max(bounded, bound.least) < best.distance - options_.tolerance) {
                const double before = best.distance;
                found(lowest);
                if (here <= before || best.distance < before) go_down(best.point);
            }
            return std::max({least, bounded, bound.least});
        }
        if (known == DistanceKnown::nothing && length(box.half) <= piece_) {
            is_piece = length(box.half) <= least_piece * size_;
            bound = function_.guess(box.center, box.half, function_.at(box.center));
            const DVec<D> lowest = core_.lowest(bound.gradient);
            const double guessed =
                bound.value + std::max(dot(bound.gradient, lowest - box.center), -sum_along(bound.gradient, box.half));
            if (guessed < best.distance - options_.tolerance) go_down(near);
            return std::max(least, guessed);
        }
        return least;
    }

    Least<D> best;

private:
    /// What it is there.
    double found(const DVec<D>& point) {
        const double here = function_.at(point);
        if (here < best.distance) {
            best.distance = here;
            best.point = point;
        }
        return here;
    }

    void go_down(DVec<D> from) {
        if (++ways_down_ > most_ways_down) return;
        double here = function_.at(from);
        for (int i = 0; i < most_steps_down && here > options_.enough; ++i) {
            const DVec<D> gradient = function_.gradient(from, step_);
            if (!(length_squared(gradient) > 0)) return;
            const DVec<D> to_corner = core_.lowest(gradient) - from;
            if (-dot(gradient, to_corner) <= 0.25 * options_.tolerance) return;
            if (!step_down(from, here, [&](double part) { return from + to_corner * part; }) &&
                !step_down(from, here, [&](double part) { return core_.nearest(from - gradient * (part * size_)); }))
                return;
        }
    }
    template <class Place>
    bool step_down(DVec<D>& from, double& here, const Place& place) {
        double part = 1;
        for (int i = 0; i < most_halvings; ++i, part *= 0.5) {
            const DVec<D> there = place(part);
            const double value = found(there);
            if (value < here - 0.1 * options_.tolerance) {
                from = there;
                here = value;
                return true;
            }
        }
        return false;
    }

    bool wanted(double least, double tolerance) const {
        return least < best.distance - tolerance && least <= options_.reach;
    }

    /// Cuts it in two until nothing in it can be less.
    void look_at(CoreSimplex<D> first) {
        for (std::size_t i = 0; i < first.count; ++i) first.values[i] = found(first.points[i]);
        SimplexStack<D> stack;
        stack.push(first);
        while (!stack.empty() && best.distance > options_.enough) {
            CoreSimplex<D> simplex = stack.pop();
            if (!wanted(simplex.least, options_.tolerance)) continue;
            if (best.boxes == options_.most_boxes || stack.full()) {
                best.doubt = std::max({best.doubt, best.distance - std::min(simplex.least, stack.least())});
                return;
            }
            ++best.boxes;
            simplex.least = std::max(simplex.least, least_of(simplex));
            if (!wanted(simplex.least, options_.tolerance)) continue;
            const auto [i, j] = longest_edge(simplex);
            const DVec<D> middle = (simplex.points[i] + simplex.points[j]) * 0.5;
            if (middle == simplex.points[i] || middle == simplex.points[j]) continue;
            const double value = found(middle);
            CoreSimplex<D> beside = simplex;
            simplex.points[i] = beside.points[j] = middle;
            simplex.values[i] = beside.values[j] = value;
            const bool beside_first = beside.values[i] < simplex.values[j];
            stack.push(beside_first ? simplex : beside);
            stack.push(beside_first ? beside : simplex);
        }
    }

    /// What it holds at least, by all that is known of it.
    double least_of(const CoreSimplex<D>& simplex) {
        const DVec<D> middle = middle_of(simplex);
        const double here = found(middle), reach = reach_from(simplex, middle);
        double least = here - function_.slope() * reach;
        if (!wanted(least, options_.tolerance)) return least;
        const SearchBox<D> box = box_around(simplex);
        DistanceBound<D> bound;
        const DistanceKnown known = function_.bound(box.center, box.half, bound);
        if (known == DistanceKnown::bound) {
            least = std::max({least, bound.least, lowest_on(simplex, bound, box.center)});
        } else if (known == DistanceKnown::nothing && reach <= piece_) {
            // Between corners it is about as they are, and dips as it does in the middle.
            double lowest = simplex.values[0], mean = 0;
            for (std::size_t i = 0; i < simplex.count; ++i) {
                lowest = std::min(lowest, simplex.values[i]);
                mean += simplex.values[i] / static_cast<double>(simplex.count);
            }
            const double guessed = std::min(lowest, here) - 2 * std::max(mean - here, 0.0);
            if (!wanted(guessed, guess_tolerance * size_)) return std::numeric_limits<double>::infinity();
            least = std::max(least, guessed);
        } else {
            return least;
        }
        if (here <= best.distance && wanted(least, options_.tolerance)) go_down(middle);
        return least;
    }

    const FunctionThere<D>& function_;
    const Convex<D>& convex_;
    NearestInCore<D> core_;
    LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

/// The bound on looks all around.
constexpr int most_rounds = 48;

template <int D>
class Inside {
public:
    Inside(const FunctionThere<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
           const LeastOptions<D>& options)
        : function_(function), normal_(normal), options_(bounded(options, function.function().bound != nullptr)) {
        const DVec<D> low(bounds.min), high(bounds.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = length(all_.half);
        piece_ = piece_of(function, size_);
        step_ = function.step(all_.center, 0.1 * size_);
    }

    void run() {
        // From below, where the surface is met that most probably is the lowest.
        candidate(all_.center - normal_ * sum_along(normal_, all_.half));
        candidate(all_.center);
        // First roughly, so that what is exact need look at little.
        const double finest = options_.tolerance;
        for (const double rough : {1e-2, 1e-3, 0.0}) {
            options_.tolerance = std::max(rough * size_, finest);
            ways_down_ = 0;
            const int before = best.boxes;
            best.boxes = 0;
            best.doubt = 0;
            look_at_boxes(*this, all_, options_);
            best.boxes += before;
            best.doubt += options_.tolerance;
        }
        if (function_.function().bound == nullptr) look_around();
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        constexpr double nothing = std::numeric_limits<double>::infinity();
        const double lowest = dot(normal_, box.center) - sum_along(normal_, box.half);
        const double here = function_.at(box.center);
        if (here - function_.slope() * length(box.half) > options_.off) return nothing;
        DistanceBound<D> bound;
        const DistanceKnown known = function_.bound(box.center, box.half, bound);
        const bool is_told = known == DistanceKnown::bound;
        const bool is_small = known == DistanceKnown::nothing && length(box.half) <= piece_;
        if (!is_told && !is_small) {
            if (here <= options_.off) look_down(box.center);
            return lowest;
        }
        if (!is_told) bound = function_.guess(box.center, box.half, here);
        if (is_told && std::max(bound.least, bound.value - sum_along(bound.gradient, box.half)) > options_.off)
            return nothing;
        // Of the plane below which the shape is, in the box: for any weight above zero a bound.
        const double square = length_squared(bound.gradient);
        const double weight = square > 0 ? std::max(0.0, -dot(normal_, bound.gradient) / square) : 0;
        const double least = std::max(lowest, dot(normal_, box.center) + weight * (bound.value - options_.off) -
                                                  sum_along(normal_ + bound.gradient * weight, box.half));
        is_piece = is_small && length(box.half) <= least_piece * size_;
        if (least < best.distance - options_.tolerance && square > 0.01) {
            const DVec<D> near = box.center - bound.gradient * (here / square);
            if (here <= options_.off) look_down(box.center);
            if (function_.at(near) <= options_.off) look_down(near);
        }
        return least;
    }

    Least<D> best;

private:
    /// From the lowest place so far to lower ones all around, nearer and nearer: an edge leads nowhere by its gradient.
    void look_around() {
        if (!(best.distance < std::numeric_limits<double>::infinity())) return;
        double stride = 0.1 * size_;
        for (int round = 0; round < most_rounds && stride > 0.1 * options_.tolerance; ++round) {
            const DVec<D> middle = best.point;
            for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
                const DVec<D> next = middle + direction_of(i) * stride;
                if (dot(normal_, next) < best.distance && function_.at(next) <= options_.off) keep(next);
            }
            stride *= best.point == middle ? 0.5 : 1.5;
        }
    }
    /// To the sides, edges and corners of a box.
    static DVec<D> direction_of(int i) {
        DVec<D> result;
        for (int a = 0; a < D; ++a, i /= 3) result[a] = i % 3 - 1;
        return result;
    }

    /// From a place inside, if that is lower than all so far.
    void look_down(const DVec<D>& point) {
        if (dot(normal_, point) < best.distance - options_.tolerance) {
            keep(point);
            candidate(point);
        }
    }
    /// Goes from there to the surface, and down along it.
    void candidate(DVec<D> point) {
        if (++ways_down_ > most_ways_down) return;
        double stride = 0.25 * size_;
        if (!to_surface(point)) return;
        for (int i = 0; i < most_steps_down; ++i) {
            keep(point);
            const DVec<D> gradient = function_.gradient(point, step_);
            const double square = length_squared(gradient);
            if (!(square > 0)) return;
            const DVec<D> along = gradient * (dot(normal_, gradient) / square) - normal_;
            if (length(along) * stride <= 0.1 * options_.tolerance) return;
            DVec<D> next = point + along * stride;
            if (to_surface(next) && dot(normal_, next) < dot(normal_, point) - 0.01 * options_.tolerance)
                point = next;
            else
                stride *= 0.25;
        }
    }
    bool to_surface(DVec<D>& point) const {
        double here = function_.at(point);
        for (int i = 0; i < most_halvings && std::abs(here) > 0.5 * options_.off; ++i) {
            const DVec<D> gradient = function_.gradient(point, step_);
            const double square = length_squared(gradient);
            if (!(square > 0.01) || !std::isfinite(here)) return false;
            point -= gradient * (here / square);
            here = function_.at(point);
        }
        return here <= options_.off;
    }
    void keep(const DVec<D>& point) {
        const double height = dot(normal_, point);
        if (height >= best.distance) return;
        best.distance = height;
        best.point = point;
    }

    const FunctionThere<D>& function_;
    const DVec<D> normal_;
    LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

template <int D>
class OfBoth {
public:
    OfBoth(const FunctionThere<D>& a, const FunctionThere<D>& b, const Aabb<D>& box, double size,
           const LeastOptions<D>& options)
        : a_(a), b_(b), options_(bounded(options, a.function().bound != nullptr && b.function().bound != nullptr)) {
        const DVec<D> low(box.min), high(box.max);
        all_ = {(low + high) * 0.5, (high - low) * 0.5, -std::numeric_limits<double>::infinity()};
        size_ = size;
        slope_ = std::max(a.slope(), b.slope());
        const double known =
            std::min(a.resolution() > 0 ? a.resolution() : size, b.resolution() > 0 ? b.resolution() : size);
        piece_ = known < size ? known : piece * size;
        step_ = std::min(a.step(all_.center, size), b.step(all_.center, size));
    }

    void run() {
        go_down(all_.center);
        look_at_boxes(*this, all_, options_);
        if (best.distance > options_.reach) best.distance = std::numeric_limits<double>::infinity();
    }

    double least_in(const SearchBox<D>& box, bool& is_piece) {
        const double of_a = a_.at(box.center), of_b = b_.at(box.center), here = std::max(of_a, of_b);
        const bool is_best = here < best.distance;
        keep(box.center, here);
        const double falls = slope_ * length(box.half), least = here - falls;
        if (!(least < best.distance - options_.tolerance && least <= options_.reach)) return least;
        DistanceBound<D> bound_a, bound_b;
        const DistanceKnown known_a = a_.bound(box.center, box.half, bound_a),
                            known_b = b_.bound(box.center, box.half, bound_b);
        const bool told_a = known_a == DistanceKnown::bound, told_b = known_b == DistanceKnown::bound;
        const bool both =
            (told_a || known_a == DistanceKnown::nothing) && (told_b || known_b == DistanceKnown::nothing);
        const bool is_small = both && !(told_a && told_b) && length(box.half) <= piece_;
        if (!told_a) bound_a = is_small ? plane_of(a_, box, of_a) : level_at(of_a - falls);
        if (!told_b) bound_b = is_small ? plane_of(b_, box, of_b) : level_at(of_b - falls);
        const auto lowest = [&](const DistanceBound<D>& bound) {
            return std::max(bound.value - sum_along(bound.gradient, box.half), bound.least);
        };
        DistanceBound<D> between;
        between.value = 0.5 * (bound_a.value + bound_b.value);
        between.gradient = (bound_a.gradient + bound_b.gradient) * 0.5;
        const double bounded = std::max({lowest(bound_a), lowest(bound_b), lowest(between)});
        is_piece = is_small && length(box.half) <= least_piece * size_;
        if (is_best && bounded < best.distance - options_.tolerance) go_down(box.center);
        return std::max(least, bounded);
    }

    Least<D> best;

private:
    static DistanceBound<D> level_at(double value) {
        DistanceBound<D> result;
        result.value = value;
        return result;
    }
    DistanceBound<D> plane_of(const FunctionThere<D>& function, const SearchBox<D>& box, double here) const {
        return function.guess(box.center, box.half, here);
    }
    void keep(const DVec<D>& point, double here) {
        if (here >= best.distance) return;
        best.distance = here;
        best.point = point;
    }

    /// To where both fall, or the larger one and the other no more than needed.
    void go_down(DVec<D> from) {
        if (++ways_down_ > most_ways_down) return;
        double of_a = a_.at(from), of_b = b_.at(from), here = std::max(of_a, of_b);
        keep(from, here);
        double stride = std::max(std::abs(here), 0.25 * size_);
        for (int i = 0; i < 2 * most_steps_down && here > options_.enough; ++i) {
            const DVec<D> down_a = a_.gradient(from, step_), down_b = b_.gradient(from, step_);
            // The shortest sum of the two with weights that make one: what it falls along, both fall.
            const DVec<D> apart = down_a - down_b;
            const double square = length_squared(apart);
            const double share = square > 0 ? std::clamp(-dot(down_b, apart) / square, 0.0, 1.0) : 0.5;
            DVec<D> way = down_b + apart * share;
            const double balance = (of_a - of_b) / std::max(square, 1e-12);
            // Where one is larger, first to where they are the same.
            const DVec<D> to_same = apart * -std::clamp(balance, -size_, size_);
            bool moved = false;
            for (int k = 0; k < most_halvings && !moved; ++k, stride *= 0.5) {
                for (const DVec<D>& next :
                     {from + to_same - way * stride, from - (of_a > of_b ? down_a : down_b) * stride}) {
                    const double next_a = a_.at(next), next_b = b_.at(next);
                    if (!(std::max(next_a, next_b) < here - 0.1 * options_.tolerance)) continue;
                    of_a = next_a;
                    of_b = next_b;
                    here = std::max(of_a, of_b);
                    from = next;
                    keep(from, here);
                    moved = true;
                    stride *= 4;
                    break;
                }
            }
            if (!moved) return;
        }
    }

    const FunctionThere<D>&a_, &b_;
    const LeastOptions<D> options_;
    SearchBox<D> all_;
    double size_ = 0, slope_ = 1, piece_ = 0, step_ = 0;
    int ways_down_ = 0;
};

}  // namespace

template <int D>
Least<D> least_in(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options) {
    if (convex.core == Core::points && convex.count == 1 && convex.inner_radius == 0) {
        Least<D> result;
        result.point = convex.place.point(DVec<D>(convex.vertices()[0]));
        const double here = function.at(result.point);
        if (here <= options.reach) result.distance = here;
        return result;
    }
    InConvex<D> search(function, convex, options);
    const Aabb<D>& own = function.function().bounds;
    search.run(function.function().place.point(DVec<D>(center(own))));
    return search.best;
}

template <int D>
Least<D> lowest_inside(const FunctionThere<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                       const LeastOptions<D>& options) {
    Inside<D> search(function, bounds, normal, options);
    search.run();
    return search.best;
}

template <int D>
Least<D> least_of_both(const FunctionThere<D>& a, const FunctionThere<D>& b, const Aabb<D>& box, double size,
                       const LeastOptions<D>& options) {
    OfBoth<D> search(a, b, box, size, options);
    search.run();
    return search.best;
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template Least<D> least_in(const FunctionThere<D>&, const Convex<D>&, const LeastOptions<D>&);                    \
    template Least<D> lowest_inside(const FunctionThere<D>&, const Aabb<D>&, const DVec<D>&, const LeastOptions<D>&); \
    template Least<D> least_of_both(const FunctionThere<D>&, const FunctionThere<D>&, const Aabb<D>&, double,         \
                                    const LeastOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
