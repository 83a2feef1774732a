#pragma once

// Sweeps a box through a structure that has region queries only, by boxes around pieces of the path. For .cpp files.

#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/detail/next_float.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {

/// A box around the moving box from one distance along its path to another, rounded outwards.
template <int D>
Aabb<D> box_around_path(const RayReach<D>& path, double from, double to) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto rounded = [](double number) {
        constexpr double largest_float = std::numeric_limits<float>::max();
        if (std::abs(number) <= largest_float) return static_cast<float>(number);
        return number < 0 ? -infinity : infinity;
    };
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        const double speed = path.direction()[i];
        const double first = speed == 0 ? 0 : speed * from, last = speed == 0 ? 0 : speed * to;
        const double low = path.low()[i] + std::min(first, last), high = path.high()[i] + std::max(first, last);
        // The sum has a rounding error in the last digits of the largest term.
        const double tolerance = 1e-14 * (std::abs(path.low()[i]) + std::abs(path.high()[i]) + std::abs(first));
        result.min[i] = next_down(rounded(low - tolerance));
        result.max[i] = next_up(rounded(high + tolerance));
    }
    return result;
}

/// The path of a moving box through `bounds`, in pieces of equal length. The box around a long diagonal path is huge;
/// the boxes around its pieces are small.
template <int D>
class WayPieces {
public:
    /// A piece is about as long as `edge`, or as the moving box if that is longer. There are at most 64 pieces.
    WayPieces(const MovingBox<D>& moving, const Aabb<D>& bounds, double edge)
        : reach_(RayReach<D>::of_box(moving)), end_(reach_.reach()) {
        if (reach_.is_exhausted() || is_empty(bounds) || !reach_.measure(bounds, begin_)) return;
        double stride = edge, speed = 0;
        for (int i = 0; i < D; ++i) {
            const double inverse = reach_.inverse()[i];
            if (reach_.direction()[i] > 0) end_ = std::min(end_, (at_max(bounds, i) - reach_.low()[i]) * inverse);
            if (reach_.direction()[i] < 0) end_ = std::min(end_, (at_min(bounds, i) - reach_.high()[i]) * inverse);
            stride = std::max(stride, reach_.high()[i] - reach_.low()[i]);
            speed = std::max(speed, std::abs(reach_.direction()[i]));
        }
        const double strides = (end_ - begin_) * speed / stride;
        count_ = strides > 1 && std::isfinite(end_) ? static_cast<int>(std::min(strides, most - 1.0)) + 1 : 1;
    }

    /// Calls overlapping(box, report) for each piece, which calls report(item, its box) for all items that overlap the
    /// box, or until that returns false. Visits each item once, in the piece in which the moving box enters it.
    template <class Overlapping>
    void each(ReachCall visit, const Overlapping& overlapping) {
        for (int piece = 0; piece < count_ && reach_.within(time(piece)); ++piece) {
            const bool is_last = piece + 1 == count_;
            const double from = piece == 0 ? 0 : time(piece);
            const double until = is_last ? std::numeric_limits<double>::infinity() : time(piece + 1);
            overlapping(box_around_path(reach_, time(piece), std::min(until, reach_.reach())),
                        [&](std::uint32_t index, const Aabb<D>& box) -> bool {
                            double enters = 0;
                            // The last piece has the boxes at infinity as well.
                            if (!reach_.measure(box, enters) || enters < from) return true;
                            if (enters >= until && !is_last) return true;
                            reach_.shrink(visit(index));
                            return !reach_.is_exhausted();
                        });
            if (reach_.is_exhausted()) return;
        }
    }

private:
    static constexpr int most = 64;

    static double at_min(const Aabb<D>& box, int axis) { return static_cast<double>(box.min[axis]); }
    static double at_max(const Aabb<D>& box, int axis) { return static_cast<double>(box.max[axis]); }

    /// The first piece begins with the path, even if that is endless.
    double time(int piece) const { return piece == 0 ? begin_ : begin_ + (end_ - begin_) * piece / count_; }

    RayReach<D> reach_;
    double begin_ = 0, end_;
    int count_ = 0;
};

}  // namespace abut::detail
