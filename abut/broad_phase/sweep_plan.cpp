#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/sweep_plan.hpp>

#include <cmath>
#include <limits>

namespace abut {
namespace {

constexpr std::size_t most_seen = 1024, most_close = 4096;

/// Some of the boxes, and what a plan would make of them.
template <int D>
class Sample {
public:
    /// About sqrt(2 n) boxes, one of each stretch of them: they make n pairs.
    explicit Sample(std::span<const Aabb<D>> boxes) {
        std::size_t wanted = 32;
        while (wanted < most_seen && wanted * wanted < 2 * boxes.size()) wanted += wanted / 4;
        wanted = std::min({wanted, boxes.size(), most_seen});
        for (std::uint64_t i = 0; i < wanted; ++i) {
            const std::uint64_t begin = boxes.size() * i / wanted, end = boxes.size() * (i + 1) / wanted;
            const std::uint64_t somewhere = (i * 0x9E3779B97F4A7C15u) >> 32;
            const Aabb<D> box = usable(boxes[begin + somewhere % (end - begin)]);
            if (!is_empty(box)) boxes_[count_++] = box;
        }
        others_ = 0.5 * static_cast<double>(boxes.size());
    }

    /// The axis along which the fewest pairs overlap.
    int best_axis() const {
        int best = 0;
        std::size_t least = std::numeric_limits<std::size_t>::max();
        for (int axis = 0; axis < D; ++axis) {
            std::array<float, most_seen> min, max;
            for (std::size_t i = 0; i < count_; ++i) {
                min[i] = boxes_[i].min[axis];
                max[i] = boxes_[i].max[axis];
            }
            std::size_t overlapping = 0;
            for (std::size_t i = 0; i < count_; ++i) {
                std::uint32_t these = 0;
                for (std::size_t k = 0; k < i; ++k)
                    these +=
                        static_cast<std::uint32_t>(min[k] <= max[i]) & static_cast<std::uint32_t>(min[i] <= max[k]);
                overlapping += these;
            }
            if (overlapping < least) {
                least = overlapping;
                best = axis;
            }
        }
        return best;
    }

    /// Turns the boxes, and keeps some of the pairs that overlap on axis 0 then: how far they overlap on the others.
    void turn(int axis) {
        for (std::size_t i = 0; i < count_; ++i) boxes_[i] = turned<D>(boxes_[i], axis);
        // Box by box with those so many places behind, so that all are among the first of the pairs.
        for (std::size_t step = 1; step < count_ && close_count_ < most_close; ++step)
            for (std::size_t i = step; i < count_ && close_count_ < most_close; ++i, ++looks_) {
                const Aabb<D>&a = boxes_[i - step], &b = boxes_[i];
                if (a.min[0] > b.max[0] || b.min[0] > a.max[0]) continue;
                Aabb<D>& common = close_[close_count_++];
                for (int k = 0; k < D; ++k) {
                    common.min[k] = std::max(a.min[k], b.min[k]);
                    common.max[k] = std::min(a.max[k], b.max[k]);
                }
            }
    }

    /// The columns that boxes are in, on the average.
    double copies(const SweepPlan<D>& plan) const {
        std::uint64_t result = 0;
        for (std::size_t i = 0; i < count_; ++i) result += columns_of(plan, boxes_[i]);
        return count_ == 0 ? 0 : static_cast<double>(result) / static_cast<double>(count_);
    }

    /// How often a box would be compared with another, on the average.
    double comparisons(const SweepPlan<D>& plan) const {
        std::uint64_t result = 0;
        for (std::size_t i = 0; i < close_count_; ++i) result += columns_of(plan, close_[i]);
        return looks_ == 0 ? 0 : others_ * static_cast<double>(result) / static_cast<double>(looks_);
    }

    /// Between those places of lower bounds that have a 32nd of the boxes on either side, along an axis as turned.
    Parts range(int axis) const {
        if (count_ == 0) return {};
        constexpr float far = 1e37f;
        std::array<float, most_seen> places;
        for (std::size_t i = 0; i < count_; ++i) places[i] = std::clamp(boxes_[i].min[axis], -far, far);
        std::sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count_));
        return {1, places[count_ / 32], places[count_ - 1 - count_ / 32]};
    }

private:
    /// The columns that the box, or the common part of two, is in.
    static std::uint32_t columns_of(const SweepPlan<D>& plan, const Aabb<D>& box) {
        std::uint32_t result = 1;
        for (int k = 1; k < D; ++k) {
            const Parts& parts = plan.parts[static_cast<std::size_t>(k - 1)];
            const std::uint32_t first = parts.at(box.min[k]), behind = parts.at(box.max[k]) + 1;
            result *= behind - std::min(first, behind);
        }
        return result;
    }

    std::size_t count_ = 0, close_count_ = 0, looks_ = 0;
    double others_ = 0;
    std::array<Aabb<D>, most_seen> boxes_;
    std::array<Aabb<D>, most_close> close_;
};

}  // namespace

Parts::Parts(std::uint32_t wanted, float from, float to) {
    if (wanted > 1u << 16 || !(to - from > 0) || !std::isfinite(static_cast<float>(wanted) / (to - from))) return;
    count = wanted;
    low = from;
    high = to;
    scale = static_cast<float>(wanted) / (to - from);
}

template <int D>
SweepPlan<D> plan_sweep(std::span<const Aabb<D>> boxes, std::size_t most_columns, double most_copies) {
    Sample<D> sample(boxes);
    SweepPlan<D> result;
    result.axis = sample.best_axis();
    sample.turn(result.axis);
    double least = sweep_cost(1, sample.comparisons(result));
    // Without any comparison, and with a tenth of the boxes in two columns each: no plan can be better.
    if (least < sweep_cost(1.1, 0)) return result;
    for (int k = 1; k < D; ++k) result.parts[static_cast<std::size_t>(k - 1)] = sample.range(k);
    // Twice as many columns, along the axis where that helps most, as long as it helps.
    for (bool better = true; better;) {
        better = false;
        const SweepPlan<D> last = result;
        for (int k = 1; k < D; ++k) {
            SweepPlan<D> next = last;
            Parts& parts = next.parts[static_cast<std::size_t>(k - 1)];
            parts = Parts(2 * parts.count, parts.low, parts.high);
            const double copies = sample.copies(next);
            if (next.columns() <= last.columns() || next.columns() > most_columns || copies > most_copies) continue;
            const double cost = sweep_cost(copies, sample.comparisons(next));
            if (cost < least) {
                least = cost;
                result = next;
                better = true;
            }
        }
    }
    return result;
}

template SweepPlan<2> plan_sweep(std::span<const Aabb<2>>, std::size_t, double);
template SweepPlan<3> plan_sweep(std::span<const Aabb<3>>, std::size_t, double);

}  // namespace abut
