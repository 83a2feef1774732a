// The layers of a LayeredGrid: chosen by what they would cost, from a sample of the boxes.
//
// Of the sample, T(w, j) is the number of pairs of boxes no longer than 2^j that begin in the same cell of edge w;
// times the square of how many boxes one of the sample stands for, it is that of all boxes. A layer of edge w for the
// boxes of sizes a to b costs about
//   what is written of each box: c, the cells that it touches,
//   T(w, b) - T(w, a) times c * c: each pair of boxes in it, and of those in it with smaller ones, is compared, and
//   a look into it for each smaller box.
// The set of layers that costs least is found by dynamic programming over the sizes.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/layered_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace abut {
namespace {

constexpr std::size_t most_samples = 2048;
constexpr int levels = 24;   // of edges to choose from, each twice the last
constexpr int planned = 12;  // layers at most; the others are for boxes far out

// In nanoseconds, roughly, with vectors of eight; no answer depends on them.
constexpr double cost_of_copy = 6, cost_of_comparing = 0.2, cost_of_cell = 60, cost_of_look = 4;

/// The exponent of the least power of two above x, which is positive.
int exponent(double x) {
    int result = 0;
    std::frexp(x, &result);
    return result;
}

template <int D>
double longest_edge(const Aabb<D>& box) {
    double result = 0;
    for (int i = 0; i < D; ++i)
        result = std::max(result, static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]));
    return result;
}

template <int D>
class Planner {
public:
    using Format = CellFormat<D>;

    explicit Planner(std::span<const Aabb<D>> boxes) {
        const std::size_t stride = std::max<std::size_t>(1, boxes.size() / most_samples);
        std::size_t seen = 0;
        for (std::size_t i = 0; i < boxes.size() && samples_ < most_samples; i += stride, ++seen) {
            const Aabb<D> box = usable(boxes[i]);
            bool bounded = !is_empty(box);
            for (int axis = 0; axis < D; ++axis) bounded = bounded && box.min[axis] > -1e37f && box.max[axis] < 1e37f;
            if (bounded) sample_[samples_++] = box;
        }
        stands_for_ = seen == 0 ? 0.0 : static_cast<double>(boxes.size()) / static_cast<double>(seen);
    }

