#pragma once

// The distance of a box from a ray or from another box, and the reach (maximum distance) of the search. For .cpp
// files. All arithmetic is in double.

#include <abut/broad_phase/boxes.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/ray.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {

/// A factor that covers the rounding of a distance, or of the length of a unit direction, to float.
inline constexpr double reach_tolerance = 1 + 1e-6;

/// The part of a ray, or of the path of a moving box, that the search has yet to cover. The measure of a box is the
/// distance along the path at which the ray enters it (slab test; Ericson, Real-Time Collision Detection, 5.3.3).
template <int D>
class RayReach {
public:
    explicit RayReach(const Ray<D>& ray)
        : RayReach(DVec<D>(ray.origin), DVec<D>(ray.origin), DVec<D>(ray.direction), static_cast<double>(ray.length)) {}

    static RayReach of_box(const MovingBox<D>& box) {
        return {box.center - box.half, box.center + box.half, box.direction, box.length};
    }

    double reach() const { return reach_; }
    bool is_exhausted() const { return reach_ < 0; }
    bool within(double measure) const { return measure <= reach_; }
    void shrink(float reach) { reach_ = std::min(reach_, static_cast<double>(reach) * reach_tolerance); }
    double max_measure() const { return reach_; }  ///< the largest measure within reach

    /// The box at the start of the path, a point for a ray, and the direction of the path.
    const DVec<D>& low() const { return low_; }
    const DVec<D>& high() const { return high_; }
    const DVec<D>& direction() const { return direction_; }
    const DVec<D>& inverse() const { return inverse_; }

    /// Returns true and sets `enters` if the ray touches the box within reach. Returns false for an empty box.
    template <class Box>
    bool measure(const Box& box, double& enters) const {
        double from = 0, to = reach_;
        for (int i = 0; i < D; ++i) {
            const double min = static_cast<double>(box.min[i]), max = static_cast<double>(box.max[i]);
            if (direction_[i] == 0) {
                if (!(min <= high_[i] && low_[i] <= max)) return false;
                continue;
            }
            const double at_min = (min - high_[i]) * inverse_[i], at_max = (max - low_[i]) * inverse_[i];
            from = std::max(from, direction_[i] > 0 ? at_min : at_max);
            to = std::min(to, direction_[i] > 0 ? at_max : at_min);
        }
        enters = from;
        // Each bound carries three rounding errors of 1e-16 each; signs are exact.
        return from <= to * (1 + 1e-12);
    }

private:
    RayReach(const DVec<D>& low, const DVec<D>& high, const DVec<D>& direction, double length)
        : low_(low), high_(high), direction_(direction), inverse_(1.0 / direction_) {
        // The doubles come from floats, so no square overflows.
        const bool is_finite = std::isfinite(length_squared(low_) + length_squared(high_) + length_squared(direction_));
        if (is_finite && length >= 0) reach_ = length * reach_tolerance;
    }

    DVec<D> low_, high_, direction_, inverse_;  ///< low and high: the box at the start of the path
    double reach_ = -1;
};

/// The neighbourhood of a box or a point: all that is within reach of it. The measure of another box is the squared
/// distance.
template <int D>
class BoxReach {
public:
    BoxReach(const Aabb<D>& box, float reach) : box_(usable(box)) {
        constexpr float far = std::numeric_limits<float>::infinity();
        bool is_valid = reach >= 0;
        for (int i = 0; i < D; ++i) is_valid = is_valid && box_.min[i] < far && box_.max[i] > -far;
        if (is_valid) reach_squared_ = squared(reach);
    }

    bool is_exhausted() const { return reach_squared_ < 0; }
    bool within(double measure) const { return measure <= reach_squared_; }
    void shrink(float reach) { reach_squared_ = std::min(reach_squared_, squared(reach)); }
    double max_measure() const { return reach_squared_; }  ///< the largest measure within reach
    const Aabb<D>& box() const { return box_; }

    /// Returns true and sets `result` if the box is within reach. An empty box may pass.
    template <class Box>
    bool measure(const Box& box, double& result) const {
        result = 0;
        for (int i = 0; i < D; ++i) {
            // The comparison comes before the subtraction, for both may be infinite.
            double gap = 0;
            if (box.min[i] > box_.max[i])
                gap = static_cast<double>(box.min[i]) - static_cast<double>(box_.max[i]);
            else if (box_.min[i] > box.max[i])
                gap = static_cast<double>(box_.min[i]) - static_cast<double>(box.max[i]);
            result += gap * gap;
        }
        return result <= reach_squared_;
    }

private:
    static double squared(float reach) {
        const double limit = static_cast<double>(reach) * reach_tolerance;
        return reach < 0 ? -1 : limit * limit;
    }

    Aabb<D> box_;
    double reach_squared_ = -1;
};

}  // namespace abut::detail