    LayeredPlan<D> plan() {
        if (samples_ > 0) {
            choose_unit();
            place_samples();
            count_pairs();
            choose_levels();
        } else {
            plan_.offset.fill(LayeredPlan<D>::whole_numbers);
        }
        number_layers();
        return plan_;
    }

private:
    double quantile(double share, int axis) {
        const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(samples_ - 1));
        for (std::size_t i = 0; i < samples_; ++i)
            numbers_[i] = axis < D ? static_cast<double>(sample_[i].min[axis]) : longest_edge(sample_[i]);
        std::nth_element(numbers_.begin(), numbers_.begin() + at,
                         numbers_.begin() + static_cast<std::ptrdiff_t>(samples_));
        return numbers_[static_cast<std::size_t>(at)];
    }

    /// The finest layer that can be of use: by the smaller boxes, unless those are far smaller than the gaps between
    /// them, and not finer than floats are here. What lies far out, or is far larger or smaller than most, has no say.
    void choose_unit() {
        constexpr double tiny = 1e-36;
        const double usual_edge = std::max(quantile(0.5, D), tiny);
        DVec<D> median;
        int sum = -exponent(stands_for_ * static_cast<double>(samples_)), farthest = -150;
        for (int axis = 0; axis < D; ++axis) {
            median[axis] = quantile(0.5, axis);
            const double spread = quantile(0.9, axis) - quantile(0.1, axis);
            sum += exponent(std::max(spread, usual_edge));
            farthest = std::max(farthest, exponent(std::max(std::abs(median[axis]), tiny)));
        }
        const int gap = static_cast<int>(std::floor(static_cast<double>(sum) / D));
        const int small_edge = exponent(std::max(quantile(0.1, D), tiny));
        const int finest = std::clamp(std::max({small_edge, gap - 8, farthest - 24}), -110, 110);
        plan_.scale = std::ldexp(1.0, Format::cell_bits - finest);
        // The middle of the boxes comes to a third of where the numbers of cells end in the finest layer, which is far
        // from the borders of cells in every layer.
        const double third = std::floor(std::ldexp(1.0, Format::coordinate_bits - 1 + Format::cell_bits) / 3);
        for (int axis = 0; axis < D; ++axis)
            plan_.offset[static_cast<std::size_t>(axis)] =
                LayeredPlan<D>::whole_numbers + (third - std::floor(median[axis] * plan_.scale));
    }

    struct Sample {
        std::array<std::int64_t, D> cell;  ///< of the finest level
        std::uint32_t size;                ///< the level whose cells are the first that are large enough
    };

    void place_samples() {
        placed_ = 0;
        for (std::size_t i = 0; i < samples_; ++i) {
            Sample& sample = samples_placed_[placed_];
            std::uint64_t edge = 0, range = 0;
            double edges = 0;
            for (std::size_t axis = 0; axis < D; ++axis) {
                const std::int64_t low = plan_.units(sample_[i].min[static_cast<int>(axis)], axis);
                const std::int64_t high = plan_.units(sample_[i].max[static_cast<int>(axis)], axis);
                sample.cell[axis] = low >> Format::cell_bits;
                edge |= static_cast<std::uint64_t>(high - low);
                edges += static_cast<double>(high - low);
                range |= plan_.magnitude(low) | plan_.magnitude(high);
            }
            sample.size =
                static_cast<std::uint32_t>(std::max(0, static_cast<int>(std::bit_width(edge)) - Format::cell_bits));
            if (range >> Format::range_bits != 0 || sample.size >= levels) continue;
            count_[sample.size] += stands_for_;
            edges_[sample.size] += stands_for_ * edges / D;
            ++placed_;
        }
        // Equal cells may come in any order: what is counted is the same.
        std::sort(samples_placed_.begin(), samples_placed_.begin() + static_cast<std::ptrdiff_t>(placed_),
                  [](const Sample& a, const Sample& b) { return before_on_the_way<D>(a.cell, b.cell); });
    }

    void count_pairs() {
        for (std::size_t level = 0; level < levels; ++level) {
            std::array<std::uint32_t, levels> run{};
            for (std::size_t i = 0; i < placed_; ++i) {
                ++run[samples_placed_[i].size];
                bool last = i + 1 == placed_;
                for (std::size_t axis = 0; axis < D && !last; ++axis)
                    last = samples_placed_[i].cell[axis] >> level != samples_placed_[i + 1].cell[axis] >> level;
                if (!last) continue;
                double so_far = 0;
                for (std::size_t size = 0; size <= level; ++size) {
                    so_far += run[size];
                    pairs_[level][size] += 0.5 * so_far * (so_far - 1) * stands_for_ * stands_for_;
                }
                run.fill(0);
            }
        }
    }

    /// Of a layer for the sizes from `from` up to `to`.
    double cost(std::size_t level, std::size_t from, std::size_t to) const {
        const double edge = std::ldexp(1.0, static_cast<int>(level) + Format::cell_bits);
        double own = 0, finer = 0, copies = 0;
        for (std::size_t size = 0; size < from; ++size) finer += count_[size];
        for (std::size_t size = from; size <= to; ++size) {
            own += count_[size];
            if (count_[size] > 0) copies += count_[size] * power(1 + edges_[size] / count_[size] / edge);
        }
        if (own == 0) return 0;
        const double before = from > 0 ? pairs_[level][from - 1] : 0;
        const double touched = copies / own, pairs = (pairs_[level][to] - before) * touched * touched;
        const double together = 2 * (pairs_[level][to] - before) / (own + finer);
        return cost_of_copy * copies + cost_of_comparing * pairs + cost_of_cell * own / (1 + together) +
               cost_of_look * finer + 1;
    }
    static double power(double x) { return D == 2 ? x * x : x * x * x; }

    void choose_levels() {
        // least[j][e]: of all ways to hold the sizes below j in layers up to level e, of which e is one.
        constexpr double never = std::numeric_limits<double>::infinity();
        std::array<std::array<double, levels>, levels + 1> least;
        std::array<std::array<std::pair<std::uint8_t, std::uint8_t>, levels>, levels + 1> came_from{};
        for (auto& row : least) row.fill(never);
        std::size_t before = 0;  // sizes that nothing has make no difference
        std::array<std::size_t, levels + 1> stops{};
        std::size_t count = 1;
        for (std::size_t size = 0; size < levels; ++size)
            if (count_[size] > 0) stops[count++] = size + 1;
        for (std::size_t t = 1; t < count; ++t)
            for (std::size_t f = 0; f < t; ++f) {
                before = stops[f];
                double best = before == 0 ? 0 : never;  // of the layers below
                std::size_t below = 0;
                for (std::size_t level = 0; level < levels; ++level) {
                    if (level > 0 && before > 0 && least[before][level - 1] < best) {
                        best = least[before][level - 1];
                        below = level - 1;
                    }
                    if (level + 1 < stops[t] || best == never) continue;
                    const double all = best + cost(level, before, stops[t] - 1);
                    if (all < least[stops[t]][level]) {
                        least[stops[t]][level] = all;
                        came_from[stops[t]][level] = {static_cast<std::uint8_t>(before),
                                                      static_cast<std::uint8_t>(below)};
                    }
                }
            }
        std::size_t size = stops[count - 1];
        if (size == 0) return;
        std::size_t level =
            static_cast<std::size_t>(std::min_element(least[size].begin(), least[size].end()) - least[size].begin());
        while (size > 0) {
            chosen_[level] = true;
            std::tie(size, level) = came_from[size][level];
        }
    }

    void number_layers() {
        const auto wanted = std::count(chosen_.begin(), chosen_.end(), true);
        long seen = 0;
        // Where there are too many, every other of the finer ones does with the next.
        for (std::size_t level = 0; level < levels; ++level) {
            if (!chosen_[level]) continue;
            if (++seen % 2 == 1 && seen < 2 * (wanted - planned)) continue;
            add_layer(level);
        }
        if (plan_.layers == 0) add_layer(0);
        // And a few more for what lies so far out that its number in a finer layer would be too large, or is larger
        // than all of the sample.
        constexpr std::size_t last = 22, step = 7;
        static_assert(last + Format::cell_bits + Format::coordinate_bits - 1 >= Format::range_bits);
        while (plan_.shift[plan_.layers - 1] < last) add_layer(std::min(plan_.shift[plan_.layers - 1] + step, last));
        static_assert(planned + (last + step - 1) / step <= most_layers);
        for (std::size_t bits = 0; bits <= 64; ++bits) {
            std::uint32_t size = 0, place = 0;
            while (size < plan_.layers && bits > plan_.shift[size] + std::size_t{Format::cell_bits}) ++size;
            while (place < plan_.layers &&
                   bits > plan_.shift[place] + std::size_t{Format::cell_bits + Format::coordinate_bits - 1})
                ++place;
            plan_.layer_of_size[bits] = static_cast<std::uint8_t>(size);
            plan_.layer_of_place[bits] = static_cast<std::uint8_t>(place);
        }
    }
    void add_layer(std::size_t level) { plan_.shift[plan_.layers++] = static_cast<std::uint8_t>(level); }

    std::array<Aabb<D>, most_samples> sample_;
    std::array<Sample, most_samples> samples_placed_;
    std::array<double, most_samples> numbers_;
    std::size_t samples_ = 0, placed_ = 0;
    double stands_for_ = 0;
    std::array<double, levels> count_{}, edges_{};  ///< boxes of each size, and the sum of their edges in units
    std::array<std::array<double, levels>, levels> pairs_{};
    std::array<bool, levels> chosen_{};
    LayeredPlan<D> plan_;
};

}  // namespace

template <int D>
LayeredPlan<D> plan_layers(std::span<const Aabb<D>> boxes) {
    return Planner<D>(boxes).plan();
}

template LayeredPlan<2> plan_layers(std::span<const Aabb<2>>);
template LayeredPlan<3> plan_layers(std::span<const Aabb<3>>);

}  // namespace abut
